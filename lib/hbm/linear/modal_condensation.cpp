#include <arcslip/hbm/linear/condensation.hpp>

#include <arcslip/continuation/linear/cpu_dispatch.hpp>
#include <arcslip/hbm/linear/in_place_elimination.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace arcslip::hbm {
namespace {

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

}  // namespace

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
  const Eigen::Index columns = into.forced ? r_ + 1 : r_;
  if (into.forced) {
    right_.re.col(r_) = f.tail(l_).real();
    right_.im.col(r_) = f.tail(l_).imag();
  } else {
    into.f.setZero();
    into.W.re.col(r_).setZero();
    into.W.im.col(r_).setZero();
  }
  const bool regular = continuation::widest([&]() __attribute__((always_inline)) {
    const Terms diagonal{M.ll.data(), C.ll.data(), K.ll.data()};
    const Split inverse = column(inverse_, 0);
    combine(g, diagonal, l_, inverse);
    if (!invert(s, diagonal, l_, inverse)) return false;
    for (Eigen::Index i = 0; i < columns; ++i) {
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

namespace {

// The part of the springs and dampers that changed, of r coordinates and so many columns of the rates.
void add_change_rates(const LinearParts& parts, const Factors& g, Eigen::Index r, Eigen::Index columns,
                      Condensed& at) {
  for (const ChangedPart& change : parts.changes()) {
    const auto along = [&](Eigen::Index k) {  // d . of a column of (Y, L)
      Complex sum = 0;
      for (const auto& [i, d] : change.part->direction.entries())
        if (i >= r)
          sum += (k == r ? d : -d) * at.W(i - r, k);
        else if (i == k)
          sum += d;
      return sum;
    };
    const Complex by = change.by * g.of(change.part->kind);
    for (Eigen::Index b = 0; b < columns; ++b) {
      const Complex force = by * along(b);
      for (Eigen::Index a = 0; a < r; ++a) at.rates(a, b) += along(a) * force;
      for (Eigen::Index i = r; i < at.rates.rows(); ++i) at.rates(i, b) += along(i + 1) * force;
    }
  }
}

}  // namespace

// With y = Y (q, force factor) and f' the rate of f, the rates are L^T (Z' Y - f'), L: Y without its last
// column, then -Z_ll^-1 c_l of each observation.
void ModalCondensation::differentiate(const LinearParts& parts, int n, Condensed& at) {
  const ModalMatrix &M = parts.modes()->M, &C = parts.modes()->C, &K = parts.modes()->K;
  const Factors g = parts.factor_rates(n);
  const Eigen::Index observations = c_.cols();
  const bool forced = parts.force_rate(n, f_rate_);
  at.rates.resize(r_ + observations, r_ + 1);
  const Eigen::Index columns = at.forced || forced ? r_ + 1 : r_;
  if (columns == r_) at.rates.col(r_).setZero();
  continuation::widest([&]() __attribute__((always_inline)) {
    const Split D = column(inverse_, 0), y = column(along_, 0), v = column(along_, 1);
    combine(g, {M.ll.data(), C.ll.data(), K.ll.data()}, l_, D);
    for (Eigen::Index i = 0; i < r_; ++i)
      combine(g, {M.lq.data() + i * l_, C.lq.data() + i * l_, K.lq.data() + i * l_}, l_, column(right_, i));
    for (Eigen::Index b = 0; b < columns; ++b) {
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
  add_change_rates(parts, g, r_, columns, at);
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

}  // namespace arcslip::hbm
