#include <arcslip/hbm/condensation.hpp>

#include <arcslip/continuation/linear/widest.hpp>
#include <arcslip/hbm/sparse_links.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

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
Split column(SplitMatrix& of, Eigen::Index j) {
  return {of.re.data() + j * of.rows(), of.im.data() + j * of.rows()};
}

// Diagonals of M, C and K, or columns of their blocks lq.
struct Terms {
  const double *M, *C, *K;
};

// z = g(M, C, K) of n entries.
[[gnu::always_inline]] inline void combine(const Factors& g, Terms of, Eigen::Index n, Split z) {
  double* __restrict re = z.re, * __restrict im = z.im;
  const double mass = g.mass.real(), spring = g.spring.real(), i_mass = g.mass.imag(),
               i_damper = g.damper.imag(), i_spring = g.spring.imag();
  for (Eigen::Index j = 0; j < n; ++j) {
    re[j] = mass * of.M[j] + spring * of.K[j];
    im[j] = i_mass * of.M[j] + i_damper * of.C[j] + i_spring * of.K[j];
  }
}

// D := D^-1 of n modes. False where one is singular to rounding.
[[gnu::always_inline]] inline bool invert(double s, Terms of, Eigen::Index n, Split D) {
  double* __restrict re = D.re, * __restrict im = D.im;
  std::int64_t singular = 0;  // as wide as a double, as vectors need it
  for (Eigen::Index j = 0; j < n; ++j) {
    const double a = re[j], b = im[j];
    const double size = a * a + b * b, least = modal_pole * (of.K[j] + s * s * of.M[j]);
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

// Four numbers at once, on every processor.
using Four [[gnu::vector_size(4 * sizeof(double))]] = double;

// sum_j a_j b_j, of every fourth j apart.
[[gnu::always_inline]] inline Complex scalar_product(Split a, Split b, Eigen::Index n) {
  constexpr Eigen::Index lanes = 4;
  Four re = {}, im = {}, a_re, a_im, b_re, b_im;
  Eigen::Index j = 0;
  for (; j + lanes <= n; j += lanes) {
    std::memcpy(&a_re, a.re + j, sizeof(Four));
    std::memcpy(&a_im, a.im + j, sizeof(Four));
    std::memcpy(&b_re, b.re + j, sizeof(Four));
    std::memcpy(&b_im, b.im + j, sizeof(Four));
    re += a_re * b_re - a_im * b_im;
    im += a_re * b_im + a_im * b_re;
  }
  for (; j < n; ++j) {
    re[0] += a.re[j] * b.re[j] - a.im[j] * b.im[j];
    im[0] += a.re[j] * b.im[j] + a.im[j] * b.re[j];
  }
  return {(re[0] + re[1]) + (re[2] + re[3]), (im[0] + im[1]) + (im[2] + im[3])};
}

void put(const ComplexVector& column, Eigen::Index j, SplitMatrix& into) {
  into.re.col(j) = column.real();
  into.im.col(j) = column.imag();
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

ModalCondensation::ModalCondensation(const FixedInterfaceModes& modes, const Eigen::MatrixXd& observed)
    : r_(modes.K.qq.rows()),
      l_(modes.K.ll.size()),
      c_(observed.bottomRows(l_)),
      f_rate_(r_ + l_),
      U_(l_, most_changes),
      inverse_U_(l_, most_changes),
      H_(r_, most_changes),
      equations_(most_changes, most_changes),
      forces_(most_changes, r_ + 1 + c_.cols()) {
  inverse_.resize(l_, 1);
  right_.resize(l_, r_ + 1);
  along_.resize(l_, 2);
}

bool ModalCondensation::condense(const LinearParts& parts, double s, const ComplexVector& f,
                                 Condensed& into) {
  const ModalMatrix &M = parts.modes()->M, &C = parts.modes()->C, &K = parts.modes()->K;
  const Factors g = parts.factors(s);
  into.has_rates = into.has_observed = false;
  into.Z.resize(r_, r_);
  into.f.resize(r_);
  into.W.resize(l_, r_ + 1 + c_.cols());
  right_.re.col(r_) = f.tail(l_).real();
  right_.im.col(r_) = f.tail(l_).imag();
  const bool regular = continuation::widest([&]() __attribute__((always_inline)) {
    const Terms diagonal{M.ll.data(), C.ll.data(), K.ll.data()};
    const Split inverse = column(inverse_, 0);
    combine(g, diagonal, l_, inverse);
    if (!invert(s, diagonal, l_, inverse)) return false;
    for (Eigen::Index i = 0; i <= r_; ++i) {
      const Split right = column(right_, i), W = column(into.W, i);
      if (i < r_) combine(g, {M.lq.data() + i * l_, C.lq.data() + i * l_, K.lq.data() + i * l_}, l_, right);
      multiply(right, inverse, l_, W);
      for (Eigen::Index k = 0; k <= std::min(i, r_ - 1); ++k) {
        const Complex sum = scalar_product(column(right_, k), W, l_);
        if (i < r_)
          into.Z(k, i) = into.Z(i, k) = g.combine(M.qq(k, i), C.qq(k, i), K.qq(k, i)) - sum;
        else
          into.f[k] = f[k] - sum;
      }
    }
    return true;
  });
  if (!regular) return false;
  for (Eigen::Index i = 0; i < c_.cols(); ++i) {
    into.W.re.col(r_ + 1 + i) = inverse_.re.cwiseProduct(c_.col(i));
    into.W.im.col(r_ + 1 + i) = inverse_.im.cwiseProduct(c_.col(i));
  }
  return parts.changes().empty() || add_changes(parts, g, f, into);
}

// With y = Y (q, force factor) and f' the rate of f, the rates are L^T (Z' Y - f'), L: Y without its last
// column, then -Z_ll^-1 c_l of each observation.
void ModalCondensation::differentiate(const LinearParts& parts, int n, Condensed& at) {
  const ModalMatrix &M = parts.modes()->M, &C = parts.modes()->C, &K = parts.modes()->K;
  const Factors g = parts.factor_rates(n);
  const Eigen::Index observations = c_.cols();
  const bool forced = parts.force_rate(n, f_rate_);
  at.rates.resize(r_ + observations, r_ + 1);
  continuation::widest([&]() __attribute__((always_inline)) {
    const Split D = column(inverse_, 0), y = column(along_, 0), v = column(along_, 1);
    combine(g, {M.ll.data(), C.ll.data(), K.ll.data()}, l_, D);
    for (Eigen::Index i = 0; i < r_; ++i)
      combine(g, {M.lq.data() + i * l_, C.lq.data() + i * l_, K.lq.data() + i * l_}, l_, column(right_, i));
    for (Eigen::Index b = 0; b <= r_; ++b) {
      const bool of_force = b == r_;
      const Split W = column(at.W, b);
      const double sign = of_force ? 1 : -1;
      for (Eigen::Index j = 0; j < l_; ++j) {
        y.re[j] = sign * W.re[j];
        y.im[j] = sign * W.im[j];
      }
      multiply(D, y, l_, v);
      if (!of_force) {
        along_.re.col(1) += right_.re.col(b);
        along_.im.col(1) += right_.im.col(b);
      } else if (forced) {
        along_.re.col(1) -= f_rate_.tail(l_).real();
        along_.im.col(1) -= f_rate_.tail(l_).imag();
      }
      for (Eigen::Index a = 0; a < r_; ++a) {
        const Complex own = !of_force ? g.combine(M.qq(a, b), C.qq(a, b), K.qq(a, b))
                            : forced  ? -f_rate_[a]
                                      : Complex(0);
        at.rates(a, b) =
            own + scalar_product(column(right_, a), y, l_) - scalar_product(column(at.W, a), v, l_);
      }
      for (Eigen::Index i = 0; i < observations; ++i)
        at.rates(r_ + i, b) = -scalar_product(column(at.W, r_ + 1 + i), v, l_);
    }
  });
  for (const ChangedPart& change : parts.changes()) {
    const auto along = [&](Eigen::Index k) {  // d . of a column of (Y, L)
      Complex sum = 0;
      for (const auto& [i, d] : change.part->direction.entries())
        if (i >= r_)
          sum += (k == r_ ? d : -d) * at.W(i - r_, k);
        else if (i == k)
          sum += d;
      return sum;
    };
    const Complex by = change.by * g.of(change.part->kind);
    for (Eigen::Index b = 0; b <= r_; ++b) {
      const Complex force = by * along(b);
      for (Eigen::Index a = 0; a < r_; ++a) at.rates(a, b) += along(a) * force;
      for (Eigen::Index i = 0; i < observations; ++i) at.rates(r_ + i, b) += along(r_ + 1 + i) * force;
    }
  }
  at.has_rates = true;
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
  for (Eigen::Index j = 0; j < l_; ++j) inverse_U.row(j) = inverse_(j, 0) * U.row(j);
  H.real().noalias() -= into.W.re.leftCols(r_).transpose() * U;  // Z_ql D^-1 d_l
  H.imag().noalias() -= into.W.im.leftCols(r_).transpose() * U;
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
  T.rightCols(1 + observations) *= -1;
  for (Eigen::Index j = 0; j < T.cols(); ++j)
    for (Eigen::Index i = 0; i < k; ++i)
      for (Eigen::Index row = 0; row < l_; ++row)
        into.W.set(row, j, less_product(into.W(row, j), -inverse_U(row, i), T(i, j)));
  return true;
}

Condensation::Condensation(const LinearParts& parts, int unknowns, const Eigen::MatrixXd& observed)
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
void Condensation::choose_sparse(const LinearParts& parts) {
  if (parts.has_matrices()) return;
  std::vector<Links> links;
  for (const PartInY& part : parts.parts()) {
    Links& linked = links.emplace_back();
    for (const auto& [i, at_i] : part.direction.entries())
      if (i >= r_) linked.push_back(i - r_);
  }
  if (const auto pattern = sparse_pattern(l_, links)) {
    sparse_Zll_ = *pattern;
    sparse_lu_.emplace(sparse_Zll_);
  }
}

bool Condensation::solve_linear(const StructuralMatrices& of, const Factors& g) {
  if (sparse_lu_) {
    for (int j = 0; j < l_; ++j)
      for (Sparse::InnerIterator entry(sparse_Zll_, j); entry; ++entry)
        entry.valueRef() = of.at(g, r_ + entry.row(), r_ + j);
    if (!sparse_lu_->factorize(sparse_Zll_, pole)) return false;
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
    if (!elimination_->run(pole)) return false;
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

UnsymmetricCondensation::UnsymmetricCondensation(int unknowns, const Eigen::MatrixXd& observed)
    : r_(unknowns),
      l_(observed.rows() - unknowns),
      Zll_(l_, l_),
      c_(observed.bottomRows(l_).cast<Complex>()),
      column_(l_),
      solution_(l_),
      lu_(l_) {}

bool UnsymmetricCondensation::condense(const ComplexMatrix& Z, const ComplexVector& f, Condensed& into) {
  into.has_rates = into.has_observed = false;
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
    put(solution_, i, into.W);
  }
  for (Eigen::Index i = 0; i < r_; ++i) {
    column_ = Z.row(i).tail(l_).transpose();
    lu_.solve_transposed(column_, solution_);
    into.V.col(i) = solution_;
  }
  for (Eigen::Index i = 0; i < c_.cols(); ++i) {
    column_ = c_.col(i);
    lu_.solve_transposed(column_, solution_);
    put(solution_, r_ + 1 + i, into.W);
  }
  const auto Zql = Z.topRightCorner(r_, l_);
  for (Eigen::Index k = 0; k < l_; ++k)
    for (Eigen::Index i = 0; i < r_; ++i) {
      for (Eigen::Index j = 0; j < r_; ++j)
        into.Z(i, j) = less_product(into.Z(i, j), Zql(i, k), into.W(k, j));
      into.f[i] = less_product(into.f[i], Zql(i, k), into.W(k, r_));
    }
  return true;
}

}  // namespace arcslip::hbm
