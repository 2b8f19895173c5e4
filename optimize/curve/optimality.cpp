#include <arcslip/optimize/curve/optimality.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {
namespace {

using continuation::Evaluated;
using continuation::In;
using continuation::Matrix;
using continuation::Needs;

constexpr double same_direction = 1e-9;  // of a gradient: what is less adds no direction

}  // namespace

Eigen::Index ActiveSet::free() const {
  return std::count(held.begin(), held.end(), 0);
}

OptimalityEvaluator::OptimalityEvaluator(std::shared_ptr<const OptimalityData> data)
    : data_(std::move(data)),
      free_(data_->active.free()),
      active_(static_cast<Eigen::Index>(data_->active.peaks.size())),
      design_(data_->scaled.size()),
      lambda_(active_),
      E_(free_ + active_),
      E_sigma_(Vector::Zero(free_ + active_)),
      y_(static_cast<Eigen::Index>(data_->scaled.size())),
      gradients_(y_.size(), active_),
      second_(Matrix::Zero(y_.size(), y_.size())),
      jacobian_(Matrix(Matrix::Zero(free_ + active_, free_ + active_))) {
  for (std::size_t k = 0; k < data_->active.held.size(); ++k)
    if (data_->active.held[k] == 0) free_parameters_.push_back(static_cast<Eigen::Index>(k));
}

Evaluated OptimalityEvaluator::move_to(In z, In p, Needs needs) {
  if (!move_design(z, p[0]) || !data_->peaks.follow_to(design_, data_->active.peaks))
    return Evaluated::outside_domain;
  lambda_[0] = 1 - z.segment(free_, active_ - 1).sum();
  lambda_.tail(active_ - 1) = z.segment(free_, active_ - 1);
  tau_ = z[free_ + active_ - 1];
  look_at_peaks();
  if (std::any_of(peaks_.begin(), peaks_.end(), [](const Peak& peak) { return peak.rises_inwards(); }))
    return Evaluated::outside_domain;
  for (Eigen::Index k = 0; k < free_; ++k)
    E_[k] = gradients_.row(free_parameters_[static_cast<std::size_t>(k)]).dot(lambda_);
  if (!E_.allFinite()) return Evaluated::failed;
  if (needs == Needs::residual) return Evaluated::ok;
  if (!add_second_derivatives()) return Evaluated::failed;
  differentiate();
  return Evaluated::ok;
}

// Sets y and the design, with the free parameters of z and those fixed at their bounds. False: not finite.
bool OptimalityEvaluator::move_design(In z, double sigma) {
  Eigen::Index next = 0;
  for (std::size_t k = 0; k < design_.size(); ++k) {
    const ScaledParameter& scaled = data_->scaled[k];
    const bool is_along = k + 1 == design_.size();
    const int side = is_along ? 0 : data_->active.held[k];
    const double y = is_along ? sigma : side != 0 ? scaled.scaled(scaled.bound(side)) : z[next++];
    y_[static_cast<Eigen::Index>(k)] = y;
    design_[k] = side != 0 ? scaled.bound(side) : scaled.value(y);
    if (!std::isfinite(design_[k])) return false;
  }
  return true;
}

// Sets the levels of all peaks, the highest one that is not active, and what the active ones add to the
// equations.
void OptimalityEvaluator::look_at_peaks() {
  const auto& active = data_->active.peaks;
  all_ = data_->peaks.state().peaks;
  levels_.clear();
  other_.reset();
  for (std::size_t i = 0; i < all_.size(); ++i) {
    levels_.push_back(std::log(all_[i].amplitude / data_->reference));
    if (std::find(active.begin(), active.end(), i) != active.end() || all_[i].kind == PeakKind::kink ||
        all_[i].rises_inwards())
      continue;
    if (!other_ || levels_[i] > levels_[*other_]) other_ = i;
  }
  peaks_.clear();
  piece_ = 0;
  for (Eigen::Index i = 0; i < active_; ++i) {
    const std::size_t at = active[static_cast<std::size_t>(i)];
    const Peak& peak = peaks_.emplace_back(all_[at]);
    piece_ = 31 * piece_ + peak.piece;
    gradients_.col(i) = scaled_gradient(peak, design_.size());
    E_[free_ + i] = levels_[at] - tau_;
  }
}

// df_i/dy of so many parameters.
Vector OptimalityEvaluator::scaled_gradient(const Peak& peak, std::size_t parameters) const {
  Vector gradient(static_cast<Eigen::Index>(parameters));
  for (std::size_t k = 0; k < parameters; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    gradient[row] = peak.gradient[row] * data_->scaled[k].slope(design_[k]) / peak.amplitude;
  }
  return gradient;
}

