#include "catch.hpp"

#include "lib/laws/contact/contacts.hpp"
#include "lib/laws/every_law.hpp"
#include "lib/laws/memoryless/piecewise_linear_laws.hpp"

#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace arcslip;
using contacts::evaluate, contacts::Force;
using continuation::Vector;
using Eigen::MatrixXd;
using std::numbers::pi;

TEST_CASE("under a constant load a contact is a Jenkins element and a linear spring") {
  const elements::Harmonics h{9, false};
  for (unsigned seed = 1; seed < 30; ++seed) {
    CAPTURE(seed);
    for (const double size : {0.2, 1.0, 5.0}) {
      Vector u = contacts::random_line(h, size, 0, seed);
      const Vector motion = u.head(h.size());
      const Force jenkins = evaluate(elements::jenkins(), h, motion, {2, 0.5, 3});
      for (const double stiffness : {0.0, 1.5}) {
        const Force contact = evaluate(elements::contact_2d(), h, u, {2, stiffness, 0.5, 3});
        const Eigen::Index c = h.size();
        CHECK((contact.F.head(c) - jenkins.F).norm() < 1e-12 * (1 + jenkins.F.norm()));
        CHECK((contact.J.topLeftCorner(c, c) - jenkins.J).norm() < 1e-12 * jenkins.J.norm());
        CHECK((contact.by_field.col(0).head(c) - jenkins.by_field.col(0)).norm() < 1e-12 * (1 + size));
        CHECK((contact.by_field.col(2).head(c) - jenkins.by_field.col(1)).norm() < 1e-12 * (1 + size));
        CHECK((contact.by_field.col(3).head(c) - jenkins.by_field.col(2)).norm() < 1e-12 * (1 + size));
        CHECK(contact.F.tail(c).norm() < 1e-14);
        CHECK((contact.J.bottomRightCorner(c, c) - stiffness * MatrixXd::Identity(c, c)).norm() == 0);
        CHECK(std::abs(contact.friction.stick_share - jenkins.friction.stick_share) < 1e-12);
      }
    }
  }
}

TEST_CASE(
    "the force of a contact that sticks and never opens loses no digits to its preload or to the mean") {
  const elements::Harmonics h{7, false};
  const Eigen::Index c = h.size();
  for (unsigned seed = 1; seed < 30; ++seed) {
    const Vector u = contacts::random_line(h, 1, 1, seed);
    Vector away = u;
    away[0] = 1e6;
    const Force light = evaluate(elements::contact_2d(), h, u, {2, 3, 0.5, 1e3});
    const double digits = 1e-13 * light.F.norm();
    REQUIRE(light.friction.stick_share == 1);
    for (const double load : {1e3, 1e6, 1e10, 1e14}) {
      CAPTURE(seed, load);
      const Force heavy = evaluate(elements::contact_2d(), h, u, {2, 3, 0.5, load});
      CHECK((heavy.F - light.F).cwiseAbs().maxCoeff() < digits);
      const Force far = evaluate(elements::contact_2d(), h, away, {2, 3, 0.5, load});
      CHECK((far.F - light.F).head(c).cwiseAbs().maxCoeff() < digits);
    }
  }
}

TEST_CASE("without friction a contact is a gap spring along its normal, for any load") {
  const elements::Harmonics h{7, false};
  const Eigen::Index c = h.size();
  for (unsigned seed = 1; seed < 30; ++seed) {
    const Vector u = contacts::random_line(h, 1, 1, seed);
    const Force gap = evaluate(*piecewise_linear_laws::gap(false), h, u.tail(c), {3, 0.4});
    const Force contact = evaluate(elements::contact_2d(), h, u, {2, 3, 0, -1.2});
    CHECK(contact.F.head(c).norm() == 0);
    CHECK((contact.F.tail(c) - gap.F).norm() < 1e-12);
    CHECK((contact.J.bottomRightCorner(c, c) - gap.J).norm() < 1e-12);
    CHECK(contact.J.topRows(c).norm() == 0);
    // Its derivative by the friction coefficient is one-sided.
    // Stick lasts for a time that goes with its root.
    for (const double slight : {1e-5, 1e-7, 1e-9}) {
      const Force at = evaluate(elements::contact_2d(), h, u, {2, 3, slight, -1.2});
      CHECK((at.F.head(c) / slight - contact.by_field.col(2).head(c)).norm() < 20 * std::sqrt(slight));
    }
  }
}

TEST_CASE("the Jacobian of a contact is exact in every sequence of stick, slip and separation") {
  const std::vector<double> loads = {-2, -0.3, 0, 0.3, 1, 3, 10};
  std::vector<std::uint64_t> pieces;
  for (const double load : loads)
    for (const double tangential : {0.05, 0.3, 1.0, 5.0})
      for (unsigned seed = 1; seed < 12; ++seed) {
        const std::vector<double> fields = {2, 1.5, 0.6, load};
        const elements::Harmonics h{4, false};
        const Vector u = contacts::random_line(h, tangential, 1, seed);
        const Force at = evaluate(elements::contact_2d(), h, u, fields);
        CAPTURE(load, tangential, seed);
        pieces.push_back(at.piece);
        const auto force = [&](const Vector& there) {
          return evaluate(elements::contact_2d(), h, there, fields).F;
        };
        const MatrixXd D = every_law::differences(force, u, 1e-6);
        CHECK((D - at.J).cwiseAbs().maxCoeff() < 2e-7);
        for (std::size_t k = 0; k < fields.size(); ++k) {
          const auto along = [&](const Vector& value) {
            std::vector<double> other = fields;
            other[k] = value[0];
            return evaluate(elements::contact_2d(), h, u, other).F;
          };
          if (load == 0 && k == 3) continue;  // the preload, and with it what balances it, begins there
          const MatrixXd by_field = every_law::differences(along, Vector::Constant(1, fields[k]), 1e-6);
          CAPTURE(k);
          CHECK((by_field - at.by_field.col(static_cast<Eigen::Index>(k))).cwiseAbs().maxCoeff() < 2e-7);
        }
      }
  std::sort(pieces.begin(), pieces.end());
  CHECK(std::unique(pieces.begin(), pieces.end()) - pieces.begin() > 60);
}

