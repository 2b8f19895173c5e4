#include <arcslip/observables/solutions_beside.hpp>

#include <arcslip/continuation/diagrams/deflation.hpp>
#include <arcslip/observables/study_branches.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace arcslip::observables {

using continuation::Vector;

namespace {

// x(theta + phi), times a factor.
Vector shifted(const hbm::HbmProblem& problem, const Vector& u, double phi, double factor) {
  const auto& h = problem.harmonics();
  Vector image = u;
  for (int block = 0; block < problem.blocks(); ++block) {
    const Eigen::Index at = block * h.size();
    for (int j = 0; j < h.sines(); ++j) {
      const int n = h.sine_order(j);
      const double a = u[at + h.cosine_index(n)], b = u[at + h.sine_index(n)];
      image[at + h.cosine_index(n)] = a * std::cos(n * phi) + b * std::sin(n * phi);
      image[at + h.sine_index(n)] = b * std::cos(n * phi) - a * std::sin(n * phi);
    }
  }
  return factor * image;
}

bool mirrors(const hbm::HbmProblem& problem) {
  const auto& all = problem.model().excitation;
  return problem.model().antisymmetric && !problem.harmonics().odd &&
         std::all_of(all.begin(), all.end(), [](const auto& each) { return each.harmonic % 2 == 1; });
}

}  // namespace

std::vector<Vector> images(const hbm::HbmProblem& problem, const Vector& u) {
  const double half = std::numbers::pi / problem.harmonics().period;  // of a period of the excitation
  std::vector<Vector> all;
  for (int k = 0; k < 2 * problem.harmonics().period; ++k)
    if (k % 2 == 0 || mirrors(problem)) all.push_back(shifted(problem, u, k * half, k % 2 == 0 ? 1 : -1));
  return all;
}

std::vector<Vector> solutions_at(const hbm::HbmProblem& problem, std::span<const ResponsePoint> branch,
                                 double omega) {
  const Vector p = hbm::parameters_at(problem, omega);
  std::vector<Vector> all;
  for (std::size_t i = 0; i + 1 < branch.size(); ++i) {
    const ResponsePoint &from = branch[i], &to = branch[i + 1];
    if ((from.omega - omega) * (to.omega - omega) > 0 || from.omega == to.omega) continue;
    const double share = (omega - from.omega) / (to.omega - from.omega);
    const Eigen::Map<const Vector> a(from.unknowns.data(), problem.size()),
        b(to.unknowns.data(), problem.size());
    if (auto found = hbm::response_near(problem, p, (1 - share) * a + share * b))
      all.push_back(std::move(*found));
  }
  return all;
}

std::optional<Vector> solution_beside(const hbm::HbmProblem& problem, double omega,
                                      const std::vector<Vector>& known, const GoOn& go_on) {
  const Vector p = hbm::parameters_at(problem, omega);
  std::vector<Vector> all, guesses{Vector::Zero(problem.size())};
  if (const Vector linear = hbm::linear_response(problem, p); linear.allFinite()) guesses.push_back(linear);
  for (const Vector& each : known) {
    guesses.push_back(each);
    for (Vector& image : images(problem, each)) {
      const auto is_it = [&](const Vector& other) {
        return (other - image).norm() <= same_solution * image.norm();
      };
      if (std::none_of(all.begin(), all.end(), is_it)) all.push_back(std::move(image));
    }
  }
  continuation::DeflationOptions options;
  options.solutions = 1;
  options.go_on = go_on;
  const auto found = continuation::deflate(problem, p, all, guesses, options);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

}  // namespace arcslip::observables
