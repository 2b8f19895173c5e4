// What the analyses ask of a law's force away from the motion at hand. Of polynomials of the displacement it
// follows from their coefficients, else from values at some displacements.

#include <arcslip/formula/facts.hpp>
#include <arcslip/laws/memoryless/formula_law.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace arcslip::elements {
namespace {

constexpr double far = 1e8, nearer = 1e6;  // amplitudes, of laws that are no polynomials
constexpr double same_growth = 1.5;        // of two works over their amplitudes: they do not grow
constexpr int instants = 8;                // of a period, of laws that depend on the phase
constexpr int places = 32;                 // between 0 and the reach
constexpr double least_probe = 1e-12, largest_probe = 1e6;  // m
constexpr double settled = 1e-13;
constexpr int most_parts_of_integral = 1 << 12;

// Nodes and weights of Gauss and Legendre on [-1, 1], of which each stands for two.
constexpr std::array<std::pair<double, double>, 4> gauss = {{{0.1834346424956498, 0.3626837833783620},
                                                             {0.5255324099163290, 0.3137066458778873},
                                                             {0.7966664774136267, 0.2223810344533745},
                                                             {0.9602898564975363, 0.1012285362903763}}};

// Over [from, to] in equal panels.
template <class Function>
double integral(Function f, double from, double to, int panels) {
  const double half = 0.5 * (to - from) / panels;
  double sum = 0;
  for (int k = 0; k < panels; ++k) {
    const double middle = from + (2 * k + 1) * half;
    for (const auto& [node, weight] : gauss)
      sum += weight * (f(middle - half * node) + f(middle + half * node));
  }
  return half * sum;
}

// The work of f(q, v) on q = cos theta, v = -sin theta of an amplitude, over it: what is dissipated.
template <class Function>
double work_over(Function force, double amplitude) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  double sum = 0;
  for (int k = 0; k < 4; ++k)
    sum += integral(
        [&](double theta) {
          const double v = -std::sin(theta);
          return force(amplitude * std::cos(theta), amplitude * v) * v;
        },
        k * quarter, (k + 1) * quarter, 4);
  return sum;
}

// The last power with a coefficient.
std::size_t power_of(const std::vector<double>& polynomial) {
  std::size_t power = polynomial.size() - 1;
  while (power > 0 && polynomial[power] == 0) --power;
  return power;
}

bool has_odd_power(const std::vector<double>& polynomial) {
  for (std::size_t n = 1; n < polynomial.size(); n += 2)
    if (polynomial[n] != 0) return true;
  return false;
}

using Force = std::function<double(double q, double v)>;

// Displacements or velocities of all sizes, to either side.
template <class Function>
bool any_of_probes(Function function) {
  for (double probe = least_probe; probe <= largest_probe; probe *= 10)
    if (function(probe) || function(-probe)) return true;
  return false;
}

// To either side of rest, in opposite directions.
bool holds_mean(const Force& force) {
  const double rest = force(0, 0);
  return any_of_probes([&](double q) { return (force(q, 0) - rest) * (force(-q, 0) - rest) < 0; });
}

// The largest force of some displacements, since it may go to and fro.
double far_power(const Force& force) {
  const auto largest = [&](double around) {
    double most = 0;
    for (int k = 0; k < places; ++k)
      for (const double sign : {-1.0, 1.0})
        most = std::max(most, std::abs(force(sign * around * (1 + k / (places + 1.0)), 0)));
    return most;
  };
  const double low = largest(nearer), high = largest(far);
  if (!std::isfinite(high)) return infinity;
  return low > 0 ? std::max(std::log(high / low) / std::log(far / nearer), 0.0) : 0;
}

double far_work(const Force& force) {
  const double low = work_over(force, nearer), high = work_over(force, far);
  if (std::isnan(high)) return infinity;
  if (!(high > 0)) return 0;
  return std::isinf(high) || high > same_growth * std::abs(low) ? infinity : high;
}

// Whether some motion is fed: where the damping at rest is negative, or the force is with the velocity.
template <class Damping>
bool feeds(const Force& force, Damping damping, bool elastic) {
  if (any_of_probes([&](double v) { return damping(v) < 0; })) return true;
  const double rest = force(0, 0);
  return elastic && any_of_probes([&](double v) { return (force(0, v) - rest) * v < 0; });
}

}  // namespace

std::optional<std::vector<double>> FormulaLaw::polynomial(Fields fields) const {
  if (inputs_.directions > 1 || phase_dependent_) return {};
  std::vector<double> values(static_cast<std::size_t>(inputs_.count()));
  for (int k = 0; k < inputs_.fields; ++k)
    values[static_cast<std::size_t>(inputs_.field(k))] = fields[static_cast<std::size_t>(k)];
  return formula::polynomial(formula_, 0, inputs_.displacement(0), values);
}

bool FormulaLaw::uses_displacement(int direction) const {
  return formula_.uses(inputs_.displacement(direction));
}

