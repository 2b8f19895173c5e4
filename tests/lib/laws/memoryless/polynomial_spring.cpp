#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/laws/memoryless/polynomial_spring.hpp>
#include <arcslip/scene/format/json_schema.hpp>

#include <cmath>

using namespace arcslip;
using namespace arcslip::elements;

namespace {

// One mass on a spring k of stiffness, with elements and forces.
scene::Scene oscillator(const std::string& elements, const std::string& forces, double k = 1) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": )" +
                       std::to_string(k) + R"(}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [)" + elements +
                       R"(], "excitation": [)" + forces + R"(], "harmonics": {"order": 9},
    "studies": [{"name": "frf", "kind": "frf", "from": 0.5, "to": 2}]})");
}
const std::string force = R"({"name": "f", "at": "x", "cosine": 0.3})";
std::string spring(const std::string& coefficients) {
  return R"({"name": "s", "type": "polynomial_spring", "at": "x", "coefficients": )" + coefficients + "}";
}

}  // namespace

TEST_CASE("powers of a cosine have binomial coefficients, without aliasing into the few harmonics kept") {
  for (int power = 1; power <= 9; ++power)
    for (const int order : {1, 2, 3, 12})
      for (const bool odd : {false, true}) {
        if (odd && power % 2 == 0) continue;
        const Harmonics h{order, odd};
        const auto law = polynomial_spring().law(polynomial_powers({power}));
        CHECK(law->antisymmetric() == (power % 2 == 1));
        const auto element = law->element(h, {});
        Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size()), expected = u;
        u[h.cosine_index(1)] = 1.5;
        // cos^g = 2^(1-g) sum over k = g, g-2, ... of binomial(g, (g-k)/2) cos k theta; half of it for k = 0
        double binomial = 1;
        for (int j = 0; 2 * j <= power; ++j) {
          const int k = power - 2 * j;
          if (h.has(k))
            expected[h.cosine_index(k)] =
                0.7 * std::pow(1.5, power) * std::pow(2, 1 - power) * binomial * (k == 0 ? 0.5 : 1);
          binomial *= static_cast<double>(power - j) / (j + 1);
        }
        element->move_to(u, std::array{0.7}, true);
        CAPTURE(power, order, odd);
        CHECK((element->force() - expected).norm() < 1e-13 * std::pow(1.5, power));
        CHECK((element->jacobian() * u - power * expected).norm() < 1e-12 * std::pow(1.5, power));
      }
}

TEST_CASE("a cubic spring about the place where a constant force holds it is a polynomial of three powers") {
  // k (d + y) + k3 (d + y)^3 = F + ..., with F = k d + k3 d^3
  const double k3 = 0.4, d = 0.5;
  const auto number = [](double value) { return scene::file::json_text(scene::file::node(value)); };
  const scene::Scene whole = oscillator(
      R"({"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 0.4})",
      force + R"(, {"name": "g", "at": "x", "harmonic": 0, "cosine": )" + number(d + k3 * d * d * d) + "}");
  const scene::Scene about = oscillator(spring(R"({"1": )" + number(3 * k3 * d * d) + R"(, "2": )" +
                                               number(3 * k3 * d) + R"(, "3": )" + number(k3) + "}"),
                                        force);
  for (const double w : {0.6, 1.1, 1.3, 1.7}) {
    const auto a = observables::point_responses(whole, {.frequency = w});
    const auto b = observables::point_responses(about, {.frequency = w});
    REQUIRE(a.size() == b.size());
    REQUIRE(!a.empty());
    for (std::size_t i = 0; i < a.size(); ++i) {
      REQUIRE(a[i].point.coefficients.size() == b[i].point.coefficients.size());
      CHECK(std::abs(a[i].point.coefficients[0] - d - b[i].point.coefficients[0]) < 1e-11);
      for (std::size_t c = 2; c < a[i].point.coefficients.size(); ++c)
        CHECK(std::abs(a[i].point.coefficients[c] - b[i].point.coefficients[c]) < 1e-11);
    }
  }
}

TEST_CASE("the linear coefficient alone is a spring, in harmonics and exactly in time") {
  const scene::Scene ours = oscillator(spring(R"({"1": 0.6})"), force);
  const scene::Scene theirs = oscillator("", force, 1.6);
  const auto a = observables::point_responses(ours, {.frequency = 1.2});
  const auto b = observables::point_responses(theirs, {.frequency = 1.2});
  REQUIRE(a.size() == 1);
  CHECK(std::abs(a[0].point.amplitude - b[0].point.amplitude) < 1e-14);
  const observables::TimeSettings exactly{.frequency = 1.2, .method = observables::TimeMethod::event_driven};
  const auto motion = observables::motion_in_time(ours, exactly);
  REQUIRE(motion.status == observables::Status::complete);
  CHECK(std::abs(motion.amplitude - observables::motion_in_time(theirs, exactly).amplitude) < 1e-12);
  const auto cubed =
      observables::motion_in_time(oscillator(spring(R"({"1": 0.6, "3": 0.1})"), force), exactly);
  CHECK(cubed.status == observables::Status::failed);
  CHECK(cubed.stop.message.find("piecewise linear") != std::string::npos);
}

