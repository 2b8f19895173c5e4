#include <arcslip/analyses/branches/unbounded_resonance.hpp>

#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/energies.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>

namespace arcslip::observables {
namespace {

constexpr double near_pole = 1e-9, off_pole = 1e-5;  // of omega: where it is looked for a pole
constexpr double grows = 100;                        // between these: less is no pole, whose growth is 1e4
constexpr double large = 1e6;                        // of that response, as a shape of large amplitude
constexpr double negligible = 1e-9;  // share of a shape in an element or damper that does not count
constexpr double least_part = 1e-4;  // of a shape in a law whose work grows: less moves next to the resonance
constexpr double beyond_display = 1e6;  // |u| in scales: larger responses may be unbounded
constexpr double close_by = 1e-5;       // of its frequency: as near a pole is reported, and known to 1e-10
constexpr double agrees = 0.1;          // of the distance to a pole: that to which its estimates agree
constexpr double on_end = 1e-9;         // of the frequency at an end of the window: there, too, is a pole
constexpr double least_beyond = 1e-6;  // of the pole's frequency: nearer, a start would be taken for the pole
constexpr std::array farther_beyond{1e-4, 1e-2};  // of it, where no response is found there
constexpr double without_course = 1.0 / 150;  // of the window: as far beyond a pole that the branch begins at

// The order of the largest harmonic of an element's motion q along one direction.
int largest_order(const elements::Harmonics& h, elements::In q) {
  int largest = 1;
  double most = 0;
  for (int j = 0; j < h.sines(); ++j) {
    const int n = h.sine_order(j);
    const double size = std::hypot(q[h.cosine_index(n)], q[h.sine_index(n)]);
    if (size > most) most = size, largest = n;
  }
  return largest;
}

// What the elements do to a large motion u.
struct ElementsAtLarge {
  double amplitude = 0;
  double friction = 0;  // work of the sliders over pi
  bool restoring = false, losing = false;
};

// power: of the amplitude, from which on an elastic force bounds the response.
ElementsAtLarge elements_at_large(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& evaluator,
                                  const continuation::Vector& p, const continuation::Vector& u,
                                  double power) {
  const auto& elements = problem.model().elements;
  const auto& h = problem.harmonics();
  ElementsAtLarge all;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto& element = elements[e];
    double sliders = 0;
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      const auto q = evaluator.element_motion(e).segment(static_cast<Eigen::Index>(i) * h.size(), h.size());
      const double size = q.norm();
      const elements::Traits traits = element.law->traits(element.fields(p), static_cast<int>(i));
      all.amplitude = std::max(all.amplitude, size);
      all.restoring = all.restoring || (traits.far_power >= power && size > negligible * u.norm());
      if (std::isinf(traits.far_work)) {
        all.losing = all.losing || size > least_part * u.norm();
        continue;
      }
      // The motion is almost wholly in the resonant harmonic n: it goes to and fro n times in a period.
      sliders += largest_order(h, q) * traits.far_work / std::numbers::pi * size;
    }
    // A normal load that grows with the motion makes it more.
    const Eigen::Index displacements = static_cast<Eigen::Index>(element.directions.size()) * h.size();
    if (element.law->has_contact() && element.directions.size() > 1)
      sliders = std::max(sliders, element_energy(h, evaluator.element_motion(e),
                                                 evaluator.element(e).force().head(displacements)) /
                                      std::numbers::pi);
    all.friction += sliders;
  }
  if (elements.empty()) all.amplitude = u.norm();
  return all;
}

// The work of the excitation over pi: at resonance the motion is in quadrature to the force, and that of
// harmonic n is n |F_n| |X_n|.
double excitation_work(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& evaluator,
                       const continuation::Vector& u) {
  const auto& h = problem.harmonics();
  continuation::Vector f(u.size());
  evaluator.stiffness().force(f);
  double all = 0;
  for (int j = 0; j < h.sines(); ++j) {
    const int n = h.sine_order(j);
    std::complex<double> work = 0;
    for (int i = 0; i < problem.coordinates().unknowns; ++i) {
      const int c = i * h.size() + h.cosine_index(n), s = i * h.size() + h.sine_index(n);
      work += std::complex<double>(f[c], -f[s]) * std::complex<double>(u[c], u[s]);
    }
    all += n * std::abs(work);
  }
  return all;
}

