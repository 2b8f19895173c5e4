#include <arcslip/hbm/linear/condensation.hpp>

#include <arcslip/hbm/linear/in_place_elimination.hpp>
#include <arcslip/hbm/linear/sparsity_pattern.hpp>

#include <cmath>

namespace arcslip::hbm {
namespace {

// Of y in its pattern, in that of l.
ComplexSparse linear_block(const ComplexSparse& of, Eigen::Index l) {
  return of.bottomRightCorner(l, l);
}

}  // namespace

void Condensed::expand(double force_factor, ComplexVector& y) const {
  const Eigen::Index r = Z.rows(), l = W.rows();
  for (Eigen::Index j = 0; j < l; ++j) y[r + j] = force_factor * W(j, r);
  for (Eigen::Index i = 0; i < r; ++i)
    for (Eigen::Index j = 0; j < l; ++j) y[r + j] = less_product(y[r + j], W(j, i), y[i]);
}

const ComplexMatrix& Condensed::of_observations(const Eigen::MatrixXd& c) {
  const Eigen::Index r = Z.rows(), l = W.rows();
  if (has_observed) return observed;
  observed.resize(c.cols(), r + 1);
  for (Eigen::Index k = 0; k < c.cols(); ++k) {
    const auto c_l = c.col(k).tail(l);
    for (Eigen::Index i = 0; i <= r; ++i) {
      const Complex sum = l > 0 ? Complex(c_l.dot(W.re.col(i)), c_l.dot(W.im.col(i))) : Complex(0);
      observed(k, i) = i < r ? c(i, k) - sum : sum;
    }
  }
  has_observed = true;
  return observed;
}

void Condensed::project(ComplexVector& v) const {
  const Eigen::Index r = Z.rows();
  if (V.size() == 0) return observe(v);
  v.head(r).noalias() -= V.transpose() * v.tail(W.rows());
}

void Condensed::observe(ComplexVector& c) const {
  const Eigen::Index r = Z.rows(), l = W.rows();
  for (Eigen::Index i = 0; i < r; ++i)
    for (Eigen::Index j = 0; j < l; ++j) c[i] = less_product(c[i], W(j, i), c[r + j]);
}

Complex Condensed::observed_change(const ComplexVector& v, int observation) const {
  const Eigen::Index r = Z.rows();
  Complex sum = 0;
  for (Eigen::Index j = 0; j < W.rows(); ++j) sum = less_product(sum, W(j, r + 1 + observation), v[r + j]);
  return sum;
}

Condensation::Condensation(const LinearParts& parts, int unknowns, const Eigen::MatrixXd& observed)
    : r_(unknowns),
      l_(observed.rows() - unknowns),
      c_(observed.bottomRows(l_)),
      rhs_(l_, r_ + 1 + c_.cols()) {
  if (l_ > in_place_up_to) choose_sparse(parts);
  if (l_ <= in_place_up_to)
    Zll_.resize(l_, l_);
  else if (!sparse_lu_)
    elimination_.emplace(r_, l_, c_.cols());
}

// Each degree of freedom of a large structure is linked to few others, and so is each coordinate in y.
void Condensation::choose_sparse(const LinearParts& parts) {
  sparse_Zll_ = linear_block(parts.pattern(), l_);
  if (sparse_is_cheaper(sparse_Zll_)) sparse_lu_.emplace(sparse_Zll_);
}

bool Condensation::solve_linear(const StructuralMatrices& of, const Factors& g) {
  if (sparse_lu_) {
    for (int j = 0; j < l_; ++j)
      for (ComplexSparse::InnerIterator entry(sparse_Zll_, j); entry; ++entry)
        entry.valueRef() = of.at(g, r_ + entry.row(), r_ + j);
    if (!sparse_lu_->factorize(sparse_Zll_, singular_pivot)) return false;
    W_ = rhs_;
    sparse_lu_->solve_in_place(W_);
    return true;
  }
  for (Eigen::Index j = 0; j < l_; ++j)
    for (Eigen::Index i = 0; i < l_; ++i) Zll_(i, j) = of.at(g, r_ + i, r_ + j);
  W_ = rhs_;
  return eliminate(Zll_, W_);
}

bool Condensation::condense(const StructuralMatrices& of, const Factors& g, const ComplexVector& f,
                            Condensed& into) {
  ComplexMatrix& Z = into.Z;
  into.has_rates = into.has_observed = false;
  if (elimination_) {
    elimination_->set(of, g, f, c_);
    if (!elimination_->run(singular_pivot)) return false;
    elimination_->condensed(Z, into.f, into.W);
    return true;
  }
  Z.resize(r_, r_);
  for (Eigen::Index j = 0; j < r_; ++j)
    for (Eigen::Index i = 0; i < r_; ++i) Z(i, j) = of.at(g, i, j);
  into.f = f.head(r_);
  if (l_ == 0) return true;

  for (Eigen::Index k = 0; k < l_; ++k) {
    for (Eigen::Index i = 0; i < r_; ++i) rhs_(k, i) = of.at(g, r_ + k, i);
    rhs_(k, r_) = f[r_ + k];
    for (Eigen::Index i = 0; i < c_.cols(); ++i) rhs_(k, r_ + 1 + i) = c_(k, i);
  }
  if (!solve_linear(of, g)) return false;
  into.W.re = W_.real();
  into.W.im = W_.imag();
  for (Eigen::Index j = 0; j < r_; ++j)
    for (Eigen::Index i = 0; i <= j; ++i) {  // Z is symmetric
      Complex sum = Z(i, j);
      for (Eigen::Index k = 0; k < l_; ++k) sum = less_product(sum, rhs_(k, i), W_(k, j));
      Z(i, j) = Z(j, i) = sum;
    }
  for (Eigen::Index i = 0; i < r_; ++i)
    for (Eigen::Index k = 0; k < l_; ++k) into.f[i] = less_product(into.f[i], rhs_(k, i), W_(k, r_));
  return true;
}

UnsymmetricCondensation::UnsymmetricCondensation(const ComplexSparse& pattern, int unknowns,
                                                 const Eigen::MatrixXd& observed)
    : r_(unknowns),
      l_(observed.rows() - unknowns),
      c_(observed.bottomRows(l_).cast<Complex>()),
      W_(l_, r_ + 1),
      V_(l_, r_ + c_.cols()),
      lu_(0) {
  sparse_Zll_ = linear_block(pattern, l_);
  if (l_ > in_place_up_to && sparse_is_cheaper_than_lu(sparse_Zll_)) {
    sparse_lu_.emplace(sparse_Zll_);
  } else {
    Zll_.setZero(l_, l_);
    solution_.resize(l_);
    lu_ = continuation::LU<Complex>(l_);
  }
}

void UnsymmetricCondensation::set_blocks(const ComplexSparse& Z, const ComplexVector& f, Condensed& into) {
  into.Z.setZero(r_, r_);
  into.f = f.head(r_);
  W_.setZero();
  V_.setZero();
  Complex* linear = sparse_Zll_.valuePtr();
  for (Eigen::Index j = 0; j < r_ + l_; ++j)
    for (ComplexSparse::InnerIterator entry(Z, j); entry; ++entry) {
      const Eigen::Index i = entry.row();
      if (i < r_ && j < r_)
        into.Z(i, j) = entry.value();
      else if (j < r_)
        W_(i - r_, j) = entry.value();
      else if (i < r_)
        V_(j - r_, i) = entry.value();
      else if (sparse_lu_)
        *linear++ = entry.value();
      else
        Zll_(i - r_, j - r_) = entry.value();
    }
  W_.col(r_) = f.tail(l_);
  V_.rightCols(c_.cols()) = c_;
}

bool UnsymmetricCondensation::solve() {
  if (sparse_lu_) {
    if (!sparse_lu_->factorize(sparse_Zll_, singular_pivot)) return false;
    sparse_lu_->solve_in_place(W_);
    sparse_lu_->solve_transposed_in_place(V_);
    return true;
  }
  lu_.factorize(Zll_);
  for (Eigen::Index k = 0; k < l_; ++k)
    if (!(std::abs(lu_.pivot(k)) > singular_pivot * Zll_.col(k).cwiseAbs().maxCoeff())) return false;
  for (Eigen::Index i = 0; i < W_.cols(); ++i) {
    lu_.solve(W_.col(i), solution_);
    W_.col(i) = solution_;
  }
  for (Eigen::Index i = 0; i < V_.cols(); ++i) {
    lu_.solve_transposed(V_.col(i), solution_);
    V_.col(i) = solution_;
  }
  return true;
}

bool UnsymmetricCondensation::condense(const ComplexSparse& Z, const ComplexVector& f, Condensed& into) {
  into.has_rates = into.has_observed = false;
  set_blocks(Z, f, into);
  if (l_ == 0) return true;
  if (!solve()) return false;
  into.V = V_.leftCols(r_);
  into.W.resize(l_, r_ + 1 + c_.cols());
  into.W.re << W_.real(), V_.rightCols(c_.cols()).real();
  into.W.im << W_.imag(), V_.rightCols(c_.cols()).imag();
  for (Eigen::Index k = r_; k < r_ + l_; ++k)
    for (ComplexSparse::InnerIterator entry(Z, k); entry && entry.row() < r_; ++entry) {
      const Eigen::Index i = entry.row();
      for (Eigen::Index j = 0; j < r_; ++j)
        into.Z(i, j) = less_product(into.Z(i, j), entry.value(), W_(k - r_, j));
      into.f[i] = less_product(into.f[i], entry.value(), W_(k - r_, r_));
    }
  return true;
}

}  // namespace arcslip::hbm