TEST_CASE("Newmark's steps come to the response of harmonic balance at second order, with even powers, too") {
  const scene::Scene s = oscillator(spring(R"({"2": 0.4, "5": 0.3})"), force);
  const auto responses = observables::point_responses(s, {.frequency = 0.7});
  REQUIRE(responses.size() == 1);
  double last = 0, last_defect = 0;
  for (const int steps : {200, 400, 800}) {
    const auto motion = observables::motion_in_time(
        s, {.frequency = 0.7, .method = observables::TimeMethod::newmark_shooting, .steps = steps});
    REQUIRE(motion.status == observables::Status::complete);
    const double error = std::abs(motion.amplitude / responses[0].point.amplitude - 1);
    if (last > 0) CHECK(error == Approx(0.25 * last).epsilon(0.1));
    const double defect = std::abs(motion.energy.defect());
    if (last > 0) CHECK(defect == Approx(0.25 * last_defect).epsilon(0.1));
    last = error;
    last_defect = defect;
  }
  CHECK(last < 1e-4);
  CHECK(last_defect < 1e-6);
}

TEST_CASE("coefficients of the powers in a scene are parameters, which are set, followed and written") {
  const scene::Scene s = oscillator(spring(R"({"3": 0.7, "2": 0.1})"), force);
  CHECK(scene::value(s, "s.c2") == 0.1);
  CHECK(scene::value(s, "s.c3") == 0.7);
  CHECK_THROWS_AS(scene::value(s, "s.c4"), scene::ParameterError);
  CHECK(scene::parameter_field(s, "s.c3").unit == "N/m^3");
  CHECK(scenes::parse(scene::write(s)) == s);
  scene::Scene changed = s;
  scene::set(changed, "s.c3", 0.4);
  CHECK(scene::write(changed).find(R"("coefficients": {"2": 0.1, "3": 0.4})") != std::string::npos);
  CHECK(scenes::parse(scene::write(changed)) == changed);
  CHECK(scene::hash(changed) != scene::hash(s));
  scene::check(changed);
  CHECK(scene::hash(oscillator(spring(R"({"2": 0.1, "3": 0.4})"), force)) == scene::hash(changed));
  CHECK(scene::json_schema(test_catalogue::whole()).find("\"coefficients\"") != std::string::npos);

  // What a scene in code says.
  scene::Scene built = s;
  built.elements[0].options = polynomial_powers({3, 2});
  CHECK(built == s);
  for (const auto& wrong : {std::vector{0}, {10}, {3, 3}})
    CHECK_THROWS_AS(polynomial_powers(wrong), std::invalid_argument);
}

TEST_CASE("coefficients of a polynomial that cannot be are reported where they stand") {
  for (const auto& [coefficients, fault] :
       {std::pair{std::string(R"({"0": 1})"),
                  R"(/elements/0/coefficients/0: found the power "0", must be an integer from 1 to 9)"},
        {R"({"10": 1})", R"(found the power "10", must be an integer from 1 to 9)"},
        {R"({"2.5": 1})", R"(found the power "2.5", must be an integer from 1 to 9)"},
        {R"({"x": 1, "2": 1})", R"(/elements/0/coefficients/x: found the power "x")"},
        {"{}", "/elements/0/coefficients: found an empty object, must be an object with a coefficient"},
        {"[1, 2]", "/elements/0/coefficients: found a list, must be an object with a coefficient"},
        {R"({"2": "a"})", "/elements/0/coefficients/2: column 1: found the unknown name \"a\""},
        {R"({"2": 1e999})", "/elements/0/coefficients/2: found 1e999"},
        {R"({"2": 1, "2": 2})", "found the key \"2\""},
        {R"({"2": 1}, "c2": 3)", "/elements/0/c2: found the unknown key \"c2\""}}) {
    CAPTURE(coefficients);
    CHECK_THROWS_WITH(oscillator(spring(coefficients), force), Catch::Matchers::Contains(fault));
  }
  CHECK_THROWS_WITH(oscillator(R"({"name": "s", "type": "polynomial_spring", "at": "x"})", force),
                    Catch::Matchers::Contains("found no key \"coefficients\", which is required"));
}

TEST_CASE("a polynomial spring keeps numbers where amplitudes are extreme") {
  const Harmonics h{5, false};
  const auto law = polynomial_spring().law(polynomial_powers({1, 2, 9}));
  const auto element = law->element(h, {});
  for (const double size : {0.0, 1e-300, 1e-30, 1e30}) {
    element->move_to(size * Eigen::VectorXd::Ones(h.size()), std::array{1.0, 1e-6, 1e12}, true);
    CHECK(element->force().allFinite());
    CHECK(element->jacobian().allFinite());
  }
}
