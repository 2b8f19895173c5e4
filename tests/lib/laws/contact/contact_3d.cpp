#include "catch.hpp"

#include "lib/laws/contact/contacts.hpp"
#include "lib/laws/every_law.hpp"

#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/laws/contact/slip_collocation.hpp>
#include <arcslip/laws/contact/stick_feasibility.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace arcslip;
using contacts::evaluate, contacts::Force;
using continuation::Vector;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

// A slider that is projected onto the disc at the end of each step: a reference that shares nothing with the
// element.
Vector marched_force(const elements::Harmonics& h, const Vector& u, const std::vector<double>& f, int steps,
                     int periods) {
  const Eigen::Index c = h.size();
  const double k_t = f[0], k_n = f[1], mu = f[2], N_0 = f[3];
  const auto normal_load = [&](double x_n) { return std::max(N_0 + k_n * x_n, 0.0); };
  std::vector<Vector2d> x;
  std::vector<double> N;
  for (int k = 0; k < steps; ++k) {
    const double theta = 2 * pi * (k + 1) / steps;
    x.emplace_back(elements::series_values(h, u.head(c), theta).x,
                   elements::series_values(h, u.segment(c, c), theta).x);
    N.push_back(normal_load(elements::series_values(h, u.tail(c), theta).x));
  }
  Vector F = Vector::Zero(3 * c), phi(c);
  Vector2d w = x.back();
  for (int period = 0; period < periods; ++period)
    for (int k = 0; k < steps; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const double radius = mu * N[at] / k_t;
      const Vector2d y = x[at] - w;
      if (y.norm() > radius) w = radius > 0 ? Vector2d(x[at] - radius * y.normalized()) : x[at];
      if (period + 1 < periods) continue;
      elements::series_basis(h, 2 * pi * (k + 1) / steps, phi);
      const Vector2d T = k_t * (x[at] - w);
      for (int i = 0; i < 2; ++i) F.segment(i * c, c) += 2.0 / steps * T[i] * phi;
      F.tail(c) += 2.0 / steps * (N[at] - std::max(N_0, 0.0)) * phi;
    }
  for (int i = 0; i < 3; ++i) F[i * c] *= 0.5;
  return F;
}

}  // namespace

TEST_CASE("on a circle under a constant load the force of slip has a closed form") {
  // The slider goes round on a smaller circle, x - w is tangential to it, and has the length h: T leads by
  // the angle whose cosine is h/a.
  const elements::Harmonics h{5, false};
  const Eigen::Index c = h.size();
  for (const double a : {1.01, 1.5, 4.0, 100.0, 1e11, 1e13, 1e100})
    for (const double way : {1.0, -1.0}) {
      CAPTURE(a, way);
      const double radius = 0.5 * 3 / 2.0;
      Vector u = Vector::Zero(3 * c);
      u[0] = 0.3;
      u[c] = -0.7;
      u[1] = a * radius;
      u[c + h.sine_index(1)] = way * a * radius;
      const Force at = evaluate(elements::contact_3d(), h, u, {2, 0, 0.5, 3});
      const double along = 1.5 / a, across = 1.5 * std::sqrt(1 - 1 / (a * a));
      CHECK(std::abs(at.F[1] - along) < 2e-12);
      CHECK(std::abs(at.F[h.sine_index(1)] + across) < 2e-12);
      CHECK(std::abs(at.F[c + 1] - way * across) < 2e-12);
      CHECK(std::abs(at.F[c + h.sine_index(1)] - way * along) < 2e-12);
      CHECK(at.friction.stick_share == 0);
    }
}

