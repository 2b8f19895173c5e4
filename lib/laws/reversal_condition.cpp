#include <arcslip/laws/reversal_condition.hpp>

#include <cmath>

namespace arcslip::elements {
namespace {

constexpr int reversal_newton_steps = 20;
constexpr double same_reversal = 0.3;  // rad: farther off, it is another one

}  // namespace

bool polish_reversal(const Harmonics& h, In w, double sign, double& theta) {
  const double begin = theta;
  for (int k = 0; k < reversal_newton_steps; ++k) {
    const Values at = series_values(h, w, theta);
    if (!(sign * at.d2 < 0)) return false;
    const double step = -at.d1 / at.d2;
    theta += step;
    if (!(std::abs(theta - begin) <= same_reversal)) return false;
    if (std::abs(step) <= 1e-14) break;
  }
  return true;
}

void set_reversal_row(const Harmonics& h, const Corner& corner, In w, int row, Corners::Equations& at) {
  const double theta = corner.angles[static_cast<std::size_t>(row - 1)];
  const Values values = series_values(h, w, theta);
  at.values[row] = values.d1;
  at.by_angle.row(row).setZero();
  at.by_angle(row, row - 1) = values.d2;
  at.by_field.row(row).setZero();
  if (!h.odd) at.by_motion(row, 0) = 0;
  for (int j = 0; j < h.sines(); ++j) {
    const int n = h.sine_order(j);
    at.by_motion(row, h.cosine_index(n)) = -n * std::sin(n * theta);
    at.by_motion(row, h.sine_index(n)) = n * std::cos(n * theta);
  }
}

}  // namespace arcslip::elements
