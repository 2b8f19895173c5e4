#include "catch.hpp"

#include <arcslip/fourier/crossings.hpp>
#include <arcslip/laws/contact/normal_contact.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace arcslip::elements;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

std::vector<Crossing> crossings_of(const Harmonics& h, const Eigen::VectorXd& u, double level) {
  Crossings crossings(h);
  Reversals reversals(h);
  return crossings.find(u, level, reversals);
}

// At angles so close that two crossings within one step are next to impossible.
int sign_changes(const Harmonics& h, const Eigen::VectorXd& u, double level) {
  constexpr int steps = 20000;
  int changes = 0;
  bool above = series_values(h, u, 0).x > level;
  for (int k = 1; k <= steps; ++k) {
    const bool next = series_values(h, u, two_pi * k / steps).x > level;
    if (next != above) ++changes;
    above = next;
  }
  return changes;
}

}  // namespace

TEST_CASE("a cosine passes a level where its arc cosine says, up to where it just touches") {
  for (const int order : {1, 2, 9, 40})
    for (const double level : {0.0, 0.3, -0.7, 0.99, 1 - 1e-4, 1 - 1e-8, 1 - 1e-12, 1.0, 1 + 1e-12, 1 + 1e-4,
                               -1 + 1e-12, -1 - 1e-12, -3.0}) {
      const Harmonics h{order, false};
      Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
      u[0] = 0.2;
      u[h.cosine_index(1)] = std::cos(0.6);
      u[h.sine_index(1)] = std::sin(0.6);
      const auto found = crossings_of(h, u, 0.2 + level);
      CAPTURE(order, level, found.size());
      if (std::abs(level) == 1) continue;  // decided by rounding
      REQUIRE(found.size() == (std::abs(level) < 1 ? 2u : 0u));
      for (const Crossing& at : found) {
        const double apart = std::acos(level), expected = at.rises ? 0.6 - apart : 0.6 + apart;
        const double rounding = 1e-15 / std::max(std::sin(apart), 1e-8);
        CHECK(std::abs(std::remainder(at.theta - expected, two_pi)) < 4e-15 + 4 * rounding);
      }
    }
}

TEST_CASE("crossings of random motions are roots, rise and fall in turn, and none is left out") {
  std::mt19937 bits(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const int order : {1, 2, 3, 7, 15, 31})
    for (int k = 0; k < 40; ++k) {
      const Harmonics h{order, false};
      Eigen::VectorXd u(h.size());
      u[0] = number(bits);
      for (int n = 1; n <= order; ++n) {
        const double size = k % 2 == 0 ? 1.0 / n : 1.0 / (n * n);
        u[h.cosine_index(n)] = size * number(bits);
        u[h.sine_index(n)] = size * number(bits);
      }
      const double level = number(bits), size = series_bound(h, u, 0) + 2;
      const auto found = crossings_of(h, u, level);
      CAPTURE(order, k);
      CHECK(static_cast<int>(found.size()) == sign_changes(h, u, level));
      for (std::size_t i = 0; i < found.size(); ++i) {
        const Values at = series_values(h, u, found[i].theta);
        CHECK(std::abs(at.x - level) < 1e-14 * size);
        CHECK((at.d1 > 0) == found[i].rises);
        if (i == 0) continue;
        CHECK(found[i].rises != found[i - 1].rises);
        CHECK(found[i].theta > found[i - 1].theta);
      }
    }
}

TEST_CASE("two touches of a level at once are decided by the extremes on either side") {
  // cos 2 theta has two equal maxima; a little cos theta raises one of them and lowers the other.
  const Harmonics h{5, false};
  for (const double tilt : {1e-3, 1e-6, 1e-9, 1e-12}) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    u[h.cosine_index(2)] = 1;
    u[h.cosine_index(1)] = tilt;
    CHECK(crossings_of(h, u, 1).size() == 2);
    CHECK(crossings_of(h, u, 1 + 2 * tilt).empty());
    CHECK(crossings_of(h, u, 1 - 2 * tilt).size() == 4);
  }
}

TEST_CASE("a motion at rest, or one that is not finite, passes no level") {
  const Harmonics h{5, false};
  Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
  u[0] = 1;
  Crossings crossings(h);
  Reversals reversals(h);
  CHECK(crossings.find(u, 1, reversals).empty());
  CHECK_FALSE(crossings.is_above());
  CHECK(crossings.find(u, 0.5, reversals).empty());
  CHECK(crossings.is_above());
  u[1] = std::nan("");
  CHECK(crossings.find(u, 1, reversals).empty());
  u[1] = 0.1;
  CHECK(crossings.find(u, std::numeric_limits<double>::infinity(), reversals).empty());
}

TEST_CASE(
    "a contact reports the largest and smallest load of a motion with many reversals, open and closed") {
  const Harmonics h{9, false};
  Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
  u[h.cosine_index(1)] = 1;
  u[h.cosine_index(9)] = 0.5;
  NormalContact contact(h);
  FrictionState state;
  for (const double N_0 : {0.5, 5.0}) {
    contact.move_to(u, 2, N_0);
    contact.tell(state);
    CHECK(std::abs(state.load_max - (N_0 + 3)) < 1e-14);  // at 0, and at pi
    CHECK(std::abs(state.load_min - std::max(N_0 - 3, 0.0)) < 1e-14);
    CHECK(contact.opens() == (N_0 < 3));
    CHECK(contact.closed().size() ==
          (N_0 < 3 ? static_cast<std::size_t>(sign_changes(h, u, -N_0 / 2) / 2) : 1));
  }
}
