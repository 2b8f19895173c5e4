// What the analyses ask of a law's force away from the motion at hand. Of polynomials of the displacement it
// follows from their coefficients, else from values at some displacements.

#include <arcslip/laws/sampled_law.hpp>

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
constexpr double settled = 1e-13, same_slope = 1e-12;
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

bool has_odd_power(const std::vector<double>& polynomial) {
  for (std::size_t n = 1; n < polynomial.size(); n += 2)
    if (polynomial[n] != 0) return true;
  return false;
}

// The force along a direction by its displacement and velocity, with the displacements along the others.
using Force = std::function<double(double q, double v, double others)>;

// Displacements or velocities of all sizes, to either side.
template <class Function>
bool any_of_probes(Function function) {
  for (double probe = least_probe; probe <= largest_probe; probe *= 10)
    if (function(probe) || function(-probe)) return true;
  return false;
}

// To either side of rest, in opposite directions, wherever the others are.
bool holds_mean(const Force& force) {
  return any_of_probes([&](double q) {
    for (const double others : {0.0, q})
      if (const double rest = force(0, 0, others);
          (force(q, 0, others) - rest) * (force(-q, 0, others) - rest) < 0)
        return true;
    return false;
  });
}

// The largest force of some displacements, since it may go to and fro.
double far_power(const Force& force) {
  const auto largest = [&](double around) {
    double most = 0;
    for (int k = 0; k < places; ++k)
      for (const double sign : {-1.0, 1.0}) {
        const double q = sign * around * (1 + k / (places + 1.0));
        for (const double others : {0.0, q}) most = std::max(most, std::abs(force(q, 0, others)));
      }
    return most;
  };
  const double low = largest(nearer), high = largest(far);
  if (!std::isfinite(high)) return infinity;
  return low > 0 ? std::max(std::log(high / low) / std::log(far / nearer), 0.0) : 0;
}

double far_work(const Force& force) {
  const auto alone = [&](double q, double v) { return force(q, v, 0); };
  const double low = work_over(alone, nearer), high = work_over(alone, far);
  if (std::isnan(high)) return infinity;
  if (!(high > 0)) return 0;
  return std::isinf(high) || high > same_growth * std::abs(low) ? infinity : high;
}

// Whether some motion is fed: where the damping at rest is negative, or the force is with the velocity.
template <class Damping>
bool feeds(const Force& force, Damping damping, bool elastic) {
  if (any_of_probes([&](double v) { return damping(v) < 0; })) return true;
  const double rest = force(0, 0, 0);
  return elastic && any_of_probes([&](double v) { return (force(0, v, 0) - rest) * v < 0; });
}

}  // namespace

SampledLaw::Shape SampledLaw::shape(Fields fields, int direction) const {
  ForceProbe probe(*this, fields);
  const double rest = probe.tangent().f_q(0, direction * directions() + direction);
  bool elastic = rest != 0, linear = true;
  const auto look = [&] {
    const double slope = probe.tangent().f_q(0, direction * directions() + direction);
    elastic = elastic || slope != 0;
    linear = linear && std::abs(slope - rest) <= same_slope * std::abs(rest);
  };
  any_of_probes([&](double q) {  // alone, with the others, and against them
    for (const double others : {0.0, q, -q}) {
      probe.q.setConstant(others);
      probe.q(0, direction) = q;
      look();
      if (directions() == 1) break;
    }
    return false;
  });
  return {elastic, linear, true, {}};
}

Traits SampledLaw::traits(Fields fields, int direction) const {
  ForceProbe probe(*this, fields);
  const Force at = [&](double q, double v, double others) {
    probe.q.setConstant(others);
    probe.q(0, direction) = q;
    probe.v(0, direction) = v;
    return probe.force().f(0, direction);
  };
  const Shape of = shape(fields, direction);
  Traits all;
  if (of.polynomial) {
    all.holds_mean = has_odd_power(*of.polynomial);
    all.far_power = static_cast<double>(of.polynomial->size()) - 1;
  } else if (of.elastic) {
    all.holds_mean = holds_mean(at);
    if (all.holds_mean) all.far_power = far_power(at);
  }
  if (of.elastic) all.stiffness = of.linear ? stiffness(fields, direction, 0) : infinity;
  if (rate_dependent()) all.far_work = far_work(at);
  const auto damping = [&](double v) {
    probe.q.setZero();
    probe.v(0, direction) = v;
    return probe.tangent().f_v(0, direction * directions() + direction);
  };
  all.several_responses = (of.elastic && (!of.linear || (rate_dependent() && !of.smooth_rates))) ||
                          (rate_dependent() && feeds(at, damping, of.elastic));
  return all;
}

double SampledLaw::stiffness(Fields fields, int direction, double reach) const {
  if (const auto coefficients = shape(fields, direction).polynomial) {
    double sum = 0;
    for (std::size_t n = 1; n < coefficients->size(); ++n)
      if (const double c = (*coefficients)[n]; c != 0)
        sum += static_cast<double>(n) * std::abs(c) * std::pow(reach, static_cast<double>(n) - 1);
    return sum;
  }
  ForceProbe probe(*this, fields);
  double largest = 0;
  // The sum of a row, which bounds the eigenvalues of a symmetric one.
  const auto look = [&] {
    const SampledForce& sample = probe.tangent();
    double sum = 0;
    for (int j = 0; j < directions(); ++j) sum += std::abs(sample.f_q(0, j * directions() + direction));
    if (std::isfinite(sum)) largest = std::max(largest, sum);
  };
  for (int instant = 0; instant < (phase_dependent() ? instants : 1); ++instant) {
    probe.phase[0] = instant * whole_turn / instants;
    for (int k = 0; k <= (reach > 0 ? places : 0); ++k)
      for (const double sign : {-1.0, 1.0}) {
        // All displacements to the same side, or to the sides by turns.
        for (const double next : {1.0, -1.0}) {
          double side = sign * reach * k / places;
          for (int j = 0; j < directions(); ++j, side *= next) probe.q(0, j) = side;
          look();
          if (directions() == 1) break;
        }
        if (reach == 0) break;
      }
  }
  return largest;
}

double SampledLaw::stored(Fields fields, In q) const {
  if (phase_dependent() || (directions() > 1 && dissipative())) return 0;
  if (directions() == 1) {
    const Shape of = shape(fields, 0);
    if (!of.elastic) return 0;
    if (of.polynomial) {
      double sum = 0, power = q[0];
      for (std::size_t n = 0; n < of.polynomial->size(); ++n, power *= q[0])
        sum += (*of.polynomial)[n] * power / (static_cast<double>(n) + 1);
      return sum;
    }
  }
  // Along the line to q.
  ForceProbe probe(*this, fields);
  const auto at = [&](double share) {
    probe.q = share * q.transpose();
    return probe.force().f.row(0).dot(q);
  };
  double last = integral(at, 0, 1, 1);
  for (int panels = 2; panels <= most_parts_of_integral; panels *= 2) {
    const double next = integral(at, 0, 1, panels);
    if (std::abs(next - last) <= settled * std::abs(next)) return next;
    last = next;
  }
  return last;
}

}  // namespace arcslip::elements
