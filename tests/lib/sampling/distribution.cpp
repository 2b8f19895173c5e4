// Quantiles and probabilities of distributions, against tables, closed forms and the complementary error
// function.
#include "catch.hpp"

#include <arcslip/sampling/distribution.hpp>

#include <cmath>
#include <string>

using namespace arcslip::sampling;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

double above_normal(double z) {
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

}  // namespace

TEST_CASE("quantiles of a normal distribution are those of tables") {
  const Distribution standard{DistributionType::normal, {0, 1}};
  CHECK_THAT(quantile(standard, 0.975), WithinRel(1.959963984540054, 1e-14));
  CHECK_THAT(quantile(standard, 0.001), WithinRel(-3.090232306167813, 1e-14));
  CHECK(quantile(standard, 0.5) == 0);
  const Distribution load{DistributionType::normal, {30, 3}};
  CHECK_THAT(quantile(load, 0.9), WithinRel(30 + 3 * 1.281551565544600, 1e-14));
}

TEST_CASE("a uniform distribution has its quantiles on a line, within its ends") {
  const Distribution between{DistributionType::uniform, {-1, 3}};
  CHECK(quantile(between, 0.25) == 0);
  CHECK(quantile(between, 1 - 0x1p-53) <= 3);
  CHECK(probability_below(between, 0) == 0.25);
  CHECK(probability_above(between, 2) == 0.25);
  CHECK(probability_below(between, -2) == 0);
  CHECK(probability_below(between, 4) == 1);
}

TEST_CASE("mean and standard deviation of a lognormal distribution are those of the number itself") {
  const Distribution of{DistributionType::lognormal, {10, 4}};
  // Its logarithm has the variance log(1 + (4/10)^2), so that its median is 10/sqrt(1.16).
  CHECK_THAT(quantile(of, 0.5), WithinRel(10 / std::sqrt(1.16), 1e-14));
  double mean = 0, square = 0;
  constexpr int count = 400'000;
  for (int i = 0; i < count; ++i) {
    const double x = quantile(of, (i + 0.5) / count);
    mean += x / count;
    square += x * x / count;
  }
  CHECK_THAT(mean, WithinRel(10.0, 1e-5));
  CHECK_THAT(std::sqrt(square - mean * mean), WithinRel(4.0, 1e-4));
  CHECK(probability_below(of, 0) == 0);
  CHECK(probability_below(of, -1) == 0);
}

TEST_CASE("a truncated normal distribution keeps its digits far from the mean, on both sides") {
  // P(5 < z < 9) is 2.9e-7: 1 - P has nine digits less.
  const Distribution right{DistributionType::truncated_normal, {0, 1, 5, 9}};
  const Distribution left{DistributionType::truncated_normal, {0, 1, -9, -5}};
  for (const double probability : {1e-3, 0.25, 0.5, 0.9}) {
    CAPTURE(probability);
    const double x = quantile(right, probability);
    const double share = (above_normal(5) - above_normal(x)) / (above_normal(5) - above_normal(9));
    CHECK_THAT(share, WithinRel(probability, 1e-9));
    CHECK_THAT(quantile(left, 1 - probability), WithinRel(-x, 1e-12));
  }
  const Distribution middle{DistributionType::truncated_normal, {2, 1, 0, 100}};
  CHECK_THAT(probability_below(middle, 2), WithinRel((0.5 - above_normal(2)) / (1 - above_normal(2)), 1e-14));
  CHECK(probability_below(middle, 0) == 0);
  CHECK(quantile(middle, 1e-300) >= 0);
  CHECK(quantile(middle, 1 - 0x1p-53) <= 100);
}

TEST_CASE("probabilities of small tails have all digits") {
  const Distribution of{DistributionType::normal, {30, 3}};
  CHECK_THAT(probability_below(of, 0), WithinRel(above_normal(10), 1e-12));
  CHECK_THAT(probability_above(of, 60), WithinRel(above_normal(10), 1e-12));
  CHECK(probability_below(of, -std::numeric_limits<double>::infinity()) == 0);
  CHECK(probability_above(of, std::numeric_limits<double>::infinity()) == 0);
}

TEST_CASE("each type of distribution has a description, at its place in the list") {
  for (const DistributionDescription& each : distribution_types())
    CHECK(description(each.type).name == each.name);
}
