#include <arcslip/fourier/harmonics.hpp>

namespace arcslip::elements {

void transfer(const Harmonics& from, Eigen::Ref<const Eigen::VectorXd> u, const Harmonics& to,
              Eigen::Ref<Eigen::VectorXd> v) {
  v.setZero();
  for (int i = 0; i < from.cosines(); ++i) {
    const int n = from.cosine_order(i) * to.period, m = n / from.period;  // n/period is the frequency
    if (n % from.period != 0 || !to.has(m)) continue;
    for (Eigen::Index a = 0, b = 0; a < u.size(); a += from.size(), b += to.size()) {
      v[b + to.cosine_index(m)] = u[a + i];
      if (m > 0) v[b + to.sine_index(m)] = u[a + from.sine_index(from.cosine_order(i))];
    }
  }
}

}  // namespace arcslip::elements
