#include <arcslip/hbm/condensation.hpp>

#include <arcslip/continuation/linear/widest.hpp>
#include <arcslip/hbm/sparse_links.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::hbm {
namespace {

constexpr double pole = 1e-14;        // pivot of Z_ll, relative to the largest entry of its column
constexpr double modal_pole = 1e-14;  // D, relative to the sum of its terms
constexpr Eigen::Index few = 8;       // coordinates, up to which elimination in place costs less

using Sparse = continuation::ComplexSparseLU::Matrix;

// a - b c, without the tests for infinity of operator*.
Complex less_product(Complex a, Complex b, Complex c) {
  return {a.real() - b.real() * c.real() + b.imag() * c.imag(),
          a.imag() - b.real() * c.imag() - b.imag() * c.real()};
}

constexpr Eigen::Index most_in_place = std::max<Eigen::Index>(few, most_changes);

// B := A^-1 B for a small A, which is overwritten, by elimination with row pivots. False: A is singular.
bool eliminate(ComplexMatrix& A, ComplexMatrix& B) {
  const Eigen::Index n = A.rows(), m = B.cols();
  std::array<double, most_in_place> least;
  for (Eigen::Index k = 0; k < n; ++k)
    least[static_cast<std::size_t>(k)] = pole * pole * A.col(k).cwiseAbs2().maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = 0;
    const double square = A.col(k).tail(n - k).cwiseAbs2().maxCoeff(&pivot);
    if (!(square > least[static_cast<std::size_t>(k)])) return false;
    if (pivot > 0) {
      A.row(k).tail(n - k).swap(A.row(k + pivot).tail(n - k));
      B.row(k).swap(B.row(k + pivot));
    }
    const Complex inverse = std::conj(A(k, k)) / square;
    A(k, k) = inverse;
    for (Eigen::Index i = k + 1; i < n; ++i) A(i, k) *= inverse;
    for (Eigen::Index j = k + 1; j < n; ++j)
      for (Eigen::Index i = k + 1; i < n; ++i) A(i, j) = less_product(A(i, j), A(i, k), A(k, j));
    for (Eigen::Index j = 0; j < m; ++j)
      for (Eigen::Index i = k + 1; i < n; ++i) B(i, j) = less_product(B(i, j), A(i, k), B(k, j));
  }
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index k = n - 1; k >= 0; --k) {
      B(k, j) *= A(k, k);
      for (Eigen::Index i = 0; i < k; ++i) B(i, j) = less_product(B(i, j), A(i, k), B(k, j));
    }
  return true;
}

// Real and imaginary parts of a column.
struct Split {
  double *re, *im;
};

// D^-1 of n modes. False where one is singular to rounding.
[[gnu::always_inline]] inline bool invert(const Factors& g, double s, const double* M, const double* C,
                                          const double* K, Eigen::Index n, Split inverse) {
  double* __restrict re = inverse.re, * __restrict im = inverse.im;
  int singular = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    const double a = g.mass.real() * M[j] + g.spring.real() * K[j],
                 b = g.mass.imag() * M[j] + g.damper.imag() * C[j] + g.spring.imag() * K[j];
    const double size = a * a + b * b, least = modal_pole * (K[j] + s * s * M[j]);
    singular |= !(size > least * least);
    re[j] = a / size;
    im[j] = -b / size;
  }
  return singular == 0;
}

[[gnu::always_inline]] inline void multiply(Split a, Split b, Eigen::Index n, Split product) {
  double* __restrict re = product.re, * __restrict im = product.im;
  for (Eigen::Index j = 0; j < n; ++j) {
    re[j] = a.re[j] * b.re[j] - a.im[j] * b.im[j];
    im[j] = a.re[j] * b.im[j] + a.im[j] * b.re[j];
  }
}

