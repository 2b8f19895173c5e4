#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/every_law.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/laws/law_type.hpp>
#include <arcslip/scene/format/json_schema.hpp>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace arcslip;

namespace {

std::string number(double value) {
  return scene::file::json_text(scene::file::node(value));
}

// Two masses on springs of their own, with one element.
scene::Scene plane(const std::string& element) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1.4}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "at": "b", "value": 1.1},
                  {"name": "kab", "between": ["a", "b"], "value": 0.3}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.1}, {"name": "cb", "at": "b", "value": 0.1}]},
    "elements": [)" + element +
                       R"(], "excitation": [{"name": "f", "at": "a", "cosine": 0.3},
                                            {"name": "g", "at": "b", "harmonic": 2, "sine": 0.1}],
    "harmonics": {"order": 7}, "response": {"at": "a"},
    "studies": [{"name": "frf", "kind": "frf", "from": 0.4, "to": 2.5}]})");
}
std::string coupling(const std::string& potential, const std::string& places = "") {
  return R"({"name": "s", "type": "polynomial_coupling", "potential": )" + potential + places + "}";
}

void same_responses(const scene::Scene& one, const scene::Scene& other, double w) {
  const auto a = observables::point_responses(one, {.frequency = w});
  const auto b = observables::point_responses(other, {.frequency = w});
  REQUIRE(!a.empty());
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].status == observables::Status::complete);
    for (std::size_t c = 0; c < a[i].point.coefficients.size(); ++c)
      CHECK(std::abs(a[i].point.coefficients[c] - b[i].point.coefficients[c]) < 1e-11);
  }
}

}  // namespace

TEST_CASE("a cubic spring along a slanted direction is the gradient of a fourth power in two displacements") {
  const double angle = 0.7, c = std::cos(angle), n = std::sin(angle), k = 0.8;
  // V = k/4 (c a + n b)^4
  std::string potential = "[";
  const double binomial[] = {1, 4, 6, 4, 1};
  for (int j = 0; j <= 4; ++j) {
    const std::string a = R"("a": )" + std::to_string(4 - j), b = R"("b": )" + std::to_string(j);
    potential += std::string(j > 0 ? ", " : "") + R"({"powers": {)" +
                 (j == 4   ? b
                  : j == 0 ? a
                           : a + ", " + b) +
                 R"(}, "value": )" + number(k / 4 * binomial[j] * std::pow(c, 4 - j) * std::pow(n, j)) + "}";
  }
  const scene::Scene slanted = plane(R"({"name": "s", "type": "cubic_spring", "direction": {"a": )" +
                                     number(c) + R"(, "b": )" + number(n) + R"(}, "stiffness": 0.8})");
  for (const double w : {0.7, 1.1, 1.4}) same_responses(plane(coupling(potential + "]")), slanted, w);
}

TEST_CASE("the potential over a named place is a spring there, with all powers") {
  const scene::Scene ours =
      plane(coupling(R"([{"powers": {"d": 3}, "value": 0.1}, {"powers": {"d": 4}, "value": 0.2},
    {"powers": {"d": 2}, "value": 0.15}])",
                     R"(, "d": {"between": ["a", "b"]})"));
  const scene::Scene theirs = plane(R"({"name": "s", "type": "polynomial_spring", "between": ["a", "b"],
    "coefficients": {"1": 0.3, "2": 0.3, "3": 0.8}})");
  for (const double w : {0.7, 1.4}) same_responses(ours, theirs, w);
}

TEST_CASE("a coupling keeps what every law promises, and its Jacobian is symmetric") {
  const scene::Scene s = plane(coupling(R"([{"powers": {"a": 2, "b": 2}, "value": 0.5},
    {"powers": {"a": 1, "b": 2, "d": 1}, "value": -0.3}, {"powers": {"d": 3}, "value": 0.2}, {"powers": {"a": 10}, "value": 0.1},
    {"powers": {"a": 1, "d": 1}, "value": 0.4}])",
                                        R"(, "d": {"direction": {"a": 0.5, "b": 2}})"));
  const auto law = elements::law_of(s.elements[0]);
  REQUIRE(law->directions() == 3);
  CHECK_FALSE(law->antisymmetric());
  CHECK(elements::law_of(plane(coupling(R"([{"powers": {"a": 2, "b": 2}, "value": 0.5}])")).elements[0])
            ->antisymmetric());
  const std::vector<double>& fields = s.elements[0].values;
  every_law::check_step(*law, fields, 1, 1e-6, 1e-8, 11);
  every_law::check_energy(*law, fields, 0.7, 1e-4, 5);
  every_law::check_element(*law, fields, 0.5, false, 1e-6, 1e-7, 1e-6, 7);
  const elements::Harmonics h{4};
  const auto element = law->element(h, {});
  std::mt19937 bits(2);
  element->move_to(every_law::random(3 * h.size(), 0.7, bits), fields, true);
  Eigen::MatrixXd J = element->jacobian();
  for (int i = 0; i < 3; ++i) J.row(i * h.size()) *= 2;  // the mean's row stands for an integral over 2 pi
  CHECK((J - J.transpose()).norm() < 1e-12 * J.norm());
}

