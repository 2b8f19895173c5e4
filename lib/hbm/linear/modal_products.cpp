#include <arcslip/hbm/linear/modal_products.hpp>

#include <arcslip/continuation/linear/cpu_dispatch.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <utility>

namespace arcslip::hbm {
namespace {

// (re, im) += (m M + k K) of one column, of so many rows.
[[gnu::always_inline]] inline void add_column(Complex m, const double* M, Complex k, const double* K,
                                              Eigen::Index rows, double* __restrict re,
                                              double* __restrict im) {
  const double m_re = m.real(), m_im = m.imag(), k_re = k.real(), k_im = k.imag();
  for (Eigen::Index i = 0; i < rows; ++i) {
    re[i] += m_re * M[i] + k_re * K[i];
    im[i] += m_im * M[i] + k_im * K[i];
  }
}

[[gnu::always_inline]] inline void add_column(Complex c, const double* C, Eigen::Index rows,
                                              double* __restrict re, double* __restrict im) {
  const double c_re = c.real(), c_im = c.imag();
  for (Eigen::Index i = 0; i < rows; ++i) {
    re[i] += c_re * C[i];
    im[i] += c_im * C[i];
  }
}

bool is_zero(const ModalMatrix& A) {
  return A.qq.isZero(0) && A.lq.isZero(0) && A.ll.isZero(0);
}

}  // namespace

ModalProducts::ModalProducts(std::shared_ptr<const FixedInterfaceModes> modes)
    : modes_(std::move(modes)),
      M_ql_(modes_->M.lq.transpose()),
      C_ql_(modes_->C.lq.transpose()),
      K_ql_(modes_->K.lq.transpose()),
      damped_(!is_zero(modes_->C)),
      re_(std::max(M_ql_.rows(), M_ql_.cols())),
      im_(re_.size()) {}

void ModalProducts::add(const Factors& g, Blocks of, const Complex* x, Complex* v) {
  const Eigen::Index rows = of.M.rows(), columns = of.M.cols();
  re_.head(rows).setZero();
  im_.head(rows).setZero();
  continuation::widest([&]() __attribute__((always_inline)) {
    double *re = re_.data(), *im = im_.data();
    for (Eigen::Index j = 0; j < columns; ++j) {
      if (x[j] == 0.0) continue;
      const Eigen::Index at = j * rows;
      add_column(product(g.mass, x[j]), of.M.data() + at, product(g.spring, x[j]), of.K.data() + at, rows, re,
                 im);
      if (damped_) add_column(product(g.damper, x[j]), of.C.data() + at, rows, re, im);
    }
  });
  for (Eigen::Index i = 0; i < rows; ++i) v[i] += Complex(re_[i], im_[i]);
}

void ModalProducts::add_qq(const Factors& g, const ComplexVector& y, ComplexVector& v) {
  add(g, {modes_->M.qq, modes_->C.qq, modes_->K.qq}, y.data(), v.data());
}

void ModalProducts::add_ql(const Factors& g, const ComplexVector& y, ComplexVector& v) {
  add(g, {M_ql_, C_ql_, K_ql_}, y.data() + M_ql_.rows(), v.data());
}

void ModalProducts::add_lq(const Factors& g, const ComplexVector& y, ComplexVector& v) {
  add(g, {modes_->M.lq, modes_->C.lq, modes_->K.lq}, y.data(), v.data() + M_ql_.rows());
}

void ModalProducts::add(const Factors& g, const ComplexVector& y, ComplexVector& v) {
  add_qq(g, y, v);
  add_ql(g, y, v);
  add_lq(g, y, v);
  const Eigen::Index r = M_ql_.rows();
  const Eigen::VectorXd &M = modes_->M.ll, &C = modes_->C.ll, &K = modes_->K.ll;
  for (Eigen::Index j = 0; j < M.size(); ++j)
    v[r + j] += product(g.mass * M[j] + g.damper * C[j] + g.spring * K[j], y[r + j]);
}

ModalOperator::ModalOperator(ModalProducts& products, const Eigen::MatrixXd& observed)
    : products_(products),
      r_(products.modes().K.qq.rows()),
      l_(products.modes().K.ll.size()),
      c_(observed),
      v_(r_ + l_) {}

bool ModalOperator::move_to(const Factors& g, double s, ModalEquation& at) const {
  const ModalMatrix &M = products_.modes().M, &C = products_.modes().C, &K = products_.modes().K;
  at.g = g;
  at.has_observations = false;
  at.inverse.resize(l_);
  bool regular = true;
  for (Eigen::Index j = 0; j < l_; ++j) {
    const Complex D = g.combine(M.ll[j], C.ll[j], K.ll[j]);
    const double size = std::norm(D), least = modal_pole * (K.ll[j] + s * s * M.ll[j]);
    regular = regular && size > least * least;
    at.inverse[j] = std::conj(D) / size;
  }
  return regular;
}

void ModalOperator::expand(const ModalEquation& at, const ComplexVector& f, double force_factor,
                           ComplexVector& y) {
  v_.tail(l_).setZero();
  products_.add_lq(at.g, y, v_);
  for (Eigen::Index j = r_; j < r_ + l_; ++j) y[j] = product(at.inverse[j - r_], force_factor * f[j] - v_[j]);
}

void ModalOperator::residual(const ModalEquation& at, const ComplexVector& f, double force_factor,
                             const ComplexVector& y, ComplexVector& v) {
  v.head(r_) = -force_factor * f.head(r_);
  products_.add_qq(at.g, y, v);
  products_.add_ql(at.g, y, v);
}

void ModalOperator::project(const ModalEquation& at, ComplexVector& v) {
  for (Eigen::Index j = r_; j < r_ + l_; ++j) v[j] = -product(at.inverse[j - r_], v[j]);
  products_.add_ql(at.g, v, v);
}

const ComplexMatrix& ModalOperator::observations(ModalEquation& at, const ComplexVector& f) {
  if (at.has_observations) return at.observations;
  at.observations.resize(c_.cols(), r_ + 1);
  for (Eigen::Index k = 0; k < c_.cols(); ++k) {
    v_ = c_.col(k).cast<Complex>();
    Complex forced = 0;
    for (Eigen::Index j = r_; j < r_ + l_; ++j) forced += product(product(at.inverse[j - r_], v_[j]), f[j]);
    project(at, v_);
    at.observations.row(k).head(r_) = v_.head(r_).transpose();
    at.observations(k, r_) = forced;
  }
  at.has_observations = true;
  return at.observations;
}

Complex ModalOperator::observed_change(const ModalEquation& at, const ComplexVector& v,
                                       int observation) const {
  Complex sum = 0;
  for (Eigen::Index j = r_; j < r_ + l_; ++j) sum -= c_(j, observation) * product(at.inverse[j - r_], v[j]);
  return sum;
}

void ModalOperator::form(const ModalEquation& at, ComplexMatrix& Z) {
  const ModalMatrix &M = products_.modes().M, &C = products_.modes().C, &K = products_.modes().K;
  const Factors& g = at.g;
  right_.resize(2 * l_, r_);
  turned_.resize(2 * l_, r_);
  solved_.resize(2 * l_, r_);
  for (Eigen::Index i = 0; i < r_; ++i)
    for (Eigen::Index j = 0; j < l_; ++j) {
      const Complex z = g.combine(M.lq(j, i), C.lq(j, i), K.lq(j, i)), w = product(at.inverse[j], z);
      right_(j, i) = turned_(l_ + j, i) = z.real();
      turned_(j, i) = z.imag();
      right_(l_ + j, i) = -z.imag();
      solved_(j, i) = w.real();
      solved_(l_ + j, i) = w.imag();
    }
  continuation::transposed_product(right_, solved_, re_);
  continuation::transposed_product(turned_, solved_, im_);
  Z.resize(r_, r_);
  for (Eigen::Index j = 0; j < r_; ++j)
    for (Eigen::Index i = 0; i < r_; ++i)
      Z(i, j) = g.combine(M.qq(i, j), C.qq(i, j), K.qq(i, j)) - Complex(re_(i, j), im_(i, j));
}

}  // namespace arcslip::hbm
