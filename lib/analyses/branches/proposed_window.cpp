#include <arcslip/analyses/branches/proposed_window.hpp>

#include <arcslip/analyses/branches/resonances.hpp>
#include <arcslip/results/text.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace arcslip::observables {
namespace {

using continuation::Vector;
using Complex = std::complex<double>;

constexpr double third = 3;  // bandwidths from a resonance, where it has fallen to a third
constexpr double least_margin = 0.05, most_margin = 0.5;
constexpr int digits_of_end = 3, digits_reported = 5;
constexpr int most_balances = 60;        // between amplitude and stiffness
constexpr double balanced = 1e-3;        // change of a frequency
constexpr double most_stiffening = 100;  // of a frequency by springs that stiffen

/// The first resonance; omega = 0: none is known.
struct FirstResonance {
  double omega = 0, damping_ratio = 0;
};

FirstResonance first_of(const std::vector<ModeAtRest>& modes) {
  for (const ModeAtRest& mode : modes)
    if (mode.responds && mode.driven) return {mode.omega, mode.damping_ratio};
  return {};
}

/// Both states; where one has no resonance, that of the other.
struct FreeAndStuck {
  FirstResonance free, stuck;
};

FreeAndStuck both_at(const model::Model& model, const Vector& p) {
  const Resonances all = resonances(model, p, many_dofs);
  FreeAndStuck both{first_of(all.free), first_of(all.stuck)};
  if (both.stuck.omega == 0) both.stuck = both.free;
  if (both.free.omega == 0) both.free = both.stuck;
  return both;
}

/// p with each parameter at the end of its range that lowers the resonance, and that raises it.
std::pair<Vector, Vector> lowest_and_highest(const model::Model& model, const Vector& p,
                                             const std::vector<ValuesTaken>& ranges) {
  Vector lowest = p, highest = p;
  for (const ValuesTaken& range : ranges) {
    if (range.parameter == "frequency") continue;
    const int k = model::parameter_index(model, range.parameter);
    Vector at_lower = p, at_upper = p;
    at_lower[k] = range.lower;
    at_upper[k] = range.upper;
    const FreeAndStuck lower = both_at(model, at_lower), upper = both_at(model, at_upper);
    lowest[k] = lower.free.omega <= upper.free.omega ? range.lower : range.upper;
    highest[k] = lower.stuck.omega >= upper.stuck.omega ? range.lower : range.upper;
  }
  return {lowest, highest};
}

/// The complex amplitudes of the response to the forces at omega, with the stiffness K.
Eigen::VectorXcd response_at(const model::Model& model, const Vector& p, const Eigen::MatrixXd& K,
                             double omega) {
  const Eigen::MatrixXd M = model::mass_matrix(model, p), own = model::stiffness_matrix(model, p);
  const model::ProportionalDamping none, &damping = model.damping ? *model.damping : none;
  const Eigen::MatrixXd loss =
      omega * (model::damping_matrix(model, p) + damping.alpha_at(p) * M + damping.beta_at(p) * own) +
      damping.loss_factor_at(p) * own;
  Eigen::MatrixXcd Z(model.dofs, model.dofs);
  Z.real() = K - omega * omega * M;
  Z.imag() = loss;
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(model.dofs);
  for (const model::Excitation& each : model.excitation)
    if (each.harmonic == model.force_harmonic)
      f += each.amplitude(p) * each.factor(omega / each.harmonic) * model::shape(model, each, p);
  return Z.partialPivLu().solve(f);
}

/// Adds what springs are stiffer in the motion x than at rest.
void add_stiffening(const model::Model& model, const Vector& p, const Eigen::VectorXcd& x,
                    Eigen::MatrixXd& K) {
  for (const model::NonlinearPart& element : model.elements) {
    if (is_contact(*element.law)) continue;
    const std::vector<double> fields = element.fields(p);
    const Eigen::MatrixXd rest = elements::tangent_at_rest(*element.law, fields);
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const double reach = std::abs(Eigen::VectorXcd(Vector(element.directions[i]).cast<Complex>()).dot(x));
      const double most = element.law->stiffness(fields, static_cast<int>(i), reach);
      model::add_outer(std::max(most - rest(row, row), 0.0), element.directions[i], K);
    }
  }
}

