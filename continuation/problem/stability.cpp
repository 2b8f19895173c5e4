#include <arcslip/continuation/problem/stability.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace arcslip::continuation {
namespace {

void require_stability(bool holds, const char* what, double value, const std::string& bound) {
  if (!holds)
    throw std::invalid_argument(std::string("stability.") + what + " is " + std::to_string(value) +
                                ", must be " + bound);
}

}  // namespace

void check(const StabilityOptions& o, int n) {
  if (o.mass && (o.mass->rows() != n || o.mass->cols() != n))
    throw std::invalid_argument("stability.mass is " + std::to_string(o.mass->rows()) + " x " +
                                std::to_string(o.mass->cols()) + " for " + std::to_string(n) + " unknowns");
  require_stability(o.every_point >= 0, "every_point", o.every_point, ">= 0");
  require_stability(o.dense >= 3, "dense", o.dense, ">= 3");
  require_stability(o.leading >= 1, "leading", o.leading, ">= 1");
  require_stability(o.near_shift >= 1, "near_shift", o.near_shift, ">= 1");
  require_stability(o.krylov > 2 * o.near_shift, "krylov", o.krylov, ">= 2 stability.near_shift + 1");
  require_stability(o.restarts >= 1, "restarts", o.restarts, ">= 1");
  require_stability(o.tolerance > 0 && o.tolerance < 1e-2, "tolerance", o.tolerance, "in (0, 0.01)");
  require_stability(o.shifts >= 1 + static_cast<int>(o.frequencies.size()), "shifts", o.shifts,
                    "at least one more than stability.frequencies");
  require_stability(o.largest_frequency >= 0 && std::isfinite(o.largest_frequency), "largest_frequency",
                    o.largest_frequency, ">= 0");
  require_stability(o.lyapunov_space >= 8, "lyapunov_space", o.lyapunov_space, ">= 8");
  for (const double w : o.frequencies)
    require_stability(w >= 0 && std::isfinite(w), "frequencies", w, ">= 0");
}

}  // namespace arcslip::continuation
