#pragma once
// The law of Bouc and Wen in one place of z, and its element in harmonic balance (bouc_wen.hpp).

#include <arcslip/laws/law.hpp>

#include <cmath>

namespace arcslip::elements {

struct BoucWenFields {
  explicit BoucWenFields(Fields f) : k(f[0]), a(f[1]), z_y(f[2]), n(f[3]), s(f[4]) {}
  double k, a, z_y, n, s;
};

/// dz/dq where q moves along `way`, and its derivatives.
struct BoucWenRate {
  BoucWenRate(const BoucWenFields& at, double z, double way)
      : turn(at.s * ((way * z > 0) - (way * z < 0)) + 1 - at.s), share(std::abs(z) / at.z_y) {
    const double below = std::pow(share, at.n - 1);
    power = below * share;
    rate = 1 - power * turn;
    by_z = -at.n * below * turn * ((z > 0) - (z < 0)) / at.z_y;
  }
  double turn, share;  // s sgn(q' z) + 1 - s, |z/z_y|
  double power, rate, by_z;
};

std::unique_ptr<Element> bouc_wen_element(const Harmonics& harmonics, const Sampling& sampling);

}  // namespace arcslip::elements
