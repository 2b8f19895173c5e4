// Rigid Coulomb friction, against Den Hartog's closed form.
#include "lib/laws/every_law.hpp"

#include "lib/hbm/scenes.hpp"
#include "random.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/laws/memoryless/coulomb.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/observables/energies.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip;
using namespace arcslip::elements;
using Eigen::VectorXd;
using std::numbers::pi;

namespace {

// m = k = 1, cos(r t): Den Hartog 1931, Eqs. 9 to 14. Friction is F_f/F, motions amplitudes over F/k. Between
// two reversals, x = X at theta = 0,
//   x = V cos(rt + phi) + f - f cos t - f s/(1 + c) sin t,  V = 1/(1 - r^2), c, s of pi/r,
// x(pi/r) = -X gives X = V cos phi, V sin phi = -f U; there x'' = -r^2 X - f before, and + f after.
struct DenHartog {
  double r, V = 1 / (1 - r * r), U = std::sin(pi / r) / (r * (1 + std::cos(pi / r)));
  double amplitude(double f) const { return std::sqrt(V * V - f * f * U * U); }
  double stops_from() const { return std::abs(V) / std::hypot(U, 1 / (r * r)); }  // r^2 X = f
};

std::string number(double value) {
  return scene::file::json_text(scene::file::node(value));
}
std::string rigid(double friction) {
  return R"("type": "coulomb", "friction_coefficient": 1, "normal_load": )" + number(friction);
}
std::string spring_and_slider(double friction, double stiffness) {
  return R"("type": "jenkins", "friction_coefficient": 1, "normal_load": )" + number(friction) +
         R"(, "stiffness": )" + number(stiffness);
}
scene::Scene oscillator(const std::string& element, int order, double damping = 0) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": )" +
                       number(damping) + R"(}]}, "elements": [{"name": "e", "at": "x", )" + element +
                       R"(}], "excitation": [{"name": "f", "at": "x", "cosine": 1}],
    "harmonics": {"order": )" +
                       std::to_string(order) +
                       R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 0.6, "to": 1.6}]})");
}

observables::ResponsePoint response(const std::string& element, int order, double r) {
  const auto found = observables::point_responses(oscillator(element, order), {.frequency = r});
  REQUIRE(found.size() == 1);
  CAPTURE(found[0].stop.message, order, r, element);
  REQUIRE(found[0].status == observables::Status::complete);
  return found[0].point;
}

}  // namespace

TEST_CASE("rigid friction keeps what every law promises in harmonics, with many reversals in a period") {
  for (unsigned seed = 1; seed < 40; ++seed)
    for (const bool odd : {false, true}) {
      CAPTURE(seed, odd);
      every_law::check_element(coulomb(), {0.7, 1.2}, 1, odd, 1e-7, 1e-6, 1e-3, seed);
    }
}

TEST_CASE("rigid friction dissipates mu N times the way, and its series is that of a square wave") {
  const Harmonics h{9, false};
  const auto element = coulomb().element(h, {});
  VectorXd u = VectorXd::Zero(h.size());
  u[h.cosine_index(1)] = 1.3;
  u[0] = 4;
  element->move_to(u, std::array{0.5, 3.0}, true);
  CHECK(observables::element_energy(h, u, element->force()) == Approx(1.5 * 4 * 1.3).epsilon(1e-14));
  for (int n = 1; n <= 9; ++n)  // -sgn sin theta
    CHECK(element->force()[h.sine_index(n)] == Approx(n % 2 == 1 ? -1.5 * 4 / (pi * n) : 0).margin(1e-14));
  CHECK(element->force().head(h.cosines()).norm() < 1e-14);
  CHECK(element->jump_over_bend() == Approx(1.5 / 1.3));
  // The size of the motion does not matter: J u = 0.
  CHECK((element->jacobian() * u).norm() < 1e-13);
}

TEST_CASE("with odd harmonics alone rigid friction is the same as with all") {
  const Harmonics odd{7, true}, all{7, false};
  std::srand(3);
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd u = VectorXd::Random(odd.size());
    VectorXd v = VectorXd::Zero(all.size()), F(all.size());
    transfer(odd, u, all, v);
    const auto a = coulomb().element(odd, {}), b = coulomb().element(all, {});
    a->move_to(u, std::array{0.5, 3.0}, true);
    b->move_to(v, std::array{0.5, 3.0}, true);
    transfer(odd, a->force(), all, F);
    CHECK((F - b->force()).norm() < 1e-12);
    VectorXd change(all.size());
    const VectorXd du = VectorXd::Random(odd.size());
    transfer(odd, a->jacobian() * du, all, F);
    transfer(odd, du, all, change);
    CHECK((F - b->jacobian() * change).norm() < 1e-10 * F.norm());
  }
}

