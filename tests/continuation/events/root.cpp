#include "catch.hpp"

#include <arcslip/continuation/events/root.hpp>

#include <cmath>

using arcslip::continuation::find_root;

TEST_CASE("a smooth root is found to rounding in few evaluations") {
  const auto f = [](double x) { return std::cos(x) - x; };
  const auto root = find_root(f, 0, f(0), 1, f(1), 1e-14);
  CHECK(std::abs(root.x - 0.7390851332151607) < 1e-14);
  CHECK(root.evaluations <= 9);
}

TEST_CASE("a root of high multiplicity and one next to a pole stay bracketed") {
  const auto flat = [](double x) { return std::pow(x - 0.3, 9); };
  const auto root = find_root(flat, 0, flat(0), 1, flat(1), 1e-6);
  CHECK(root.lower <= 0.3);
  CHECK(root.upper >= 0.3);
  CHECK(root.upper - root.lower <= 1e-6);
  const auto steep = [](double x) { return 1 / (x + 1e-9) - 1e3; };
  CHECK(std::abs(find_root(steep, 0, steep(0), 1, steep(1), 1e-15).x - (1e-3 - 1e-9)) < 1e-14);
}

TEST_CASE("a jump across zero is bracketed, and its sides differ by the jump") {
  const auto f = [](double x) { return x < 1.0 / 3 ? 1.0 : -2.0; };
  const auto root = find_root(f, 0, 1, 1, -2, 1e-12);
  CHECK(root.lower <= 1.0 / 3);
  CHECK(root.upper >= 1.0 / 3);
  CHECK(root.upper - root.lower <= 1e-12);
  CHECK(root.f_lower - root.f_upper == 3);
}

TEST_CASE("a zero at an end of the bracket is that end") {
  CHECK(find_root([](double x) { return x; }, 0, 0, 1, 1, 1e-12).x == 0);
}
