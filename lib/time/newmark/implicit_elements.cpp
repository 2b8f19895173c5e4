#include <arcslip/time/newmark/implicit_elements.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::time {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double residual_roundings = 8;  // a residual of as many roundings of its terms is zero
constexpr double stagnated = 1e3;         // as many are, where no step makes them fewer
constexpr double flat = 0.5;              // of the slope that a search begins with: low enough
constexpr int largest_bisections = 60, largest_halvings = 10;

}  // namespace

ImplicitElements::ImplicitElements(std::vector<TimeElement> elements, int dofs)
    : elements_(std::move(elements)) {
  Eigen::Index directions = 0, tangents = 0;
  int memory = 0;
  for (const TimeElement& element : elements_) {
    const int own = element.law->directions();
    laws_.push_back(element.law->in_time(element.fields));
    first_.push_back(directions);
    ends_.emplace_back(own, element.law->memory());
    starts_.emplace_back(own, element.law->memory());
    const bool moves = element.law->rate_dependent();
    convex_ = convex_ && element.law->symmetric_step();
    moves_ = moves_ || moves;
    directions += own;
    tangents += (moves ? 2 : 1) * own * own;
    memory = std::max(memory, element.memory + element.law->memory());
  }
  D_.resize(dofs, directions);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    D_.middleCols(first_[e], elements_[e].directions.cols()) = elements_[e].directions;
  size_of_D_ = D_.cwiseAbs();
  J_.resize(dofs, dofs);
  lu_ = continuation::LU<double>(dofs);
  for (Vector* v : {&factored_, &tangent_}) v->setZero(tangents);
  for (Vector* v : {&q_, &force_, &last_q_, &new_force_, &dq_}) v->setZero(directions);
  for (Vector* v : {&rate_, &last_rate_, &carried_, &new_rate_}) v->setZero(directions);
  for (Vector* v : {&z_, &dz_, &last_z_}) v->setZero(memory);
  moved_.setZero(std::max<Eigen::Index>(directions, memory));
  for (Vector* v : {&b_, &residual_, &size_, &step_, &trial_, &halved_}) v->setZero(dofs);
}

void ImplicitElements::set_matrix(const Matrix& A) {
  A_ = A;
  size_of_A_ = A.cwiseAbs();
  convex_ = convex_ && A == A.transpose();
  has_factors_ = false;
}

void ImplicitElements::set_velocities(const Matrix& B, const Matrix& S) {
  if (!moves_) return;
  B_of_D_ = B.transpose() * D_;
  S_of_D_ = S.transpose() * D_;
  has_factors_ = false;
}

void ImplicitElements::begin(const Vector& x, const Vector& v, const Vector& z) {
  begin_at(D_.transpose() * x, D_.transpose() * v, z);
  if (S_of_D_.size() > 0) carried_.noalias() = S_of_D_.transpose() * v;
}

void ImplicitElements::begin_at(const Vector& q, const Vector& rate, const Vector& z) {
  q_ = q;
  rate_ = carried_ = rate;
  start_phase_ = phase_;
  z_ = z;
  dz_.setZero();
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const TimeElement& element = elements_[e];
    const auto d = element.directions.cols(), m = ends_[e].dz.size();
    ends_[e].v = rate_.segment(first_[e], d);
    ends_[e].phase = phase_;
    laws_[e]->begin(q_.segment(first_[e], d), z_.segment(element.memory, m), ends_[e]);
    force_.segment(first_[e], d) = ends_[e].f;
  }
  new_force_ = force_;
}

// Forces and tangents after the increment y.
void ImplicitElements::evaluate(const Vector& y) {
  dq_.noalias() = D_.transpose() * y;
  if (moves_) {
    new_rate_ = carried_;
    if (B_of_D_.size() > 0) new_rate_.noalias() += B_of_D_.transpose() * y;
  }
  Eigen::Index at = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const TimeElement& element = elements_[e];
    elements::StepEnd& end = ends_[e];
    const auto d = end.f.size(), m = end.dz.size(), i = first_[e];
    if (moves_) end.v = new_rate_.segment(i, d);
    end.phase = phase_;
    laws_[e]->step({q_.segment(i, d), z_.segment(element.memory, m), force_.segment(i, d)}, dq_.segment(i, d),
                   end);
    new_force_.segment(i, d) = end.f;
    tangent_.segment(at, d * d) = end.f_q.reshaped();
    at += d * d;
    if (!element.law->rate_dependent()) continue;
    tangent_.segment(at, d * d) = end.f_v.reshaped();
    at += d * d;
  }
}

// The residual b - A y - D f at y, and its largest entry in units of the rounding of its terms.
double ImplicitElements::residual(const Vector& y) {
  evaluate(y);
  residual_ = b_;
  residual_.noalias() -= A_ * y;
  residual_.noalias() -= D_ * new_force_;
  trial_ = y.cwiseAbs();
  size_ = b_.cwiseAbs();
  size_.noalias() += size_of_A_ * trial_;
  dq_.noalias() = size_of_D_.transpose() * trial_;
  Eigen::Index t = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const auto d = ends_[e].f.size();
    if (d == 1) {
      dq_[first_[e]] *= std::abs(tangent_[t]);
    } else {
      auto own = dq_.segment(first_[e], d);
      moved_.head(d).noalias() = ends_[e].f_q.cwiseAbs().lazyProduct(own);
      own = moved_.head(d);
    }
    t += d * d;
    if (!elements_[e].law->rate_dependent()) continue;
    const auto i = first_[e];
    moved_.head(d) = new_rate_.segment(i, d).cwiseAbs() + 2 * carried_.segment(i, d).cwiseAbs();
    dq_.segment(i, d).noalias() += ends_[e].f_v.cwiseAbs().lazyProduct(moved_.head(d));
    t += d * d;
  }
  dq_ += new_force_.cwiseAbs();
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
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Matrix& T = ends_[e].f_q;
    for (Eigen::Index l = 0; l < T.cols(); ++l)
      for (Eigen::Index k = 0; k < T.rows(); ++k) {
        if (T(k, l) == 0) continue;
        const auto row = D_.col(first_[e] + k), column = D_.col(first_[e] + l);
        for (Eigen::Index j = 0; j < J_.cols(); ++j)
          if (column[j] != 0) J_.col(j) += T(k, l) * column[j] * row;
      }
    if (!elements_[e].law->rate_dependent() || B_of_D_.size() == 0) continue;
    for (Eigen::Index l = 0; l < T.cols(); ++l)
      for (Eigen::Index k = 0; k < T.rows(); ++k) {
        const auto row = D_.col(first_[e] + k), column = B_of_D_.col(first_[e] + l);
        for (Eigen::Index j = 0; j < J_.cols(); ++j)
          if (column[j] != 0) J_.col(j) += ends_[e].f_v(k, l) * column[j] * row;
      }
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