TEST_CASE("in time a coupling comes to the same response at second order, and keeps its energy") {
  const scene::Scene s = plane(coupling(R"([{"powers": {"a": 2, "b": 2}, "value": 0.5}])"));
  const auto responses = observables::point_responses(s, {.frequency = 0.8});
  REQUIRE(responses.size() == 1);
  double last = 0;
  for (const int steps : {200, 400, 800}) {
    const auto motion = observables::motion_in_time(
        s, {.frequency = 0.8, .method = observables::TimeMethod::newmark_shooting, .steps = steps});
    REQUIRE(motion.status == observables::Status::complete);
    const double error = std::abs(motion.amplitude / responses[0].point.amplitude - 1);
    if (last > 0) CHECK(error < 0.35 * last);
    CHECK(std::abs(motion.energy.defect()) < 1e-6);
    last = error;
  }
  CHECK(last < 1e-4);
}

TEST_CASE("the terms of a potential are parameters, which are set and written, with their places") {
  const scene::Scene s =
      plane(coupling(R"([{"powers": {"a": 2, "d": 2}, "value": 0.5}, {"powers": {"d": 3}, "value": 2}])",
                     R"(, "d": {"between": ["a", "b"]})"));
  CHECK(s.elements[0].directions.size() == 2);
  CHECK(scene::value(s, "s.v1") == 0.5);
  CHECK(scene::value(s, "s.v2") == 2);
  CHECK(scene::parameter_field(s, "s.v1").unit == "J/m^4");
  CHECK(scenes::parse(scene::write(s)) == s);
  scene::Scene changed = s;
  scene::set(changed, "s.v2", 3);
  CHECK(scenes::parse(scene::write(changed)) == changed);
  scene::check(changed);
  changed.elements[0].directions.pop_back();
  CHECK_THROWS_WITH(scene::check(changed),
                    "/elements/0: found 1 directions, must be 2 for the type \"polynomial_coupling\"");
  CHECK(scene::json_schema(test_catalogue::whole()).find("\"potential\"") != std::string::npos);
}

TEST_CASE("a potential that cannot be is reported where it stands") {
  for (const auto& [potential, fault] :
       {std::pair{std::string("[]"),
                  "/elements/0/potential: found a list of 0 terms, must be a list of at least one"},
        {"3", "/elements/0/potential: found 3 (a number), must be a list"},
        {R"([{"powers": {"a": 2}}])", "/elements/0/potential/0/value: found no key \"value\""},
        {R"([{"value": 2}])", "/elements/0/potential/0/powers: found no key \"powers\""},
        {R"([{"powers": {"a": 2}, "value": 1}, {"powers": {"a": 1}, "value": 1}])",
         "/elements/0/potential/1/powers: found powers of the sum 1, must have a sum from 2 to 10"},
        {R"([{"powers": {"a": 6, "b": 5}, "value": 1}])", "found powers of the sum 11"},
        {R"([{"powers": {"a": 1.5, "b": 5}, "value": 1}])", "/elements/0/potential/0/powers/a: found 1.5"},
        {R"([{"powers": {"x": 2}, "value": 1}])",
         "/elements/0/potential/0/powers/x: found \"x\", must be one of the degrees of freedom"},
        {R"([{"powers": {"type": 2}, "value": 1}])", "which is a key of the element"},
        {R"([{"powers": {"a": 2}, "value": "b"}])",
         "/elements/0/potential/0/value: column 1: found the unknown name \"b\""},
        {R"([{"powers": {"a": 2}, "value": 1}], "d": {"at": "a"})",
         "/elements/0/d: found the unknown key \"d\""},
        {R"([{"powers": {"a": 2}, "value": 1}], "at": "a")", "/elements/0/at: found the unknown key \"at\""},
        {R"([{"powers": {"d": 2}, "value": 1}], "d": {"at": "q"})", "/elements/0/d/at: found \"q\""}}) {
    CAPTURE(potential);
    CHECK_THROWS_WITH(plane(coupling(potential)), Catch::Matchers::Contains(fault));
  }
}

TEST_CASE("a potential of a thousand terms over eight displacements is read, and its force is its gradient") {
  std::mt19937 bits(3);
  std::uniform_int_distribution<int> place(0, 7), power(1, 3);
  std::string potential, places;
  for (int i = 0; i < 8; ++i)
    places += ", \"q" + std::to_string(i) + R"(": {"at": ")" + (i % 2 ? "a" : "b") + "\"}";
  for (int t = 0; t < 1000; ++t) {
    std::map<int, int> powers{{t % 8, power(bits)}};
    for (int k = 0; k < 2; ++k) powers[place(bits)] += 1;
    std::string of;
    for (const auto& [i, n] : powers)
      of += (of.empty() ? "\"q" : ", \"q") + std::to_string(i) + "\": " + std::to_string(n);
    potential += (t > 0 ? ", " : "") + (R"({"powers": {)" + of) + R"(}, "value": 0.001})";
  }
  const scene::Scene s = plane(coupling("[" + potential + "]", places));
  const auto law = elements::law_of(s.elements[0]);
  const std::vector<double> fields(1000, 0.001);
  const auto in_time = law->in_time(fields);
  const Eigen::VectorXd q = Eigen::VectorXd::Random(8), none(0);
  elements::StepEnd at(8, 0);
  Eigen::VectorXd z(0);
  in_time->begin(q, z, at);
  for (int i = 0; i < 8; ++i) {
    const Eigen::VectorXd d = 1e-5 * Eigen::VectorXd::Unit(8, i);
    CHECK(at.f[i] == Approx((in_time->stored(q + d, none) - in_time->stored(q - d, none)) / 2e-5)
                         .epsilon(1e-8)
                         .margin(1e-9));
  }
}
