#pragma once
// The algorithms of NLopt, by their own names.

#include <stdexcept>
#include <string>
#include <vector>

namespace arcslip::optimize {

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

}  // namespace arcslip::optimize
