#include <arcslip/continuation/special_points/lyapunov_schmidt.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/continuation/special_points/dependent_equations.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

namespace arcslip::continuation {
namespace {

constexpr int adaptions = 3;      // of C and W to the null spaces of one place, at most
constexpr double adapted = 1e-6;  // change of the space of C by an adaption: V is orthonormal to its square
constexpr int corrections = 60;   // chord steps, at most
constexpr double chord_rounding = 1e-15;  // of a correction in scales, relative
constexpr double stagnation = 1e-12;      // of corrections that shrink no more: rounding
constexpr double chord_divergence = 2;    // of corrections, from one to the next

// Rows of a matrix of full column rank, as many as it has columns, that are independent.
std::vector<Eigen::Index> independent_rows(const Matrix& A) {
  Matrix rest = A;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    Eigen::Index row = 0;
    rest.rowwise().squaredNorm().maxCoeff(&row);
    const Vector direction = rest.row(row).transpose().normalized();
    rest -= (rest * direction) * direction.transpose();
    rows.push_back(row);
  }
  return rows;
}

Matrix generic_matrix(Eigen::Index rows, Eigen::Index columns, double phase) {
  Matrix result(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto x = static_cast<double>(i);
      result(i, j) = std::sin((0.7 + 0.1 * static_cast<double>(j)) * x * x + phase + static_cast<double>(j)) +
                     (i == j ? 0.1 : 0);
    }
  return result;
}

}  // namespace

LyapunovSchmidt::LyapunovSchmidt(const Problem& problem, const Vector& p, int along, int rank_loss,
                                 const MakeLinearSolver& make_solver)
    : problem_(problem),
      p_(p),
      along_(along),
      n_(problem.size()),
      m_(rank_loss),
      at_(problem.evaluator()),
      M_(make_solver ? make_solver() : problem.linear_solver()),
      borders_(problem.size(), rank_loss + 1),
      scale_(n_ + 1),
      x_(n_ + 1),
      F_p_(n_),
      C_(n_ + 1, m_ + 1),
      V_(n_ + 1, m_ + 1),
      W_(orthonormal_columns(generic_matrix(n_, m_, 1.0))),
      G_(m_, m_ + 1),
      added_(!M_ && std::holds_alternative<SparseMatrix>(at_->jacobian()) ? m_ : 0) {
  borders_ = Borders(problem.size(), static_cast<int>(m_ + 1 + added_));
  rhs_.resize(n_ + 1 + m_ + added_);
  scale_ << problem.scales(), problem.parameters()[static_cast<std::size_t>(along)].scale;
  C_ = scale_.cwiseInverse().asDiagonal() * orthonormal_columns(generic_matrix(n_ + 1, m_ + 1, 0.5));
}

bool LyapunovSchmidt::evaluate(const Vector& x, Needs needs) try {
  p_[along_] = x[n_];
  return at_->move_to(x.head(n_), p_, needs) == Evaluated::ok && at_->residual().allFinite();
} catch (const std::exception&) {  // outside the domain, as it says
  return false;
}

// J, and of a sparse J, whose m smallest pivots would be rounding at the point, J_r = J + s sum e_r e_c^T
// with entries where the null vectors are large. M is then that of J_r with further borders, z = (x_c):
//
//   J_r x - s sum e_r z + .. = ..,   e_c^T x - z = 0.
const Jacobian& LyapunovSchmidt::regular_jacobian() {
  if (added_ == 0) return at_->jacobian();
  const SparseMatrix& J = std::get<SparseMatrix>(at_->jacobian());
  const double size = J.nonZeros() > 0 ? J.coeffs().cwiseAbs().maxCoeff() : 1;
  const Matrix right = scale_.head(n_).cwiseAbs2().asDiagonal() * C_.topRows(n_) *
                       orthogonal_complement(Matrix(C_.row(n_).transpose()));  // null J, without the tangent
  const auto rows = independent_rows(W_), columns = independent_rows(right);
  SparseMatrix sum = J;
  for (Eigen::Index k = 0; k < m_; ++k) {
    const Eigen::Index r = rows[static_cast<std::size_t>(k)], c = columns[static_cast<std::size_t>(k)];
    sum.coeffRef(r, c) += size;
    borders_.columns(r, m_ + 1 + k) = -size;
    borders_.rows(c, m_ + 1 + k) = 1;
    borders_.corner(m_ + 1 + k, m_ + 1 + k) = -1;
  }
  sum.makeCompressed();
  regular_ = std::move(sum);
  return regular_;
}

