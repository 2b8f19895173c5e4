#include <arcslip/continuation/correction/mode_crossings.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <cmath>
#include <exception>

namespace arcslip::continuation {
namespace {

constexpr Eigen::Index all_modes = 24;  // up to this size all are computed
constexpr Eigen::Index block_size = 3;  // of the Krylov space: modes that cross zero at the same point
constexpr double quiet = 0.2;           // of B_1^-1 B_m - 1: below this no mode crosses zero
constexpr double dependent = 1e-8;      // of a column, left by the others
constexpr double zero_mode = 1e-6;      // of a mode at the second point, in its value in the middle
constexpr double nearly_real = 1e-4;    // of an eigenvalue: double ones are split by rounding

// The independent columns of `block`, orthonormalized against Q and each other.
Matrix orthonormal_nearby(const Matrix& Q, const Matrix& block) {
  Matrix result(block.rows(), 0);
  for (Eigen::Index j = 0; j < block.cols(); ++j) {
    Vector q = block.col(j);
    const double before = q.norm();
    for (int sweep = 0; sweep < 2; ++sweep) {
      q -= Q * (Q.transpose() * q);
      q -= result * (result.transpose() * q);
    }
    if (!(q.norm() > dependent * before) || before == 0) continue;
    result.conservativeResize(Eigen::NoChange, result.cols() + 1);
    result.rightCols(1) = q.normalized();
  }
  return result;
}

int negative(const Eigen::VectorXcd& eigenvalues) {
  int count = 0;
  for (const auto& mu : eigenvalues)
    if (mu.real() < 0 && std::abs(mu.imag()) <= nearly_real * std::abs(mu.real())) ++count;
  return count;
}

}  // namespace

ModeCounter::ModeCounter(const Problem& problem, const Vector& p, int free, Counts& counts)
    : problem_(problem),
      p_(p),
      free_(free),
      counts_(counts),
      at_(problem.evaluator()),
      scale_(problem.size() + 1),
      F_p_(problem.size()),
      x_(problem.size() + 1),
      y_(problem.size() + 1),
      middle_(problem.size() + 1) {
  scale_ << problem.scales(), problem.parameters()[static_cast<std::size_t>(free)].scale;
}

bool ModeCounter::evaluate(const Vector& v, std::uint64_t piece) try {
  p_[free_] = v[v.size() - 1];
  ++counts_.jacobians;
  if (at_->move_to(v.head(v.size() - 1), p_, Needs::jacobian) != Evaluated::ok || at_->piece() != piece)
    return false;
  at_->parameter_derivative(free_, F_p_);
  return F_p_.allFinite();
} catch (const std::exception&) {  // outside the domain, as it says
  return false;
}

// Y = B_1^-1 B Q in scales, B where the evaluator is.
bool ModeCounter::multiply(const Matrix& Q, Matrix& Y) try {
  const Eigen::Index n = F_p_.size();
  Y.resize(Q.rows(), Q.cols());
  for (Eigen::Index j = 0; j < Q.cols(); ++j) {
    x_ = scale_.cwiseProduct(Q.col(j));
    apply(at_->jacobian(), x_.head(n), y_.head(n));
    y_.head(n) += x_[n] * F_p_;
    y_[n] = row_->dot(x_);
    ++counts_.solves;
    at_to_->solve(y_);
    Y.col(j) = y_.cwiseQuotient(scale_);
  }
  return Y.allFinite();
} catch (const std::exception&) {
  return false;
}

bool ModeCounter::counts_all() const {
  return scale_.size() <= all_modes;
}

// Builds Q and Y. No columns: no mode is near zero.
bool ModeCounter::basis() {
  const Eigen::Index size = scale_.size();
  if (counts_all()) {
    Q_ = Matrix::Identity(size, size);
    return multiply(Q_, Y_);
  }
  Q_.resize(size, 0);
  Y_.resize(size, 0);
  block_.resize(size, block_size);
  for (Eigen::Index j = 0; j < block_size; ++j)
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto x = static_cast<double>(i);
      block_(i, j) = std::sin((0.7 + 0.1 * static_cast<double>(j)) * x * x + 0.5 + static_cast<double>(j));
    }
  block_ = orthonormal_nearby(Q_, block_);
  if (!multiply(block_, image_)) return false;
  block_ = orthonormal_nearby(Q_, image_ - block_);
  while (Q_.cols() + block_.cols() <= all_modes && block_.cols() > 0) {
    if (!multiply(block_, image_)) return false;
    const Eigen::Index before = Q_.cols(), next = block_.cols();
    const Matrix beyond = image_ - block_;
    if (before == 0 && beyond.colwise().norm().maxCoeff() < quiet) return true;
    Q_.conservativeResize(Eigen::NoChange, before + next);
    Y_.conservativeResize(Eigen::NoChange, before + next);
    Q_.rightCols(next) = block_;
    Y_.rightCols(next) = image_;
    block_ = orthonormal_nearby(Q_, beyond);
  }
  return true;
}

std::optional<ModeCrossings> ModeCounter::between(const CurvePoint& from, const CurvePoint& to, double length,
                                                  const Vector& row, const LinearSolver& at_to) {
  row_ = &row;
  at_to_ = &at_to;
  hermite(from.v, from.tangent, to.v, to.tangent, length, 0.5, middle_);
  if (!evaluate(middle_, from.piece)) return {};
  ModeCrossings result;
  result.at_zero = !basis();  // B_1 is singular to the last bit
  if (result.at_zero || Q_.cols() == 0) return result;
  const Matrix middle = Q_.transpose() * Y_;
  const Modes modes = continuation::modes(middle);
  if (modes.values.size() == 0) return {};
  result.at_zero = modes.values.cwiseAbs().maxCoeff() > 1 / zero_mode;
  if (result.at_zero) return result;
  if (!evaluate(from.v, from.piece) || !multiply(Q_, Y_)) return {};
  const Matrix first = Q_.transpose() * Y_;
  if (modes.values.cwiseAbs().minCoeff() < zero_mode)  // the middle is such a place
    result.count = negative(eigenvalues(first));
  else
    result.count = negative(modes.values) + negative(eigenvalues(solve(middle, first)));
  if (result.count > 0) return result;

  const Eigen::MatrixXcd at_first = solve_complex(modes.V, first * modes.V);
  for (Eigen::Index i = 0; i < middle.cols(); ++i) {
    const auto m = modes.values[i], a = at_first(i, i);
    if (m.imag() != 0 || !(a.real() > 0)) continue;
    const double bend = 4 * std::abs(m.real() - 0.5 * (a.real() + 1));
    if (pair_safety * bend > 1 + a.real() + 2 * std::sqrt(a.real())) result.is_certain = false;
  }
  return result;
}

}  // namespace arcslip::continuation
