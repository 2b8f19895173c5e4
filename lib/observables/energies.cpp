#include <arcslip/observables/energies.hpp>

#include <numbers>

namespace arcslip::observables {

double element_energy(const elements::Harmonics& h, elements::In w, elements::In F) {
  double sum = 0;
  for (Eigen::Index direction = 0; direction < F.size(); direction += h.size())
    for (int j = 0; j < h.sines(); ++j) {
      const int n = h.sine_order(j);
      const Eigen::Index c = direction + h.cosine_index(n), s = direction + h.sine_index(n);
      sum += n * (F[c] * w[s] - F[s] * w[c]);
    }
  return std::numbers::pi * sum;
}

double input_energy(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In u) {
  const auto& h = problem.harmonics();
  const auto& forces = problem.model().excitation;
  double sum = 0;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const int n = h.excited(forces[k].harmonic);
    bool counted = n == 0 || !h.has(n);
    for (std::size_t earlier = 0; earlier < k; ++earlier)
      counted = counted || forces[earlier].harmonic == forces[k].harmonic;
    if (!counted) sum += n * at.stiffness().quadratic_forms(n, u, at.force_factor()).force.imag();
  }
  return std::numbers::pi * sum;
}

}  // namespace arcslip::observables