bool LyapunovSchmidt::factorize() try {
  at_->parameter_derivative(along_, F_p_);
  if (!F_p_.allFinite()) return false;
  if (!M_) M_ = suitable_solver(at_->jacobian());
  // F_p may vanish here, for instance by symmetry: a zero column spoils the scaling of M. A column of W is
  // added to it, which changes the unknowns beta by a multiple of dp.
  apply(at_->jacobian(), generic_matrix(n_, 1, 3.0).col(0).normalized(), rhs_.head(n_));
  shift_ = std::max(rhs_.head(n_).norm(), F_p_.norm());
  magnitude_ = W_.col(0).cwiseAbs().dot(rhs_.head(n_).cwiseAbs() + F_p_.cwiseAbs()) + 0.1 * shift_;
  if (shift_ == 0) shift_ = 1;
  if (W_.col(0).dot(F_p_) < 0) shift_ = -shift_;
  borders_.columns.setZero();
  borders_.rows.setZero();
  borders_.corner.setZero();
  borders_.columns.col(0) = F_p_ + shift_ * W_.col(0);
  borders_.columns.middleCols(1, m_) = W_;
  borders_.rows.leftCols(m_ + 1) = C_.topRows(n_);
  borders_.corner.col(0).head(m_ + 1) = C_.row(n_).transpose();
  return M_->factorize(regular_jacobian(), borders_);
} catch (const std::exception&) {
  return false;
}

void LyapunovSchmidt::solve() {
  M_->solve(rhs_);
  rhs_[n_ + 1] += shift_ * rhs_[n_];
}

// w_i as the rows of its transpose. False: no transposed solves, or not finite.
bool LyapunovSchmidt::left_vectors(Matrix& left) {
  left.resize(n_, m_);
  for (Eigen::Index i = 0; i < m_; ++i) {
    rhs_.setZero();
    rhs_[n_ + 1 + i] = 1;
    if (i == 0) rhs_[n_] = shift_;
    transposed_ = transposed_ && M_->solve_transposed(rhs_);
    if (!transposed_) return false;
    left.col(i) = rhs_.head(n_);
  }
  return left.allFinite();
}

// w_i . c for each column c, m rows: by w_i, or without them by forward solves, for M (x, beta) = (c, 0) has
// beta_i = w_i . c.
Matrix LyapunovSchmidt::left_parts(const Matrix& left, const Matrix& changes) {
  if (transposed_) return left.transpose() * changes;
  Matrix parts(m_, changes.cols());
  for (Eigen::Index j = 0; j < changes.cols(); ++j) {
    rhs_.setZero();
    rhs_.head(n_) = changes.col(j);
    solve();
    parts.col(j) = rhs_.segment(n_ + 1, m_);
  }
  return parts;
}

bool LyapunovSchmidt::null_spaces() {
  for (Eigen::Index j = 0; j <= m_; ++j) {
    rhs_.setZero();
    rhs_[n_ + j] = 1;
    solve();
    V_.col(j) = rhs_.head(n_ + 1);
    G_.col(j) = rhs_.segment(n_ + 1, m_);
  }
  return V_.allFinite() && G_.allFinite();
}

bool LyapunovSchmidt::move_to(const Vector& x) {
  x_ = x;
  if (!evaluate(x_, Needs::jacobian)) return false;
  for (int k = 0; k < adaptions; ++k) {
    if (!factorize() || !null_spaces()) return false;
    const Matrix before = scale_.asDiagonal() * C_,
                 now = orthonormal_columns(scale_.cwiseInverse().asDiagonal() * V_);
    if (k > 0 && (now - before * (before.transpose() * now)).norm() <= adapted) return true;
    Matrix left;
    if (left_vectors(left))
      W_ = orthonormal_columns(left);
    else if (transposed_)
      return false;
    C_ = scale_.cwiseInverse().asDiagonal() * now;
  }
  return factorize() && null_spaces();
}

