#include <arcslip/time/implicit_elements.hpp>

#include <arcslip/continuation/dense_algebra.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::time {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 8;     // a residual of as many roundings of its terms is zero
constexpr double stagnated = 1e3;  // as many are, where no step makes them fewer
constexpr double flat = 0.5;       // of the slope that a search begins with: low enough
constexpr int largest_bisections = 60;

bool is_jenkins(const Element& element) {
  return element.law == model::Law::jenkins;
}

}  // namespace

ImplicitElements::ImplicitElements(std::vector<Element> elements, int dofs) : elements_(std::move(elements)) {
  const auto count = static_cast<Eigen::Index>(elements_.size());
  D_.resize(dofs, count);
  int sliders = 0;
  for (Eigen::Index e = 0; e < count; ++e) {
    const Element& element = elements_[static_cast<std::size_t>(e)];
    D_.col(e) = element.direction;
    sliders += element.slider >= 0 ? 1 : 0;
  }
  size_of_D_ = D_.cwiseAbs();
  J_.resize(dofs, dofs);
  lu_ = continuation::LU<double>(dofs);
  for (Vector* v : {&factored_, &q_, &force_, &stiffness_, &new_force_, &tangent_, &dq_}) v->setZero(count);
  for (Vector* v : {&z_, &slip_}) v->setZero(sliders);
  for (Vector* v : {&b_, &residual_, &size_, &step_, &trial_}) v->setZero(dofs);
}

void ImplicitElements::set_matrix(const Matrix& A) {
  A_ = A;
  size_of_A_ = A.cwiseAbs();
  has_factors_ = false;
}

void ImplicitElements::begin_at(const Vector& q, const Vector& z) {
  q_ = q;
  z_ = z;
  slip_.setZero();
  for (Eigen::Index e = 0; e < q_.size(); ++e) {
    const Element& element = elements_[static_cast<std::size_t>(e)];
    if (is_jenkins(element)) {
      const double f = element.stiffness * (q_[e] - z_[element.slider]);
      force_[e] = std::clamp(f, -element.slip_limit, element.slip_limit);
      if (force_[e] != f) z_[element.slider] = q_[e] - force_[e] / element.stiffness;
    } else {
      force_[e] = element.stiffness * q_[e] * q_[e] * q_[e];
    }
  }
  new_force_ = force_;
}

// Forces and tangents after the increment y.
void ImplicitElements::evaluate(const Vector& y) {
  dq_.noalias() = D_.transpose() * y;
  for (Eigen::Index e = 0; e < dq_.size(); ++e) {
    const Element& element = elements_[static_cast<std::size_t>(e)];
    if (is_jenkins(element)) {
      const double f = force_[e] + element.stiffness * dq_[e];
      const bool sticks = std::abs(f) < element.slip_limit;
      new_force_[e] = sticks ? f : std::copysign(element.slip_limit, f);
      tangent_[e] = sticks ? element.stiffness : 0;
    } else {
      const double q = q_[e] + dq_[e];
      new_force_[e] = element.stiffness * q * q * q;
      tangent_[e] = 3 * element.stiffness * q * q;
    }
  }
}

