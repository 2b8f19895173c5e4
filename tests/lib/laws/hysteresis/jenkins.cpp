#include "catch.hpp"

#include "lib/laws/every_law.hpp"

#include <arcslip/fourier/reversals.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/sampled_automata.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

using namespace arcslip::elements;
using std::numbers::pi;

namespace {

using FieldValues = std::array<double, 3>;  // stiffness, friction coefficient, normal load

}  // namespace

TEST_CASE("with one harmonic the force has the describing function of the Jenkins element") {
  // Full slip from the turn at A: theta* = arccos(1 - 2 x_s/A); F_c = (k_d A/pi)(theta* - sin theta* cos
  // theta*), F_s = -(4 p/pi)(1 - x_s/A) against x = A cos theta.
  const auto element = make_jenkins({1, true});
  const double kd = 3500, mu = 0.5;
  for (double A : {1.0001, 1.5, 2.0, 5.0, 1e3, 1e6})
    for (double Fn : {1e-6, 3.0, 1e6}) {
      const double p = mu * Fn, x_s = p / kd, a = A * x_s;
      element->move_to(Eigen::VectorXd{{a, 0.0}}, FieldValues{kd, mu, Fn}, false);
      const double onset = 2 * std::asin(std::sqrt(1 / A));
      const double digits = 1e-11 + 1e-15 * A;  // k_d a is A times the force
      CAPTURE(A, Fn);
      CHECK(element->force()[0] ==
            Approx(kd * a / pi * (onset - std::sin(onset) * std::cos(onset))).epsilon(digits));
      CHECK(element->force()[1] == Approx(-4 * p / pi * (1 - 1 / A)).epsilon(digits));
      FrictionState state;
      REQUIRE(element->friction(state));
      CHECK(state.stick_share == Approx(onset / pi).epsilon(digits));
      REQUIRE(state.slip_onsets.size() == 2);
      CHECK(state.slip_onsets[0] == Approx(onset).epsilon(digits));
      CHECK(std::abs(std::sin(state.slip_ends[0])) < 1e-14);
    }
}

TEST_CASE(
    "the Jacobian is that of central differences, over decades of amplitude and load, for all kinds of "
    "motion") {
  for (bool odd : {true, false})
    for (int order : {1, 2, 3, 7, 15})
      for (double amplitude : {1e-6, 1e-3, 1.0, 1e3})
        for (double load : {0.1, 0.5, 1.3, 10.0, 1e3})
          for (unsigned seed : {1u, 2u, 3u}) {
            const Harmonics h{order, odd};
            const auto element = make_jenkins(h);
            const Eigen::VectorXd u = every_law::falling_motion(h, amplitude, seed);
            const FieldValues fields{2.0, 0.5, amplitude * load};
            element->move_to(u, fields, true);
            const Eigen::MatrixXd J = element->jacobian();
            const std::uint64_t piece = element->piece();
            double worst = 0;
            bool across_a_kink = false;
            for (int i = 0; i < h.size(); ++i) {
              const double step = 1e-5 * amplitude;
              Eigen::VectorXd v = u;
              v[i] += step;
              element->move_to(v, fields, false);
              const Eigen::VectorXd plus = element->force();
              across_a_kink = across_a_kink || element->piece() != piece;
              v[i] -= 2 * step;
              element->move_to(v, fields, false);
              across_a_kink = across_a_kink || element->piece() != piece;
              worst =
                  std::max(worst, (J.col(i) - (plus - element->force()) / (2 * step)).cwiseAbs().maxCoeff());
            }
            CAPTURE(odd, order, amplitude, load, seed);
            if (!across_a_kink)
              CHECK(worst < 1e-6);  // of k_d = 2; the differences' own error at order 15 is 2.5e-7
          }
}

TEST_CASE("the derivative in every field is that of central differences") {
  for (bool odd : {true, false})
    for (const bool sampled : {false, true})
      for (double load : {0.3, 1.0, 2.0, 1e3}) {
        const Harmonics h{7, odd};
        const auto element = sampled ? sampled_automata(jenkins(), h, 256) : make_jenkins(h);
        const Eigen::VectorXd u = every_law::falling_motion(h, 1, 5);
        const FieldValues fields{2.0, 0.5, load};
        for (int k = 0; k < 3; ++k) {
          const auto at = static_cast<std::size_t>(k);
          Eigen::VectorXd dF(h.size());
          element->move_to(u, fields, true);
          element->field_derivative(k, dF);
          const double step = 1e-6 * fields[at];
          FieldValues changed = fields;
          changed[at] += step;
          element->move_to(u, changed, false);
          const Eigen::VectorXd plus = element->force();
          changed[at] -= 2 * step;
          element->move_to(u, changed, false);
          CAPTURE(odd, sampled, load, k);
          CHECK((dF - (plus - element->force()) / (2 * step)).norm() < 1e-7 * (1 + dF.norm()));
        }
      }
}

