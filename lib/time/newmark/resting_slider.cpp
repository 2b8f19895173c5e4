#include <arcslip/time/newmark/resting_slider.hpp>

#include <algorithm>
#include <numbers>

namespace arcslip::time {
namespace {

constexpr long highest_order = 16;
constexpr long steps_per_order = 4;

}  // namespace

bool PlaneSlider::among(const std::vector<elements::Slider>& sliders) {
  return std::any_of(sliders.begin(), sliders.end(), [&](const elements::Slider& slider) {
    return slider.direction != sliders.front().direction;
  });
}

PlaneSlider::PlaneSlider(const TimeElement& element, long steps, Eigen::Index start)
    : element_(&element), steps_(steps) {
  harmonics_.order = static_cast<int>(std::clamp(steps / steps_per_order, 1L, highest_order));
  balance_ = element.law->element(harmonics_, {});
  const Eigen::Index size = element.directions.cols() * harmonics_.size();
  u_ = Vector::Zero(size);
  phi_.resize(harmonics_.size());
  u_start_ = Matrix::Zero(size, start);
  for (const elements::Slider& slider : element.law->sliders(element.fields)) {
    const bool free = element.law->traits(element.fields, slider.direction).limit == 0;
    coordinates_.push_back({slider.memory, free, free});
  }
}

bool PlaneSlider::rests() const {
  return std::none_of(coordinates_.begin(), coordinates_.end(),
                      [](const Coordinate& each) { return each.up && each.down; });
}

void PlaneSlider::step(const Vector& x, const Vector& memory_change,
                       const Eigen::Ref<const Matrix>& x_start) {
  ++done_;
  for (Coordinate& each : coordinates_) {
    const double slip = memory_change[element_->memory + each.memory];
    each.up = each.up || slip > 0;
    each.down = each.down || slip < 0;
  }
  if (!rests()) return;
  const double share = 1 / static_cast<double>(steps_);
  elements::series_basis(harmonics_, 2 * std::numbers::pi * share * static_cast<double>(done_), phi_);
  phi_ *= 2 * share;
  phi_[0] = share;
  const Eigen::Index c = harmonics_.size();
  for (Eigen::Index i = 0; i < element_->directions.cols(); ++i) {
    const auto direction = element_->directions.col(i);
    u_.segment(i * c, c) += direction.dot(x) * phi_;
    u_start_.middleRows(i * c, c) += phi_ * (direction.transpose() * x_start);
  }
}

void PlaneSlider::add_to(std::vector<RestingSlider>& resting) const {
  const elements::Law& law = *element_->law;
  balance_->move_to(u_, element_->fields, true);
  const Eigen::Index c = harmonics_.size(), d = element_->directions.cols(), columns = u_start_.cols();
  Vector mean(d), force(d), w(law.memory());
  Matrix mean_start(d, columns), force_start(d, columns), w_start(law.memory(), columns);
  for (Eigen::Index i = 0; i < d; ++i) {
    mean[i] = u_[i * c];
    force[i] = balance_->force()[i * c];
    mean_start.row(i) = u_start_.row(i * c);
    force_start.row(i) = balance_->jacobian().row(i * c) * u_start_;
  }
  const auto in_time = law.in_time(element_->fields);
  in_time->memory_at(mean, force, w);  // linear where sliders rest
  for (Eigen::Index j = 0; j < columns; ++j)
    in_time->memory_at(mean_start.col(j), force_start.col(j), w_start.col(j));
  for (int k = 0; k < law.memory(); ++k) resting.push_back({element_->memory + k, w[k], w_start.row(k)});
}

}  // namespace arcslip::time
