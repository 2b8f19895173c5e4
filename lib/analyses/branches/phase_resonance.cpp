#include <arcslip/analyses/branches/phase_resonance.hpp>

#include <arcslip/results/event_kinds.hpp>

#include <complex>

namespace arcslip::observables {

double cosine_of_phase(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In u) {
  const auto& h = problem.harmonics();
  const int n = h.excited(problem.model().force_harmonic);
  if (n == 0 || !h.has(n)) return 1;
  const std::complex<double> work = at.stiffness().quadratic_forms(n, u, at.force_factor()).force;
  return work == 0.0 ? 1 : work.real() / std::abs(work);
}

continuation::Monitor phase_resonance_monitor(const std::shared_ptr<Observer>& observer, int direction) {
  continuation::Monitor monitor;
  monitor.name = event_kinds::phase_resonance;
  monitor.value = [observer](const continuation::Accepted& now) {
    return cosine_of_phase(observer->problem(), static_cast<const hbm::HbmEvaluator&>(now.at), now.u);
  };
  monitor.crossing = direction > 0 ? continuation::Crossing::falling : continuation::Crossing::rising;
  return monitor;
}

}  // namespace arcslip::observables
