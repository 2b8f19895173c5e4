// The curve of a hysteretic law between two reversals next to closed forms, and polynomials at Gauss nodes.
#include "catch.hpp"

#include <arcslip/laws/hysteresis/bouc_wen.hpp>
#include <arcslip/stability/hysteresis_curve.hpp>

#include <cmath>

using namespace arcslip;
using namespace arcslip::time;

namespace {

HysteresisCurve curve_of(double n, double s) {
  const auto& law = dynamic_cast<const elements::Hysteresis&>(elements::bouc_wen());
  return {law, std::vector<double>{3.0, 0.1, 0.7, n, s}};
}

}  // namespace

TEST_CASE("the curves of Bouc and Wen of exponents 1 and 2 are the closed forms, and their inverses") {
  // x' = 1 - x^n for x > 0, 1 + (2 s - 1) |x|^n for x < 0.
  for (const double n : {1.0, 2.0})
    for (const double s : {0.5, 0.8, 3.0}) {
      const double c = 2 * s - 1;
      const auto curve = curve_of(n, s);
      const auto up = [&](double g) { return n == 1 ? 1 - std::exp(-g) : std::tanh(g); };
      const auto down = [&](double g) {
        if (c == 0) return g;
        return n == 1 ? std::expm1(c * g) / c : std::tan(std::sqrt(c) * g) / std::sqrt(c);
      };
      const double last = c == 0 ? 1 : n == 1 ? std::log1p(c) / c : std::atan(std::sqrt(c)) / std::sqrt(c);
      CHECK(std::abs(curve.g(-1) + last) < 4e-15);
      CHECK(curve.end() > std::log(1e13) / n);
      CHECK(curve.x(2 * curve.end()) == 1);
      for (const double g : {1e-12, 1e-5, 0.01, 0.3, 1.0, 3.0, 10.0, 14.0}) {
        CAPTURE(n, s, g);
        CHECK(std::abs(curve.x(g) - up(g)) < 4e-15);
        CHECK(std::abs(curve.rate_at(g) - (1 - std::pow(up(g), n))) < 1e-14);
        const double back = std::min(g, 0.999) * last;
        CHECK(std::abs(curve.x(-back) + down(back)) < 4e-15);
        CHECK(std::abs(curve.rate_at(-back) - (1 + c * std::pow(down(back), n))) < 2e-14 * s);
        for (const double x : {up(std::min(g, 3.0)), -down(back)})
          CHECK(std::abs(curve.x(curve.g(x)) - x) < 1e-15 * std::abs(x) + 1e-16);
      }
    }
}

TEST_CASE("polynomials through values at Gauss nodes are exact, as are their integrals") {
  for (const int count : {1, 8, 12}) {
    const LegendreFit fit(count);
    Vector values(count), integrals(count);
    for (int i = 0; i < count; ++i) {
      values[i] = std::pow(fit.nodes[i], count - 1);
      integrals[i] = std::pow(fit.nodes[i], count) / count;
    }
    Vector power = fit.powers.transpose() * (fit.by_values * values);
    power[count - 1] -= 1;
    CAPTURE(count);
    CHECK((fit.integral * values - integrals).cwiseAbs().maxCoeff() < 1e-15);
    CHECK(power.cwiseAbs().maxCoeff() < 1e-15 * fit.powers.cwiseAbs().maxCoeff());
    // Twice as exact over the whole: 1/(2 count) is the integral of s^(2 count - 1).
    Vector high(count);
    for (int i = 0; i < count; ++i) high[i] = std::pow(fit.nodes[i], 2 * count - 1);
    CHECK(std::abs(fit.by_values.row(0).dot(high) - 0.5 / count) < 1e-16);
  }
}
