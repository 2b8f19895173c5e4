// Sliders that stick throughout the period and hold a mean force: "offset": "static".
#include "catch.hpp"

#include "contains.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/laws/every_law.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/offset_option.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

using namespace arcslip;
using continuation::Vector;
using Eigen::MatrixXd;
using std::numbers::pi;

namespace {

const auto settings = scene::Settings::of(elements::OffsetOption{elements::Offset::static_loads});
const auto slider = elements::jenkins().law(settings), contact_law = elements::contact_2d().law(settings);

struct Example {
  const elements::Law& law;
  std::vector<double> fields;
  double stiffness, limit;  // tangential; mu N_0
};
const Example examples[] = {{*slider, {2, 0.5, 3}, 2, 1.5},
                            {*contact_law, {2, 0, 0.5, 3}, 2, 1.5},
                            {*contact_law, {2, 0.4, 0.5, 3}, 2, 1.5}};

// Of small oscillations about the mean given.
Vector motion(const elements::Law& law, const elements::Harmonics& h, double mean, double size,
              unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Vector u(law.directions() * h.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = size * number(random);
  u[0] = mean;
  return u;
}

Vector force(const elements::Law& law, const elements::Harmonics& h, const Vector& u,
             const std::vector<double>& fields) {
  const auto element = law.element(h, {});
  element->move_to(u, fields, false);
  return element->force();
}

// 1 kg on a spring of 1 N/m, or none, a damper of 0.1 N s/m and a slider of 2 N/m and 1 N, under a constant
// load and f cos wt.
scene::Scene held(double load, double amplitude, double spring, const std::string& offset = "static",
                  const std::string& more = "") {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": )"
       << spring << R"(}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "x", "stiffness": 2, "friction_coefficient": 0.5,
                  "normal_load": 2, "offset": ")"
       << offset << R"("}], "excitation": [{"name": "f", "at": "x", "cosine": )" << amplitude
       << R"(}, {"name": "load", "at": "x", "harmonic": 0, "cosine": )" << load
       << R"(}], "harmonics": {"order": 5)" << more << "}}";
  return scenes::parse(text.str());
}

double oscillation(double amplitude, double spring, double w) {
  return amplitude / std::hypot(spring + 2 - w * w, 0.1 * w);
}

// The mean position: the slider rests at 0, or follows a bound, with the mean force 1 - 2 A then.
double place(double load, double A, double spring) {
  const double stuck = load / (spring + 2);
  if (2 * (std::abs(stuck) + A) <= 1) return stuck;
  return (load - std::copysign(1 - 2 * A, load)) / spring;
}

observables::ResponsePoint at(const scene::Scene& s, double w) {
  const auto found = observables::point_responses(s, {.frequency = w});
  REQUIRE(found.size() == 1);
  return found[0].point;
}

}  // namespace

TEST_CASE("a slider with a static offset rests as near to 0 as its bounds allow, with these derivatives") {
  const elements::Harmonics h{3, false};
  std::set<int> sides;
  for (const Example& each : examples)
    for (unsigned seed = 1; seed < 40; ++seed)
      for (const double mean : {-3.0, -0.7, -0.3, 0.0, 0.2, 0.6, 0.8, 4.0}) {
        const Vector u = motion(each.law, h, mean, 0.06, seed);
        const auto element = each.law.element(h, {});
        element->move_to(u, each.fields, true);
        elements::FrictionState state;
        REQUIRE(element->friction(state));
        if (state.stick_share < 1) continue;
        double a = -1e300, b = 1e300;
        for (int i = 0; i < 20000; ++i) {
          const double theta = 2 * pi * i / 20000, x = elements::series_values(h, u.head(h.size()), theta).x;
          double reach = each.limit / each.stiffness;
          if (each.law.directions() == 2)
            reach += each.fields[2] * each.fields[1] * elements::series_values(h, u.tail(h.size()), theta).x /
                     each.stiffness;
          a = std::max(a, x - reach);
          b = std::min(b, x + reach);
        }
        const double w = std::min(std::max(0.0, a), b);
        sides.insert(a > 0 ? 1 : b < 0 ? -1 : 0);
        CAPTURE(each.law.directions(), seed, mean, a, b);
        Vector expected = each.stiffness * u.head(h.size());
        expected[0] -= each.stiffness * w;
        CHECK((element->force().head(h.size()) - expected).norm() < 1e-6);
        CHECK(std::abs(state.mean_min - each.stiffness * (mean - b)) < 1e-6);
        CHECK(std::abs(state.mean_max - each.stiffness * (mean - a)) < 1e-6);
        const std::vector<double> angles = {0.3, 2, 5};
        const MatrixXd exact = each.law.force_at(h, u, each.fields, angles);
        for (std::size_t i = 0; i < angles.size(); ++i)
          CHECK(std::abs(exact(static_cast<Eigen::Index>(i), 0) -
                         each.stiffness * (elements::series_values(h, u.head(h.size()), angles[i]).x - w)) <
                1e-6);
        if (std::min(std::abs(a), std::abs(b)) < 1e-4 || b - a < 1e-4) continue;
        const MatrixXd by_motion = every_law::differences(
            [&](const Vector& moved) { return force(each.law, h, moved, each.fields); }, u, 1e-6);
        CHECK((by_motion - element->jacobian()).cwiseAbs().maxCoeff() < 1e-6);
        const MatrixXd by_field = every_law::differences(
            [&](const Vector& moved) {
              return force(each.law, h, u, {moved.begin(), moved.end()});
            },
            Eigen::Map<const Vector>(each.fields.data(), static_cast<Eigen::Index>(each.fields.size())),
            1e-6);
        Vector derivative(u.size());
        for (int k = 0; k < static_cast<int>(each.fields.size()); ++k) {
          if (each.law.directions() == 2 && each.fields[1] == 0 && k == 1) continue;  // at its bound
          element->field_derivative(k, derivative);
          CHECK((by_field.col(k) - derivative).cwiseAbs().maxCoeff() < 1e-6);
        }
      }
  CHECK(sides.size() == 3);
}