TEST_CASE("sampling converges to the exact force as samples^-2") {
  for (bool odd : {true, false}) {
    const Harmonics h{9, odd};
    const Eigen::VectorXd u = every_law::falling_motion(h, 1, 11);
    const FieldValues fields{2.0, 0.5, 0.8};
    const auto exact = make_jenkins(h);
    exact->move_to(u, fields, true);
    double last = 0;
    for (int samples : {1000, 10000, 100000}) {
      const auto sampled = sampled_automata(jenkins(), h, samples);
      sampled->move_to(u, fields, true);
      last = (sampled->force() - exact->force()).norm();
      CHECK(last < 40.0 / samples / samples);
    }
    CHECK(last > 0);
  }
}

TEST_CASE("sampled friction reports a slip phase up to each extreme, of any length") {
  // From all slip to slip at one sample: of 1.7 cos(theta - 0.3) + 0.4 cos 2 theta (one extreme of either
  // kind) and of its odd part.
  const double apart = 2 * pi / 128;
  for (const bool odd : {true, false}) {
    const Harmonics h{3, odd};
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    u[h.cosine_index(1)] = 1.7 * std::cos(0.3);
    u[h.sine_index(1)] = 1.7 * std::sin(0.3);
    if (!odd) u[h.cosine_index(2)] = 0.4;
    Reversals reversals(h);
    const auto extremes = reversals.find(u);
    const auto element = sampled_automata(jenkins(), h, 128);
    for (const double load : {1e-9, 1e-3, 0.1, 0.9}) {
      CAPTURE(odd, load);
      element->move_to(u, FieldValues{1.0, 1.0, load}, false);
      FrictionState state;
      REQUIRE(element->friction(state));
      REQUIRE(state.slip_onsets.size() == 2);
      REQUIRE(state.slip_ends.size() == 2);
      for (const double end : state.slip_ends) {
        double nearest = 1e300;
        for (const auto& r : extremes)
          for (const double turn : {-2 * pi, -pi, 0.0, pi, 2 * pi})
            if (odd || std::abs(turn) != pi) nearest = std::min(nearest, std::abs(end - r.theta - turn));
        CHECK(nearest < apart);
      }
      if (load < 1e-3) {
        CHECK(state.stick_share == 0);
        // The next sample slips the other way.
        for (const double onset : state.slip_onsets) {
          double after = 1e300;
          for (const double end : state.slip_ends)
            for (const double turn : {0.0, 2 * pi})
              after = std::min(after, std::abs(onset + turn - end - apart));
          CHECK(after < 1e-12);
        }
      }
    }
  }
}

TEST_CASE("the sampled Jacobian is exact for the sampled force") {
  for (bool odd : {true, false})
    for (double load : {0.5, 1.0, 2.5, 100.0}) {
      const Harmonics h{5, odd};
      const auto element = sampled_automata(jenkins(), h, 100);
      const Eigen::VectorXd u = every_law::falling_motion(h, 1, 3);
      const FieldValues fields{2.0, 0.5, load};
      element->move_to(u, fields, true);
      const Eigen::MatrixXd J = element->jacobian();
      for (int i = 0; i < h.size(); ++i) {
        Eigen::VectorXd v = u;
        v[i] += 1e-6;
        element->move_to(v, fields, false);
        const Eigen::VectorXd plus = element->force();
        v[i] -= 2e-6;
        element->move_to(v, fields, false);
        CHECK((J.col(i) - (plus - element->force()) / 2e-6).norm() < 1e-8);
      }
    }
}

TEST_CASE("the sampled force is one straight line within its piece") {
  long within = 0;
  for (const bool odd : {true, false})
    for (const double load : {0.0, 0.3, 1.0, 2.5, 100.0})
      for (unsigned seed = 1; seed <= 40; ++seed) {
        const Harmonics h{5, odd};
        const auto element = sampled_automata(jenkins(), h, 64);
        const Eigen::VectorXd u = every_law::falling_motion(h, 1, seed),
                              v = u + every_law::falling_motion(h, 0.03, seed + 100);
        const FieldValues fields{2.0, 0.5, load};
        element->move_to(u, fields, true);
        const std::uint64_t piece = element->piece();
        const Eigen::VectorXd expected = element->force() + element->jacobian() * (v - u);
        element->move_to(v, fields, false);
        if (element->piece() != piece) continue;
        ++within;
        CAPTURE(odd, load, seed);
        CHECK((element->force() - expected).norm() < 1e-13);
      }
  CHECK(within > 40);
}

