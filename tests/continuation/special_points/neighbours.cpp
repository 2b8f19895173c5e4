// Difference quotients that stay within a piece.

#include <arcslip/continuation/special_points/neighbours.hpp>

#include "catch.hpp"

#include <cmath>

using arcslip::continuation::difference_within_piece;

namespace {

// Of e^x at 0 on the piece [lower, upper]; nothing where there is no room.
std::optional<double> slope(double lower, double upper, double h, double* farthest = nullptr) {
  std::array<double, 2> f{};
  const auto quotient = difference_within_piece(h, [&](std::size_t i, double distance) {
    f[i] = std::exp(distance);
    return lower <= distance && distance <= upper;
  });
  if (!quotient) return {};
  if (farthest) *farthest = std::max(std::abs(quotient->distance[0]), std::abs(quotient->distance[1]));
  return quotient->here * 1 + quotient->weight[0] * f[0] + quotient->weight[1] * f[1];
}

}  // namespace

TEST_CASE("a difference quotient is central where both sides have room, with the longest step that does") {
  double farthest = 0;
  for (const auto& [room, expected] : {std::pair{1.0, 0.1}, std::pair{0.03, 0.01}, std::pair{3e-3, 1e-3}}) {
    const auto found = slope(-room, room, 0.1, &farthest);
    REQUIRE(found);
    CHECK(std::abs(farthest - expected) < 1e-15);
    CHECK(std::abs(*found - 1) < expected * expected / 5 + 1e-12);  // h^2 / 6
    CHECK(*found > 1);
  }
}

TEST_CASE("at the end of a piece a difference quotient is one-sided, and of second order too") {
  for (const auto& [lower, upper] : {std::pair{-1.0, 0.0}, std::pair{0.0, 1.0}})
    for (double h : {100.0, 10.0}) {
      double farthest = 0;
      const auto found = slope(lower, upper, h, &farthest);
      REQUIRE(found);
      const double d = farthest / 2;
      CHECK(std::abs(*found - 1) < d * d / 2.5);  // d^2 / 3
      CHECK(*found < 1 + 1e-12);
    }
  CHECK_FALSE(slope(0, 0, 1));
}

TEST_CASE("a quotient of F itself takes the whole step to one side before any shorter one") {
  using arcslip::continuation::AtEnd;
  const double h = 1e-2;
  for (const auto& [lower, upper] : {std::pair{-1.0, 0.0}, std::pair{0.0, 1.0}, std::pair{-1e-9, 1.0}}) {
    std::array<double, 2> f{};
    const auto quotient = difference_within_piece(
        h,
        [&, lower = lower, upper = upper](std::size_t i, double distance) {
          f[i] = std::exp(distance);
          return lower <= distance && distance <= upper;
        },
        AtEnd::one_sided);
    REQUIRE(quotient);
    CHECK(std::max(std::abs(quotient->distance[0]), std::abs(quotient->distance[1])) == 2 * h);
    CHECK_FALSE(quotient->central());
    const double found = quotient->here + quotient->weight[0] * f[0] + quotient->weight[1] * f[1];
    CHECK(std::abs(found - 1) < h * h / 2.5);  // h^2 / 3
  }
}
