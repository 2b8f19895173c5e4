#include <arcslip/observables/force_components.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>

namespace arcslip::observables {
namespace {

using Complex = std::complex<double>;

Complex amplitude_of(const elements::Harmonics& h, elements::In coefficients, int n) {
  return {coefficients[h.cosine_index(n)], -coefficients[h.sine_index(n)]};
}

PhaseParts& operator+=(PhaseParts& sum, Complex force) {
  sum.in_phase += force.real();
  sum.out_of_phase += force.imag();
  return sum;
}

}  // namespace

ForceComponents force_components(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at,
                                 elements::In x) {
  const auto& h = problem.harmonics();
  const int n = h.excited(problem.model().force_harmonic);
  ForceComponents result;
  const double square = h.has(n) ? std::norm(amplitude_of(h, x, n)) : 0;
  if (!(square > 0)) return result;
  const double omega = n * at.stiffness().base_frequency();
  const hbm::QuadraticForms forms = at.stiffness().quadratic_forms(n, at.unknowns(), at.force_factor());
  result.inertia = (forms.gyroscopic - omega * omega * forms.mass) / square;
  result.spring = forms.stiffness / square;
  result.viscous = forms.damping / square;
  result.excitation += forms.force / square;
  for (std::size_t e = 0; e < at.element_count(); ++e) {
    const auto& law = *problem.model().elements[e].law;
    PhaseParts& sum = law.has_contact() ? result.contact : result.nonlinear_spring;
    for (int i = 0; i < law.directions(); ++i) {
      const Complex Q = amplitude_of(h, at.element_motion(e).segment(i * h.size(), h.size()), n);
      const Complex F = amplitude_of(h, at.element(e).force().segment(i * h.size(), h.size()), n);
      sum += F * std::conj(Q) / square;
    }
  }
  return result;
}

void set_fundamental(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, std::size_t e,
                     ElementResponse& element) {
  const auto& h = problem.harmonics();
  const int n = h.excited(problem.model().force_harmonic);
  const Complex Q = h.has(n) ? amplitude_of(h, at.element_motion(e), n) : 0;
  const double X = std::abs(Q);
  if (!(X > 0)) return;
  const Complex along = amplitude_of(h, at.element(e).force(), n) * std::conj(Q) / X;
  element.fundamental = {along.real(), along.imag()};
  element.equivalent_stiffness = along.real() / X;
  element.equivalent_damping = along.imag() / (n * at.stiffness().base_frequency() * X);
}

void set_contact_angles(const elements::Harmonics& h, elements::In motion, ElementResponse& element) {
  const auto& ends = element.reversal_angles;
  if (ends.size() != 2 || element.slip_angles.size() != 2) return;
  // Of the two slip phases one rises, the other falls: the first ends where the displacement is largest.
  const bool first =
      elements::series_values(h, motion, ends[0]).x > elements::series_values(h, motion, ends[1]).x;
  element.theta_0 = first ? ends[0] : ends[1];
  element.theta_star = HUGE_VAL;
  for (double onset : element.slip_angles)
    element.theta_star =
        std::min(element.theta_star, onset > element.theta_0 ? onset : onset + 2 * std::numbers::pi);
}

Maxima::Maxima(const hbm::HbmProblem& problem)
    : problem_(problem), largest_(problem.harmonics()), v_(problem.harmonics().size()) {}

std::pair<double, double> Maxima::of(elements::In x, double base_frequency) {
  const auto& h = problem_.harmonics();
  const int ns = h.sines();
  v_.setZero();
  for (int j = 0; j < ns; ++j) {  // x' = sum n (b cos - a sin)
    const int n = h.sine_order(j);
    v_[h.cosine_index(n)] = n * x[h.sine_index(n)];
    v_[h.sine_index(n)] = -n * x[h.cosine_index(n)];
  }
  const double velocity = base_frequency * largest_.of(v_);
  for (int j = 0; j < ns; ++j) {
    const int n = h.sine_order(j);
    v_[h.cosine_index(n)] = n * n * x[h.cosine_index(n)];
    v_[h.sine_index(n)] = n * n * x[h.sine_index(n)];
  }
  if (!h.odd) v_[0] = 0;
  return {velocity, base_frequency * base_frequency * largest_.of(v_)};
}

void Maxima::add_to(ResponsePoint& point, const hbm::HbmEvaluator& at, elements::In x) {
  const auto& h = problem_.harmonics();
  const auto& model = problem_.model();
  const int nc = h.cosines(), ns = h.sines();
  std::tie(point.maxima.velocity, point.maxima.acceleration) = of(x, at.stiffness().base_frequency());
  for (std::size_t e = 0; e < at.element_count(); ++e) {
    ElementResponse& element = point.elements[e];
    if (!element.has_stick) continue;
    v_ = at.element(e).force().head(h.size());  // of the first direction
    element.maxima.force = largest_.of(v_);
    v_.tail(ns).setZero();
    element.maxima.cosine = largest_.of(v_);
    v_ = at.element(e).force().head(h.size());
    v_.head(nc).setZero();
    element.maxima.sine = largest_.of(v_);
  }
  if (model.dofs != 1 || model.sector || model.elements.size() != 1 || !point.elements[0].has_stick ||
      model.elements[0].directions.size() != 1)
    return;
  const double omega = model.force_harmonic * point.omega;
  const double contact =
      std::abs(model.elements[0].directions[0].coeff(0) / model.response[0]) / point.amplitude;
  const ForceMaxima& force = point.elements[0].maxima;
  point.maxima.force_per_displacement = {
      point.forces.spring +
          point.forces.inertia / (omega * omega) * point.maxima.acceleration / point.amplitude +
          contact * force.sine,
      point.forces.viscous / omega * point.maxima.velocity / point.amplitude + contact * force.cosine};
}

}  // namespace arcslip::observables
