#include "catch.hpp"

#include <arcslip/fourier/reversals.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip::elements;

TEST_CASE("cos theta + a cos 3 theta has the reversals that calculus gives") {
  // x' = -sin theta (1 + 9 a - 12 a sin^2 theta): besides 0 where cos^2 theta = (3 a - 1)/(12 a), if that is
  // in (0, 1).
  const Harmonics h{3, true};
  for (double a : {0.2, 0.34, 0.5, 2.0, -0.1, -0.12, -1.0}) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    u[0] = 1;
    u[1] = a;
    const double cos2 = (3 * a - 1) / (12 * a);
    const bool more = cos2 > 0 && cos2 < 1;
    Reversals reversals(h);
    const auto& found = reversals.find(u);
    CAPTURE(a);
    CHECK(found.size() == (more ? 3u : 1u));
    for (const auto& r : found) {
      const double c = std::cos(r.theta), s = std::sin(r.theta);
      CHECK((std::abs(s) < 1e-14 || std::abs(c * c - cos2) < 1e-13));
      CHECK(std::abs(r.x - (c + a * std::cos(3 * r.theta))) < 1e-15);
    }
  }
}

TEST_CASE("a pair of reversals is found on either side of its birth, 1e-4 rad apart") {
  const Harmonics h{3, true};
  for (double offset :
       {1e-3, 1e-5, 1e-7, 1e-9, -1e-9, -1e-7, -1e-5, -1e-3}) {  // cos + a cos 3 at a = -1/9: a flat top
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    u[0] = std::cos(0.7);
    u[h.sine_index(1)] = std::sin(0.7);
    const double a = -1.0 / 9 - offset;
    u[1] = a * std::cos(2.1);
    u[h.sine_index(3)] = a * std::sin(2.1);
    Reversals reversals(h);
    CHECK(reversals.find(u).size() == (offset > 0 ? 3u : 1u));
  }
}

TEST_CASE("a motion at rest has no reversals") {
  Reversals reversals({5, false});
  Eigen::VectorXd u = Eigen::VectorXd::Zero(11);
  CHECK(reversals.find(u).empty());
  u[0] = 3;
  CHECK(reversals.find(u).empty());
}

TEST_CASE("a pure cosine, whose reversals lie at 0 and pi, has both") {
  for (bool odd : {true, false}) {
    const Harmonics h{9, odd};
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    u[h.cosine_index(1)] = 1;
    Reversals reversals(h);
    CHECK(reversals.find(u).size() == (odd ? 1u : 2u));
  }
}
