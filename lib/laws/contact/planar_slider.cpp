#include <arcslip/laws/contact/planar_slider.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {

DiscAngles::DiscAngles(int count) {
  for (int k = 0; k < count; ++k) {
    theta.push_back(whole_turn * static_cast<double>(k) / static_cast<double>(count));
    cosine.push_back(std::cos(theta.back()));
    sine.push_back(std::sin(theta.back()));
  }
}

Disc::Disc(const Harmonics& harmonics) : harmonics_(harmonics), u_(harmonics.size(), 3) {
  u_.setZero();
}

void Disc::set(In x_1, In x_2, In h) {
  u_.col(0) = x_1;
  u_.col(1) = x_2;
  u_.col(2) = h;
  double bound[3][4] = {};
  for (int i = 0; i < 3; ++i)
    for (int n = 1; n <= harmonics_.order; ++n) {
      const double a = u_(n, i), b = u_(harmonics_.order + n, i);
      double wave = std::sqrt(a * a + b * b);  // an overflow is one of the force
      for (int order = 0; order < 4; ++order, wave *= n) bound[i][order] += wave;
    }
  for (int order = 0; order < 4; ++order) {
    motion_[order] = std::hypot(bound[0][order], bound[1][order]);
    radius_[order] = bound[2][order];
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

void Disc::at(const DiscAngles& angles, std::size_t stride, std::vector<DiscInstant>& instants) const {
  constexpr std::size_t width = 8;
  using Block = Eigen::Array<double, width, 1>;
  const std::size_t all = instants.size();
  for (std::size_t first = 0; first < all; first += width * stride) {
    Block c_1, s_1;
    const auto index = [&](std::size_t j) { return first + j * stride; };
    for (std::size_t j = 0; j < width; ++j) {
      const std::size_t k = std::min(index(j), all - 1);
      c_1[static_cast<Eigen::Index>(j)] = angles.cosine[k];
      s_1[static_cast<Eigen::Index>(j)] = angles.sine[k];
    }
    Block c = c_1, s = s_1, value[3];
    for (int i = 0; i < 3; ++i) value[i].setConstant(u_(0, i));
    for (int n = 1; n <= harmonics_.order; ++n) {
      for (int i = 0; i < 3; ++i) value[i] += u_(n, i) * c + u_(harmonics_.order + n, i) * s;
      const Block next = c * c_1 - s * s_1;
      s = s * c_1 + c * s_1;
      c = next;
    }
    for (std::size_t j = 0; j < width && index(j) < all; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      instants[index(j)] = {angles.theta[index(j)], {value[0][k], value[1][k]}, value[2][k]};
    }
  }
}

}  // namespace arcslip::elements
