#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/every_law.hpp"
#include "lib/laws/piecewise_linear_laws.hpp"
#include "lib/time/beside_exact.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/elements/contact_2d.hpp>

#include <arcslip/elements/jenkins.hpp>
#include <arcslip/elements/largest_value.hpp>
#include <arcslip/hbm/corner.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/reasons.hpp>
#include <arcslip/observables/responses_at.hpp>
#include <arcslip/observables/time_study.hpp>
#include <arcslip/studies/figures.hpp>
#include <arcslip/time/shooting.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>
#include <numbers>
#include <random>

using namespace arcslip;
using continuation::Vector;
using Eigen::MatrixXd;
using std::numbers::pi;

namespace {

// Two coupled coordinates on a contact, M = 1, C = 2, K = [1e4 1500; 1500 2e4], forces f_t, f_n times cos 95
// t and -8 N along the normal direction.
scene::Scene pad(int order, double f_t, double f_n) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["t", "n"],
      "masses": [{"name": "m_t", "at": "t", "value": 1}, {"name": "m_n", "at": "n", "value": 1}],
      "springs": [{"name": "s_t", "at": "t", "value": 8500}, {"name": "s_n", "at": "n", "value": 18500},
                  {"name": "s", "direction": {"t": 1, "n": 1}, "value": 1500}],
      "dampers": [{"name": "d_t", "at": "t", "value": 2}, {"name": "d_n", "at": "n", "value": 2}]},
    "elements": [{"name": "pad", "type": "contact_2d", "tangential": {"at": "t"}, "normal": {"at": "n"},
      "tangential_stiffness": 6e3, "normal_stiffness": 9e3, "friction_coefficient": 0.4, "normal_load": 8}],
    "response": [{"name": "t", "at": "t"}, {"name": "n", "at": "n"}],
    "excitation": [{"name": "f_t", "at": "t", "cosine": )"
       << f_t << R"(}, {"name": "f_n", "at": "n", "cosine": )" << f_n
       << R"(}, {"name": "load", "at": "n", "cosine": -8, "harmonic": 0}], "harmonics": {"order": )" << order
       << R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 60, "to": 180}]})";
  return scenes::parse(text.str());
}

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

Vector random_motion(const elements::Harmonics& h, double tangential, double normal, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Vector u(2 * h.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = (i < h.size() ? tangential : normal) * number(bits);
  return u;
}

}  // namespace

TEST_CASE("a contact under a load that varies comes to the motions of a march with all digits printed") {
  // max x_t where it is known, open and stick share, of an independent march
  struct Case {
    double f_t, f_n, x_t, open, stick, error;
  };
  const Case cases[] = {{5, 3, 2.877543173e-3, 0, 0.2284116876, 3e-9},
                        {20, 12, 2.004842575e-2, 0.3246971631, 0.0727003611, 5e-9},
                        {60, 36, 0, 0.5298996792, 0.0679040881, 3e-8},
                        {5, 60, 3.176953612e-4, 0.5293812621, 0.4668064197, 3e-8}};
  for (const Case& each : cases) {
    CAPTURE(each.f_t, each.f_n);
    const auto exact = observables::motion_in_time(pad(5, each.f_t, each.f_n), {.frequency = 95});
    REQUIRE(exact.status == observables::Status::complete);
    CHECK(exact.integrator == "event-driven");
    if (each.x_t > 0) CHECK(std::abs(exact.amplitude / each.x_t - 1) < 1e-8);
    CHECK(std::abs(exact.elements[0].stick_percent / 100 - each.stick) < 1e-9);
    CHECK(std::abs(exact.elements[0].open_percent / 100 - each.open) < 1e-9);
    const auto stepped = observables::motion_in_time(
        pad(5, each.f_t, each.f_n),
        {.frequency = 95, .method = observables::TimeMethod::newmark_shooting, .steps = 2000});
    REQUIRE(stepped.status == observables::Status::complete);
    CHECK(std::abs(stepped.amplitude / exact.amplitude - 1) < 1e-4);
    CHECK(std::abs(stepped.elements[0].stick_percent / 100 - each.stick) < 1e-3);
    CHECK(std::abs(stepped.elements[0].open_percent / 100 - each.open) < 1e-3);
    double last = 1;
    for (const int order : {3, 7, 15, 27, 55, 101}) {
      const auto balanced = beside_exact::balanced(pad(order, each.f_t, each.f_n), 95);
      elements::LargestValue largest(balanced.problem->harmonics());
      last = std::abs(largest.of(balanced.u.head(2 * order + 1)) / exact.amplitude - 1);
      CAPTURE(order, last);
      CHECK(last < 0.2 * std::pow(order, -3.0));
    }
    CHECK(last < each.error);
  }
}

