#pragma once
// The amplitude that a point of a response has in more harmonics.

#include "catch.hpp"

#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/amplitude.hpp>
#include <arcslip/results/response.hpp>

#include <cmath>
#include <memory>
#include <optional>

namespace in_more_harmonics {

using namespace arcslip;

/// At the frequency of the point, whose motion has the harmonics `kept`, in those of the model: by Newton's
/// method. Nothing where that fails, or leads to another response.
inline std::optional<double> amplitude(const std::shared_ptr<const model::Model>& model,
                                       const elements::Harmonics& kept,
                                       const observables::ResponsePoint& point) {
  using continuation::Vector;
  const elements::Harmonics& wide = model->harmonics;
  const Eigen::Map<const Vector> from(point.unknowns.data(),
                                      static_cast<Eigen::Index>(point.unknowns.size()));
  const auto problem = std::make_shared<const hbm::HbmProblem>(model, wide, from.norm(), 1);
  Vector u(problem->size());
  elements::transfer(kept, from, wide, u);
  const Vector p = hbm::parameters_at(*problem, point.omega);
  const auto found = hbm::response_near(*problem, p, u);
  if (!found || (*found - u).norm() > 0.1 * u.norm()) return {};
  const auto at = problem->hbm_evaluator();
  at->move_to(*found, p, continuation::Needs::residual);
  Vector x(wide.size());
  return observables::Amplitude(wide).of(*at, *found, x).amplitude;
}

/// Of points next to more harmonics: how many errors are compared, and how many of them are above twice and
/// above ten times the estimate.
struct Compared {
  int points = 0, flagged = 0, above_twice = 0, above_ten_times = 0;
};

/// Each `every`-th point of a branch that is not flagged; errors below `digits` of the amplitude are not
/// looked at.
inline void compare(const std::shared_ptr<const model::Model>& model, const elements::Harmonics& kept,
                    const observables::ResponseBranch& branch, std::size_t every, double digits,
                    Compared& to) {
  for (std::size_t k = 0; k < branch.points.size(); k += every) {
    const auto& point = branch.points[k];
    if (point.truncation_flagged) {
      ++to.flagged;
      continue;
    }
    CHECK(point.truncation_estimate <= 0.1 * point.amplitude * (1 + 1e-9));
    const auto exact = amplitude(model, kept, point);
    if (!exact) continue;
    const double error = std::abs(point.amplitude - *exact);
    ++to.points;
    if (!(error > digits * *exact)) continue;
    if (error > 2 * point.truncation_estimate) ++to.above_twice;
    if (error > 10 * point.truncation_estimate) ++to.above_ten_times;
  }
}

}  // namespace in_more_harmonics