TEST_CASE(
    "at the birth of two reversals the force of rigid friction is continuous, as the root of what is "
    "beyond") {
  // q' = -sin theta + a cos 2 theta has a double root for a = 1/... at theta = -pi/2: q' = 1 - a.
  const Harmonics h{2, false};
  const auto element = coulomb().element(h, {});
  const auto force = [&](double a) {
    VectorXd u = VectorXd::Zero(h.size());
    u[h.cosine_index(1)] = 1;
    u[h.sine_index(2)] = a / 2;
    element->move_to(u, std::array{1.0, 1.0}, true);
    CHECK(element->jacobian().allFinite());
    return VectorXd(element->force());
  };
  const VectorXd at = force(1);
  const auto before = element->piece();
  double last = 0;
  for (const double beyond : {1e-2, 1e-4, 1e-6}) {
    const double change = (force(1 + beyond) - at).norm();
    CHECK(element->piece() == before + 2);
    if (last > 0) CHECK(change / last == Approx(0.1).epsilon(0.02));
    last = change;
  }
}

TEST_CASE("rigid friction comes to Den Hartog's response without stops as 1/N") {
  const DenHartog exact{0.8};
  CHECK(exact.amplitude(0.3) == Approx(2.62610487572).epsilon(1e-11));
  // Friction of the harmonics above N moves the reversals of those kept: by the slope of the displacement
  // left out, 4 f/(pi r^2) sum n^-2 over odd n > N, near 2 f/(pi r^2 N), over x'' = r^2 X.
  for (const double friction : {0.1, 0.3, 0.6})
    for (const double r : {0.8, 1.3}) {
      double last = 0;
      for (const int order : {25, 51, 101, 201}) {
        const auto point = response(rigid(friction), order, r);
        const double error = std::abs(point.amplitude / DenHartog{r}.amplitude(friction) - 1);
        CAPTURE(friction, r, order, error, point.truncation_estimate / point.amplitude);
        CHECK_FALSE(point.truncation_flagged);
        CHECK(point.stops == "");
        if (last > 0) CHECK(last / error == Approx(2).epsilon(0.05));
        last = error;
        // The estimate is that of the harmonics up to 2 N + 9: half of an error that falls as 1/N.
        CHECK(point.truncation_estimate / point.amplitude == Approx(0.54 * error).epsilon(0.08));
      }
    }
}

TEST_CASE("at random frequencies and loads without stops rigid friction comes to Den Hartog's response") {
  test_random::Random random(1);
  for (int k = 0; k < 100; ++k) {
    const DenHartog exact{random.one_in(2) ? random.between(0.55, 0.95) : random.between(1.05, 3)};
    const double friction = random.between(0.02, 0.9) * exact.stops_from(),
                 amplitude = exact.amplitude(friction);
    const auto coarse = response(rigid(friction), 50, exact.r),
               fine = response(rigid(friction), 100, exact.r);
    CAPTURE(exact.r, friction, coarse.amplitude, fine.amplitude, amplitude);
    CHECK(coarse.stops == "");
    CHECK(fine.stops == "");
    CHECK((coarse.amplitude - amplitude) / (fine.amplitude - amplitude) == Approx(2).epsilon(0.03));
    CHECK(2 * fine.amplitude - coarse.amplitude == Approx(amplitude).epsilon(1e-4));  // 1/N^2
  }
}

TEST_CASE(
    "a stiff spring with a slider, and regularized friction, come to rigid friction of the same order") {
  const int order = 9;
  const double limit = response(rigid(0.3), order, 0.8).amplitude;
  // The spring sticks after a reversal for the time sqrt(4 f/(k x'')).
  double last = 0;
  for (const double stiffness : {1e5, 1e6, 1e7, 1e8}) {
    const double error = std::abs(response(spring_and_slider(0.3, stiffness), order, 0.8).amplitude - limit);
    CAPTURE(stiffness, error);
    if (last > 0) CHECK(last / error == Approx(std::sqrt(10.0)).epsilon(0.01));
    last = error;
  }
  // The force differs within v0 of rest and oddly in the velocity: only its slope in time counts.
  // Below, samples are too few.
  last = 0;
  for (const double v0 : {0.1, 0.05}) {
    const std::string regularized =
        R"("type": "tanh_friction", "friction_coefficient": 1, "normal_load": 0.3, "reference_velocity": )" +
        number(v0);
    const double error = std::abs(response(regularized, order, 0.8).amplitude - limit);
    CAPTURE(v0, error);
    if (last > 0) CHECK(last / error == Approx(4).epsilon(0.1));
    last = error;
  }
}