TEST_CASE("under a constant load a contact is a Jenkins element and a linear spring") {
  const elements::Harmonics h{9, false};
  for (unsigned seed = 1; seed < 30; ++seed) {
    CAPTURE(seed);
    for (const double size : {0.2, 1.0, 5.0}) {
      Vector u = random_motion(h, size, 0, seed);
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

TEST_CASE("without friction a contact is a gap spring along its normal, for any load") {
  const elements::Harmonics h{7, false};
  const Eigen::Index c = h.size();
  for (unsigned seed = 1; seed < 30; ++seed) {
    const Vector u = random_motion(h, 1, 1, seed);
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
        const Vector u = random_motion(h, tangential, 1, seed);
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

TEST_CASE(
    "the corners of a contact have the gradients of their differences, and lie where the piece changes") {
  // Along a random way two motions of different phases have corners between them.
  const elements::Harmonics h{3, false};
  const auto corners = elements::contact_2d().corners(h);
  const std::vector<double> fields = {2, 1.5, 0.6, 0.7};
  std::vector<int> guards;
  int met = 0;
  for (unsigned seed = 1; seed < 500; ++seed) {
    const double size = seed % 4 == 0 ? 0.1 : 1;
    const Vector from = random_motion(h, size, size, seed),
                 to = from + random_motion(h, 0.1, 0.1, seed + 1000);
    const auto at = [&](double s) -> Vector { return from + s * (to - from); };
    const auto piece = [&](double s) { return evaluate(elements::contact_2d(), h, at(s), fields).piece; };
    double low = 0, high = 1;
    if (piece(low) == piece(high)) continue;
    while (high - low > 1e-13) (piece(0.5 * (low + high)) == piece(low) ? low : high) = 0.5 * (low + high);
    const Vector w = at(low);
    const auto found = corners->near(w, fields, 1e-9);
    const bool both_slip = found.empty();
    CAPTURE(seed, low, piece(low), piece(high));
    if (both_slip) continue;  // of a phase of zero length after closing: no corner
    ++met;
    for (const auto& corner : found) {
      guards.push_back(corner.guard);
      const auto angles = static_cast<int>(corner.angles.size());
      elements::Corners::Equations equations(w.size(), angles, 4);
      corners->equations(corner, w, fields, equations);
      CHECK(equations.values.cwiseAbs().maxCoeff() < 1e-8);
      const auto values = [&](const elements::Corner& moved, const Vector& u, const std::vector<double>& f) {
        elements::Corners::Equations there(u.size(), angles, 4);
        corners->equations(moved, u, f, there);
        return Vector(there.values);
      };
      const MatrixXd by_motion =
          every_law::differences([&](const Vector& u) { return values(corner, u, fields); }, w, 1e-6);
      CHECK((by_motion - equations.by_motion).cwiseAbs().maxCoeff() < 1e-7);
      const Vector theta = Eigen::Map<const Vector>(corner.angles.data(), angles);
      const MatrixXd by_angle = every_law::differences(
          [&](const Vector& t) {
            return values({corner.guard, {t.begin(), t.end()}}, w, fields);
          },
          theta, 1e-6);
      CHECK((by_angle - equations.by_angle).cwiseAbs().maxCoeff() < 1e-7);
      const Vector f = Eigen::Map<const Vector>(fields.data(), 4);
      const MatrixXd by_field = every_law::differences(
          [&](const Vector& g) {
            return values(corner, w, {g.begin(), g.end()});
          },
          f, 1e-6);
      CHECK((by_field - equations.by_field).cwiseAbs().maxCoeff() < 1e-7);
      elements::Corner near = corner;
      for (double& angle : near.angles) angle += 1e-3;
      REQUIRE(corners->polish(near, w, fields));
      for (std::size_t i = 0; i < near.angles.size(); ++i)
        CHECK(std::abs(near.angles[i] - corner.angles[i]) < 1e-8);
    }
  }
  CHECK(met > 60);
  std::sort(guards.begin(), guards.end());
  CHECK(std::unique(guards.begin(), guards.end()) - guards.begin() == 8);
}

TEST_CASE("at a birth of slip the Jacobian of a contact jumps along the corner's gradient, by rank one") {
  const elements::Harmonics h{3, false};
  const auto corners = elements::contact_2d().corners(h);
  const std::vector<double> fields = {2, 1.5, 0.6, 0.7};
  int jumps = 0;
  for (unsigned seed = 1; seed < 200; ++seed) {
    const Vector from = random_motion(h, 1, 1, seed), to = from + random_motion(h, 0.1, 0.1, seed + 1000);
    const auto at = [&](double s) -> Vector { return from + s * (to - from); };
    const auto piece = [&](double s) { return evaluate(elements::contact_2d(), h, at(s), fields).piece; };
    double low = 0, high = 1;
    if (piece(low) == piece(high)) continue;
    while (high - low > 1e-13) (piece(0.5 * (low + high)) == piece(low) ? low : high) = 0.5 * (low + high);
    const auto found = corners->near(at(low), fields, 1e-9);
    if (found.size() != 1 || found[0].guard < 2) continue;
    const MatrixXd jump = evaluate(elements::contact_2d(), h, at(high), fields).J -
                          evaluate(elements::contact_2d(), h, at(low), fields).J;
    const Eigen::JacobiSVD<MatrixXd> svd(jump, Eigen::ComputeThinU | Eigen::ComputeThinV);
    if (svd.singularValues()[0] < 1e-3) continue;
    ++jumps;
    elements::Corners::Equations equations(2 * h.size(), 2, 4);
    corners->equations(found[0], at(low), fields, equations);
    const Eigen::RowVectorXd dh =
        equations.by_motion.row(0) - equations.by_angle.row(0) * equations.by_angle.bottomRows(2).inverse() *
                                         equations.by_motion.bottomRows(2);
    CAPTURE(seed, found[0].guard);
    CHECK(svd.singularValues()[1] < 1e-4 * svd.singularValues()[0]);
    CHECK(std::abs(svd.matrixV().col(0).dot(dh.transpose())) > (1 - 1e-6) * dh.norm());
  }
  CHECK(jumps > 10);
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
              const Vector u = random_motion(h, size, normal_size, 5);
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

TEST_CASE("a frequency response with stick, slip and separation is traced to its end, as the march has it") {
  scene::Scene s = pad(21, 20, 12);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].status == observables::Status::complete);
  int opened = 0, stuck = 0, compared = 0;
  for (std::size_t i = 0; i < branches[0].points.size(); i += 1 + branches[0].points.size() / 12) {
    const auto& point = branches[0].points[i];
    const auto motion = observables::motion_in_time(s, {.frequency = point.omega});
    if (motion.status != observables::Status::complete) continue;
    ++compared;
    CAPTURE(point.omega);
    CHECK(std::abs(point.amplitude / motion.amplitude - 1) < 1e-4);
    opened += point.elements[0].open_percent > 0;
    stuck += point.elements[0].open_percent == 0;
  }
  CHECK(compared > 9);
  CHECK(opened > 0);
  CHECK(stuck > 0);
}

TEST_CASE("in units a thousand times larger a contact has the same events") {
  const auto kinds = [](double factor) {
    scene::Scene s = pad(9, 20 * factor, 12 * factor);
    scene::set(s, "load.cosine", -8 * factor);
    scene::set(s, "pad.normal_load", 8 * factor);
    const auto branches = observables::frequency_response(s, scenes::window(s));
    REQUIRE(branches.size() == 1);
    std::vector<std::pair<std::string, double>> found;
    for (const auto& event : branches[0].events) found.emplace_back(event.kind, event.point.omega);
    return found;
  };
  const auto one = kinds(1), thousand = kinds(1000);
  REQUIRE(one.size() == thousand.size());
  REQUIRE_FALSE(one.empty());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].first == thousand[i].first);
    CHECK(std::abs(one[i].second / thousand[i].second - 1) < 1e-9);
  }
}

TEST_CASE("the figures of a contact show stick and separation over the frequency, and what it does") {
  scene::Scene s = pad(7, 20, 12);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  const auto names = [](const results::FigureData& data) {
    std::vector<std::string> all;
    for (const auto& figure : data.figures) all.push_back(figure.name);
    return all;
  };
  const auto shares = studies::figures_of(s, studies::BranchKind::responses, branches);
  CHECK(names(shares) == std::vector<std::string>{"amplitude", "stick", "separation", "contact"});
  double most = 0;
  for (const auto& part : shares.lines[0].parts)
    for (const auto& record : part) {
      CHECK(record[2] + record[3] <= 100 + 1e-9);
      most = std::max(most, record[3]);
    }
  CHECK(most > 30);
}

TEST_CASE("the example of a rubbing pad has the amplitude, stick and separation of an independent march") {
  struct Case {
    double force, x_t, open, stick;  // x_t: where it is known
  };
  const Case cases[] = {{5, 2.877543173e-3, 0, 0.2284116876},
                        {20, 2.004842575e-2, 0.3246971631, 0.0727003611},
                        {60, 0, 0.5298996792, 0.0679040881}};
  scene::Scene s = scenes::example("rubbing_pad");
  CHECK(s.harmonics.order == 27);
  for (const Case& each : cases) {
    CAPTURE(each.force);
    scene::set(s, "force.cosine", each.force);
    const auto responses = observables::point_responses(s, {.frequency = 95});
    REQUIRE(responses.size() == 1);
    const auto& point = responses[0].point;
    REQUIRE(point.elements.size() == 1);
    if (each.x_t > 0) CHECK(std::abs(point.amplitude / each.x_t - 1) < 2e-6);
    CHECK(std::abs(point.elements[0].open_percent / 100 - each.open) < 1e-5);
    CHECK(std::abs(point.elements[0].stick_percent / 100 - each.stick) < 1e-5);
    const auto motion = observables::motion_in_time(s, {.frequency = 95});
    REQUIRE(motion.status == observables::Status::complete);
    if (each.x_t > 0) CHECK(std::abs(motion.amplitude / each.x_t - 1) < 1e-8);
  }
}

TEST_CASE("a contact along one line of motion, just touched, has few phases and a finite force") {
  // Both bounds turn where the load is extreme, and meet the slider where the contact opens.
  const elements::Harmonics h{5, false};
  elements::Reversals reversals(h);
  for (unsigned seed = 1; seed < 40; ++seed)
    for (const double slope : {1.0, -0.5, 0.5})
      for (const double friction : {0.3, 2.0, 1 / 0.5, 5.0}) {
        Vector u = random_motion(h, 1, 0, seed);
        u.tail(h.size()) = slope * u.head(h.size());
        const auto turns = reversals.find(u.tail(h.size()));
        for (const auto& turn : turns)
          for (const double beside : {0.0, 1e-16, -1e-16, 1e-13, -1e-13, 1e-9, -1e-9}) {
            const std::vector<double> fields = {1, 1, friction, -turn.x * (1 + beside)};
            const Force at = evaluate(elements::contact_2d(), h, u, fields);
            CAPTURE(seed, slope, friction, turn.x, beside);
            REQUIRE(at.F.allFinite());
            REQUIRE(at.J.allFinite());
            REQUIRE(at.friction.slip_onsets.size() <= 2 * turns.size());
          }
      }
}

TEST_CASE(
    "a contact that no slip precedes where it opens is traced, and is no change of the piece by rounding") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["t"], "masses": [{"name": "m", "at": "t", "value": 1}],
      "springs": [{"name": "k", "at": "t", "value": 1}], "dampers": [{"name": "d", "at": "t", "value": 0.05}]},
    "elements": [{"name": "c", "type": "contact_2d", "tangential": {"at": "t"},
      "normal": {"direction": {"t": 0.5}}, "tangential_stiffness": 1, "normal_stiffness": 1,
      "friction_coefficient": 3, "normal_load": 0.3}],
    "excitation": [{"name": "f", "at": "t", "cosine": 1}], "harmonics": {"order": 5},
    "studies": [{"name": "frf", "kind": "frf", "from": 0.2, "to": 2.5}]})");
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  CHECK(branches[0].points.size() < 2000);
}