bool stiffens(const model::Model& model) {
  return !model.sector && std::any_of(model.elements.begin(), model.elements.end(),
                                      [](const auto& element) { return !is_contact(*element.law); });
}

/// The resonance at the largest amplitude, with springs that stiffen; omega without them, or without damping.
double stiffened(const model::Model& model, const Vector& p, double omega) {
  const auto at_rest = stiffness_at_rest(model, p, Contacts::stuck);
  if (!stiffens(model) || !at_rest || model.dofs > few_dofs) return omega;
  const Eigen::MatrixXd M = model::mass_matrix(model, p);
  // Whether the springs, at the amplitude of a resonance at `at`, are stiffer than a resonance there takes.
  const auto is_stiffer = [&](double at) {
    const Eigen::VectorXcd x = response_at(model, p, *at_rest * (at * at / (omega * omega)), at);
    Eigen::MatrixXd K = *at_rest;
    add_stiffening(model, p, x, K);
    return x.dot(K.cast<Complex>() * x).real() > at * at * x.dot(M.cast<Complex>() * x).real();
  };
  double lower = omega, upper = most_stiffening * omega;
  if (is_stiffer(upper)) return omega;
  for (int i = 0; i < most_balances && upper > (1 + balanced) * lower; ++i) {
    const double middle = std::sqrt(lower * upper);
    (is_stiffer(middle) ? lower : upper) = middle;
  }
  return lower == omega ? omega : upper;
}

/// to three digits, away from the window.
double rounded(double value, bool upwards) {
  const double step = std::pow(10, std::floor(std::log10(value)) + 1 - digits_of_end);
  return std::stod(results::to_digits(step * (upwards ? std::ceil(value / step) : std::floor(value / step)),
                                      digits_of_end));
}

}  // namespace

std::optional<ProposedWindow> proposed_window(const scene::Scene& scene,
                                              const std::vector<ValuesTaken>& ranges,
                                              const control::Control& control) {
  const model::Model model = model::build(scene, control);
  const auto [lowest, highest] = lowest_and_highest(model, model::defaults(model), ranges);
  const FirstResonance free = both_at(model, lowest).free, stuck = both_at(model, highest).stuck;
  if (free.omega == 0 || stuck.omega == 0) return {};
  const double first = std::min(free.omega, stuck.omega), last = std::max(free.omega, stuck.omega);
  const FreeAndStuck base = both_at(model, model::defaults(model));
  const double ratio = base.stuck.omega / base.free.omega;
  const double of_sliders = std::max(ratio * ratio - 1, 0.0) / (2 * std::numbers::pi);
  const double bandwidth = std::max({free.damping_ratio, stuck.damping_ratio, of_sliders});
  const double margin = std::clamp(third * bandwidth, least_margin, most_margin);
  const double harmonic = model.force_harmonic;
  const double stiff = stiffened(model, highest, harmonic * last) / harmonic;
  const double unit = scene::to_rad_per_s(scene.frequency_unit);
  ProposedWindow window{
      rounded((1 - margin) * first / unit, false), rounded((1 + margin) * stiff / unit, true), {}};
  const auto text = [&](double omega) {
    return results::to_digits(omega / unit, digits_reported) + ' ' +
           std::string(scene::unit_name(scene.frequency_unit));
  };
  window.reason = text(window.lower * unit) + " to " + text(window.upper * unit) +
                  ", around the first resonance, " + text(free.omega);
  if (last > (1 + balanced) * first)
    window.reason += " with all contacts free and " + text(stuck.omega) + " stuck";
  if (stiff > (1 + balanced) * last) window.reason += ", up to " + text(stiff) + " where springs stiffen";
  window.reason += ", with margins of " + results::to_digits(100 * margin, 2) + " %";
  return window;
}

}  // namespace arcslip::observables