TEST_CASE("a slider sticks throughout iff one place is within every disc, and rests at the centre of such") {
  const elements::Harmonics h{3, false};
  const Eigen::Index c = h.size();
  for (const double a : {0.2, 0.999, 1 - 1e-12}) {
    Vector u = Vector::Zero(3 * c);
    u[0] = 0.3;
    u[c] = -0.7;
    u[1] = 0.75 * a;
    u[c + h.sine_index(1)] = 0.75 * a;
    const Force at = evaluate(elements::contact_3d(), h, u, {2, 0, 0.5, 3});
    CHECK(at.friction.stick_share == 1);
    Vector expected = 2 * u;
    expected[0] = expected[c] = 0;
    expected.tail(c).setZero();
    CHECK((at.F - expected).norm() < 1e-12);
  }
  // Any motion: no place next to the centre has a smaller excess, over many instants.
  elements::StickCentre centre(h);
  elements::Disc disc(h);
  for (unsigned seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    const Vector u = contacts::random_plane(h, 1, 0.1 * (seed % 4), seed);
    disc.set(u.head(c), u.segment(c, c), u.tail(c));
    centre.find(disc);
    const auto excess = [&](const Vector2d& w) {
      double largest = -1e9;
      for (int k = 0; k < 4000; ++k) {
        const auto at = disc.at(2 * pi * k / 4000);
        largest = std::max(largest, (at.x - w).norm() - at.h);
      }
      return largest;
    };
    const double here = excess(centre.w());
    CHECK(std::abs(here - centre.r()) < 3e-6);
    for (int k = 0; k < 16; ++k)
      CHECK(excess(centre.w() + 1e-3 * Vector2d(std::cos(k * pi / 8), std::sin(k * pi / 8))) > here - 1e-6);
    MatrixXd dw(2, 3 * c);
    centre.derivative(dw);
    // Of a motion far smaller than its means, in proportion.
    const double small = 1e-12;
    Vector shrunk = small * u;
    for (const Eigen::Index mean : {Eigen::Index{0}, c, 2 * c}) shrunk[mean] = u[mean];
    elements::StickCentre nearby(h);
    disc.set(shrunk.head(c), shrunk.segment(c, c), shrunk.tail(c));
    nearby.find(disc);
    MatrixXd same(2, 3 * c);
    nearby.derivative(same);
    CHECK((same - dw).cwiseAbs().maxCoeff() < 1e-6);
    if (seed % 4 == 0) continue;
    const auto rest = [&](const Vector& at) {
      disc.set(at.head(c), at.segment(c, c), at.tail(c));
      centre.find(disc);
      return Vector(centre.w());
    };
    CHECK((every_law::differences(rest, u, 1e-6) - dw).cwiseAbs().maxCoeff() < 1e-7);
  }
}

TEST_CASE("a disc at many angles at once is that of the three series at each") {
  const elements::Harmonics h{4, false};
  const Eigen::Index c = h.size();
  const Vector u = contacts::random_plane(h, 1, 1, 5);
  elements::Disc disc(h);
  disc.set(u.head(c), u.segment(c, c), u.tail(c));
  const elements::DiscAngles angles(27);
  std::vector<elements::DiscInstant> instants(27, {-1, Vector2d::Zero(), 0});
  disc.at(angles, 4, instants);
  for (std::size_t k = 0; k < instants.size(); ++k) {
    CAPTURE(k);
    const auto& at = instants[k];
    if (k % 4 != 0) {
      CHECK(at.theta == -1);
      continue;
    }
    CHECK(std::abs(at.theta - 2 * pi * static_cast<double>(k) / 27) < 1e-15);
    CHECK(std::abs(at.x[0] - elements::series_values(h, u.head(c), at.theta).x) < 1e-14);
    CHECK(std::abs(at.x[1] - elements::series_values(h, u.segment(c, c), at.theta).x) < 1e-14);
    CHECK(std::abs(at.h - elements::series_values(h, u.tail(c), at.theta).x) < 1e-14);
  }
  elements::DiscNodes<3> nodes;
  const Eigen::Vector3d theta(0.3, 2, 5);
  disc.at<3>(theta.array().cos(), theta.array().sin(), nodes);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 2; ++i) {
      const elements::Values x = elements::series_values(h, u.segment(i * c, c), theta[j]);
      CHECK(std::abs(nodes.v[i][j] - x.d1) < 1e-13);
      CHECK(std::abs(nodes.a[i][j] - x.d2) < 1e-13);
    }
    const elements::Values radius = elements::series_values(h, u.tail(c), theta[j]);
    CHECK(std::abs(nodes.h[j] - radius.x) < 1e-14);
    CHECK(std::abs(nodes.dh[j] - radius.d1) < 1e-13);
    CHECK(std::abs(nodes.ddh[j] - radius.d2) < 1e-13);
  }
}

TEST_CASE(
    "a panel of slip that is too long is reported as not solved, and a short one is exact on a circle") {
  // x = (cos, sin): slip goes round with sin(theta + pi/2 - psi) = h.
  const elements::Harmonics h{1, false};
  Vector x_1 = Vector::Zero(3), x_2 = Vector::Zero(3), radius = Vector::Zero(3);
  x_1[1] = x_2[h.sine_index(1)] = 1;
  elements::Disc disc(h);
  const elements::SlipCollocation collocation;
  elements::SlipPanel panel;
  for (const double r : {0.9, 0.1, 1e-3, 1e-6}) {
    CAPTURE(r);
    radius[0] = r;
    disc.set(x_1, x_2, radius);
    const double psi = 0.5 * pi - std::asin(r), tolerance = 1e-8 * r;
    CHECK(collocation.solve(disc, 0, 0.4, psi, tolerance, panel) <= tolerance);
    CHECK(std::abs(panel.to() - psi - 0.4) < 1e-12);
    // Almost against the motion n turns round faster than a whole period resolves.
    if (r <= 0.1) CHECK(collocation.solve(disc, 0, 2 * pi, psi + 3.1, tolerance, panel) > tolerance);
  }
  // Newton's method finds nothing.
  radius[0] = 0.1;
  disc.set(x_1, x_2, radius);
  CHECK(std::isinf(collocation.solve(disc, 0, 6.28, 0.5 * pi - std::asin(0.1) + 3, 1e-9, panel)));
}

