#include <arcslip/hbm/linear/elimination.hpp>

#include <arcslip/continuation/linear/cpu_dispatch.hpp>

#include <algorithm>
#include <utility>

namespace arcslip::hbm {
namespace {

using Eigen::Index;

struct Parts {  // of a matrix of n rows, column by column
  double *re, *im;
  Parts column(Index j, Index n) const { return {re + j * n, im + j * n}; }
};

struct Equations {
  Parts all;
  Index r, n, columns;
  Parts inverse, multipliers;  // n each

  Parts column(Index j) const { return all.column(j, n); }
};

double square(Parts of, Index i) {
  return of.re[i] * of.re[i] + of.im[i] * of.im[i];
}

// a -= u b from row `begin` to `end`.
[[gnu::always_inline]] inline void subtract(Parts a, double u_re, double u_im, Parts b, Index begin,
                                            Index end) {
  double* __restrict a_re = a.re, * __restrict a_im = a.im;
  const double* __restrict b_re = b.re, * __restrict b_im = b.im;
  for (Index i = begin; i < end; ++i) {
    a_re[i] -= u_re * b_re[i] - u_im * b_im[i];
    a_im[i] -= u_re * b_im[i] + u_im * b_re[i];
  }
}

[[gnu::always_inline]] inline bool eliminate_rows(const Equations& z, double least) {
  for (Index k = z.r; k < z.n; ++k) {  // of the columns as they are given
    double largest = 0;
    for (Index i = z.r; i < z.n; ++i) largest = std::max(largest, square(z.column(k), i));
    z.inverse.re[k] = least * least * largest;
  }
  for (Index k = z.n - 1; k >= z.r; --k) {
    const Parts column = z.column(k);
    Index pivot = k;
    double size = square(column, k);
    for (Index i = z.r; i < k; ++i)
      if (const double other = square(column, i); other > size) pivot = i, size = other;
    if (!(size > z.inverse.re[k])) return false;
    if (pivot != k)
      for (Index j = 0; j < z.columns; ++j) {
        if (j > k && j < z.n) continue;
        const Parts at = z.column(j);
        std::swap(at.re[k], at.re[pivot]);
        std::swap(at.im[k], at.im[pivot]);
      }
    const double a = column.re[k] / size, b = -column.im[k] / size;
    z.inverse.re[k] = a;
    z.inverse.im[k] = b;
    for (Index i = 0; i < k; ++i) {
      z.multipliers.re[i] = a * column.re[i] - b * column.im[i];
      z.multipliers.im[i] = a * column.im[i] + b * column.re[i];
    }
    for (Index j = 0; j < z.columns; ++j) {
      if (j >= k && j < z.n) continue;
      const Parts at = z.column(j);
      subtract(at, at.re[k], at.im[k], z.multipliers, j > z.n ? z.r : 0, k);
    }
  }
  // Row k has the pivot and what stands left of it: forward substitution.
  for (Index j = 0; j < z.columns; ++j) {
    if (j >= z.r && j < z.n) continue;
    const Parts at = z.column(j);
    for (Index k = z.r; k < z.n; ++k) {
      const double re = at.re[k], im = at.im[k];
      at.re[k] = z.inverse.re[k] * re - z.inverse.im[k] * im;
      at.im[k] = z.inverse.re[k] * im + z.inverse.im[k] * re;
      subtract(at, at.re[k], at.im[k], z.column(k), k + 1, z.n);
    }
  }
  return true;
}

}  // namespace

Elimination::Elimination(Index r, Index l, Index more)
    : r_(r),
      n_(r + l),
      columns_(n_ + 1 + more),
      re_(n_, columns_),
      im_(n_, columns_),
      inverse_re_(n_),
      inverse_im_(n_),
      multipliers_re_(n_),
      multipliers_im_(n_) {}

void Elimination::set(const StructuralMatrices& of, const Factors& g, const ComplexVector& f,
                      const Eigen::MatrixXd& c) {
  re_.leftCols(n_) = g.mass.real() * of.M + g.spring.real() * of.K;
  im_.leftCols(n_) = g.damper.imag() * of.C;
  if (g.mass.imag() != 0) im_.leftCols(n_) += g.mass.imag() * of.M;
  if (g.spring.imag() != 0) im_.leftCols(n_) += g.spring.imag() * of.K;
  re_.col(n_) = f.real();
  im_.col(n_) = f.imag();
  re_.bottomRightCorner(n_ - r_, c.cols()) = c;
  im_.rightCols(c.cols()).setZero();
}

bool Elimination::run(double least) {
  const Equations all{{re_.data(), im_.data()},
                      r_,
                      n_,
                      columns_,
                      {inverse_re_.data(), inverse_im_.data()},
                      {multipliers_re_.data(), multipliers_im_.data()}};
  return continuation::widest([&]() __attribute__((always_inline)) { return eliminate_rows(all, least); });
}

void Elimination::condensed(ComplexMatrix& Z, ComplexVector& f, SplitMatrix& W) const {
  const auto value = [&](Index i, Index j) { return Complex(re_(i, j), im_(i, j)); };
  Z.resize(r_, r_);
  for (Index j = 0; j < r_; ++j)
    for (Index i = 0; i <= j; ++i) Z(i, j) = Z(j, i) = value(i, j);
  f.resize(r_);
  for (Index i = 0; i < r_; ++i) f[i] = value(i, n_);
  const Index l = n_ - r_, more = columns_ - n_ - 1;
  W.resize(l, r_ + 1 + more);
  W.re.leftCols(r_) = re_.bottomLeftCorner(l, r_);
  W.im.leftCols(r_) = im_.bottomLeftCorner(l, r_);
  W.re.rightCols(1 + more) = re_.bottomRightCorner(l, 1 + more);
  W.im.rightCols(1 + more) = im_.bottomRightCorner(l, 1 + more);
}

}  // namespace arcslip::hbm