TEST_CASE("force and energy are continuous where slip is born, between stick and slip") {
  for (bool odd : {true, false}) {
    const Harmonics h{5, odd};
    const auto element = make_jenkins(h);
    const Eigen::VectorXd u = every_law::falling_motion(h, 1, 7);
    // Bisect the load for the limit of full stick, and compare both sides.
    double slips = 1e-3, sticks = 1e3;
    FrictionState state;
    for (int k = 0; k < 200; ++k) {
      const double middle = 0.5 * (slips + sticks);
      element->move_to(u, FieldValues{2.0, 0.5, middle}, false);
      element->friction(state);
      (state.stick_share == 1 ? sticks : slips) = middle;
    }
    element->move_to(u, FieldValues{2.0, 0.5, slips}, false);
    const Eigen::VectorXd below = element->force();
    element->move_to(u, FieldValues{2.0, 0.5, sticks}, false);
    CHECK((element->force() - below).norm() < 1e-12);
  }
}

TEST_CASE("a small loop within the large one keeps the anchor of the large one") {
  // cos + 0.5 cos 3 has a small reversal pair in each half period that does not slip at this limit.
  const Harmonics h{3, true};
  Eigen::VectorXd u = Eigen::VectorXd::Zero(4);
  u[0] = 1;
  u[1] = 0.5;
  const auto exact = make_jenkins(h);
  const auto sampled = sampled_automata(jenkins(), h, 400000);
  for (double load : {0.2, 0.6, 1.0, 1.4, 2.0}) {
    exact->move_to(u, FieldValues{1.0, 1.0, load}, true);
    sampled->move_to(u, FieldValues{1.0, 1.0, load}, true);
    CAPTURE(load);
    CHECK((exact->force() - sampled->force()).norm() < 1e-9);
    CHECK((exact->jacobian() - sampled->jacobian()).norm() < 1e-4);
  }
}

TEST_CASE("without load or without motion the force is what it must be") {
  for (bool odd : {true, false}) {
    const Harmonics h{5, odd};
    for (const bool sampled : {false, true}) {
      const auto element = sampled ? sampled_automata(jenkins(), h, 128) : make_jenkins(h);
      const Eigen::VectorXd u = every_law::falling_motion(h, 1, 2);
      element->move_to(u, FieldValues{2.0, 0.5, 0.0}, true);
      CHECK(element->force().norm() < 1e-14);
      CHECK(element->jacobian().norm() < 1e-12);
      element->move_to(0 * u, FieldValues{2.0, 0.5, 0.0}, true);
      CHECK(element->force().norm() == 0);
      CHECK(element->jacobian().norm() == 0);
      element->move_to(0 * u, FieldValues{2.0, 0.5, 1.0}, true);
      CHECK(element->force().norm() == 0);
      CHECK(element->jacobian()
                .bottomRightCorner(5 - 2 * odd, 5 - 2 * odd)
                .isApprox(2.0 * Eigen::MatrixXd::Identity(5 - 2 * odd, 5 - 2 * odd)));
    }
  }
}

TEST_CASE("full stick is a centred linear spring, mean included") {
  const Harmonics h{4, false};
  const auto element = make_jenkins(h);
  Eigen::VectorXd u = every_law::falling_motion(h, 1, 9);
  element->move_to(u, FieldValues{2.0, 0.5, 1e3}, true);
  Eigen::VectorXd shifted = u;
  shifted[0] += 0.7;
  const Eigen::VectorXd F = element->force();
  CHECK((F.tail(8) - 2 * u.tail(8)).norm() < 1e-14);
  element->move_to(shifted, FieldValues{2.0, 0.5, 1e3}, true);
  CHECK((element->force() - F).norm() < 1e-13);  // the slider has no memory of where it stands
}

TEST_CASE(
    "an element that sticks stays in its piece, whichever of equal extremes rounding makes the highest") {
  // A motion of half the period of the force has each of its extremes twice.
  const Harmonics h{7, false};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const auto element = trial % 2 == 0 ? make_jenkins(h) : sampled_automata(jenkins(), h, 128);
    Eigen::VectorXd u = every_law::falling_motion(h, 1, static_cast<unsigned>(trial));
    for (int n = 1; n <= h.order; n += 2) u[h.cosine_index(n)] = u[h.sine_index(n)] = 0;
    const FieldValues fields{1, 0.5, 100};
    element->move_to(u, fields, false);
    const auto piece = element->piece();
    for (int k = 0; k < 50; ++k) {
      Eigen::VectorXd rounded = u;
      for (double& x : rounded) x += 1e-15 * number(random);
      element->move_to(rounded, fields, true);
      REQUIRE(element->piece() == piece);
    }
  }
}

TEST_CASE("an element without load has one piece, whatever its motion") {
  const Harmonics h{5, false};
  const FieldValues fields{2, 0.5, 0};
  for (const bool sampled : {false, true}) {
    const auto element = sampled ? sampled_automata(jenkins(), h, 64) : make_jenkins(h);
    element->move_to(every_law::falling_motion(h, 1, 1), fields, false);
    const auto piece = element->piece();
    for (unsigned seed = 2; seed < 30; ++seed) {
      element->move_to(every_law::falling_motion(h, 1, seed), fields, false);
      CHECK(element->piece() == piece);
      CHECK(element->force().norm() < 1e-14);
    }
  }
}
