#include <arcslip/laws/contact/planar_slider.hpp>

#include <cmath>

namespace arcslip::elements {

Disc::Disc(const Harmonics& harmonics) : harmonics_(harmonics), u_(harmonics.size(), 3) {
  u_.setZero();
}

void Disc::set(In x_1, In x_2, In h) {
  u_.col(0) = x_1;
  u_.col(1) = x_2;
  u_.col(2) = h;
  for (int order = 0; order < 4; ++order) {
    motion_[order] =
        std::hypot(series_bound(harmonics_, u_.col(0), order), series_bound(harmonics_, u_.col(1), order));
    radius_[order] = series_bound(harmonics_, u_.col(2), order);
  }
  largest_ = std::abs(u_(0, 2)) + radius_[0];
}

DiscPoint Disc::at(double theta) const {
  return at(std::cos(theta), std::sin(theta));
}

DiscPoint Disc::at(double c_1, double s_1) const {
  const int order = harmonics_.order;
  double c = c_1, s = s_1, value[3], d1[3] = {}, d2[3] = {};
  for (int i = 0; i < 3; ++i) value[i] = u_(0, i);
  for (int n = 1; n <= order; ++n) {
    for (int i = 0; i < 3; ++i) {
      const double a = u_(n, i), b = u_(order + n, i);
      const double even = a * c + b * s;
      value[i] += even;
      d1[i] += n * (b * c - a * s);
      d2[i] -= static_cast<double>(n) * n * even;
    }
    const double next = c * c_1 - s * s_1;
    s = s * c_1 + c * s_1;
    c = next;
  }
  return {{value[0], value[1]}, {d1[0], d1[1]}, {d2[0], d2[1]}, value[2], d1[2], d2[2]};
}

}  // namespace arcslip::elements