// The share of step_ at which the residual is smaller than `size`, which it is at y.
double ImplicitElements::halve(const Vector& y, double size) {
  double share = 1;
  for (int i = 0; i < largest_halvings; ++i, share /= 2) {
    halved_ = y + share * step_;
    if (residual(halved_) < size) return share;
  }
  return share;
}

Solved ImplicitElements::solve(const Vector& b, Vector& y) {
  b_ = b;
  if (!y.allFinite()) y.setZero();
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < largest_iterations; ++i) {
    const double size = residual(y);
    if (!std::isfinite(size)) return Solved::not_finite;
    if (size <= residual_roundings || (size <= stagnated && size > flat * last)) {
      dq_.noalias() = D_.transpose() * y;
      for (std::size_t e = 0; e < elements_.size(); ++e)
        dz_.segment(elements_[e].memory, ends_[e].dz.size()) = ends_[e].dz;
      return Solved::yes;
    }
    last = size;
    if (!factorize()) return Solved::singular;
    lu_.solve(residual_, step_);
    if (!step_.allFinite()) return Solved::not_finite;
    if (!convex_) {
      y += halve(y, size) * step_;
      continue;
    }
    const double slope = -residual_.dot(step_);
    y += (slope < 0 ? search(y, slope) : 1.0) * step_;
  }
  return Solved::no;
}

void ImplicitElements::accept(const Vector& v) {
  if (moves_) {
    last_rate_ = rate_;
    rate_ = new_rate_;
    if (S_of_D_.size() > 0) carried_.noalias() = S_of_D_.transpose() * v;
  }
  last_q_ = q_;
  last_z_ = z_;
  last_phase_ = start_phase_;
  start_phase_ = phase_;
  q_ += dq_;
  z_ += dz_;
  force_ = new_force_;
}

double ImplicitElements::energy() const {
  double sum = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const TimeElement& element = elements_[e];
    sum += laws_[e]->stored(q_.segment(first_[e], element.directions.cols()),
                            z_.segment(element.memory, ends_[e].dz.size()));
  }
  return sum;
}

void ImplicitElements::force_change(const Matrix& dx, const Matrix& dv, const Matrix& dz, Matrix& df) {
  dq_columns_.noalias() = D_.transpose() * dx;
  df.resize(dq_columns_.rows(), dq_columns_.cols());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const TimeElement& element = elements_[e];
    const auto d = element.directions.cols(), m = ends_[e].dz.size(), i = first_[e];
    elements::StepEnd& at = starts_[e];
    auto z = moved_.head(m);
    z = last_z_.segment(element.memory, m);
    at.v = last_rate_.segment(i, d);
    at.phase = last_phase_;
    laws_[e]->begin(last_q_.segment(i, d), z, at);
    df.middleRows(i, d).noalias() = at.f_q * dq_columns_.middleRows(i, d);
    df.middleRows(i, d).noalias() += at.f_z * dz.middleRows(element.memory, m);
    if (element.law->rate_dependent()) df.middleRows(i, d) += at.f_v * (element.directions.transpose() * dv);
  }
}

void ImplicitElements::differentiate(const Matrix& dx, const Matrix& dv, Matrix& dz, Matrix& db) {
  dq_columns_.noalias() = D_.transpose() * dx;
  df_.resize(dq_columns_.rows(), dq_columns_.cols());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const elements::StepEnd& end = ends_[e];
    const auto d = end.f.size(), m = end.dz.size(), i = first_[e];
    df_.middleRows(i, d).noalias() = (end.f_q + end.f_start) * dq_columns_.middleRows(i, d);
    df_.middleRows(i, d).noalias() += end.f_z * dz.middleRows(elements_[e].memory, m);
    if (elements_[e].law->rate_dependent() && S_of_D_.size() > 0)
      df_.middleRows(i, d) += end.f_v * (S_of_D_.middleCols(i, d).transpose() * dv);
    if (m > 0)
      dz.middleRows(elements_[e].memory, m) = (end.z_z * dz.middleRows(elements_[e].memory, m) +
                                               (end.z_q + end.z_start) * dq_columns_.middleRows(i, d))
                                                  .eval();
  }
  db.noalias() -= D_ * df_;
  factorize();
  lu_.solve_columns(db, df_);
  db = df_;
  dq_columns_.noalias() = D_.transpose() * db;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (const auto m = ends_[e].dz.size(); m > 0)
      dz.middleRows(elements_[e].memory, m).noalias() +=
          ends_[e].z_q * dq_columns_.middleRows(first_[e], ends_[e].f.size());
}

}  // namespace arcslip::time
