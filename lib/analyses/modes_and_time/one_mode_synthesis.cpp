#include <arcslip/analyses/modes_and_time/one_mode_synthesis.hpp>

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/mode.hpp>
#include <arcslip/observables/observe.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::observables {
namespace {

using Complex = std::complex<double>;
using continuation::In;
using continuation::Vector;

constexpr double half_widths = 20;   // of the window around a peak, in damping ratios,
constexpr double narrowest = 1e-3;   // but at least this share of the frequency
constexpr double widest = 0.5;       // and at most this
constexpr double at_a_node = 1e-12;  // of the work of the forces without their signs

// The root of the left side over omega^2, in q = W/omega:
//   h(q)^2 = (1 - q^2)^2 + 4 (zeta_v q + zeta_i)^2
struct Balance {
  double zeta_v, zeta_i;

  double at(double q) const { return std::hypot((1 - q) * (1 + q), 2 * (zeta_v * q + zeta_i)); }
  // A quarter of dh^2/dq: q^3 - (1 - 2 zeta_v^2) q + 2 zeta_v zeta_i.
  double slope(double q) const { return q * ((q - 1) * (q + 1) + 2 * zeta_v * zeta_v) + 2 * zeta_v * zeta_i; }

  // Where the slope vanishes above its own least value; 0: nowhere.
  double lowest() const {
    const double square = 1 - 2 * zeta_v * zeta_v, least = std::sqrt(std::max(0.0, square / 3));
    if (slope(least) > 0) return 0;
    return bisected([this](double q) { return slope(q) > 0; }, 1 + std::abs(zeta_v * zeta_i), least);
  }
  // Where it vanishes below, or 0.
  double highest_below(double lowest) const {
    const double least = std::sqrt(std::max(0.0, (1 - 2 * zeta_v * zeta_v) / 3));
    if (!(slope(0) > 0) || !(least < lowest)) return 0;
    return bisected([this](double q) { return slope(q) > 0; }, 0, least);
  }
  // h = level between an argument at which it is less and one at which it is not.
  double crossing(double level, double less, double more) const {
    return bisected([&](double q) { return at(q) > level; }, more, less);
  }

 private:
  // To the last digit between an argument at which the condition holds and one at which it does not.
  template <class Condition>
  static double bisected(const Condition& condition, double holds, double fails) {
    for (;;) {
      const double middle = 0.5 * (holds + fails);
      if (middle == holds || middle == fails) return middle;
      (condition(middle) ? holds : fails) = middle;
    }
  }
};

// The same with all periodic excitation times a level.
std::shared_ptr<const model::Model> at_level(const model::Model& excited, double level) {
  auto model = std::make_shared<model::Model>(excited);
  const Vector p = model::defaults(excited);
  const auto add = [&](const char* name, double value) {
    model->parameters.push_back({name, "", value, std::max(std::abs(value), 1e-300)});
    return model::Number(static_cast<int>(model->parameters.size()) - 1);
  };
  for (model::Excitation& each : model->excitation) {
    if (each.harmonic == 0) continue;
    each.cosine = add("cosine at the level", level * each.cosine.value(p));
    each.sine = add("sine at the level", level * each.sine.value(p));
  }
  return model;
}

// x(theta + shift) for all unknowns, theta of the base frequency.
void shift(const elements::Harmonics& h, double by, Vector& u) {
  for (Eigen::Index block = 0; block < u.size(); block += h.size())
    for (int j = 0; j < h.sines(); ++j) {
      const int n = h.sine_order(j);
      double &a = u[block + h.cosine_index(n)], &b = u[block + h.sine_index(n)];
      const Complex turned = Complex(a, -b) * std::polar(1.0, n * by);
      a = turned.real();
      b = -turned.imag();
    }
}

}  // namespace

OneModeSynthesis::OneModeSynthesis(const hbm::HbmProblem& motions,
                                   std::shared_ptr<const model::Model> excited)
    : harmonics_(motions.harmonics()), excited_(std::move(excited)) {
  const Vector p = model::defaults(*excited_);
  for (const model::Excitation& each : excited_->excitation)
    if (each.harmonic == 1) forces_.push_back({each, each.amplitude(p), model::shape(*excited_, each, p)});
  std::vector<Eigen::Index> driven;
  for (Eigen::Index i = 0; i < excited_->dofs; ++i)
    if (std::any_of(forces_.begin(), forces_.end(), [&](const Force& each) { return each.shape[i] != 0; }))
      driven.push_back(i);
  P_ = motions.coordinates().P(driven, Eigen::all);
  for (Force& each : forces_) each.shape = Vector(each.shape(driven));
}

