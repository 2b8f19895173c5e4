#include <arcslip/fourier/velocity_sign.hpp>

namespace arcslip::elements {

VelocitySign::VelocitySign(const Harmonics& h)
    : harmonics_(h),
      search_(h),
      integrals_(static_cast<std::size_t>(3 * h.order + 1)),
      middle_(integrals_.size()),
      half_(integrals_.size()) {
  turns_.reserve(static_cast<std::size_t>(4 * h.order + 16));
}

void VelocitySign::move_to(In u) {
  const auto& found = search_.find(u);
  turns_.assign(found.begin(), found.end());
  for (auto& integral : integrals_) integral = 0;
  const int count = static_cast<int>(integrals_.size());
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    const Reversal& from = turns_[i];
    Reversal to = turns_[(i + 1) % turns_.size()];
    if (i + 1 == turns_.size()) to = {to.theta + harmonics_.span(), harmonics_.odd ? -to.x : to.x};
    const double sign = to.x > from.x ? 1 : -1, half = 0.5 * (to.theta - from.theta);
    powers(0.5 * (from.theta + to.theta), count, middle_.data());
    powers(half, count, half_.data());
    integrals_[0] += sign * 2 * half;
    for (std::size_t k = 1; k < integrals_.size(); ++k)
      integrals_[k] += sign * 2 * half_[k].imag() / static_cast<double>(k) * middle_[k];
  }
}

// exp(i k theta) cos m theta = (e^(i (k + m) theta) + e^(i (k - m) theta))/2, and likewise with sin.
void VelocitySign::moments(In w, Moments& result) const {
  const Harmonics& h = harmonics_;
  result.clear();
  for (int q = 0; q < result.count(); ++q) {
    const int k = q * h.stride();
    std::complex<double> sum = 0;
    for (int i = 0; i < h.cosines(); ++i) {
      const int m = h.cosine_order(i);
      sum += 0.5 * w[i] * (integral(k + m) + integral(k - m));
    }
    for (int j = 0; j < h.sines(); ++j) {
      const int m = h.sine_order(j);
      const std::complex<double> difference = integral(k + m) - integral(k - m);
      sum += 0.5 * w[h.cosines() + j] * std::complex<double>(difference.imag(), -difference.real());
    }
    result.add(q, sum.real(), sum.imag());
  }
  result.close();
}

}  // namespace arcslip::elements