// Of a force that is a field times the displacement.
int FormulaLaw::stiffness_field(Fields fields) const {
  const auto nodes = formula_.nodes();
  if (inputs_.directions > 1 || nodes.size() != 3 || nodes[2].operation != formula::Operation::multiply)
    return -1;
  for (int k = 0; k < inputs_.fields; ++k)
    if (formula_.uses(inputs_.field(k)) && formula_.uses(inputs_.displacement(0)) &&
        fields[static_cast<std::size_t>(k)] > 0)
      return k;
  return -1;
}

Traits FormulaLaw::traits(Fields fields, int direction) const {
  std::vector<double> motion(static_cast<std::size_t>(inputs_.phase() + 1));
  double& q = motion[static_cast<std::size_t>(inputs_.displacement(direction))];
  double& v = motion[static_cast<std::size_t>(inputs_.velocity(direction))];
  const Force at = [&](double at_q, double at_v) {
    q = at_q;
    v = at_v;
    return force(fields, direction, motion);
  };
  Traits all;
  const auto coefficients = polynomial(fields);
  const std::size_t power = coefficients ? power_of(*coefficients) : 0;
  const bool linear = coefficients ? power < 2 : degree_ && degree_->motion < 2,
             elastic = uses_displacement(direction);
  if (coefficients) {
    all.holds_mean = has_odd_power(*coefficients);
    all.far_power = static_cast<double>(power);
  } else if (elastic) {
    all.holds_mean = holds_mean(at);
    if (all.holds_mean) all.far_power = far_power(at);
  }
  all.stiffness_field = stiffness_field(fields);
  if (elastic) all.stiffness = linear ? stiffness(fields, direction, 0) : infinity;
  if (rate_dependent_) all.far_work = far_work(at);
  const auto damping = [&](double at_v) {
    q = 0;
    v = at_v;
    return derivative(fields, direction, motion, inputs_.velocity(direction));
  };
  all.several_responses = (elastic && (!linear || (rate_dependent_ && !degree_))) ||
                          (rate_dependent_ && feeds(at, damping, elastic));
  return all;
}

double FormulaLaw::stiffness(Fields fields, int direction, double reach) const {
  if (const auto coefficients = polynomial(fields)) {
    double sum = 0;
    for (std::size_t n = 1; n < coefficients->size(); ++n)
      if (const double c = (*coefficients)[n]; c != 0)
        sum += static_cast<double>(n) * std::abs(c) * std::pow(reach, static_cast<double>(n) - 1);
    return sum;
  }
  std::vector<double> motion(static_cast<std::size_t>(inputs_.phase() + 1));
  double largest = 0;
  // The sum of a row, which bounds the eigenvalues of a symmetric one.
  const auto look = [&] {
    double sum = 0;
    for (int j = 0; j < inputs_.directions; ++j)
      sum += std::abs(derivative(fields, direction, motion, inputs_.displacement(j)));
    if (std::isfinite(sum)) largest = std::max(largest, sum);
  };
  for (int instant = 0; instant < (phase_dependent_ ? instants : 1); ++instant) {
    motion.back() = instant * whole_turn / instants;
    for (int k = 0; k <= (reach > 0 ? places : 0); ++k)
      for (const double sign : {-1.0, 1.0}) {
        // All displacements to the same side, or to the sides by turns.
        for (const double next : {1.0, -1.0}) {
          double side = sign * reach * k / places;
          for (int j = 0; j < inputs_.directions; ++j, side *= next)
            motion[static_cast<std::size_t>(inputs_.displacement(j))] = side;
          look();
          if (inputs_.directions == 1) break;
        }
        if (reach == 0) break;
      }
  }
  return largest;
}

std::optional<std::vector<Automaton>> FormulaLaw::automata(Fields fields) const {
  const auto coefficients = potential_ ? polynomial(fields) : std::nullopt;
  if (!coefficients || power_of(*coefficients) > 1) return {};
  Automaton spring(-1);
  spring.add("linear", coefficients->size() > 1 ? (*coefficients)[1] : 0, 0, coefficients->front());
  return std::vector{spring};
}

double FormulaLaw::stored(Fields fields, In q, In) const {
  if (inputs_.directions > 1 || phase_dependent_ || !uses_displacement(0)) return 0;
  if (const auto coefficients = polynomial(fields)) {
    double sum = 0, power = q[0];
    for (std::size_t n = 0; n < coefficients->size(); ++n, power *= q[0])
      sum += (*coefficients)[n] * power / (static_cast<double>(n) + 1);
    return sum;
  }
  const auto at = [&](double x) { return force(fields, 0, std::array{x, 0.0, 0.0}); };
  double last = integral(at, 0, q[0], 1);
  for (int panels = 2; panels <= most_parts_of_integral; panels *= 2) {
    const double next = integral(at, 0, q[0], panels);
    if (std::abs(next - last) <= settled * std::abs(next)) return next;
    last = next;
  }
  return last;
}

}  // namespace arcslip::elements