// x^H f of the fundamental.
Complex OneModeSynthesis::work(const hbm::HbmEvaluator& motion, In u, double omega) const {
  const int n = harmonics_.excited(1), a = harmonics_.cosine_index(n), b = harmonics_.sine_index(n);
  const Eigen::MatrixXd x = motion.stiffness().motion(P_, u, 0);
  Complex sum = 0;
  double size = 0;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    Complex f = 0;
    for (const Force& each : forces_) f += each.given * each.of.factor(omega) * each.shape[i];
    const Complex term = Complex(x(a, i), x(b, i)) * f;
    sum += term;
    size += std::abs(term);
  }
  return std::abs(sum) > at_a_node * size ? sum : 0;
}

Synthesis OneModeSynthesis::of(const hbm::HbmEvaluator& motion, In u, double omega, double zeta_v,
                               double zeta_i) const {
  Synthesis found;
  if (forces_.empty()) return found;
  const double P = std::abs(work(motion, u, omega));
  const double m = motion.stiffness().quadratic_forms(harmonics_.excited(1), u, 0).mass;
  if (!(P > 0 && m > 0)) return found;
  const double drive = P / (m * omega * omega);
  const Balance balance{zeta_v, zeta_i};
  const double q = balance.lowest();
  found.omega = q * omega;
  found.level = std::copysign(balance.at(q), zeta_v * q + zeta_i) / drive;
  if (!(balance.at(q) <= drive)) return found;
  found.above = omega * balance.crossing(drive, q, q + 1 + drive);
  // From 0 on the left side may rise at first.
  if (const double rises = balance.highest_below(q); balance.at(rises) >= drive)
    found.below = omega * balance.crossing(drive, q, rises);
  return found;
}

std::optional<OneModeSynthesis::Peak> OneModeSynthesis::true_peak(const hbm::HbmEvaluator& motion, In u,
                                                                  double zeta, const Synthesis& nearby,
                                                                  const control::Control& control) const {
  if (!(nearby.level > 0) || !std::isfinite(nearby.level) || !(nearby.omega > 0)) return {};
  const double half = std::clamp(half_widths * std::abs(zeta), narrowest, widest) * nearby.omega;
  const FrequencyWindow window{nearby.omega - half, nearby.omega + half};
  const auto problem = std::make_shared<const hbm::HbmProblem>(at_level(*excited_, nearby.level), harmonics_,
                                                               u.norm(), 2 * half, nearby.omega);
  if (problem->size() != u.size()) return {};
  // The excitation a quarter period ahead of the motion.
  Vector guess = u;
  const double turn = std::arg(work(motion, u, nearby.omega)) - std::numbers::pi / 2;
  shift(harmonics_, turn / harmonics_.excited(1), guess);
  const Vector p = hbm::parameters_at(*problem, nearby.omega);
  const auto start = hbm::response_near(*problem, p, guess);
  if (!start) return {};

  std::optional<Peak> highest;
  hbm::HalfRange range(harmonics_);
  Vector x(harmonics_.size());
  for (const int direction : {1, -1}) {
    const auto record = [&](const continuation::Accepted& now, const continuation::Event* event) {
      if (!event || event->monitor != event_kinds::peak) return true;
      const auto& at = static_cast<const hbm::HbmEvaluator&>(now.at);
      at.stiffness().response(now.u, at.force_factor(), x);
      const double amplitude = range.of(x);
      if (!highest || amplitude > highest->amplitude) highest = {now.p[model::frequency], amplitude};
      return false;
    };
    continuation::trace(problem, {*start, p, model::frequency, direction},
                        frequency_options(window, Steps::events, control),
                        frequency_monitors(std::make_shared<Observer>(problem), Steps::events, {}), record);
  }
  return highest;
}

}  // namespace arcslip::observables