TEST_CASE("the coefficients of a contact in a plane are those of a march in small steps") {
  const elements::Harmonics h{3, false};
  for (unsigned seed = 1; seed <= 12; ++seed)
    for (const double load : {3.0, 0.6, -0.2})
      for (const double size : {0.3, 1.0, 4.0}) {
        CAPTURE(seed, load, size);
        const Vector u = contacts::random_plane(h, size, 1, seed);
        const std::vector<double> fields{2, 1.5, 0.5, load};
        const Force at = evaluate(elements::contact_3d(), h, u, fields);
        if (at.friction.stick_share > 0.9) continue;
        // The march is of first order in its steps.
        const Vector coarse = marched_force(h, u, fields, 8000, 8);
        const Vector fine = marched_force(h, u, fields, 16000, 8);
        CHECK((2 * fine - coarse - at.F).norm() < 5e-5 * (1 + at.F.norm()));
      }
}

TEST_CASE("along any line of the plane it is the contact in one direction") {
  const elements::Harmonics h{5, false};
  const Eigen::Index c = h.size();
  for (unsigned seed = 1; seed <= 30; ++seed)
    for (const double load : {3.0, 0.6, -0.2}) {
      CAPTURE(seed, load);
      const double turn = 0.2 * seed, cosine = std::cos(turn), sine = std::sin(turn);
      const Vector random = contacts::random_plane(h, 1.5, 1, seed);
      Vector u(3 * c), line(2 * c);
      u << cosine * random.head(c), sine * random.head(c), random.tail(c);
      line << random.head(c), random.tail(c);
      const std::vector<double> fields{2, 1.5, 0.5, load};
      const Force plane = evaluate(elements::contact_3d(), h, u, fields);
      const Force one = evaluate(elements::contact_2d(), h, line, fields);
      CHECK((plane.F.head(c) - cosine * one.F.head(c)).norm() < 1e-10);
      CHECK((plane.F.segment(c, c) - sine * one.F.head(c)).norm() < 1e-10);
      CHECK((plane.F.tail(c) - one.F.tail(c)).norm() < 1e-12);
      CHECK(std::abs(plane.friction.stick_share - one.friction.stick_share) < 1e-8);
      CHECK(std::abs(plane.friction.open_share - one.friction.open_share) < 1e-12);
      CHECK(plane.friction.load_max == one.friction.load_max);
      const MatrixXd along = cosine * plane.J.block(0, 0, c, c) + sine * plane.J.block(0, c, c, c);
      CHECK((along - cosine * one.J.topLeftCorner(c, c)).norm() <= 1e-6 * one.J.norm());
      for (int k = 0; k < 4; ++k)
        CHECK((plane.by_field.col(k).head(c) - cosine * one.by_field.col(k).head(c)).norm() < 1e-6);
    }
}

TEST_CASE("the Jacobian and the derivatives by the fields follow the history of slip in a plane") {
  std::set<std::uint64_t> pieces;
  for (const int order : {3, 6})
    for (unsigned seed = 1; seed <= (order == 3 ? 20u : 4u); ++seed)
      for (const double load : {3.0, 0.6, -0.2})
        for (const double size : {0.3, 1.0, 4.0}) {
          CAPTURE(order, seed, load, size);
          const elements::Harmonics h{order, false};
          const Vector u = contacts::random_plane(h, size, 1, seed);
          const std::vector<double> fields{2, 1.5, 0.5, load};
          const auto element = elements::contact_3d().element(h, {});
          const Force at = evaluate(elements::contact_3d(), h, u, fields);
          bool same = true;
          const auto force = [&](const Vector& v) {
            element->move_to(v, fields, false);
            same = same && element->piece() == at.piece;
            return Vector(element->force());
          };
          const MatrixXd J = every_law::differences(force, u, 1e-6);
          if (!same) continue;
          pieces.insert(at.piece);
          CHECK((J - at.J).cwiseAbs().maxCoeff() < 3e-6);
          const auto by_fields = [&](const Vector& values) {
            const std::vector<double> f(values.begin(), values.end());
            element->move_to(u, f, false);
            return Vector(element->force());
          };
          const Vector values = Eigen::Map<const Vector>(fields.data(), 4);
          CHECK((every_law::differences(by_fields, values, 1e-6) - at.by_field).cwiseAbs().maxCoeff() < 3e-6);
        }
  CHECK(pieces.size() > 15);
}

