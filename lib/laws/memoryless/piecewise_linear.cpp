#include <arcslip/laws/memoryless/piecewise_linear.hpp>

#include <arcslip/laws/memoryless/piecewise_linear_curve.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::elements {
namespace {

bool is_antisymmetric(const PiecewiseLinearShape& shape) {
  const std::size_t last = shape.corners.size();
  for (std::size_t i = 0; i < last; ++i)
    if (shape.corners[i] != -shape.corners[last - 1 - i]) return false;
  return std::all_of(shape.terms.begin(), shape.terms.end(), [&](const auto& lines) {
    for (std::size_t j = 0; j <= last; ++j)
      if (lines[j].slope != lines[last - j].slope || lines[j].offset != -lines[last - j].offset) return false;
    return true;
  });
}

}  // namespace

PiecewiseLinearCurve::PiecewiseLinearCurve(const std::vector<PiecewiseLinearShape>& shapes, Fields fields)
    : fields_(fields), shape_(&shapes.front()) {
  if (shapes.size() == 1) return;
  length_ = std::abs(fields.back());
  sign_ = fields.back() < 0 ? -1 : 1;
  if (sign_ < 0) shape_ = &shapes.back();
}

std::size_t PiecewiseLinearCurve::line_at(double q) const {
  const auto& all = shape_->corners;
  const auto first_not_below =
      std::partition_point(all.begin(), all.end(), [&](double c) { return q > c * length_; });
  return static_cast<std::size_t>(first_not_below - all.begin());
}

bool PiecewiseLinearCurve::is_empty(std::size_t j) const {
  return j > 0 && j + 1 < lines() && !(corner(j - 1) < corner(j));
}

double PiecewiseLinearCurve::slope(std::size_t j) const {
  double sum = 0;
  for (std::size_t a = 0; a < shape_->terms.size(); ++a) sum += fields_[a] * shape_->terms[a][j].slope;
  return sum;
}

double PiecewiseLinearCurve::offset(std::size_t j) const {
  double sum = 0;
  for (std::size_t a = 0; a < shape_->terms.size(); ++a)
    sum += fields_[a] * (shape_->terms[a][j].offset * length_);
  return sum;
}

double PiecewiseLinearCurve::force(std::size_t j, double q) const {
  double sum = 0;
  for (std::size_t a = 0; a < shape_->terms.size(); ++a) {
    const auto [slope, offset] = shape_->terms[a][j];
    sum += fields_[a] * (slope * q + offset * length_);
  }
  return sum;
}

PiecewiseLinearLaw::PiecewiseLinearLaw(PiecewiseLinearShape shape)
    : shapes_{std::move(shape)}, antisymmetric_(is_antisymmetric(shapes_.front())) {}

PiecewiseLinearLaw::PiecewiseLinearLaw(PiecewiseLinearShape positive, PiecewiseLinearShape negative)
    : shapes_{std::move(positive), std::move(negative)},
      antisymmetric_(is_antisymmetric(shapes_.front()) && is_antisymmetric(shapes_.back())) {}

Traits PiecewiseLinearLaw::traits(Fields fields, int) const {
  const PiecewiseLinearCurve curve(shapes_, fields);
  const std::size_t last = curve.lines() - 1;
  Traits traits;
  for (std::size_t j = 0; j <= last; ++j) {
    if (curve.is_empty(j)) continue;
    const double stiffness = std::abs(curve.slope(j));
    if (stiffness > traits.stiffness) {
      traits.stiffness = stiffness;
      traits.stiffness_field = -1;
      if (curve.length_sign() == 0) continue;  // factors
      for (std::size_t a = 0; a < curve.shape().terms.size(); ++a)
        if (fields[a] == stiffness) traits.stiffness_field = static_cast<int>(a);
    }
  }
  for (std::size_t j = 1; j <= last; ++j)
    if (!curve.is_empty(j) && curve.slope(j) != curve.slope(0)) traits.several_responses = true;
  const auto acts = [&](std::size_t j) { return curve.slope(j) != 0 || curve.offset(j) != 0; };
  const std::size_t below = curve.line_at(0),
                    above = curve.line_at(std::numeric_limits<double>::denorm_min());
  traits.holds_mean = (acts(0) && acts(last)) || (curve.slope(below) != 0 && curve.slope(above) != 0);
  traits.far_power = curve.slope(0) != 0 || curve.slope(last) != 0 ? 1 : 0;
  return traits;
}

double PiecewiseLinearLaw::stiffness(Fields fields, int, double reach) const {
  const PiecewiseLinearCurve curve(shapes_, fields);
  double largest = 0;
  for (std::size_t j = curve.line_at(-reach); j <= curve.line_at(reach); ++j)
    if (!curve.is_empty(j)) largest = std::max(largest, std::abs(curve.slope(j)));
  return largest;
}

std::unique_ptr<Element> PiecewiseLinearLaw::element(const Harmonics& harmonics, const Sampling&) const {
  return make_piecewise_linear(shapes_, harmonics);
}

std::unique_ptr<Corners> PiecewiseLinearLaw::corners(const Harmonics& harmonics) const {
  return make_piecewise_linear_corners(shapes_, antisymmetric_, harmonics);
}

Eigen::MatrixXd PiecewiseLinearLaw::force_at(const Harmonics& h, In u, Fields fields, Angles angles) const {
  const PiecewiseLinearCurve curve(shapes_, fields);
  Eigen::MatrixXd f(static_cast<Eigen::Index>(angles.size()), 1);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double q = series_values(h, u, angles[i]).x;
    f(static_cast<Eigen::Index>(i), 0) = curve.force(curve.line_at(q), q);
  }
  return f;
}

std::optional<std::vector<Automaton>> PiecewiseLinearLaw::automata(Fields fields) const {
  const PiecewiseLinearCurve curve(shapes_, fields);
  Automaton lines(-1);
  for (std::size_t j = 0; j < curve.lines(); ++j) {
    Mode& mode = lines.add(curve.shape().names[j], curve.slope(j), 0, curve.offset(j));
    const int at = static_cast<int>(j);
    if (j > 0) mode.leaves_where(1, 0, 0, -curve.corner(j - 1), at - 1);
    if (j + 1 < curve.lines()) mode.leaves_where(-1, 0, 0, curve.corner(j), at + 1);
  }
  return std::vector{lines};
}

}  // namespace arcslip::elements