TEST_CASE("a contact that is open for 1 or 99 % of the period has that share, and the impulse of its load") {
  // N = max(k (cos theta - cos alpha), 0): the mean is k (sin alpha - alpha cos alpha)/pi.
  const elements::Harmonics h{3, false};
  for (const double share : {1e-6, 0.01, 0.5, 0.99, 1 - 1e-6}) {
    Vector u = Vector::Zero(2 * h.size());
    u[h.size() + h.cosine_index(1)] = 1;
    u[h.sine_index(1)] = 0.3;
    const double alpha = pi * (1 - share);
    const Force at = evaluate(elements::contact_2d(), h, u, {2, 5, 0.4, -5 * std::cos(alpha)});
    CAPTURE(share);
    CHECK(std::abs(at.friction.open_share - share) < 1e-9);
    const double preload = std::max(-5 * std::cos(alpha), 0.0);
    const double mean = 5 * (std::sin(alpha) - alpha * std::cos(alpha)) / pi - preload;
    CHECK(std::abs(at.F[h.size()] - mean) < 1e-13);
    CHECK(std::abs(at.friction.load_max - 5 * (1 - std::cos(alpha))) < 1e-14);
    CHECK(at.friction.load_min == 0);
  }
}

TEST_CASE("a contact stays finite and dissipates at every extreme of stiffness, load and motion") {
  const elements::Harmonics h{5, false};
  for (const double tangential : {1e-6, 1.0, 1e6})
    for (const double normal : {0.0, 1e-6, 1.0, 1e6})
      for (const double friction : {0.0, 1e-9, 0.5, 1e3})
        for (const double load : {-1e6, -1.0, 0.0, 1e-9, 1.0, 1e9})
          for (const double size : {0.0, 1e-12, 1.0, 1e6}) {
            CAPTURE(tangential, normal, friction, load, size);
            for (const double normal_size : {0.0, size}) {
              const Vector u = contacts::random_line(h, size, normal_size, 5);
              const Force at = evaluate(elements::contact_2d(), h, u, {tangential, normal, friction, load});
              REQUIRE(at.F.allFinite());
              REQUIRE(at.J.allFinite());
              REQUIRE(at.by_field.allFinite());
              const double stick = at.friction.stick_share, open = at.friction.open_share;
              REQUIRE((stick >= 0 && open >= 0 && stick + open <= 1 + 1e-12));
              double work = 0;  // tangential, over pi
              for (int n = 1; n <= h.order; ++n)
                work += n * (at.F[h.cosine_index(n)] * u[h.sine_index(n)] -
                             at.F[h.sine_index(n)] * u[h.cosine_index(n)]);
              const double rounding = 1e-12 * size * at.F.head(h.size()).cwiseAbs().sum();
              CHECK(work >= -rounding - 1e-13 * tangential * size * size);
            }
          }
}

TEST_CASE("a contact along one line of motion, just touched, has few phases and a finite force") {
  // Both bounds turn where the load is extreme, and meet the slider where the contact opens.
  const elements::Harmonics h{5, false};
  elements::Reversals reversals(h);
  for (unsigned seed = 1; seed < 40; ++seed)
    for (const double slope : {1.0, -0.5, 0.5})
      for (const double friction : {0.3, 2.0, 1 / 0.5, 5.0}) {
        Vector u = contacts::random_line(h, 1, 0, seed);
        u.tail(h.size()) = slope * u.head(h.size());
        const auto turns = reversals.find(u.tail(h.size()));
        for (const auto& turn : turns)
          for (const double nearby : {0.0, 1e-16, -1e-16, 1e-13, -1e-13, 1e-9, -1e-9}) {
            const std::vector<double> fields = {1, 1, friction, -turn.x * (1 + nearby)};
            const Force at = evaluate(elements::contact_2d(), h, u, fields);
            CAPTURE(seed, slope, friction, turn.x, nearby);
            REQUIRE(at.F.allFinite());
            REQUIRE(at.J.allFinite());
            REQUIRE(at.friction.slip_onsets.size() <= 2 * turns.size());
          }
      }
}

TEST_CASE("where a preload becomes a gap a contact has another piece, with the derivative of each side") {
  const elements::Harmonics h{4, false};
  const Vector u = contacts::random_line(h, 1, 1, 3);
  const auto at = [&](double load) { return evaluate(elements::contact_2d(), h, u, {2, 1.5, 0.6, load}); };
  CHECK(at(1e-9).piece != at(-1e-9).piece);
  for (const double side : {1e-3, -1e-3}) {
    const Force here = at(side);
    CHECK(((at(side + 1e-6).F - at(side - 1e-6).F) / 2e-6 - here.by_field.col(3)).norm() < 1e-6);
  }
}