// Compares the work of the excitation and of the sliders on the motion u, over pi and its amplitude.
UnboundedGrowth balance(const hbm::HbmProblem& problem, const continuation::Vector& p,
                        const continuation::Vector& u, double power) {
  const auto evaluator = problem.hbm_evaluator();
  UnboundedGrowth result;
  if (evaluator->move_to(u, p, continuation::Needs::residual) != continuation::Evaluated::ok) {
    result.message = "the response overflowed";
    return result;
  }
  const double viscous =
      evaluator->stiffness().viscous_energy(u, 1) / std::numbers::pi;  // over amplitude^2 below
  const ElementsAtLarge of = elements_at_large(problem, *evaluator, p, u, power);
  result.input = excitation_work(problem, *evaluator, u) / of.amplitude;
  result.dissipation = of.friction / of.amplitude;
  const bool damped = viscous > negligible * result.input * of.amplitude;
  result.unbounded =
      !damped && !of.restoring && !of.losing && result.dissipation <= result.input * (1 + negligible);
  std::ostringstream text;
  text.precision(6);
  if (result.unbounded) {
    text << "the resonance is unbounded: it has no viscous damping, and friction dissipates "
         << result.dissipation << " N of the " << result.input
         << " N supplied by the excitation (work per period over pi and amplitude)";
  } else {
    text << (std::isfinite(of.amplitude) ? "beyond " + results::quantity(of.amplitude, "m")
                                         : "at any amplitude")
         << " the response is bounded by "
         << (damped         ? "viscous damping"
             : of.restoring ? "a nonlinear spring"
             : of.losing    ? "a nonlinear damper"
                            : "friction");
  }
  result.message = text.str();
  return result;
}

// A response that grows along its branch includes all elastic forces that grow no faster than itself; the
// pole of the response without elements is shifted by those that grow as fast.
constexpr double faster = 1.5, as_fast = 1;

}  // namespace

UnboundedGrowth unboundedness(const hbm::HbmProblem& problem, const continuation::Vector& p,
                              const continuation::Vector& u) {
  return balance(problem, p, u, faster);
}

UnboundedGrowth unbounded_resonance(const std::shared_ptr<const model::Model>& model, double omega) {
  constexpr double at_rest = 0;  // without modes, which cost more than two evaluations
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1, at_rest);
  const continuation::Vector p = hbm::parameters_at(problem, omega * (1 + near_pole));
  const continuation::Vector u = hbm::linear_response(problem, p);
  const double off =
      hbm::linear_response(problem, hbm::parameters_at(problem, omega * (1 + off_pole))).norm();
  if (!u.allFinite() || !(u.norm() > grows * off)) return {};
  return balance(problem, p, large * u, as_fast);
}

BeyondPole beyond_pole_at_start(double omega, double width) {
  return {{omega + width * without_course}};
}

// The last place before, at which |u| is at most half as large.
const PoleWatch::Place* PoleWatch::half_as_large(const Place& of) const {
  for (const Place* at = &of; at != course_.data();)
    if ((--at)->size <= of.size / 2) return at;
  return nullptr;
}

std::optional<double> PoleWatch::pole_ahead() const {
  const Place& now = course_.back();
  const Place* before = half_as_large(now);
  const Place* first = before ? half_as_large(*before) : nullptr;
  if (!first) return {};
  // 1/|u| is linear in the frequency.
  const auto distance = [](const Place& a, const Place& b) {
    return (b.omega - a.omega) * a.size / (b.size - a.size);
  };
  const double ahead = distance(*before, now), known_before = distance(*first, *before);
  const double pole = now.omega + ahead;
  const bool agree = std::abs(before->omega + known_before - pole) <= agrees * std::abs(ahead);
  const bool within = pole >= lower_ * (1 - on_end) && pole <= upper_ * (1 + on_end);
  if (!agree || !within || !(std::abs(ahead) <= close_by * now.omega)) return {};
  return std::clamp(pole, lower_, upper_);
}

bool PoleWatch::is_next_to_pole(const hbm::HbmProblem& problem, const continuation::Vector& p,
                                const continuation::Vector& u) {
  const double large_size = beyond_display * problem.displacement();
  const bool was_large = !course_.empty() && course_.back().size > large_size;
  course_.push_back({p[model::frequency], u.norm()});
  if (!(course_.back().size > large_size)) return false;
  const auto pole = pole_ahead();
  if (was_large && !pole) return false;
  growth_ = unboundedness(problem, p, u);
  if (!growth_.unbounded) return false;
  if (!pole) growth_ = {};
  pole_ = pole.value_or(0);
  return growth_.unbounded;
}

BeyondPole PoleWatch::beyond() const {
  const Place& last = course_.back();
  const double distance = pole_ - last.omega, side = distance < 0 ? -1 : 1;
  BeyondPole there;
  there.starts.push_back(pole_ + side * std::max(std::abs(distance), least_beyond * pole_));
  for (const double share : farther_beyond)
    if (const double farther = pole_ * (1 + side * share); farther >= lower_ && farther <= upper_)
      there.starts.push_back(farther);
  there.displacement = last.size * std::abs(distance) / pole_;
  there.ahead = side > 0;
  return there;
}

}  // namespace arcslip::observables