Vector LyapunovSchmidt::settle() {
  Vector place;
  const Vector found = beta(Vector::Zero(m_ + 1), place);
  if (found.allFinite()) x_ = place;
  return found;
}

bool LyapunovSchmidt::form(Matrix& H) {
  H.resize(m_ * (m_ + 1), m_ + 1);
  Matrix left;
  if (!left_vectors(left) && transposed_) return false;
  std::array<Matrix, 2> AV{Matrix(n_, m_ + 1), Matrix(n_, m_ + 1)};
  const Matrix V = V_;
  const double h = difference_step * std::max(1.0, size());
  for (Eigen::Index k = 0; k <= m_; ++k) {
    const auto quotient = difference_within_piece(h, [&](std::size_t side, double distance) {
      if (!evaluate(x_ + distance * V.col(k), Needs::jacobian)) return false;
      Vector y(n_);
      at_->parameter_derivative(along_, F_p_);
      for (Eigen::Index j = 0; j <= m_; ++j) {
        apply(at_->jacobian(), V.col(j).head(n_), y);
        AV[side].col(j) = y + V(n_, j) * F_p_;
      }
      return AV[side].allFinite();
    });
    if (!quotient || quotient->here != 0) return false;
    const Matrix change = left_parts(left, quotient->weight[0] * AV[0] + quotient->weight[1] * AV[1]);
    for (Eigen::Index i = 0; i < m_; ++i) H.col(k).segment(i * (m_ + 1), m_ + 1) = change.row(i).transpose();
  }
  return H.allFinite();
}

Vector LyapunovSchmidt::beta(const Vector& y, Vector& place) {
  const Vector none = Vector::Constant(m_, std::numeric_limits<double>::quiet_NaN());
  place = x_ + V_ * y;
  Vector found = Vector::Zero(m_);
  double before = 0;
  for (int k = 0; k < corrections; ++k) {
    if (!evaluate(place, Needs::residual)) return none;
    rhs_.setZero();
    rhs_.head(n_) = -at_->residual() - W_ * found;
    solve();
    place += rhs_.head(n_ + 1);
    found += rhs_.segment(n_ + 1, m_);
    const double now = rhs_.head(n_ + 1).cwiseQuotient(scale_).norm() / std::max(1.0, size());
    if (!std::isfinite(now)) return none;
    if (now <= chord_rounding || (k > 0 && now > 0.5 * before && before <= stagnation)) return found;
    if (k > 1 && now > chord_divergence * before) return none;
    before = now;
  }
  return none;
}

namespace {

constexpr double circle_radius =
    1e-3;  // relative to 1 + |u|: of the circle on which solutions are looked for
constexpr double beta_rounding = 1e-13;  // there, in the size of its terms
constexpr int places = 7;                // on the circle

}  // namespace

std::string doubt_of_isolation(const Problem& problem, const Vector& v, const Vector& p, int along,
                               const MakeLinearSolver& make_solver) try {
  if (std::string dependence = doubt_of_dependence(problem, v, p, along); !dependence.empty())
    return dependence;
  LyapunovSchmidt reduction(problem, p, along, 1, make_solver);
  if (!reduction.move_to(v) || !reduction.has_left() || !reduction.settle().allFinite() ||
      !reduction.move_to(reduction.x()))
    return {};
  const double r = circle_radius * (1 + reduction.size());
  Vector place;
  for (int k = 0; k < places; ++k) {
    const double angle = 0.3 + 2 * std::numbers::pi * k / places;
    const Vector beta = reduction.beta(r * Vector{{std::cos(angle), std::sin(angle)}}, place);
    if (!(std::abs(beta[0]) <= beta_rounding * reduction.magnitude() * r)) return {};
  }
  return "; the solutions here are not isolated: [J F_p] has a two-dimensional null space along the branch, "
         "for instance due to a continuous symmetry (rotations, time shifts): add a phase condition";
} catch (const std::exception&) {
  return {};
}

}  // namespace arcslip::continuation