// sum_j a_j b_j, of every fourth j apart.
[[gnu::always_inline]] inline Complex scalar_product(Split a, Split b, Eigen::Index n) {
  constexpr Eigen::Index lanes = 4;
  double re[lanes] = {}, im[lanes] = {};
  Eigen::Index j = 0;
  for (; j + lanes <= n; j += lanes)
    for (Eigen::Index q = 0; q < lanes; ++q) {
      re[q] += a.re[j + q] * b.re[j + q] - a.im[j + q] * b.im[j + q];
      im[q] += a.re[j + q] * b.im[j + q] + a.im[j + q] * b.re[j + q];
    }
  for (; j < n; ++j) {
    re[0] += a.re[j] * b.re[j] - a.im[j] * b.im[j];
    im[0] += a.re[j] * b.im[j] + a.im[j] * b.re[j];
  }
  return {(re[0] + re[1]) + (re[2] + re[3]), (im[0] + im[1]) + (im[2] + im[3])};
}

}  // namespace

void Condensed::expand(double force_factor, ComplexVector& y) const {
  const Eigen::Index r = Z.rows(), l = W.rows();
  if (l == 0) return;
  y.tail(l) = force_factor * W.col(r);
  y.tail(l).noalias() -= W.leftCols(r) * y.head(r);
}

void Condensed::project(ComplexVector& v) const {
  const Eigen::Index r = Z.rows(), l = W.rows();
  if (l == 0) return;
  if (V.size() > 0)
    v.head(r).noalias() -= V.transpose() * v.tail(l);
  else
    v.head(r).noalias() -= W.leftCols(r).transpose() * v.tail(l);
}

void Condensed::observe(ComplexVector& c) const {
  const Eigen::Index r = Z.rows(), l = W.rows();
  if (l == 0) return;
  c.head(r).noalias() -= W.leftCols(r).transpose() * c.tail(l);
}

Complex Condensed::observed_change(const ComplexVector& v, int observation) const {
  const Eigen::Index r = Z.rows();
  Complex sum = 0;
  for (Eigen::Index k = 0; k < W.rows(); ++k) sum -= W(k, r + 1 + observation) * v[r + k];
  return sum;
}

ModalCondensation::ModalCondensation(const FixedInterfaceModes& modes, const Eigen::MatrixXd& observed)
    : r_(modes.K.qq.rows()),
      l_(modes.K.ll.size()),
      c_(observed.bottomRows(l_)),
      inverse_re_(l_),
      inverse_im_(l_),
      right_re_(l_, r_ + 1),
      right_im_(l_, r_ + 1),
      W_re_(l_, r_ + 1),
      W_im_(l_, r_ + 1),
      U_(l_, most_changes),
      inverse_U_(l_, most_changes),
      H_(r_, most_changes),
      equations_(most_changes, most_changes),
      forces_(most_changes, r_ + 1 + c_.cols()) {}

bool ModalCondensation::condense(const LinearParts& parts, double s, const ComplexVector& f,
                                 Condensed& into) {
  const ModalMatrix &M = parts.modes()->M, &C = parts.modes()->C, &K = parts.modes()->K;
  const Factors g = parts.factors(s);
  right_re_.leftCols(r_) = g.mass.real() * M.lq + g.spring.real() * K.lq;
  right_im_.leftCols(r_) = g.mass.imag() * M.lq + g.damper.imag() * C.lq + g.spring.imag() * K.lq;
  right_re_.col(r_) = f.tail(l_).real();
  right_im_.col(r_) = f.tail(l_).imag();
  into.Z.resize(r_, r_);
  into.f.resize(r_);
  const bool regular = continuation::widest([&]() __attribute__((always_inline)) {
    const Split inverse{inverse_re_.data(), inverse_im_.data()};
    if (!invert(g, s, M.ll.data(), C.ll.data(), K.ll.data(), l_, inverse)) return false;
    for (Eigen::Index i = 0; i <= r_; ++i) {
      const Split W{W_re_.col(i).data(), W_im_.col(i).data()};
      multiply({right_re_.col(i).data(), right_im_.col(i).data()}, inverse, l_, W);
      for (Eigen::Index k = 0; k <= std::min(i, r_ - 1); ++k) {
        const Complex sum = scalar_product({right_re_.col(k).data(), right_im_.col(k).data()}, W, l_);
        if (i < r_)
          into.Z(k, i) = into.Z(i, k) = g.combine(M.qq(k, i), C.qq(k, i), K.qq(k, i)) - sum;
        else
          into.f[k] = f[k] - sum;
      }
    }
    return true;
  });
  if (!regular) return false;
  into.W.resize(l_, r_ + 1 + c_.cols());
  for (Eigen::Index i = 0; i <= r_; ++i)
    for (Eigen::Index j = 0; j < l_; ++j) into.W(j, i) = Complex(W_re_(j, i), W_im_(j, i));
  for (Eigen::Index i = 0; i < c_.cols(); ++i)
    for (Eigen::Index j = 0; j < l_; ++j)
      into.W(j, r_ + 1 + i) = Complex(inverse_re_[j] * c_(j, i), inverse_im_[j] * c_(j, i));
  return parts.changes().empty() || add_changes(parts, g, f, into);
}

