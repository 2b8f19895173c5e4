#include <arcslip/fourier/series.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::elements {
namespace {

constexpr double same_motion = 1e-8;  // of the largest coefficient

}  // namespace

Values series_values(const Harmonics& h, In u, double theta) {
  return series_values(h, u, std::cos(theta), std::sin(theta));
}

Values series_values(const Harmonics& h, In u, double c, double s) {
  const double step_c = h.odd ? (c - s) * (c + s) : c, step_s = h.odd ? 2 * c * s : s;
  Values v{h.odd ? 0.0 : u[0], 0, 0, 0};
  const int sines = h.sines();
  const double* a = u.data() + (h.odd ? 0 : 1);
  const double* b = u.data() + h.cosines();
  for (int j = 0; j < sines; ++j) {
    const double n = h.sine_order(j);
    const double even = a[j] * c + b[j] * s, odd = b[j] * c - a[j] * s;
    v.x += even;
    v.d1 += n * odd;
    v.d2 -= n * n * even;
    v.d3 -= n * n * n * odd;
    const double next = c * step_c - s * step_s;
    s = s * step_c + c * step_s;
    c = next;
  }
  return v;
}

void series_basis(const Harmonics& h, double theta, Out phi) {
  for (int i = 0; i < h.cosines(); ++i) phi[i] = std::cos(h.cosine_order(i) * theta);
  for (int j = 0; j < h.sines(); ++j) phi[h.cosines() + j] = std::sin(h.sine_order(j) * theta);
}

void series_slope(const Harmonics& h, In u, Out slope) {
  if (!h.odd) slope[0] = 0;
  for (int j = 0; j < h.sines(); ++j) {
    const int n = h.sine_order(j), a = h.cosine_index(n), b = h.sine_index(n);
    slope[a] = n * u[b];
    slope[b] = -n * u[a];
  }
}

void powers(double theta, int count, std::complex<double>* z) {
  powers(std::complex<double>(std::cos(theta), std::sin(theta)), count, z);
}

void powers(std::complex<double> on_circle, int count, std::complex<double>* z) {
  if (count < 1) return;
  z[0] = 1;
  if (count < 2) return;
  z[1] = on_circle;
  for (int known = 1; known + 1 < count; known *= 2) {  // z[1 .. known] are there
    const double c = z[known].real(), s = z[known].imag();
    const int more = std::min(known, count - 1 - known);
    for (int k = 1; k <= more; ++k) {
      const double re = z[k].real(), im = z[k].imag();
      z[known + k] = {re * c - im * s, re * s + im * c};
    }
  }
}

double series_bound(const Harmonics& h, In u, int power) {
  const double* a = u.data() + (h.odd ? 0 : 1);
  const double* b = u.data() + h.cosines();
  double bound = 0;
  for (int j = 0; j < h.sines(); ++j) {
    double weight = 1;
    for (int k = 0; k < power; ++k) weight *= h.sine_order(j);
    bound += weight * std::sqrt(a[j] * a[j] + b[j] * b[j]);
  }
  return bound;
}

double root_mean_square(const Harmonics& h, In u) {
  const int means = h.odd ? 0 : 1;
  const double waves = u.tail(u.size() - means).norm() / std::numbers::sqrt2;
  return means == 0 ? waves : std::hypot(u[0], waves);
}

bool is_image(const Harmonics& h, In u, double turn, double sign) {
  return is_image(h, u, u, turn, sign);
}

bool is_image(const Harmonics& h, In v, In u, double turn, double sign) {
  const double same = same_motion * u.cwiseAbs().maxCoeff();
  if (!h.odd && std::abs(v[0] - sign * u[0]) > 2 * same) return false;
  for (int j = 0; j < h.sines(); ++j) {
    const int n = h.sine_order(j);
    const double a = v[h.cosine_index(n)], b = v[h.sine_index(n)];
    const double c = std::cos(n * turn), s = std::sin(n * turn);
    const double to_a = sign * u[h.cosine_index(n)], to_b = sign * u[h.sine_index(n)];
    if (std::hypot(c * a + s * b - to_a, c * b - s * a - to_b) > same) return false;
  }
  return true;
}

}  // namespace arcslip::elements