TEST_CASE("under a constant load a contact with a static offset is the slider, and slipping it is centred") {
  const elements::Harmonics h{4, false};
  for (unsigned seed = 1; seed < 30; ++seed)
    for (const double size : {0.05, 0.4, 2.0})
      for (const double mean : {-1.0, 0.1, 2.0}) {
        const Vector u = motion(*slider, h, mean, size, seed);
        Vector both = Vector::Zero(2 * h.size());
        both.head(h.size()) = u;
        CAPTURE(seed, size, mean);
        const Vector F = force(*slider, h, u, {2, 0.5, 3});
        CHECK((force(*contact_law, h, both, {2, 0, 0.5, 3}).head(h.size()) - F).norm() < 1e-12);
        if (size == 2.0) CHECK((force(elements::jenkins(), h, u, {2, 0.5, 3}) - F).norm() < 1e-13);
        const auto sampled = slider->element(h, {false, 4096});
        sampled->move_to(u, std::vector<double>{2, 0.5, 3}, true);
        CHECK((sampled->force() - F).norm() < 2e-5 * (1 + F.norm()));
      }
  const elements::Harmonics odd{5, true};
  Vector u = motion(*slider, odd, 0.2, 0.1, 3);
  CHECK(force(*slider, odd, u, {2, 0.5, 3}) == force(elements::jenkins(), odd, u, {2, 0.5, 3}));
}