// With the forces t = v (d . y) in the changed parts, v = by g(s), as further unknowns, Z' of the modes alone
// and H = d_q - Z'_ql D^-1 d_l:
//
//   l = D^-1 (f_l - Z'_lq q - d_l t),   (1 + v d_l^T D^-1 d_l) t = v (H^T q + d_l^T D^-1 f_l)
bool ModalCondensation::add_changes(const LinearParts& parts, const Factors& g, const ComplexVector& f,
                                    Condensed& into) {
  const auto& changes = parts.changes();
  const auto k = static_cast<Eigen::Index>(changes.size());
  auto U = U_.leftCols(k);
  auto inverse_U = inverse_U_.leftCols(k);
  auto H = H_.leftCols(k);
  U.setZero();
  H.setZero();
  for (Eigen::Index i = 0; i < k; ++i)
    for (const auto& [at, d] : changes[static_cast<std::size_t>(i)].part->direction.entries())
      if (at < r_)
        H(at, i) = d;
      else
        U(at - r_, i) = d;
  for (Eigen::Index j = 0; j < l_; ++j) inverse_U.row(j) = Complex(inverse_re_[j], inverse_im_[j]) * U.row(j);
  H.noalias() -= into.W.leftCols(r_).transpose() * U;  // Z_ql D^-1 d_l
  ComplexMatrix &A = equations_, &T = forces_;
  A.noalias() = U.transpose() * inverse_U;
  const Eigen::Index observations = c_.cols();
  T.resize(k, r_ + 1 + observations);
  T.leftCols(r_) = H.transpose();
  T.col(r_).noalias() = inverse_U.transpose() * f.tail(l_);
  T.rightCols(observations).noalias() = inverse_U.transpose() * c_;
  for (Eigen::Index i = 0; i < k; ++i) {
    const ChangedPart& change = changes[static_cast<std::size_t>(i)];
    const Complex v = change.by * g.of(change.part->kind);
    A.row(i) *= v;
    A(i, i) += 1;
    T.row(i) *= v;
  }
  if (!eliminate(A, T)) return false;
  into.Z.noalias() += H * T.leftCols(r_);
  into.f.noalias() -= H * T.col(r_);
  into.W.leftCols(r_).noalias() += inverse_U * T.leftCols(r_);
  into.W.rightCols(1 + observations).noalias() -= inverse_U * T.rightCols(1 + observations);
  return true;
}

Condensation::Condensation(const std::vector<PartInY>& parts, int unknowns, const Eigen::MatrixXd& observed)
    : r_(unknowns),
      l_(observed.rows() - unknowns),
      c_(observed.bottomRows(l_)),
      rhs_(l_, r_ + 1 + c_.cols()) {
  if (l_ > few) choose_sparse(parts);
  if (l_ <= few)
    Zll_.resize(l_, l_);
  else if (!sparse_lu_)
    elimination_.emplace(r_, l_, c_.cols());
}

// Each degree of freedom of a large structure is linked to few others, and so is each coordinate in y.
void Condensation::choose_sparse(const std::vector<PartInY>& parts) {
  std::vector<Links> links;
  for (const PartInY& part : parts) {
    Links& linked = links.emplace_back();
    for (const auto& [i, at_i] : part.direction.entries())
      if (i >= r_) linked.push_back(i - r_);
  }
  if (const auto pattern = sparse_pattern(l_, links)) {
    sparse_Zll_ = *pattern;
    sparse_lu_.emplace(sparse_Zll_);
  }
}

