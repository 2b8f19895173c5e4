#include "catch.hpp"

#include <arcslip/time/event_driven/polynomial_roots.hpp>

#include <cmath>

using namespace arcslip::time;

namespace {

std::vector<double> product_of_roots(const std::vector<double>& roots) {
  std::vector<double> c = {1};
  for (double root : roots) {
    std::vector<double> next(c.size() + 1, 0.0);
    for (std::size_t k = 0; k < c.size(); ++k) {
      next[k] -= root * c[k];
      next[k + 1] += c[k];
    }
    c = next;
  }
  return c;
}

}  // namespace

TEST_CASE("every sign change of a Chebyshev polynomial on [0, 1] is found") {
  // T_8(2 s - 1) = 1 - 128 s + 2688 s^2 - 21504 s^3 + 84480 s^4 - 180224 s^5 + 212992 s^6 - 131072 s^7 +
  // 32768 s^8
  const std::vector<double> c = {1, -128, 2688, -21504, 84480, -180224, 212992, -131072, 32768};
  std::vector<double> found;
  sign_changes(c, found);
  REQUIRE(found.size() == 8);
  const double pi = std::acos(-1.0);
  for (std::size_t j = 0; j < 8; ++j)
    CHECK(found[j] ==
          Approx(0.5 * (1 - std::cos(pi * (2.0 * static_cast<double>(j) + 1) / 16))).epsilon(1e-12));
}

TEST_CASE("two sign changes 2e-6 apart are found, and a touch without one is not") {
  std::vector<double> found;
  sign_changes(product_of_roots({0.4, 0.4 + 2e-6}), found);
  REQUIRE(found.size() == 2);
  CHECK(std::abs(found[0] - 0.4) < 1e-9);
  CHECK(std::abs(found[1] - 0.4 - 2e-6) < 1e-9);
  sign_changes(std::vector<double>{0.25, -1, 1 + 1e-12}, found);  // 0.5 touched from above
  CHECK(found.empty());
}

TEST_CASE("a fall is the first place where the polynomial goes below zero") {
  CHECK(*first_fall(product_of_roots({0.3, 0.6, 2}), 0) == 0);  // negative at 0
  CHECK(*first_fall(std::vector<double>{0.06, -0.5, 1}, 0) ==
        Approx(0.2).epsilon(1e-15));  // (s - 0.2)(s - 0.3)
  CHECK_FALSE(first_fall(std::vector<double>{1, -0.4, -0.3}, 0));
  CHECK_FALSE(first_fall(std::vector<double>{}, 0));
}

TEST_CASE("a polynomial that begins within rounding of zero is judged by where it goes") {
  CHECK(*first_fall(std::vector<double>{1e-17, -1e-17, -1}, 1e-15) == 0);
  CHECK_FALSE(first_fall(std::vector<double>{-1e-17, -1e-17, 1}, 1e-15));
  CHECK(*first_fall(std::vector<double>{-1e-17, 1e-17, 1, -4}, 1e-15) == Approx(0.25).epsilon(1e-14));
  CHECK_FALSE(first_fall(std::vector<double>{1e-17, -1e-17, 1e-17}, 1e-15));
}

TEST_CASE("a polynomial that is zero, constant or flat to a high order is decided at once") {
  std::vector<double> found, flat(20, 0.0);
  sign_changes(flat, found);
  CHECK(found.empty());
  flat[15] = 1;
  sign_changes(flat, found);
  CHECK(found.empty());
  flat[12] = -1e-3;  // s^12 (s^3 - 0.001)
  sign_changes(flat, found);
  REQUIRE(found.size() == 1);
  CHECK(found[0] == Approx(0.1).epsilon(1e-13));
}
