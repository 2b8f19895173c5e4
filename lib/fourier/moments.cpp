#include <arcslip/fourier/moments.hpp>

namespace arcslip::elements {
namespace {

// In units of the stride, with i and j the indices of cosines and sines: n + m and n - m.
struct Offsets {
  int cc_sum, ss_sum, cs_sum, cs_difference;
};
Offsets offsets(const Harmonics& h) {
  return h.odd ? Offsets{1, 1, 1, 0} : Offsets{0, 2, 1, -1};
}

}  // namespace

Moments::Moments(const Harmonics& h)
    : harmonics_(h),
      count_(2 * h.order / h.stride() + 1),
      c_(Eigen::VectorXd::Zero(2 * count_ - 1)),
      s_(Eigen::VectorXd::Zero(2 * count_ - 1)),
      inverse_(count_) {
  inverse_[0] = 0;
  for (int q = 1; q < count_; ++q) inverse_[q] = 1.0 / (q * h.stride());
}

void Moments::clear() {
  c_.setZero();
  s_.setZero();
}

void Moments::add(int q, double c, double s) {
  c_[count_ - 1 + q] += c;
  s_[count_ - 1 + q] += s;
}

void Moments::add_interval(double length, const std::complex<double>* z_sum,
                           const std::complex<double>* z_half, double weight) {
  double* c = c_.data() + count_ - 1;
  double* s = s_.data() + count_ - 1;
  const int stride = harmonics_.stride();
  c[0] += weight * length;
  for (int q = 1; q < count_; ++q) {
    const double chord = 2 * weight * z_half[q * stride].imag() * inverse_[q];
    c[q] += chord * z_sum[q * stride].real();
    s[q] += chord * z_sum[q * stride].imag();
  }
}

void Moments::close() {
  const int zero = count_ - 1;
  for (int q = 1; q < count_; ++q) {
    c_[zero - q] = c_[zero + q];
    s_[zero - q] = -s_[zero + q];
  }
}

void Moments::integral(Out l) const {
  const double* c = c_.data() + count_ - 1;
  const double* s = s_.data() + count_ - 1;
  for (int i = 0; i < harmonics_.cosines(); ++i) l[i] = c[harmonics_.cosine_order(i) / harmonics_.stride()];
  for (int j = 0; j < harmonics_.sines(); ++j)
    l[harmonics_.cosines() + j] = s[harmonics_.sine_order(j) / harmonics_.stride()];
}

void Moments::times(In u, double factor, Out y) const {
  const Offsets o = offsets(harmonics_);
  const int nc = harmonics_.cosines(), ns = harmonics_.sines();
  const double* c = c_.data() + count_ - 1;
  const double* s = s_.data() + count_ - 1;
  const double half = factor / 2;
  double* yc = y.data();
  double* ys = y.data() + nc;
  for (int j = 0; j < nc; ++j) {
    const double a = half * u[j];
    const double *difference = c - j, *sum = c + j + o.cc_sum;
    for (int i = 0; i < nc; ++i) yc[i] += a * (difference[i] + sum[i]);
    // The row of sines: G_sc(m, n) = G_cs(n, m) = (S_n+m - S_n-m)/2, and S_-k = -S_k.
    const double *s_sum = s + j + o.cs_sum, *s_difference = s - j - o.cs_difference;
    for (int i = 0; i < ns; ++i) ys[i] += a * (s_sum[i] + s_difference[i]);
  }
  for (int j = 0; j < ns; ++j) {
    const double b = half * u[nc + j];
    const double *s_sum = s + j + o.cs_sum, *s_difference = s - j + o.cs_difference;
    for (int i = 0; i < nc; ++i) yc[i] += b * (s_sum[i] - s_difference[i]);
    const double *difference = c - j, *sum = c + j + o.ss_sum;
    for (int i = 0; i < ns; ++i) ys[i] += b * (difference[i] - sum[i]);
  }
}

void Moments::add_to(Eigen::Ref<Eigen::MatrixXd> J, double factor) const {
  const Offsets o = offsets(harmonics_);
  const int nc = harmonics_.cosines(), ns = harmonics_.sines();
  const double* c = c_.data() + count_ - 1;
  const double* s = s_.data() + count_ - 1;
  const double half = factor / 2;
  for (int j = 0; j < nc; ++j) {
    double* column = J.col(j).data();
    const double *difference = c - j, *sum = c + j + o.cc_sum;
    for (int i = 0; i < nc; ++i) column[i] += half * (difference[i] + sum[i]);
    const double *s_sum = s + j + o.cs_sum, *s_difference = s - j - o.cs_difference;
    for (int i = 0; i < ns; ++i) column[nc + i] += half * (s_sum[i] + s_difference[i]);
  }
  for (int j = 0; j < ns; ++j) {
    double* column = J.col(nc + j).data();
    const double *s_sum = s + j + o.cs_sum, *s_difference = s - j + o.cs_difference;
    for (int i = 0; i < nc; ++i) column[i] += half * (s_sum[i] - s_difference[i]);
    const double *difference = c - j, *sum = c + j + o.ss_sum;
    for (int i = 0; i < ns; ++i) column[nc + i] += half * (difference[i] - sum[i]);
  }
}

}  // namespace arcslip::elements
