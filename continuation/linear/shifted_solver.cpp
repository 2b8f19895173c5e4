#include <arcslip/continuation/linear/shifted_solver.hpp>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace arcslip::continuation {
namespace {

constexpr double rounding_of_jacobian = 1e-14;  // of an entry, relative
constexpr int eigenpair_steps = 3;              // of borders: each squares the error of the vectors
constexpr double least_eigenoverlap = 1e-10;    // |w^H v|, |v| = |w| = 1

// The row of a border, relative to J: made small, it is no pivot before nothing else is left, as a full row
// that is one early fills all that follow (klu.cpp). It only changes the length of what a unit right-hand
// side gives.
double border_row_size(const SparseMatrix& J, const ComplexVector& c) {
  const double largest = J.nonZeros() ? J.coeffs().cwiseAbs().maxCoeff() : 1, of_c = c.cwiseAbs().maxCoeff();
  return of_c > 0 && largest > 0 ? largest / of_c * std::pow(static_cast<double>(J.rows()), -3) : 1;
}

// J - s with its border.
ComplexSparseLU::Matrix bordered(const SparseMatrix& J, Complex shift, const ComplexVector* b,
                                 const ComplexVector* c) {
  const Eigen::Index n = J.rows(), all = n + (b ? 1 : 0);
  const double row_size = c ? border_row_size(J, *c) : 1;
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(static_cast<std::size_t>(J.nonZeros() + 3 * n));
  for (int j = 0; j < J.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(J, j); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), j, it.value());
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, -shift);
    if (!b) continue;
    entries.emplace_back(i, static_cast<int>(n), (*b)[i]);
    entries.emplace_back(static_cast<int>(n), i, row_size * std::conj((*c)[i]));
  }
  ComplexSparseLU::Matrix A(all, all);
  A.setFromTriplets(entries.begin(), entries.end());
  A.makeCompressed();
  return A;
}

}  // namespace

ShiftedSolver::ShiftedSolver(const Jacobian& J, Matrix errors) : errors_(std::move(errors)) {
  if (const auto* full = std::get_if<Matrix>(&J)) {
    balanced_ = *full;
    balance(balanced_, D_);
    n_ = balanced_.rows();
  } else if (const auto* sparse = std::get_if<SparseMatrix>(&J)) {
    sparse_ = *sparse;
    dense_ = false;
    n_ = sparse_.rows();
    D_ = Vector::Ones(n_);
  } else {
    throw std::invalid_argument("the Jacobian is an operator, which cannot be shifted and factorized");
  }
}

bool ShiftedSolver::factorize(Complex shift) {
  return dense_ ? factorize_dense(shift, nullptr, nullptr) : factorize_sparse(shift, nullptr, nullptr);
}

bool ShiftedSolver::factorize(Complex shift, const ComplexVector& b, const ComplexVector& c) {
  return dense_ ? factorize_dense(shift, &b, &c) : factorize_sparse(shift, &b, &c);
}

// Of D^-1 (J - s) D, with the border D^-1 b and D c.
bool ShiftedSolver::factorize_dense(Complex shift, const ComplexVector* b, const ComplexVector* c) {
  const Eigen::Index all = n_ + (b ? 1 : 0);
  Eigen::MatrixXcd A(all, all);
  A.topLeftCorner(n_, n_) = balanced_.cast<Complex>();
  A.topLeftCorner(n_, n_).diagonal().array() -= shift;
  if (b) {
    A.col(n_).head(n_) = b->cwiseQuotient(D_.cast<Complex>());
    A.row(n_).head(n_) = c->cwiseProduct(D_.cast<Complex>()).adjoint();
    A(n_, n_) = 0;
  }
  if (!A.allFinite()) return false;
  lu_.factorize(A);
  for (Eigen::Index i = 0; i < all; ++i)
    if (lu_.pivot(i) == 0.0) return false;
  return true;
}