bool Condensation::solve_linear(const StructuralMatrices& of, const Factors& g, ComplexMatrix& W) {
  if (sparse_lu_) {
    for (int j = 0; j < l_; ++j)
      for (Sparse::InnerIterator entry(sparse_Zll_, j); entry; ++entry)
        entry.valueRef() = of.at(g, r_ + entry.row(), r_ + j);
    if (!sparse_lu_->factorize(sparse_Zll_, pole)) return false;
    W = rhs_;
    sparse_lu_->solve_in_place(W);
    return true;
  }
  for (Eigen::Index j = 0; j < l_; ++j)
    for (Eigen::Index i = 0; i < l_; ++i) Zll_(i, j) = of.at(g, r_ + i, r_ + j);
  W = rhs_;
  return eliminate(Zll_, W);
}

bool Condensation::condense(const StructuralMatrices& of, const Factors& g, const ComplexVector& f,
                            Condensed& into) {
  ComplexMatrix &Z = into.Z, &W = into.W;
  if (elimination_) {
    elimination_->set(of, g, f, c_);
    if (!elimination_->run(pole)) return false;
    elimination_->condensed(Z, into.f, W);
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
  if (!solve_linear(of, g, W)) return false;
  for (Eigen::Index j = 0; j < r_; ++j)
    for (Eigen::Index i = 0; i <= j; ++i) {  // Z is symmetric
      Complex sum = Z(i, j);
      for (Eigen::Index k = 0; k < l_; ++k) sum = less_product(sum, rhs_(k, i), W(k, j));
      Z(i, j) = Z(j, i) = sum;
    }
  for (Eigen::Index i = 0; i < r_; ++i)
    for (Eigen::Index k = 0; k < l_; ++k) into.f[i] = less_product(into.f[i], rhs_(k, i), W(k, r_));
  return true;
}

UnsymmetricCondensation::UnsymmetricCondensation(int unknowns, const Eigen::MatrixXd& observed)
    : r_(unknowns),
      l_(observed.rows() - unknowns),
      Zll_(l_, l_),
      c_(observed.bottomRows(l_).cast<Complex>()),
      column_(l_),
      solution_(l_),
      lu_(l_) {}

bool UnsymmetricCondensation::condense(const ComplexMatrix& Z, const ComplexVector& f, Condensed& into) {
  into.Z = Z.topLeftCorner(r_, r_);
  into.f = f.head(r_);
  if (l_ == 0) return true;
  Zll_ = Z.bottomRightCorner(l_, l_);
  lu_.factorize(Zll_);
  for (Eigen::Index k = 0; k < l_; ++k)
    if (!(std::abs(lu_.pivot(k)) > pole * Zll_.col(k).cwiseAbs().maxCoeff())) return false;
  into.W.resize(l_, r_ + 1 + c_.cols());
  into.V.resize(l_, r_);
  for (Eigen::Index i = 0; i <= r_; ++i) {
    if (i < r_)
      column_ = Z.col(i).tail(l_);
    else
      column_ = f.tail(l_);
    lu_.solve(column_, solution_);
    into.W.col(i) = solution_;
  }
  for (Eigen::Index i = 0; i < r_; ++i) {
    column_ = Z.row(i).tail(l_).transpose();
    lu_.solve_transposed(column_, solution_);
    into.V.col(i) = solution_;
  }
  for (Eigen::Index i = 0; i < c_.cols(); ++i) {
    column_ = c_.col(i);
    lu_.solve_transposed(column_, solution_);
    into.W.col(r_ + 1 + i) = solution_;
  }
  const auto Zql = Z.topRightCorner(r_, l_);
  into.Z.noalias() -= Zql * into.W.leftCols(r_);
  into.f.noalias() -= Zql * into.W.col(r_);
  return true;
}

}  // namespace arcslip::hbm
