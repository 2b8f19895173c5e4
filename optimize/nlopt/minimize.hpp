#pragma once
// Minimisation within bounds, by any algorithm of NLopt:
//
//   minimise f(x) over lower <= x <= upper such that c_k(x) <= 0
//
//   auto result = minimize({.objective = [](auto x, auto g) { if (!g.empty()) g[0] = 2 * x[0]; return x[0] *
//   x[0]; },
//                           .lower = {-1}, .upper = {2}}, {1.5});

#include <arcslip/optimize/nlopt/reason.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace arcslip::optimize {

// The algorithms of NLopt, by their own names.

inline constexpr const char* default_algorithm = "LD_SLSQP";

/// Bad input: sizes that do not match, bounds that are reversed or equal, an unknown algorithm, a negative
/// tolerance, an algorithm that does not take what was given. The message has the numbers, and what is
/// allowed.
class OptionsError : public std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// What an algorithm takes. The name begins with L (local) or G (global), then N (no gradient) or D
/// (gradient).
struct Algorithm {
  std::string name;          // "LD_SLSQP"
  int code = 0;              // nlopt_algorithm
  bool global = false;       // needs finite bounds
  bool needs_local = false;  // searches only through Options::local
  bool takes_local = false;  // AUGLAG and MLSL
  bool takes_constraints = false;
};

/// All algorithms of the NLopt at hand; those that it was built without are left out.
std::vector<Algorithm> algorithms();

/// Throws OptionsError, with the nearest name and the known ones, where there is none of that name.
Algorithm algorithm(const std::string& name);

/// f(x). Where `gradient` is not empty it has as many entries as x, and df/dx_i is to be written into each.
/// Algorithms with an N as their second letter never ask for it, those with a D at most of their calls. It
/// may throw: the run then ends with reason objective_failed, or, of Interrupted, user.
using Function = std::function<double(std::span<const double> x, std::span<double> gradient)>;

/// c(x) <= 0. Values up to `tolerance` count as satisfied.
struct Constraint {
  std::string name;
  Function function;
  double tolerance = 1e-8;  // >= 0, in the unit of c
};

/// Bounds may be infinite for local algorithms. lower < upper in every variable.
/// An objective of +infinity says that x is outside the domain; algorithms then see a value above all the
/// others.
struct Problem {
  Function objective;
  std::vector<double> lower, upper;
  std::vector<Constraint> constraints{};
};

/// A step that is smaller than one of these ends the run. All >= 0; 0: not looked at.
struct Tolerances {
  double x_relative = 1e-8;   // |dx| <= x_relative |x|
  double x_absolute = 0;      // |dx_i| <= x_absolute for every i
  double f_relative = 1e-12;  // |df| <= f_relative |f|
  double f_absolute = 0;      // |df| <= f_absolute
};

/// The algorithm that AUGLAG and MLSL call for each of their local searches.
struct LocalOptions {
  std::string algorithm;
  Tolerances tolerances{};
  int evaluations = 0;  // in each local search; 0: no limit but that of the whole run
};

struct Progress {
  long evaluations = 0;       // calls of the objective so far
  std::span<const double> x;  // of the last call
  double value = 0;           // of the last call
  double best = 0;            // least value so far where all constraints hold; infinity if there is none
};

struct Options {
  std::string algorithm{default_algorithm};  // by NLopt's own name, see algorithms()
  Tolerances tolerances{};
  int evaluations = 10000;                                   // calls of the objective, >= 1
  double seconds = 0;                                        // >= 0; 0: no limit
  double target = -std::numeric_limits<double>::infinity();  // a value that is good enough
  int population = 0;      // of the stochastic algorithms; 0: the algorithm's own choice
  unsigned long seed = 1;  // of the stochastic algorithms: the same seed gives the same run
  std::optional<LocalOptions> local{};
  std::function<bool(const Progress&)>
      progress{};  // told after every call of the objective; false stops the run
};

struct Result {
  std::vector<double> x;  // best point: least excess of the constraints, then least value; may be empty
  double value =
      std::numeric_limits<double>::infinity();  // f(x); infinity, and x empty, where no evaluation succeeded
  bool feasible = false;                        // all constraints hold at x, within their tolerances
  long evaluations = 0;                         // calls of the objective
  double seconds = 0;
  Reason reason = Reason::failed;
  std::string message;             // the reason as one sentence, with its numbers
  std::string cause;               // the beginning of it, without the evaluations and what was best
  std::vector<std::string> notes;  // what was changed in the input: a start that was moved into the bounds
};

/// Runs from `start`; outside the bounds it is moved onto them. Throws OptionsError, and nothing else of its
/// own; whatever the objective throws becomes a reason. Any number of threads may call it at once.
Result minimize(const Problem& problem, std::vector<double> start, const Options& options = {});

}  // namespace arcslip::optimize
