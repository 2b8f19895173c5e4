#pragma once
// Constrained minimization within bounds, by any algorithm of NLopt:
//
//   minimize f(x) over lower <= x <= upper subject to c_k(x) <= 0
//
//   const auto square = [](auto x, auto g) { if (!g.empty()) g[0] = 2 * x[0]; return x[0] * x[0]; };
//   auto result = minimize({.objective = square, .lower = {-1}, .upper = {2}}, {1.5});

#include <arcslip/control/error.hpp>
#include <arcslip/optimize/nlopt/reason.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

// The algorithms of NLopt, by name.

inline constexpr const char* default_algorithm = "LD_SLSQP";

/// Invalid input: inconsistent sizes, reversed or equal bounds, an unknown algorithm, a negative tolerance,
/// an algorithm that does not support the problem. The message has the values found and allowed.
class OptionsError : public Error {
  using Error::Error;
};

/// Properties of an algorithm. The name starts with L (local) or G (global), then N (derivative-free) or
/// D (gradient-based).
struct Algorithm {
  std::string name;          // "LD_SLSQP"
  int code = 0;              // nlopt_algorithm
  bool global = false;       // needs finite bounds
  bool needs_local = false;  // requires MinimizeOptions::local
  bool takes_local = false;  // AUGLAG and MLSL
  bool takes_constraints = false;
};

/// All algorithms that this build of NLopt provides.
std::vector<Algorithm> algorithms();

/// Throws OptionsError, with the nearest name and the list, for an unknown name.
Algorithm algorithm(const std::string& name);

/// f(x). If `gradient` is not empty it has the size of x and must be set to df/dx_i. Algorithms with N as
/// second letter never request it, those with D in most calls. Exceptions end the run with reason
/// objective_failed, or user for Interrupted.
using Function = std::function<double(std::span<const double> x, std::span<double> gradient)>;

/// c(x) <= 0. Values up to `tolerance` count as satisfied.
struct Constraint {
  std::string name;
  Function function;
  double tolerance = 1e-8;  // >= 0, in the unit of c
};

/// Bounds may be infinite for local algorithms. lower < upper in every variable. An objective of +infinity
/// means that x is outside the domain; algorithms then see a value above all others.
struct NonlinearProgram {
  Function objective;
  std::vector<double> lower, upper;
  std::vector<Constraint> constraints{};
};

/// A step smaller than one of these ends the run. All >= 0; 0: disabled.
struct Tolerances {
  double x_relative = 1e-8;   // |dx| <= x_relative |x|
  double x_absolute = 0;      // |dx_i| <= x_absolute for every i
  double f_relative = 1e-12;  // |df| <= f_relative |f|
  double f_absolute = 0;      // |df| <= f_absolute
};

/// The local algorithm of AUGLAG and MLSL.
struct LocalOptions {
  std::string algorithm;
  Tolerances tolerances{};
  int evaluations = 0;  // in each local search; 0: only the limit of the whole run
};

struct MinimizeProgress {
  long evaluations = 0;       // calls of the objective so far
  std::span<const double> x;  // of the last call
  double value = 0;           // of the last call
  double best = 0;            // lowest feasible value so far; infinity if there is none
};

struct MinimizeOptions {
  std::string algorithm{default_algorithm};  // NLopt name, see algorithms()
  Tolerances tolerances{};
  int evaluations = 10000;                                   // calls of the objective, >= 1
  double seconds = 0;                                        // >= 0; 0: no limit
  double target = -std::numeric_limits<double>::infinity();  // stops at a feasible value this low
  int population = 0;      // of stochastic algorithms; 0: the algorithm's default
  unsigned long seed = 1;  // of stochastic algorithms: the same seed gives the same run
  std::optional<LocalOptions> local{};
  std::function<bool(const MinimizeProgress&)>
      progress{};  // called after every call of the objective; false stops the run
};

struct MinimizeResult {
  std::vector<double> x;  // best point: least constraint violation, then lowest value; may be empty
  /// f(x); infinity, and x empty, if no evaluation succeeded.
  double value = std::numeric_limits<double>::infinity();
  bool feasible = false;  // all constraints hold at x, within their tolerances
  long evaluations = 0;   // calls of the objective
  double seconds = 0;
  MinimizeReason reason = MinimizeReason::failed;
  std::string message;             // the reason as one sentence, with its numbers
  std::string cause;               // the first part of it, without evaluations and best value
  std::vector<std::string> notes;  // changes of the input: a start moved into the bounds
};

/// Minimizes from `start`, which is projected onto the bounds. Throws only OptionsError; exceptions of the
/// objective become a reason. Thread-safe.
MinimizeResult minimize(const NonlinearProgram& problem, std::vector<double> start,
                        const MinimizeOptions& options = {});

}  // namespace arcslip::optimize
