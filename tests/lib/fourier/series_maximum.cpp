#include "catch.hpp"

#include <arcslip/fourier/reversals.hpp>
#include <arcslip/fourier/series_maximum.hpp>

#include <cmath>
#include <random>

using namespace arcslip::elements;

namespace {

double at_reversals(const Harmonics& h, In u) {
  double largest = 0;
  Reversals reversals(h);
  for (const Reversal& turn : reversals.find(u)) largest = std::max(largest, std::abs(turn.x));
  return largest;
}

}  // namespace

TEST_CASE("the largest value of one harmonic is its amplitude, wherever it lies between the samples") {
  for (int order : {1, 3, 55}) {
    const Harmonics h{order, true};
    LargestValue largest(h);
    for (double angle = 0; angle < 7; angle += 0.0137) {
      Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
      u[h.cosine_index(order)] = 3 * std::cos(angle);
      u[h.sine_index(order)] = 3 * std::sin(angle);
      CHECK(std::abs(largest.of(u) - 3) < 1e-13);
    }
  }
}

TEST_CASE("the partial sum of a square wave is largest at its first ripple, pi/(N + 1)") {
  for (int order : {7, 55, 201}) {
    const Harmonics h{order, true};
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    const double ripple = std::numbers::pi / (order + 1);
    double exact = 0;
    for (int n = 1; n <= order; n += 2) {
      u[h.sine_index(n)] = 1.0 / n;
      exact += std::sin(n * ripple) / n;
    }
    CHECK(std::abs(LargestValue(h).of(u) - exact) < 1e-13);
  }
}

TEST_CASE("random series of any kind are largest at one of their reversals") {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int order : {1, 2, 5, 20, 55})
    for (bool odd : {true, false}) {
      const Harmonics h{odd && order % 2 == 0 ? order + 1 : order, odd};
      LargestValue largest(h);
      for (int trial = 0; trial < 200; ++trial) {
        Eigen::VectorXd u(h.size());
        const double decay = trial % 4;
        for (int i = 0; i < h.cosines(); ++i) u[i] = normal(random) * std::pow(1 + h.cosine_order(i), -decay);
        for (int j = 0; j < h.sines(); ++j)
          u[h.cosines() + j] = normal(random) * std::pow(1 + h.sine_order(j), -decay);
        const double exact = at_reversals(h, u);
        CAPTURE(order, odd, trial);
        CHECK(std::abs(largest.of(u) - exact) < 1e-12 * exact);
      }
    }
}

TEST_CASE("nothing, and a mean alone, have their own value") {
  const Harmonics h{5, false};
  LargestValue largest(h);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
  CHECK(largest.of(u) == 0);
  u[0] = -2;
  CHECK(largest.of(u) == 2);
}
