#include <arcslip/hbm/linear/modal_products.hpp>

#include <arcslip/continuation/linear/cpu_dispatch.hpp>

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

}  // namespace arcslip::hbm