TEST_CASE("a contact in a plane follows from the motion and the fields, whatever was asked before") {
  const auto law = elements::contact_3d().law({});
  const elements::Harmonics h{2, false};
  const Vector first = contacts::random_plane(h, 1, 0.2, 3), second = contacts::random_plane(h, 1, 0.2, 4);
  const std::vector<double> fields{2, 1.5, 0.5, 1}, lighter{2, 1.5, 0.5, 0.6};
  const auto element = law->element(h, {});
  const auto check = [&](const Vector& u, const std::vector<double>& f) {
    const Force fresh = evaluate(*law, h, u, f);
    CHECK(element->force() == fresh.F);
    CHECK(element->piece() == fresh.piece);
    element->move_to(u, f, true);
    CHECK(element->force() == fresh.F);
    CHECK(element->jacobian() == fresh.J);
    Vector by_load(u.size());
    element->field_derivative(3, by_load);
    CHECK(by_load == fresh.by_field.col(3));
  };
  for (const Vector* u : {&first, &second, &first})
    for (const auto* f : {&fields, &lighter, &fields})
      for (int k = 0; k < 2; ++k) {
        element->move_to(*u, *f, false);
        check(*u, *f);
      }
}

TEST_CASE("a contact in a plane stays finite and dissipates at every extreme") {
  const elements::Harmonics h{4, false};
  const Eigen::Index c = h.size();
  for (const double k_t : {1e-6, 1.0, 1e6})
    for (const double k_n : {0.0, 1e-6, 1.0, 1e6})
      for (const double mu : {0.0, 1e-6, 0.3, 1e3})
        for (const double load : {-1e3, 0.0, 1e-3, 1e6})
          for (const double size : {0.0, 1e-6, 1.0, 1e3}) {
            CAPTURE(k_t, k_n, mu, load, size);
            const Vector u = contacts::random_plane(h, size, size, 3);
            const Force at = evaluate(elements::contact_3d(), h, u, {k_t, k_n, mu, load});
            CHECK(at.F.allFinite());
            CHECK(at.J.allFinite());
            CHECK(at.by_field.allFinite());
            double work = 0;  // over a period, over pi
            for (int i = 0; i < 3; ++i)
              for (int n = 1; n <= h.order; ++n) {
                const Eigen::Index a = i * c + h.cosine_index(n), b = i * c + h.sine_index(n);
                work += n * (at.F[a] * u[b] - at.F[b] * u[a]);
              }
            CHECK(work >= -1e-10 * (at.F.norm() * size + 1e-300));
          }
}

TEST_CASE("motions that are almost straight or far beyond the disc end, and overflow is reported") {
  const elements::Harmonics h{4, false};
  const Eigen::Index c = h.size();
  for (const double size : {1.0, 1e3, 1e6, 1e9, 1e12, 1e15, 1e80})
    for (const double across : {1e-15, 1e-9, 1e-6, 1e-3}) {
      CAPTURE(size, across);
      Vector u = contacts::random_plane(h, size, 1, 7);
      u.segment(c, c) = 0.4 * u.head(c) + across * u.segment(c, c);
      const Force at = evaluate(elements::contact_3d(), h, u, {1, 0, 0.3, 2});
      CHECK(at.F.allFinite());
      CHECK(at.J.allFinite());
      // A slider that slips almost always, with the friction mu N = 0.6 against the motion.
      if (size >= 1e6) CHECK(at.F.head(c).norm() < 2 * 0.6);
    }
  // Friction that is next to nothing, down to the smallest number.
  for (const double mu : {1e-20, 1e-290, 1e-310, 5e-324}) {
    CAPTURE(mu);
    const Force at = evaluate(elements::contact_3d(), h, contacts::random_plane(h, 1, 1, 7), {1, 1, mu, 2});
    CHECK(at.F.allFinite());
    CHECK(at.J.allFinite());
    CHECK(at.F.head(2 * c).norm() < 20 * mu);
  }
  const Force overflow =
      evaluate(elements::contact_3d(), h, contacts::random_plane(h, 1e300, 1e300, 7), {1, 1, 0.3, 2});
  CHECK_FALSE(overflow.F.allFinite());
}