TEST_CASE("a motion that stops is distinguished from one that does not at Den Hartog's boundary") {
  int found_with_stops = 0;
  for (const double r : {0.6, 0.8, 1.2, 1.6}) {
    const double boundary = DenHartog{r}.stops_from();
    CAPTURE(r, boundary);
    const auto below = response(rigid(0.96 * boundary), 101, r);
    CHECK(below.stops == "");
    CHECK_FALSE(below.truncation_flagged);
    const auto above =
        observables::point_responses(oscillator(rigid(1.02 * boundary), 101), {.frequency = r});
    REQUIRE(above.size() == 1);
    if (above[0].status != observables::Status::complete) {
      CHECK(above[0].stop.reason == observables::reasons::start_failed);
      CHECK(above[0].stop.message.find("the friction of \"e\" has no stiffness") != std::string::npos);
      continue;
    }
    ++found_with_stops;
    CHECK(above[0].point.stops == "e");
    CHECK(above[0].point.truncation_flagged);
  }
  CHECK(found_with_stops >= 2);
}

TEST_CASE("a frequency response with rigid friction is followed to where the motion stops, and says so") {
  const double friction = 0.6;
  const auto branches = observables::frequency_response(oscillator(rigid(friction), 51), {1.2, 2.5});
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  double last = 0, first_stop = 10;
  for (const auto& point : branches[0].points) {
    if (!point.stops.empty()) {
      first_stop = std::min(first_stop, point.omega);
      continue;
    }
    last = std::max(last, point.omega);
    if (DenHartog{point.omega}.stops_from() > 1.05 * friction)
      CHECK(point.amplitude == Approx(DenHartog{point.omega}.amplitude(friction)).epsilon(0.04));
  }
  CHECK(last > 1.5);
  CHECK(DenHartog{last}.stops_from() == Approx(friction).epsilon(0.01));
  CHECK(DenHartog{first_stop}.stops_from() == Approx(friction).epsilon(0.01));
  CHECK(last < first_stop);
  const std::string doubt = studies::doubt_of(branches[0]);
  CAPTURE(doubt);
  CHECK(doubt.find("points \"e\" stops where its motion reverses") != std::string::npos);
}

TEST_CASE("where a branch of motions that stop cannot be followed, its friction is named") {
  const auto branches = observables::frequency_response(oscillator(rigid(0.7), 21, 0.05), {0.8, 2});
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::failed);
  REQUIRE_FALSE(branches[0].points.empty());
  CHECK(branches[0].points.back().stops == "e");
  CHECK(branches[0].stop.message.find("the friction of \"e\" has no stiffness: where it stops the motion") !=
        std::string::npos);
}

TEST_CASE("with stops rigid friction is flagged, and near the motion of a stiff spring and slider") {
  const double r = 0.5;
  const auto motion =
      observables::motion_in_time(oscillator(spring_and_slider(0.5, 1e7), 5), {.frequency = r});
  CAPTURE(motion.stop.message);
  REQUIRE(motion.status == observables::Status::complete);
  CHECK(motion.elements[0].stick_percent > 15);
  const auto point = response(rigid(0.5), 3, r);
  CHECK(point.stops == "e");
  CHECK(point.truncation_flagged);
  CHECK(point.amplitude == Approx(motion.amplitude).epsilon(0.012));
}

TEST_CASE("friction that holds a mass throughout is reported, without a response") {
  const auto found = observables::point_responses(oscillator(rigid(1.2), 9), {.frequency = 0.8});
  REQUIRE(found.size() == 1);
  CHECK(found[0].status == observables::Status::failed);
  CHECK(found[0].stop.message.find("give the contact a stiffness") != std::string::npos);
}

TEST_CASE("friction holds at once what has no mass of its own") {
  // A spring alone moves the slider: as it turns, the force falls short of the limit on the other side.
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}, {"name": "k2", "between": ["x", "y"], "value": 0.5}],
      "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "e", "at": "y", "type": "coulomb", "friction_coefficient": 0.5, "normal_load": 0.1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "harmonics": {"order": 1}, "response": {"at": "x"},
    "studies": [{"name": "frf", "kind": "frf", "from": 0.6, "to": 1.6}]})");
  const auto found = observables::point_responses(s, {.frequency = 0.8});
  REQUIRE(found.size() == 1);
  CAPTURE(found[0].stop.message);
  REQUIRE(found[0].status == observables::Status::complete);
  CHECK(found[0].point.stops == "e");
}