TEST_CASE("where a bound begins to carry a slider the Jacobian jumps along the gradient of that corner") {
  const elements::Harmonics h{3, false};
  std::set<int> guards;
  int jumps = 0;
  for (const Example& each : examples) {
    const auto corners = each.law.corners(h);
    for (unsigned seed = 1; seed < 120; ++seed) {
      const Vector from = motion(each.law, h, seed % 2 == 0 ? 0.6 : -0.6, 0.06, seed),
                   to = from + motion(each.law, h, seed % 2 == 0 ? 0.2 : -0.2, 0.01, seed + 500);
      const auto at = [&](double s) -> Vector { return from + s * (to - from); };
      const auto evaluate = [&](double s) {
        auto element = each.law.element(h, {});
        element->move_to(at(s), each.fields, true);
        return element;
      };
      double low = 0, high = 1;
      if (evaluate(low)->piece() == evaluate(high)->piece()) continue;
      while (high - low > 1e-13)
        (evaluate(0.5 * (low + high))->piece() == evaluate(low)->piece() ? low : high) = 0.5 * (low + high);
      CAPTURE(each.law.directions(), seed, low);
      const MatrixXd jump = evaluate(high)->jacobian() - evaluate(low)->jacobian();
      const auto found = corners->near(at(low), each.fields, 1e-9);
      if (jump.norm() < 1e-3) continue;  // another reversal is the highest one
      REQUIRE(found.size() == 1);
      guards.insert(found[0].guard);
      ++jumps;
      const auto angles = static_cast<int>(found[0].angles.size());
      elements::Corners::Equations equations(from.size(), angles,
                                             static_cast<Eigen::Index>(each.fields.size()));
      corners->equations(found[0], at(low), each.fields, equations);
      CHECK(equations.values.cwiseAbs().maxCoeff() < 1e-8);
      const Eigen::RowVectorXd dh =
          equations.by_motion.row(0) - equations.by_angle.row(0) *
                                           equations.by_angle.bottomRows(angles).inverse() *
                                           equations.by_motion.bottomRows(angles);
      const Eigen::JacobiSVD<MatrixXd> svd(jump, Eigen::ComputeThinU | Eigen::ComputeThinV);
      CHECK(svd.singularValues()[1] < 1e-6 * svd.singularValues()[0]);
      CHECK(std::abs(svd.matrixV().col(0).dot(dh.transpose())) > (1 - 1e-9) * dh.norm());
      const auto values = [&](const elements::Corner& corner, const Vector& u, const std::vector<double>& f) {
        elements::Corners::Equations there(u.size(), angles, static_cast<Eigen::Index>(f.size()));
        corners->equations(corner, u, f, there);
        return Vector(there.values);
      };
      CHECK((every_law::differences([&](const Vector& u) { return values(found[0], u, each.fields); },
                                    at(low), 1e-6) -
             equations.by_motion)
                .cwiseAbs()
                .maxCoeff() < 1e-7);
      CHECK((every_law::differences(
                 [&](const Vector& f) {
                   return values(found[0], at(low), {f.begin(), f.end()});
                 },
                 Eigen::Map<const Vector>(each.fields.data(), static_cast<Eigen::Index>(each.fields.size())),
                 1e-6) -
             equations.by_field)
                .cwiseAbs()
                .maxCoeff() < 1e-7);
      elements::Corner near = found[0];
      for (double& angle : near.angles) angle += 1e-3;
      REQUIRE(corners->polish(near, at(low), each.fields));
      CHECK(std::abs(near.angles[0] - found[0].angles[0]) < 1e-8);
    }
  }
  CHECK(jumps > 30);
  for (const int guard : {4, 5, 8, 9}) CHECK(guards.count(guard) == 1);
}

TEST_CASE(
    "a mass on a spring and a slider that sticks stands where its load, the spring and friction balance") {
  for (const double load : {0.0, 0.9, -0.9, 1.45, 1.6, -1.6, 5.0})
    for (const double amplitude : {0.02, 0.2, 1.0}) {
      const double w = 0.5, A = oscillation(amplitude, 1, w), mean = place(load, A, 1);
      CAPTURE(load, amplitude);
      const auto s = held(load, amplitude, 1);
      const auto point = at(s, w);
      CHECK(std::abs(point.coefficients[0] - mean) < 1e-12);
      CHECK(std::abs(point.amplitude - std::abs(mean) - A) < 1e-12);
      CHECK(std::abs(point.elements[0].mean_force_max - (1 - 2 * A)) < 1e-12);
      CHECK(std::abs(point.elements[0].mean_force_min + (1 - 2 * A)) < 1e-12);
      for (const auto method :
           {observables::TimeMethod::shooting, observables::TimeMethod::newmark_shooting}) {
        const auto motion = observables::motion_in_time(s, {.frequency = w, .method = method});
        REQUIRE(motion.status == observables::Status::complete);
        const bool exact = method == observables::TimeMethod::shooting;
        CHECK(std::abs(motion.amplitude - point.amplitude) < (exact ? 1e-11 : 1e-5));
      }
    }
}

TEST_CASE("over a load the place of a mass that friction helps to hold has the corners of its slider") {
  auto s = held(0, 0.2, 1);
  const double w = 0.5, A = oscillation(0.2, 1, w);
  const auto branches = observables::parameter_response(s, {"load.cosine", -3, 3, w});
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  CHECK(branches[0].points.size() > 5);
  for (const auto& point : branches[0].points) {
    CAPTURE(point.over);
    CHECK(std::abs(point.coefficients[0] - place(point.over, A, 1)) < 1e-9);
  }
}

TEST_CASE("once the slider slips in each period its offset does not matter") {
  for (const double load : {0.3, 2.0}) {
    const auto with_offset = at(held(load, 2, 1), 1.2), centred = at(held(load, 2, 1, "centred"), 1.2);
    CHECK(with_offset.elements[0].stick_percent < 95);
    CHECK(std::abs(with_offset.amplitude - centred.amplitude) < 1e-10);
    CHECK(std::abs(with_offset.elements[0].mean_force_max - with_offset.elements[0].mean_force_min) == 0);
  }
}

