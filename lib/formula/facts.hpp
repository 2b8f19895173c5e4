#pragma once
// What can be said of a formula from its text alone.

#include <arcslip/formula/formula.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace arcslip::formula {

/// What an input is for the facts below.
enum class Role {
  constant,  // as a parameter
  motion,    // changes its sign with the motion: a displacement, a velocity
  phase      // an angle, by which the value is periodic
};

/// The degree of a polynomial in all inputs of the motion, whose coefficients are sums of cosines and sines
/// of whole multiples of the phase, `orders` the highest of them.
struct Degree {
  int motion = 0, orders = 0;
  friend bool operator==(const Degree&, const Degree&) = default;
};
/// Whether a polynomial may be another one on either side of a kink or jump.
enum class Pieces { one, several };
/// Of one expression, the largest of its pieces; none: it is no such polynomial. roles: of the inputs.
std::optional<Degree> degree(const Formula& formula, std::size_t expression, std::span<const Role> roles,
                             Pieces pieces = Pieces::one);

/// How an expression changes where all inputs of the motion change their signs, and the others do not.
enum class Parity { neither, even, odd, zero };
/// Where it says odd or even the expression is; of others it may say neither.
Parity parity(const Formula& formula, std::size_t expression, std::span<const Role> roles);

/// What changes its sign where a formula has kinks or jumps: the arguments of abs and sign, and the
/// differences of what min, max and comparisons compare, as far as they vary.
Formula switches(const Formula& formula, std::span<const Role> roles);
/// Whether it may jump at such a place: by sign, a comparison or if().
bool may_jump(const Formula& formula, std::span<const Role> roles);

/// The coefficients of one expression as a polynomial of one input, from that of power 0; none: it is none,
/// or of a degree above largest_whole_power. values: of the other inputs.
std::optional<std::vector<double>> polynomial(const Formula& formula, std::size_t expression, int input,
                                              std::span<const double> values);

}  // namespace arcslip::formula