TEST_CASE("without a load, or at a constant place, rigid friction is nothing") {
  const auto free = response(rigid(0), 9, 0.8);
  CHECK(free.amplitude == Approx(1 / (1 - 0.64)).epsilon(1e-13));
  CHECK(free.stops == "");
  const Harmonics h{4, false};
  const auto element = coulomb().element(h, {});
  VectorXd u = VectorXd::Zero(h.size());
  for (const double place : {0.0, 3.0}) {
    u[0] = place;
    element->move_to(u, std::array{0.5, 3.0}, true);
    CHECK(element->force().norm() == 0);
    CHECK(element->jacobian().norm() == 0);
    CHECK(element->jump_over_bend() == 0);
  }
}

TEST_CASE("rigid friction keeps numbers at all amplitudes and loads, and its force does not depend on size") {
  const Harmonics h{5, false};
  const auto element = coulomb().element(h, {});
  std::srand(8);
  const VectorXd shape = VectorXd::Random(h.size());
  for (const double load : {1e-200, 1.0, 1e100}) {
    element->move_to(shape, std::array{0.5, load}, true);
    const VectorXd F = element->force();
    for (const double size : {1e-150, 1e-30, 1e30, 1e150}) {
      CAPTURE(load, size);
      element->move_to(size * shape, std::array{0.5, load}, true);
      CHECK((element->force() - F).cwiseAbs().maxCoeff() < 1e-10 * F.cwiseAbs().maxCoeff());
      CHECK(element->jacobian().allFinite());
      CHECK(std::isfinite(element->jump_over_bend()));
    }
  }
}

TEST_CASE("in time rigid friction is refused by every method, with a reason") {
  for (const auto method : {observables::TimeMethod::shooting, observables::TimeMethod::newmark_shooting,
                            observables::TimeMethod::newmark, observables::TimeMethod::event_driven}) {
    const auto motion =
        observables::motion_in_time(oscillator(rigid(0.3), 9), {.frequency = 0.8, .method = method});
    CHECK(motion.status == observables::Status::failed);
    CHECK(motion.stop.reason == observables::reasons::set_valued);
    CHECK(motion.stop.message.find("\"e\"") != std::string::npos);
  }
}

TEST_CASE("in a chain, what is reported to stop sticks as a stiff slider in time, and what is not does not") {
  const auto chain = [](const std::string& friction, double load, double between, int order) {
    const auto element = [&](const std::string& place, double value) {
      return place + R"(, "friction_coefficient": 1, "normal_load": )" + number(value) + friction + "}";
    };
    return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["a", "b", "c"],
        "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1.5},
                   {"name": "mc", "at": "c", "value": 0.7}],
        "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8},
                    {"name": "kbc", "between": ["b", "c"], "value": 1.2}, {"name": "kc", "at": "c", "value": 0.5}],
        "dampers": [{"name": "ca", "at": "a", "value": 0.03}, {"name": "cb", "at": "b", "value": 0.03},
                    {"name": "cc", "at": "c", "value": 0.03}]},
      "elements": [)" + element(R"({"name": "d1", "at": "a")", load) +
                         ", " + element(R"({"name": "d2", "between": ["b", "c"])", between) +
                         R"(, {"name": "j", "type": "jenkins", "at": "b", "stiffness": 0.5,
        "friction_coefficient": 0.5, "normal_load": 0.4}],
      "excitation": [{"name": "f", "at": "a", "cosine": 1}], "response": {"at": "a"},
      "harmonics": {"order": )" +
                         std::to_string(order) + R"(}, "studies": []})");
  };
  const struct {
    double load, between, omega;
  } all[] = {{0.1, 0.05, 0.4}, {0.1, 0.05, 0.6}, {0.1, 0.05, 0.9}, {0.1, 0.05, 1.2}, {0.1, 0.01, 1}};
  int stops = 0;
  for (const auto& each : all) {
    CAPTURE(each.load, each.between, each.omega);
    const auto motion = observables::motion_in_time(
        chain(R"(, "type": "jenkins", "stiffness": 1e6)", each.load, each.between, 5),
        {.frequency = each.omega});
    REQUIRE(motion.status == observables::Status::complete);
    const bool sticks = motion.elements[0].stick_percent > 1 || motion.elements[1].stick_percent > 1;
    const auto found = observables::point_responses(
        chain(R"(, "type": "coulomb")", each.load, each.between, 5), {.frequency = each.omega});
    REQUIRE(found.size() == 1);
    REQUIRE(found[0].status == observables::Status::complete);
    CHECK(!found[0].point.stops.empty() == sticks);
    CHECK(found[0].point.truncation_flagged == sticks);
    if (sticks) CHECK(found[0].point.stops == "d2");
    CHECK(found[0].point.amplitude == Approx(motion.amplitude).epsilon(sticks ? 0.03 : 0.002));
    stops += sticks ? 1 : 0;
  }
  CHECK(stops == 2);
}