// False: those of a peak are not known.
bool OptimalityEvaluator::add_second_derivatives() {
  second_.setZero();
  for (Eigen::Index i = 0; i < active_; ++i) {
    const std::size_t at = data_->active.peaks[static_cast<std::size_t>(i)];
    const Matrix H = data_->peaks.hessian(at);
    if (H.size() == 0) return false;
    const Peak& peak = all_[at];
    for (std::size_t k = 0; k < design_.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const double slope = data_->scaled[k].slope(design_[k]);
      for (std::size_t l = 0; l < design_.size(); ++l) {
        const auto column = static_cast<Eigen::Index>(l);
        const double along = slope * data_->scaled[l].slope(design_[l]);
        second_(row, column) += lambda_[i] * (H(row, column) * along / peak.amplitude -
                                              gradients_(row, i) * gradients_(column, i));
      }
      second_(row, row) +=
          lambda_[i] * peak.gradient[row] * data_->scaled[k].second(design_[k]) / peak.amplitude;
    }
  }
  return true;
}

void OptimalityEvaluator::differentiate() {
  auto& J = std::get<Matrix>(jacobian_);
  const Eigen::Index sigma = y_.size() - 1, tau = free_ + active_ - 1;
  J.setZero();
  for (Eigen::Index k = 0; k < free_; ++k) {
    const Eigen::Index row = free_parameters_[static_cast<std::size_t>(k)];
    for (Eigen::Index l = 0; l < free_; ++l)
      J(k, l) = second_(row, free_parameters_[static_cast<std::size_t>(l)]);
    for (Eigen::Index i = 1; i < active_; ++i) J(k, free_ + i - 1) = gradients_(row, i) - gradients_(row, 0);
    E_sigma_[k] = second_(row, sigma);
  }
  for (Eigen::Index i = 0; i < active_; ++i) {
    for (Eigen::Index l = 0; l < free_; ++l)
      J(free_ + i, l) = gradients_(free_parameters_[static_cast<std::size_t>(l)], i);
    J(free_ + i, tau) = -1;
    E_sigma_[free_ + i] = gradients_(sigma, i);
  }
}

double OptimalityEvaluator::slack(const Inequality& of) const {
  if (of.kind == Inequality::Kind::peak) {
    const auto& active = data_->active.peaks;
    const auto at = std::find(active.begin(), active.end(), of.index);
    return at != active.end() ? lambda_[at - active.begin()] : tau_ - levels_[of.index];
  }
  const auto k = static_cast<Eigen::Index>(of.index);
  if (data_->active.held[of.index] == of.side) return -of.side * gradients_.row(k).dot(lambda_);
  const ScaledParameter& scaled = data_->scaled[of.index];
  return of.side * (scaled.scaled(scaled.bound(of.side)) - y_[k]);
}

continuation::Vector OptimalityEvaluator::gradient(std::size_t peak) const {
  return scaled_gradient(all_[peak], design_.size() - 1);
}

bool OptimalityEvaluator::is_minimum() const {
  if (free_ == 0) return true;
  Matrix G(free_, active_), W(free_, free_);
  for (Eigen::Index k = 0; k < free_; ++k) {
    const Eigen::Index row = free_parameters_[static_cast<std::size_t>(k)];
    G.row(k) = gradients_.row(row);
    for (Eigen::Index l = 0; l < free_; ++l)
      W(k, l) = second_(row, free_parameters_[static_cast<std::size_t>(l)]);
  }
  // A single gradient vanishes at the optimum; of several, differences span what is not free.
  const Matrix D = G.rightCols(active_ - 1).colwise() - G.col(0);
  Matrix N = Matrix::Identity(free_, free_);
  if (D.cols() > 0) N = continuation::orthogonal_complement(D, same_direction);
  return N.cols() == 0 || continuation::symmetric_eigenvalues(N.transpose() * W * N)[0] > 0;
}

namespace {

class OptimalityProblem final : public continuation::Problem {
 public:
  explicit OptimalityProblem(std::shared_ptr<const OptimalityData> data) : data_(std::move(data)) {}

  int size() const override { return static_cast<int>(data_->active.unknowns()); }
  std::span<const continuation::Parameter> parameters() const override { return {&sigma_, 1}; }
  Vector scales() const override { return Vector::Ones(size()); }
  std::unique_ptr<continuation::Evaluator> evaluator() const override {
    return std::make_unique<OptimalityEvaluator>(data_);
  }

 private:
  std::shared_ptr<const OptimalityData> data_;
  continuation::Parameter sigma_{"sigma", "-", 0, 1};
};

}  // namespace

std::shared_ptr<const continuation::Problem> optimality(std::shared_ptr<const OptimalityData> data) {
  return std::make_shared<OptimalityProblem>(std::move(data));
}

}  // namespace arcslip::optimize
