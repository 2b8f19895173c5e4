#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/every_law.hpp"
#include "lib/time/beside_exact.hpp"

#include <arcslip/elements/contact_2d.hpp>
#include <arcslip/elements/contact_3d.hpp>
#include <arcslip/elements/disc_phases.hpp>

#include <arcslip/elements/largest_value.hpp>
#include <arcslip/elements/stick_centre.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/time_study.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <sstream>

#include <Eigen/SVD>

using namespace arcslip;
using continuation::Vector;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

struct Force {
  Vector F;
  MatrixXd J, by_field;
  std::uint64_t piece = 0;
  elements::FrictionState friction;
};

Force evaluate(const elements::Law& law, const elements::Harmonics& h, const Vector& u,
               const std::vector<double>& fields) {
  const auto element = law.element(h, {});
  element->move_to(u, fields, true);
  Force at{element->force(), element->jacobian(), MatrixXd(u.size(), fields.size()), element->piece(), {}};
  for (std::size_t k = 0; k < fields.size(); ++k)
    element->field_derivative(static_cast<int>(k), at.by_field.col(static_cast<Eigen::Index>(k)));
  element->friction(at.friction);
  return at;
}

// Coefficients that fall with the square of their order.
Vector random_motion(const elements::Harmonics& h, double tangential, double normal, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Vector u(3 * h.size());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < h.size(); ++j) {
      const int n = j < h.cosines() ? j : j - h.order;
      u[i * h.size() + j] = (i < 2 ? tangential : normal) * number(bits) / (1 + n * n);
    }
  return u;
}

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

// M = 1 and C = 2 in three coordinates, coupled by springs, under forces at 95 rad/s with a phase between the
// tangential ones.
scene::Scene pad(int order, double f, double normal_load) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "n"],
      "masses": [{"name": "m_a", "at": "a", "value": 1}, {"name": "m_b", "at": "b", "value": 1},
                 {"name": "m_n", "at": "n", "value": 1}],
      "springs": [{"name": "s_a", "at": "a", "value": 8500}, {"name": "s_b", "at": "b", "value": 6500},
                  {"name": "s_n", "at": "n", "value": 18500},
                  {"name": "s", "direction": {"a": 1, "n": 1}, "value": 1500}],
      "dampers": [{"name": "d_a", "at": "a", "value": 2}, {"name": "d_b", "at": "b", "value": 2},
                  {"name": "d_n", "at": "n", "value": 2}]},
    "elements": [{"name": "pad", "type": "contact_3d", "tangential_1": {"at": "a"},
      "tangential_2": {"at": "b"}, "normal": {"at": "n"},
      "tangential_stiffness": 6e3, "normal_stiffness": 9e3, "friction_coefficient": 0.4, "normal_load": )"
       << normal_load << R"(}],
    "response": [{"name": "a", "at": "a"}, {"name": "b", "at": "b"}],
    "excitation": [{"name": "f_a", "at": "a", "cosine": )"
       << f << R"(}, {"name": "f_b", "at": "b", "cosine": )" << 0.3 * f << R"(, "sine": )" << 0.7 * f
       << R"(}, {"name": "f_n", "at": "n", "cosine": )" << 0.6 * f << R"(}],
    "harmonics": {"order": )"
       << order << R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 60, "to": 180}]})";
  return scenes::parse(text.str());
}

}  // namespace

TEST_CASE("on a circle under a constant load the force of slip has a closed form") {
  // The slider goes round on a smaller circle, x - w is tangential to it, and has the length h: T leads by
  // the angle whose cosine is h/a.
  const elements::Harmonics h{5, false};
  const Eigen::Index c = h.size();
  for (const double a : {1.01, 1.5, 4.0, 100.0})
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
  // Any motion: no place beside the centre has a smaller excess, over many instants.
  elements::StickCentre centre(h);
  elements::Disc disc(h);
  for (unsigned seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    const Vector u = random_motion(h, 1, 0.1 * (seed % 4), seed);
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
    centre.derivative(disc, dw);
    if (seed % 4 == 0) continue;
    const auto rest = [&](const Vector& at) {
      disc.set(at.head(c), at.segment(c, c), at.tail(c));
      centre.find(disc);
      return Vector(centre.w());
    };
    CHECK((every_law::differences(rest, u, 1e-6) - dw).cwiseAbs().maxCoeff() < 1e-7);
  }
}