bool ShiftedSolver::factorize_sparse(Complex shift, const ComplexVector* b, const ComplexVector* c) {
  const ComplexSparseLU::Matrix A = bordered(sparse_, shift, b, c);
  const Eigen::Index border = A.rows() - n_;
  if (bordered_ != border) klu_.emplace(A);
  bordered_ = border;
  return klu_->factorize(A, 0);
}

bool ShiftedSolver::solve(ComplexVector& x) const {
  if (!dense_) {
    Eigen::MatrixXcd B = x;
    klu_->solve_in_place(B);
    x = B.col(0);
    return x.allFinite();
  }
  ComplexVector rhs = x;
  rhs.head(n_) = rhs.head(n_).cwiseQuotient(D_.cast<Complex>()).eval();
  lu_.solve(rhs, x);
  x.head(n_) = x.head(n_).cwiseProduct(D_.cast<Complex>()).eval();
  return x.allFinite();
}

bool ShiftedSolver::solve_adjoint(ComplexVector& x) const {
  if (!dense_) {
    Eigen::MatrixXcd B = x.conjugate();
    klu_->solve_transposed_in_place(B);
    x = B.col(0).conjugate();
    return x.allFinite();
  }
  ComplexVector rhs = x.conjugate();
  rhs.head(n_) = rhs.head(n_).cwiseProduct(D_.cast<Complex>()).eval();
  lu_.solve_transposed(rhs, x);
  x = x.conjugate().eval();
  x.head(n_) = x.head(n_).cwiseQuotient(D_.cast<Complex>()).eval();
  return x.allFinite();
}

ComplexVector ShiftedSolver::apply(const ComplexVector& x) const {
  if (!dense_) return sparse_.cast<Complex>() * x;
  const ComplexVector y = x.cwiseQuotient(D_.cast<Complex>());
  ComplexVector z(n_);
  z.real() = balanced_ * y.real();
  z.imag() = balanced_ * y.imag();
  return z.cwiseProduct(D_.cast<Complex>());
}

Vector ShiftedSolver::error_of_apply(const ComplexVector& x) const {
  const Vector sizes = x.cwiseAbs();
  Vector sum = dense_ ? (balanced_.cwiseAbs() * sizes.cwiseQuotient(D_)).cwiseProduct(D_).eval()
                      : Vector(sparse_.cwiseAbs() * sizes);
  sum *= rounding_of_jacobian;
  if (errors_.size() > 0) sum += errors_ * sizes;
  return sum;
}

// In the balanced coordinates D^-1 v, D w, whose borders are D^-1 b = D w and D c = D^-1 v.
std::optional<Eigenpair> refined_eigenpair(ShiftedSolver& solver, Complex value, const ComplexVector& right) {
  const Eigen::Index n = solver.size();
  const ComplexVector D = solver.scales().cast<Complex>();
  ComplexVector v = right.cwiseQuotient(D).normalized(), w = v;
  Complex overlap = 1;
  for (int k = 0; k < eigenpair_steps; ++k) {
    if (!solver.factorize(value, D.cwiseProduct(w), v.cwiseQuotient(D))) return {};
    ComplexVector x = ComplexVector::Unit(n + 1, n), y = x;
    if (!solver.solve(x) || !solver.solve_adjoint(y)) return {};
    v = x.head(n).cwiseQuotient(D).normalized();
    w = y.head(n).cwiseProduct(D).normalized();
    overlap = w.dot(v);
    if (!(std::abs(overlap) > least_eigenoverlap)) return {};
    value = w.cwiseQuotient(D).dot(solver.apply(v.cwiseProduct(D))) / overlap;
  }
  Eigenpair pair{value, v.cwiseProduct(D), w.cwiseQuotient(D)};
  const double length = pair.right.norm();
  pair.right /= length;
  pair.left *= length / std::conj(overlap);
  return pair;
}

}  // namespace arcslip::continuation