TEST_CASE("a body that friction alone holds under a load stands as on the spring of its contact") {
  const auto s = held(0.3, 0.1, 0);
  const double w = 0.7, A = oscillation(0.1, 0, w);
  const auto point = at(s, w);
  CHECK(std::abs(point.coefficients[0] - 0.15) < 1e-13);
  CHECK(std::abs(point.amplitude - 0.15 - A) < 1e-13);
  const auto motion = observables::motion_in_time(s, {.frequency = w});
  REQUIRE(motion.status == observables::Status::complete);
  CHECK(std::abs(motion.amplitude - 0.15 - A) < 1e-11);

  const auto refused = observables::frequency_response(held(0.3, 0.1, 0, "centred"), {0.5, 3});
  REQUIRE(refused.size() == 1);
  CHECK(refused[0].status == observables::Status::failed);
  CHECK(contains(refused[0].stop.message, "\"offset\": \"static\""));
  // Beyond what friction holds, and where it begins to slip in resonance.
  const auto beyond = observables::frequency_response(held(1.3, 0.1, 0), {0.5, 3});
  REQUIRE(beyond.size() == 1);
  CHECK(beyond[0].status == observables::Status::failed);
  CHECK(contains(beyond[0].stop.message, "only friction holds the mean position of \"x\""));
  const auto slips = observables::frequency_response(held(0.3, 0.5, 0), {0.5, 3});
  REQUIRE_FALSE(slips.empty());
  CHECK(slips[0].status != observables::Status::complete);
  CHECK(contains(slips[0].stop.message, "only friction holds the mean position of \"x\""));
}

TEST_CASE("the offset is an option of the elements that have it, and written with its default") {
  const auto s = held(0.3, 0.1, 1), centred = held(0.3, 0.1, 1, "centred");
  CHECK(scenes::parse(scene::write(s)) == s);
  CHECK_FALSE(s == centred);
  CHECK(contains(scene::write(centred), "\"offset\": \"centred\""));
  try {
    held(0.3, 0.1, 1, "mean");
    FAIL("no fault");
  } catch (const scene::SceneError& error) {
    CHECK(contains(error.what(), "\"static\""));
  }
}

TEST_CASE("a law without a static offset refuses one, and says what holds a mean force instead") {
  const auto fault = [](const std::string& element) {
    try {
      scenes::parse(R"({"format": "arcslip-scene-1", "structure": {"dofs": ["x", "y", "n"],
        "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 1},
                   {"name": "mn", "at": "n", "value": 1}],
        "springs": [{"name": "kx", "at": "x", "value": 1}]}, "response": {"at": "x"},
        "elements": [{"name": "j", )" +
                    element + R"(}], "excitation": [{"name": "f", "at": "x", "cosine": 1}]})");
    } catch (const scene::SceneError& error) {
      REQUIRE(error.faults().size() == 1);
      CHECK(error.faults()[0].pointer == "/elements/0/offset");
      return error.faults()[0].message;
    }
    return std::string("none");
  };
  const std::string joint = R"("type": "iwan", "at": "x", "stiffness": 1, "slip_force": 1, "offset": )",
                    plane = R"("type": "contact_3d", "tangential_1": {"at": "x"}, "tangential_2": {"at": "y"},
    "normal": {"at": "n"}, "tangential_stiffness": 1, "normal_stiffness": 1, "friction_coefficient": 0.3,
    "normal_load": 1, "offset": )";
  for (const std::string& element : {joint, plane}) {
    CHECK(fault(element + R"("centred")") == "none");
    for (const char* other : {R"("static")", "0"}) {
      const std::string message = fault(element + other);
      CAPTURE(message);
      CHECK(contains(message, "found another offset than \"centred\", which"));
      CHECK(contains(message, "hold no mean force") != contains(message, "holds no mean force"));
      CHECK(contains(message, "where one is to be held, put elements of type \"jenkins\""));
    }
  }
}

TEST_CASE("from resonance to resonance friction holds a load, lets go where it slips, and holds it again") {
  const auto with_offset = observables::frequency_response(held(0.9, 0.6, 1), {0.5, 4}),
             centred = observables::frequency_response(held(0.9, 0.6, 1, "centred"), {0.5, 4});
  REQUIRE(with_offset.size() == 1);
  REQUIRE(centred.size() == 1);
  CHECK(with_offset[0].status == observables::Status::complete);
  int stuck = 0, slipping = 0;
  for (const auto& point : with_offset[0].points) {
    const double A = oscillation(0.6, 1, point.omega);
    CAPTURE(point.omega);
    if (2 * A < 1 - 1e-6) {
      ++stuck;
      CHECK(std::abs(point.coefficients[0] - place(0.9, A, 1)) < 1e-8);
    } else {
      ++slipping;
    }
  }
  CHECK(stuck > 10);
  CHECK(slipping > 10);
  REQUIRE(with_offset[0].events.size() == 1);
  REQUIRE(centred[0].events.size() == 1);
  CHECK(with_offset[0].events[0].point.elements[0].stick_percent < 99);
  CHECK(std::abs(with_offset[0].events[0].point.amplitude - centred[0].events[0].point.amplitude) < 1e-9);
}