TEST_CASE("the march begins in separation where the contact is open at the start, whichever way it moves") {
  scene::Scene s = pad(5, 20, 12);
  scene::set(s, "pad.normal_load", -0.3);
  scene::set(s, "f_t.sine", -30);
  const auto motion = observables::motion_in_time(s, {.frequency = 95});
  REQUIRE(motion.status == observables::Status::complete);
  CHECK(motion.integrator == "event-driven");
  const auto model = model::build(s);
  Vector p = model::defaults(model);
  p[model::frequency] = 95;
  time::EventDriven march(time::equation_of_motion(model, p));
  for (const double tangential : {-1.0, 0.0, 1.0})
    for (const double normal : {-1.0, 0.0, 1.0}) {
      auto start = time::at_rest(march.equation());
      start.x[1] = -1e-3;
      start.v << tangential, normal;
      const auto end = march.integrate(start, 0, march.equation().period());
      CAPTURE(tangential, normal);
      CHECK(end.reason == time::EndReason::reached);
      CHECK(end.events.size() < 100);
    }
}

TEST_CASE(
    "a motion in steps too long for a stiff contact is not complete, since its energies do not balance") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["t", "n"],
      "masses": [{"name": "mt", "at": "t", "value": 1}, {"name": "mn", "at": "n", "value": 1}],
      "springs": [{"name": "kt", "at": "t", "value": 1}, {"name": "kn", "at": "n", "value": 2}],
      "dampers": [{"name": "ct", "at": "t", "value": 0.05}, {"name": "cn", "at": "n", "value": 0.05}]},
    "elements": [{"name": "c", "type": "contact_2d", "tangential": {"at": "t"}, "normal": {"at": "n"},
      "tangential_stiffness": 1, "normal_stiffness": 1e6, "friction_coefficient": 0.5, "normal_load": 1}],
    "excitation": [{"name": "ft", "at": "t", "cosine": 1}, {"name": "fn", "at": "n", "cosine": 0.8, "sine": 0.5}],
    "harmonics": {"order": 40}, "response": {"at": "t"}})");
  const observables::TimeSettings settings{.frequency = 1.1,
                                           .method = observables::TimeMethod::newmark_shooting};
  for (const int steps : {500, 2000, 8000}) {
    auto with = settings;
    with.steps = steps;
    const auto motion = observables::motion_in_time(s, with);
    const auto& energy = motion.energy;
    const bool balanced =
        std::abs(energy.defect()) <= 0.01 * std::max(energy.input, energy.friction + energy.viscous);
    CAPTURE(steps, energy.input, energy.defect());
    if (motion.status == observables::Status::complete) CHECK(balanced);
    if (steps == 2000) {
      CHECK(motion.status == observables::Status::stopped);
      CHECK(motion.stop.reason == observables::reasons::energy_defect);
    }
  }
}

TEST_CASE("where a preload becomes a gap a contact has another piece, with the derivative of each side") {
  const elements::Harmonics h{4, false};
  const Vector u = random_motion(h, 1, 1, 3);
  const auto at = [&](double load) { return evaluate(elements::contact_2d(), h, u, {2, 1.5, 0.6, load}); };
  CHECK(at(1e-9).piece != at(-1e-9).piece);
  for (const double side : {1e-3, -1e-3}) {
    const Force here = at(side);
    CHECK(((at(side + 1e-6).F - at(side - 1e-6).F) / 2e-6 - here.by_field.col(3)).norm() < 1e-6);
  }
}