TEST_CASE("the coefficients of a contact in a plane are those of a march in small steps") {
  const elements::Harmonics h{3, false};
  for (unsigned seed = 1; seed <= 12; ++seed)
    for (const double load : {3.0, 0.6, -0.2})
      for (const double size : {0.3, 1.0, 4.0}) {
        CAPTURE(seed, load, size);
        const Vector u = random_motion(h, size, 1, seed);
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
      const Vector random = random_motion(h, 1.5, 1, seed);
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
          const Vector u = random_motion(h, size, 1, seed);
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

TEST_CASE("a contact in a plane stays finite and dissipates at every extreme") {
  const elements::Harmonics h{4, false};
  const Eigen::Index c = h.size();
  for (const double k_t : {1e-6, 1.0, 1e6})
    for (const double k_n : {0.0, 1e-6, 1.0, 1e6})
      for (const double mu : {0.0, 1e-6, 0.3, 1e3})
        for (const double load : {-1e3, 0.0, 1e-3, 1e6})
          for (const double size : {0.0, 1e-6, 1.0, 1e3}) {
            CAPTURE(k_t, k_n, mu, load, size);
            const Vector u = random_motion(h, size, size, 3);
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

TEST_CASE("motions that are almost straight or far beyond the disc end, and overflow is told") {
  const elements::Harmonics h{4, false};
  const Eigen::Index c = h.size();
  for (const double size : {1.0, 1e3, 1e6, 1e9, 1e12})
    for (const double across : {1e-15, 1e-9, 1e-6, 1e-3}) {
      CAPTURE(size, across);
      Vector u = random_motion(h, size, 1, 7);
      u.segment(c, c) = 0.4 * u.head(c) + across * u.segment(c, c);
      const Force at = evaluate(elements::contact_3d(), h, u, {1, 0, 0.3, 2});
      CHECK(at.F.allFinite());
      CHECK(at.J.allFinite());
      // A slider that slips almost always, with the friction mu N = 0.6 against the motion.
      if (size >= 1e6) CHECK(at.F.head(c).norm() < 2 * 0.6);
    }
  const Force overflow =
      evaluate(elements::contact_3d(), h, random_motion(h, 1e300, 1e300, 7), {1, 1, 0.3, 2});
  CHECK_FALSE(overflow.F.allFinite());
}

namespace {

constexpr double friction = 0.6;

// From one motion to another, with a change of the piece between them at `place`.
struct Way {
  Vector from, to;
  std::vector<double> fields;
  double low = 0, high = 1;

  Vector at(double s) const { return from + s * (to - from); }
  std::uint64_t piece(const elements::Harmonics& h, double s) const {
    return evaluate(elements::contact_3d(), h, at(s), fields).piece;
  }
};

std::optional<Way> way_across_pieces(const elements::Harmonics& h, double size, unsigned seed) {
  const Vector from = random_motion(h, size, size, seed);
  Way way{from, from + random_motion(h, 0.1 * size, 0.1 * size, seed + 1000), {2, 1.5, friction, 0.7}};
  const auto first = way.piece(h, way.low);
  if (first == way.piece(h, way.high)) return {};
  while (way.high - way.low > 1e-13) {
    const double middle = 0.5 * (way.low + way.high);
    (way.piece(h, middle) == first ? way.low : way.high) = middle;
  }
  return way;
}

Vector row_of_field_changes(const std::function<Vector(const std::vector<double>&)>& f,
                            const std::vector<double>& fields, std::size_t k) {
  std::vector<double> above = fields, below = fields;
  above[k] += 1e-6;
  below[k] -= 1e-6;
  return (f(above) - f(below)) / 2e-6;
}

}  // namespace

TEST_CASE(
    "corners of a contact in a plane have the gradients of differences, and lie where the piece changes") {
  const elements::Harmonics h{3, false};
  const auto corners = elements::contact_3d().corners(h);
  std::map<int, int> guards;
  for (unsigned seed = 1; seed < 400; ++seed) {
    const auto way = way_across_pieces(h, seed % 3 == 0 ? 0.45 : 1, seed);
    if (!way) continue;
    const Vector there = way->at(way->low);
    for (const auto& corner : corners->near(there, way->fields, 1e-9)) {
      CAPTURE(seed, way->low, corner.guard);
      ++guards[corner.guard];
      const auto angles = static_cast<int>(corner.angles.size());
      elements::Corners::Equations at(there.size(), angles, 4);
      corners->equations(corner, there, way->fields, at);
      CHECK(at.values.cwiseAbs().maxCoeff() < 1e-8);
      const auto values = [&](const elements::Corner& moved, const Vector& u, const std::vector<double>& f) {
        elements::Corners::Equations beside(u.size(), angles, 4);
        corners->equations(moved, u, f, beside);
        return Vector(beside.values);
      };
      // On both sides: the rest of a slider that slips in each period depends on the slip that is born.
      const Vector dh = at.by_motion.row(0).transpose();
      for (const double side : {-1, 1}) {
        const Vector u = there + side * 2e-4 * dh.normalized();
        corners->equations(corner, u, way->fields, at);
        const MatrixXd by_motion =
            every_law::differences([&](const Vector& v) { return values(corner, v, way->fields); }, u, 1e-6);
        CHECK((by_motion - at.by_motion).cwiseAbs().maxCoeff() < 1e-7);
        for (std::size_t k = 0; k < 4; ++k) {
          const auto by_fields = [&](const std::vector<double>& f) { return values(corner, u, f); };
          CHECK((row_of_field_changes(by_fields, way->fields, k) - at.by_field.col(static_cast<int>(k)))
                    .cwiseAbs()
                    .maxCoeff() < 1e-7);
        }
        const MatrixXd by_angle = every_law::differences(
            [&](const Vector& t) {
              return values({corner.guard, {t.begin(), t.end()}}, u, way->fields);
            },
            Eigen::Map<const Vector>(corner.angles.data(), angles), 1e-6);
        CHECK((by_angle - at.by_angle).cwiseAbs().maxCoeff() < 1e-7);
      }
      elements::Corner near = corner;
      for (double& angle : near.angles) angle += 1e-3;
      REQUIRE(corners->polish(near, there, way->fields));
      for (std::size_t i = 0; i < near.angles.size(); ++i)
        CHECK(std::abs(near.angles[i] - corner.angles[i]) < 1e-8);
    }
  }
  for (int guard = 0; guard < 5; ++guard) CHECK(guards[guard] > 3);
}

TEST_CASE("at a birth of slip in a plane the Jacobian jumps along the corner's gradient, by rank one") {
  const elements::Harmonics h{3, false};
  const auto corners = elements::contact_3d().corners(h);
  std::map<int, int> jumps;
  for (unsigned seed = 1; seed < 400; ++seed) {
    const auto way = way_across_pieces(h, seed % 3 == 0 ? 0.45 : 1, seed);
    if (!way) continue;
    const Vector there = way->at(way->low);
    const auto found = corners->near(there, way->fields, 1e-9);
    if (found.size() != 1 || found[0].guard < 2) continue;
    const auto angles = static_cast<int>(found[0].angles.size());
    elements::Corners::Equations at(there.size(), angles, 4);
    corners->equations(found[0], there, way->fields, at);
    const Vector dh = at.by_motion.row(0).transpose();
    const auto jacobian = [&](double side) {
      return evaluate(elements::contact_3d(), h, there + side * dh / dh.squaredNorm(), way->fields).J;
    };
    // Beside the corner the Jacobian changes with the root of h, which two distances take away.
    const auto limit = [&](double side) -> MatrixXd {
      return 2 * jacobian(side * 1e-10) - jacobian(side * 4e-10);
    };
    const MatrixXd jump = limit(1) - limit(-1);
    const Eigen::JacobiSVD<MatrixXd> svd(jump, Eigen::ComputeThinU | Eigen::ComputeThinV);
    if (svd.singularValues()[0] < 1e-2) continue;
    ++jumps[found[0].guard];
    CAPTURE(seed, found[0].guard, svd.singularValues()[0], svd.singularValues()[1]);
    CHECK(svd.singularValues()[1] < 1e-3 * svd.singularValues()[0]);
    CHECK(std::abs(svd.matrixV().col(0).dot(dh)) > (1 - 1e-6) * dh.norm());
  }
  for (int guard = 2; guard < 5; ++guard) CHECK(jumps[guard] > 1);
}

TEST_CASE("the error of harmonic balance with slip in a plane falls as the third power of the order") {
  for (const double f : {8.0, 25.0}) {
    CAPTURE(f);
    const auto fine = beside_exact::balanced(pad(61, f, 8), 95);
    elements::LargestValue finest(fine.problem->harmonics());
    const double exact = finest.of(fine.u.head(fine.problem->harmonics().size()));
    std::array<double, 2> stepped;
    for (int i = 0; i < 2; ++i) {
      const auto motion = observables::motion_in_time(
          pad(5, f, 8),
          {.frequency = 95, .method = observables::TimeMethod::newmark_shooting, .steps = 1000 << i});
      REQUIRE(motion.status == observables::Status::complete);
      stepped[static_cast<std::size_t>(i)] = motion.amplitude;
      CHECK(motion.elements[0].stick_percent > 0);
    }
    // Of second order in the steps.
    CHECK(std::abs((4 * stepped[1] - stepped[0]) / 3 / exact - 1) < 1e-5);
    for (const int order : {5, 9, 17, 31}) {
      const auto balanced = beside_exact::balanced(pad(order, f, 8), 95);
      elements::LargestValue largest(balanced.problem->harmonics());
      CAPTURE(order);
      CHECK(std::abs(largest.of(balanced.u.head(2 * order + 1)) / exact - 1) < 0.5 * std::pow(order, -3.0));
    }
  }
}

TEST_CASE("a frequency response with slip in a plane and separation is traced to its end") {
  const scene::Scene s = pad(7, 25, 8);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  CHECK(branches[0].points.back().omega == 180);
  int opened = 0, stuck = 0;
  for (const auto& point : branches[0].points) {
    opened += point.elements[0].open_percent > 0;
    stuck += point.elements[0].stick_percent > 0 && point.elements[0].stick_percent < 100;
  }
  CHECK(opened > 0);
  CHECK(stuck > 0);
}

namespace {

// The example of an orbiting pad without lift: in full stick two oscillators, of 0.5 kg, 2 N s/m and 40 and
// 46 kN/m, under forces of 10 N in quadrature.
scene::Scene level_pad(double normal_load) {
  scene::Scene s = scenes::example("orbiting_pad");
  scene::set(s, "lift.cosine", 0);
  scene::set(s, "pad.normal_load", normal_load);
  return s;
}

// Half the long axis of the ellipse that the stuck pad describes, m. It sticks while that is below mu N/k_t.
double stuck_orbit(double omega) {
  const std::complex<double> x = 10.0 / std::complex<double>(40e3 - 0.5 * omega * omega, 2 * omega);
  const std::complex<double> y =
      std::complex<double>(0, -10) / std::complex<double>(46e3 - 0.5 * omega * omega, 2 * omega);
  return std::sqrt(0.5 * (std::norm(x) + std::norm(y) + std::abs(x * x + y * y)));
}

}  // namespace

TEST_CASE("a frequency response passes from slip in a plane to full stick where the orbit fits the disc") {
  for (const double load : {60.0, 120.0}) {
    const scene::Scene s = level_pad(load);
    const auto branches = observables::frequency_response(s, {30, 70});
    REQUIRE(branches.size() == 1);
    CHECK(branches[0].status == observables::Status::complete);
    double low = 305, high = 70 * scenes::hertz;  // beyond both resonances
    while (high - low > 1e-12 * high) {
      const double middle = 0.5 * (low + high);
      (stuck_orbit(middle) > 0.3 * load / 20e3 ? low : high) = middle;
    }
    double nearest = 1;
    for (const auto& point : branches[0].points) {
      nearest = std::min(nearest, std::abs(point.omega / low - 1));
      if (point.omega > low * (1 + 1e-9)) CHECK(point.elements[0].stick_percent == 100);
    }
    CAPTURE(load, low);
    CHECK(nearest < 1e-10);
  }
}

TEST_CASE("the example of an orbiting pad has the amplitude and the stick of its motion in time") {
  scene::Scene s = scenes::example("orbiting_pad");
  // The table of its README, at 34 Hz.
  const struct {
    double lift, amplitude, stick;
  } rows[] = {{0, 3.52170e-3, 12.551}, {15, 3.59921e-3, 11.006}};
  for (const auto& row : rows) {
    CAPTURE(row.lift);
    scene::set(s, "lift.cosine", row.lift);
    std::array<double, 2> stepped;
    for (int i = 0; i < 2; ++i) {
      const auto motion = observables::motion_in_time(
          s, {.frequency = 34, .method = observables::TimeMethod::newmark_shooting, .steps = 1000 << i});
      REQUIRE(motion.status == observables::Status::complete);
      stepped[static_cast<std::size_t>(i)] = motion.amplitude;
      CHECK(std::abs(motion.elements[0].stick_percent - row.stick) < 0.2);
    }
    CHECK(std::abs((4 * stepped[1] - stepped[0]) / 3 / row.amplitude - 1) < 3e-4);
  }
}
