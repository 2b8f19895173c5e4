#include <arcslip/fourier/samples.hpp>

namespace arcslip::elements {

Samples::Samples(const Harmonics& h, int count) : harmonics_(h), count_(count), basis_(count, h.size()) {
  const int moments = Moments(h).count();
  cos_.resize(moments, count);
  sin_.resize(moments, count);
  c_.resize(moments);
  s_.resize(moments);
  // Angles are reduced in integers, so that k theta_s loses no digits.
  const long full = (h.odd ? 2L : 1L) * count;
  const auto turn = [&](long k, long s) {
    return 2 * std::numbers::pi * static_cast<double>((k * s) % full) / static_cast<double>(full);
  };
  for (int s = 0; s < count; ++s) {
    for (int i = 0; i < h.cosines(); ++i) basis_(s, i) = std::cos(turn(h.cosine_order(i), s));
    for (int j = 0; j < h.sines(); ++j) basis_(s, h.cosines() + j) = std::sin(turn(h.sine_order(j), s));
    for (int q = 0; q < moments; ++q) {
      cos_(q, s) = std::cos(turn(q * h.stride(), s));
      sin_(q, s) = std::sin(turn(q * h.stride(), s));
    }
  }
}

void Samples::moments(In w, Moments& result) const {
  c_.noalias() = cos_ * w;
  s_.noalias() = sin_ * w;
  result.clear();
  for (int q = 0; q < result.count(); ++q) result.add(q, c_[q], s_[q]);
  result.close();
}

}  // namespace arcslip::elements
