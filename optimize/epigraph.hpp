#pragma once
// min over y of max_k f_k(y) as min t subject to f_k(y) <= t: t becomes the last variable. Not installed.

#include <arcslip/optimize/minimize.hpp>

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace arcslip::optimize {

/// Adds t to the variables of a problem and to its start, and makes it the objective. visit: told of every y
/// at which the objective is asked for. The constraints f_k(y) - t <= 0 are the caller's.
inline void add_level(Problem& problem, std::vector<double>& start, double level, double lower, double upper,
                      std::function<void(std::span<const double>)> visit) {
  const std::size_t n = start.size();
  start.push_back(level);
  problem.lower.push_back(lower);
  problem.upper.push_back(upper);
  problem.objective = [n, visit = std::move(visit)](std::span<const double> x, std::span<double> g) {
    visit(x.first(n));
    if (!g.empty()) {
      std::fill(g.begin(), g.end(), 0.0);
      g[n] = 1;
    }
    return x[n];
  };
}

}  // namespace arcslip::optimize