TEST_CASE("the place that friction holds has its digits over twelve decades of stiffness and of load") {
  for (const double stiffness : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double limit : {1e-9, 1e-3, 1.0, 1e6})
      for (const double load : {0.0, 1e-6, 0.5, -2.0, 1e4}) {
        auto s = held(load, 1e-3, 1);
        scene::set(s, "d.stiffness", stiffness);
        scene::set(s, "d.normal_load", 2 * limit);
        const double w = 0.5, A = 1e-3 / std::hypot(1 + stiffness - w * w, 0.1 * w);
        if (stiffness * A > limit) continue;
        const double stuck = load / (1 + stiffness);
        const bool rests = stiffness * (std::abs(stuck) + A) <= limit;
        const double mean = rests ? stuck : load - std::copysign(limit - stiffness * A, load);
        CAPTURE(stiffness, limit, load);
        const auto point = at(s, w);
        // k_d (x - w) rounds in x, against a spring of 1 N/m.
        const double rounding = 1e-15 * stiffness * (std::abs(mean) + A);
        CHECK(std::abs(point.coefficients[0] - mean) <
              1e-12 * (std::abs(mean) + std::abs(load) + A) + rounding);
        CHECK(std::abs(point.amplitude - std::abs(mean) - A) < 1e-9 * (std::abs(mean) + A) + rounding);
      }
}

TEST_CASE("contacts that hold a mean force move as in time, one of constant and one of varying load") {
  // Both stick: the motion is linear, and exact in harmonics. One slips: N^-3.
  int mixed = 0;
  for (const double force : {0.15, 1.0, 1.2, 1.4, 1.6}) {
    std::ostringstream text;
    text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1.5}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.05}, {"name": "cab", "between": ["a", "b"], "value": 0.04}]},
    "elements": [
      {"name": "d", "type": "jenkins", "at": "a", "stiffness": 2, "friction_coefficient": 0.5, "normal_load": 1.6,
       "offset": "static"},
      {"name": "c", "type": "contact_2d", "tangential": {"at": "b"}, "normal": {"direction": {"a": 0.5, "b": 0.2}},
       "offset": "static", "tangential_stiffness": 1, "normal_stiffness": 0.6, "friction_coefficient": 0.5,
       "normal_load": 2.4}],
    "excitation": [{"name": "f", "at": "b", "cosine": )"
         << force << R"(}, {"name": "load", "at": "a", "harmonic": 0, "cosine": 1.6},
      {"name": "weight", "at": "b", "harmonic": 0, "cosine": -1.1},
      {"name": "base", "type": "base_acceleration", "sine": 0.05}],
    "harmonics": {"order": 31}, "response": {"at": "b"}})";
    const auto s = scenes::parse(text.str());
    const auto point = at(s, 0.6);
    const bool sticks = point.elements[0].stick_percent == 100 && point.elements[1].stick_percent == 100;
    CAPTURE(force, point.elements[0].stick_percent, point.elements[1].stick_percent);
    const bool both_slip = point.elements[0].stick_percent < 100 && point.elements[1].stick_percent < 100;
    CHECK((sticks || force > 0.5));
    if (!sticks && !both_slip) ++mixed;
    const auto motion = observables::motion_in_time(s, {.frequency = 0.6});
    REQUIRE(motion.status == observables::Status::complete);
    CHECK(std::abs(motion.amplitude / point.amplitude - 1) < (sticks ? 1e-10 : 1e-4));
    const auto centred = at(
        [&] {
          scene::Scene other = s;
          for (auto& element : other.elements) element.options = {};
          return other;
        }(),
        0.6);
    CHECK((both_slip || std::abs(point.amplitude / centred.amplitude - 1) > 0.01));
    for (std::size_t e = 0; e < 2; ++e) {
      const auto& element = point.elements[e];
      CHECK(element.mean_force_min <= element.mean_force_max);
    }
  }
  CHECK(mixed > 0);
}