// b - A y - D f after y, and its largest entry in roundings of the terms that it is made of.
double ImplicitElements::residual(const Vector& y) {
  evaluate(y);
  residual_ = b_;
  residual_.noalias() -= A_ * y;
  residual_.noalias() -= D_ * new_force_;
  trial_ = y.cwiseAbs();
  size_ = b_.cwiseAbs();
  size_.noalias() += size_of_A_ * trial_;
  dq_.noalias() = size_of_D_.transpose() * trial_;
  dq_ = new_force_.cwiseAbs() + tangent_.cwiseAbs().cwiseProduct(dq_);
  size_.noalias() += size_of_D_ * dq_;
  if (!residual_.allFinite() || !size_.allFinite()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (Eigen::Index i = 0; i < size_.size(); ++i)
    if (residual_[i] != 0) largest = std::max(largest, std::abs(residual_[i]) / (eps * size_[i]));
  return largest / static_cast<double>(size_.size() + dq_.size());
}

// The tangent at the last evaluate(). False where it is singular.
bool ImplicitElements::factorize() {
  if (has_factors_ && factored_ == tangent_) return true;
  J_ = A_;
  for (Eigen::Index e = 0; e < tangent_.size(); ++e) {
    if (tangent_[e] == 0) continue;
    for (Eigen::Index j = 0; j < J_.cols(); ++j)
      if (D_(j, e) != 0) J_.col(j) += tangent_[e] * D_(j, e) * D_.col(e);
  }
  lu_.factorize(J_);
  factored_ = tangent_;
  has_factors_ = true;
  for (Eigen::Index i = 0; i < J_.cols(); ++i) {
    const double pivot = std::abs(lu_.pivot(i));
    const double column = J_.col(i).cwiseAbs().maxCoeff();
    if (pivot <= eps * static_cast<double>(J_.cols()) * column) has_factors_ = false;
  }
  return has_factors_;
}

// The share of step_ at which the slope of the convex function along it is small, which is `slope` < 0 at y.
double ImplicitElements::search(const Vector& y, double slope) {
  const auto slope_at = [&](double share) {
    trial_ = y + share * step_;
    evaluate(trial_);
    size_ = b_;
    size_.noalias() -= A_ * trial_;
    size_.noalias() -= D_ * new_force_;
    return -size_.dot(step_);
  };
  double low = 0, high = 1, share = 1;
  if (!(slope_at(1) > -flat * slope)) return 1;
  for (int i = 0; i < largest_bisections; ++i) {
    share = 0.5 * (low + high);
    const double here = slope_at(share);
    if (std::abs(here) <= -flat * slope) break;
    (here < 0 ? low : high) = share;
  }
  return share;
}

Solved ImplicitElements::solve(const Vector& b, Vector& y) {
  b_ = b;
  if (!y.allFinite()) y.setZero();
  for (Eigen::Index e = 0; e < q_.size(); ++e) {
    const Element& element = elements_[static_cast<std::size_t>(e)];
    stiffness_[e] = is_jenkins(element) ? element.stiffness : 3 * element.stiffness * q_[e] * q_[e];
  }
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < largest_iterations; ++i) {
    const double size = residual(y);
    if (!std::isfinite(size)) return Solved::not_finite;
    if (size <= rounding || (size <= stagnated && size > flat * last)) {
      dq_.noalias() = D_.transpose() * y;
      for (Eigen::Index e = 0; e < dq_.size(); ++e) {
        const Element& element = elements_[static_cast<std::size_t>(e)];
        if (is_jenkins(element))
          slip_[element.slider] = slides(static_cast<std::size_t>(e))
                                      ? dq_[e] - (new_force_[e] - force_[e]) / element.stiffness
                                      : 0;
      }
      return Solved::yes;
    }
    last = size;
    if (!factorize()) return Solved::singular;
    lu_.solve(residual_, step_);
    if (!step_.allFinite()) return Solved::not_finite;
    const double slope = -residual_.dot(step_);
    y += (slope < 0 ? search(y, slope) : 1.0) * step_;
  }
  return Solved::no;
}

bool ImplicitElements::slides(std::size_t element) const {
  return is_jenkins(elements_[element]) && tangent_[static_cast<Eigen::Index>(element)] == 0;
}

void ImplicitElements::accept() {
  q_ += dq_;
  z_ += slip_;
  force_ = new_force_;
}

double ImplicitElements::energy() const {
  double sum = 0;
  for (Eigen::Index e = 0; e < q_.size(); ++e) {
    const Element& element = elements_[static_cast<std::size_t>(e)];
    sum += is_jenkins(element) ? 0.5 * force_[e] * force_[e] / element.stiffness : 0.25 * force_[e] * q_[e];
  }
  return sum;
}

void ImplicitElements::force_change(const Matrix& dx, const Matrix& dz, Matrix& df) const {
  df.noalias() = D_.transpose() * dx;
  for (Eigen::Index e = 0; e < q_.size(); ++e) {
    const Element& element = elements_[static_cast<std::size_t>(e)];
    if (is_jenkins(element)) df.row(e) -= dz.row(element.slider);
    df.row(e) *= stiffness_[e];
  }
}

void ImplicitElements::differentiate(const Matrix& dx, Matrix& dz, Matrix& db) {
  df_.noalias() = D_.transpose() * dx;
  for (Eigen::Index e = 0; e < q_.size(); ++e) {
    const Element& element = elements_[static_cast<std::size_t>(e)];
    if (is_jenkins(element)) df_.row(e) -= dz.row(element.slider);
    df_.row(e) *= tangent_[e];
  }
  db.noalias() -= D_ * df_;
  factorize();
  lu_.solve_columns(db, df_);
  db = df_;
  for (Eigen::Index e = 0; e < q_.size(); ++e)
    if (slides(static_cast<std::size_t>(e)))
      dz.row(elements_[static_cast<std::size_t>(e)].slider) = D_.col(e).transpose() * (dx + db);
}

}  // namespace arcslip::time
