#pragma once
// Epigraph form: min over y of sum_g max_k f_gk(y) as min sum_g exp(t_g) subject to ln f_gk(y) <= t_g, with
// the levels t_g as additional variables at the end. One group: min t_1. Not installed.

#include <arcslip/optimize/nlopt/minimize.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace arcslip::optimize {

/// Adds levels to the variables of a problem and to its start, and sets ln sum_g exp(t_g) as the objective.
/// visit: called with every y at which the objective is evaluated. The caller adds the constraints
/// ln f_gk(y) - t_g <= 0.
inline void add_levels(NonlinearProgram& problem, std::vector<double>& start, std::span<const double> levels,
                       double lower, double upper, std::function<void(std::span<const double>)> visit) {
  const std::size_t n = start.size();
  start.insert(start.end(), levels.begin(), levels.end());
  problem.lower.insert(problem.lower.end(), levels.size(), lower);
  problem.upper.insert(problem.upper.end(), levels.size(), upper);
  problem.objective = [n, visit = std::move(visit)](std::span<const double> x, std::span<double> g) {
    visit(x.first(n));
    const auto t = x.subspan(n);
    const double most = *std::max_element(t.begin(), t.end());
    double sum = 0;
    for (const double each : t) sum += std::exp(each - most);
    if (!g.empty()) {
      std::fill(g.begin(), g.end(), 0.0);
      for (std::size_t k = 0; k < t.size(); ++k) g[n + k] = std::exp(t[k] - most) / sum;
    }
    return most + std::log(sum);
  };
}

}  // namespace arcslip::optimize
