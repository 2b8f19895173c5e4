// What contacts tell: wear, normal loads, and the totals of patches.

#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/scene/patch.hpp>
#include <arcslip/studies/presentation/branches.hpp>
#include <arcslip/studies/presentation/motions.hpp>

#include <nlohmann/json.hpp>

#include <numbers>

using namespace arcslip;
using continuation::Vector;

namespace {

// A plate of two translations and a rotation on a patch of three contacts, one of them behind a gap.
scene::Scene plate(int order, bool details = true) {
  const Folder folder = {{"pad.csv",
                          "tangential,normal,area,pressure,gap\n"
                          "t + 0.01*r,n,2e-4,2e4,0\n"
                          "t + 0.01*r,n - 0.05*r,1e-4,5e4,0\n"
                          "t + 0.01*r,n + 0.05*r,1e-4,0,2e-5\n"}};
  std::istringstream text(
      R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    )" +
      scenes::uncoupled({{"t", 1, 1e4, 4}, {"n", 1, 2e4, 4}, {"r", 0.01, 200, 0.04}}) +
      R"(,
    "patches": [{"name": "pad", "law": "contact_2d", "file": "pad.csv", "tangential_stiffness": 3e7,
      "normal_stiffness": 4.5e7, "friction_coefficient": 0.4, "wear_coefficient": 1e-13, "details": )" +
      std::string(details ? "true" : "false") + R"(}],
    "excitation": [{"name": "f", "direction": {"t": 1, "n": 0.6, "r": 0.02}, "cosine": 20}],
    "response": {"at": "t"}, "harmonics": {"order": )" +
      std::to_string(order) + R"(}, "studies": [{"kind": "frf", "from": 80, "to": 120}]})");
  return scene::read(text, test_catalogue::whole(), folder.path());
}

scene::Scene by_elements(scene::Scene s) {
  s.elements = scene::all_elements(s);
  s.patches.clear();
  return s;
}

double power(const observables::ElementResponse& element, double omega) {
  return element.energy * omega / (2 * std::numbers::pi);
}

}  // namespace

TEST_CASE("a patch responds as its elements would without it") {
  const scene::Scene s = plate(9);
  for (const double omega : {85.0, 95.0, 110.0}) {
    const auto one = compared_with_exact::balanced(s, omega),
               other = compared_with_exact::balanced(by_elements(s), omega);
    CHECK((one.u - other.u).norm() < 1e-10 * one.u.norm());
  }
}

TEST_CASE("a response has derivatives by the parameters of a patch") {
  const auto pair = compared_with_exact::balanced(plate(5), 95);
  const auto at = pair.problem->hbm_evaluator();
  const auto& model = pair.problem->model();
  const auto residual = [&](const Vector& p) {
    REQUIRE(at->move_to(pair.u, p, continuation::Needs::residual) == continuation::Evaluated::ok);
    return Vector(at->residual());
  };
  for (const char* name : {"pad.tangential_stiffness", "pad.normal_stiffness", "pad.friction_coefficient",
                           "pad.pressure_factor"}) {
    CAPTURE(name);
    const int k = model::parameter_index(model, name);
    Vector by_parameter(pair.u.size());
    residual(pair.p);
    at->parameter_derivative(k, by_parameter);
    const double h = 1e-6 * pair.p[k];
    Vector more = pair.p, less = pair.p;
    more[k] += h;
    less[k] -= h;
    const Vector expected = (residual(more) - residual(less)) / (2 * h);
    CHECK(expected.norm() > 0);
    CHECK((by_parameter - expected).norm() < 1e-6 * expected.norm());
  }
}

TEST_CASE("the totals of a patch are those of its elements") {
  const scene::Scene s = plate(5);
  const auto found = observables::point_responses(s, {.frequency = 95, .steps = 100'000});
  REQUIRE(found.size() == 1);
  const observables::ResponsePoint& point = found[0].point;
  REQUIRE(point.elements.size() == 3);
  REQUIRE(point.patches.size() == 1);
  const observables::ElementResponse& total = point.patches[0];
  const double areas[] = {2e-4, 1e-4, 1e-4};
  double energy = 0, stick = 0, open = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    energy += point.elements[i].energy;
    stick += areas[i] * point.elements[i].stick_percent / 4e-4;
    open += areas[i] * point.elements[i].open_percent / 4e-4;
  }
  CHECK(total.name == "pad");
  CHECK(total.energy == Approx(energy).epsilon(1e-14));
  CHECK(total.energy == Approx(point.energy_friction).epsilon(1e-14));
  CHECK(total.stick_percent == Approx(stick).epsilon(1e-14));
  CHECK(total.open_percent == Approx(open).epsilon(1e-14));
  CHECK(open > 1);
  CHECK(stick > 1);
  CHECK(total.wear_rate == Approx(1e-13 * power(total, point.omega)).epsilon(1e-14));

  double stick_min = 100, pressure = 0, per_area = 0, depth = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    stick_min = std::min(stick_min, point.elements[i].stick_percent);
    pressure = std::max(pressure, point.elements[i].normal_load_max / areas[i]);
    per_area = std::max(per_area, point.elements[i].energy / areas[i]);
    depth = std::max(depth, point.elements[i].wear_rate / areas[i]);
  }
  CHECK(total.extremes.stick_percent_min == stick_min);
  CHECK(total.extremes.stick_percent_min < total.stick_percent);
  CHECK(total.extremes.pressure_max == pressure);
  CHECK(total.extremes.pressure_max > 1.1 * total.normal_load_max / 4e-4);
  CHECK(total.extremes.energy_per_area_max == per_area);
  CHECK(total.extremes.wear_depth_rate_max == depth);
  CHECK(depth == Approx(1e-13 * per_area * point.omega / (2 * std::numbers::pi)).epsilon(1e-12));

  // The normal load at many instants, from the histories of its forces.
  const double at_rest[] = {4, 5, 0};
  double most = 0, least = 1e9;
  for (std::size_t k = 0; k < found[0].history.angle.size(); ++k) {
    double load = 0;
    for (std::size_t i = 0; i < 3; ++i) load += at_rest[i] + found[0].history.elements[i].further[0].force[k];
    most = std::max(most, load);
    least = std::min(least, load);
  }
  CHECK(least < most);
  CHECK(total.normal_load_max == Approx(most).epsilon(1e-7));
  CHECK(total.normal_load_min == Approx(least).epsilon(1e-7));
  CHECK(total.normal_load_max >= most * (1 - 1e-13));
  CHECK(total.normal_load_min <= least * (1 + 1e-13));
}

TEST_CASE("a march in time says what harmonics tell of contacts") {
  const scene::Scene s = plate(55);
  const auto found = observables::point_responses(s, {.frequency = 95});
  REQUIRE(found.size() == 1);
  const observables::ResponsePoint& point = found[0].point;
  for (const auto method : {observables::TimeMethod::shooting, observables::TimeMethod::newmark_shooting}) {
    const bool exact = method == observables::TimeMethod::shooting;
    const auto motion =
        observables::motion_in_time(s, {.frequency = 95, .method = method, .steps = exact ? 1000 : 4000});
    REQUIRE(motion.status == observables::Status::complete);
    REQUIRE(motion.elements.size() == 3);
    REQUIRE(motion.patches.size() == 1);
    const double tolerance = exact ? 3e-5 : 2e-3;
    const auto check = [&](const observables::ElementMotion& a, const observables::ElementResponse& b) {
      CHECK(a.name == b.name);
      CHECK(a.normal_load_max == Approx(b.normal_load_max).epsilon(tolerance));
      CHECK(std::abs(a.normal_load_min - b.normal_load_min) < tolerance * b.normal_load_max);
      CHECK(a.wear_rate == Approx(b.wear_rate).epsilon(tolerance));
      CHECK(std::abs(a.stick_percent - b.stick_percent) < 100 * tolerance);
      CHECK(std::abs(a.open_percent - b.open_percent) < 100 * tolerance);
      CHECK(a.normal_load_min < a.normal_load_max);
      CHECK(std::isnan(a.extremes.pressure_max) == std::isnan(b.extremes.pressure_max));
    };
    for (std::size_t i = 0; i < 3; ++i) check(motion.elements[i], point.elements[i]);
    check(motion.patches[0], point.patches[0]);
    const observables::ContactExtremes &over_contacts = motion.patches[0].extremes,
                                       &expected = point.patches[0].extremes;
    CHECK(std::abs(over_contacts.stick_percent_min - expected.stick_percent_min) < 100 * tolerance);
    CHECK(over_contacts.pressure_max == Approx(expected.pressure_max).epsilon(tolerance));
    CHECK(over_contacts.energy_per_area_max == Approx(expected.energy_per_area_max).epsilon(tolerance));
    CHECK(over_contacts.wear_depth_rate_max == Approx(expected.wear_depth_rate_max).epsilon(tolerance));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& load = motion.history.elements[i].normal_load;
      REQUIRE(load.size() == motion.history.time.size());
      const auto [least, most] = std::minmax_element(load.begin(), load.end());
      CHECK(*most == Approx(motion.elements[i].normal_load_max).epsilon(1e-3));
      CHECK(*most <= motion.elements[i].normal_load_max);
      CHECK(*least >= motion.elements[i].normal_load_min);
    }
  }
}

TEST_CASE("the extremes of a normal load in contact are those of a linear oscillator") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["t", "n"],
      "masses": [{"name": "m_t", "at": "t", "value": 1}, {"name": "m_n", "at": "n", "value": 2}],
      "springs": [{"name": "s_t", "at": "t", "value": 1e4}, {"name": "s_n", "at": "n", "value": 2e4}],
      "dampers": [{"name": "d_t", "at": "t", "value": 2}, {"name": "d_n", "at": "n", "value": 3}]},
    "elements": [{"name": "pad", "type": "contact_2d", "tangential": {"at": "t"}, "normal": {"at": "n"},
      "tangential_stiffness": 6e3, "normal_stiffness": 9e3, "friction_coefficient": 0.4, "normal_load": 80}],
    "response": {"at": "n"}, "excitation": [{"name": "f", "at": "n", "cosine": 5, "sine": 7}],
    "harmonics": {"order": 3}, "studies": []})");
  const double w = 95, swing = 9e3 * std::hypot(5, 7) / std::hypot(2.9e4 - 2 * w * w, 3 * w);
  const auto exact = observables::motion_in_time(s, {.frequency = w});
  REQUIRE(exact.integrator == "event-driven");
  CHECK(exact.elements.at(0).normal_load_max == Approx(80 + swing).epsilon(1e-10));
  CHECK(exact.elements.at(0).normal_load_min == Approx(80 - swing).epsilon(1e-10));
  const auto stepped = observables::motion_in_time(
      s, {.frequency = w, .method = observables::TimeMethod::newmark_shooting, .steps = 2000});
  CHECK(stepped.elements.at(0).normal_load_max == Approx(80 + swing).epsilon(1e-5));
  CHECK(stepped.elements.at(0).normal_load_min == Approx(80 - swing).epsilon(1e-5));
  for (std::size_t i = 0; i < exact.history.time.size(); ++i)
    CHECK(exact.history.elements[0].normal_load[i] ==
          Approx(80 + 9e3 * exact.history.displacement[i]).epsilon(1e-12));
  // Two harmonics, whose extremes lie where no sample is: the march finds them.
  s.harmonics.order = 5;
  s.excitation.push_back(s.excitation[0]);
  s.excitation[1].name = "g";
  s.excitation[1].harmonic = 3;
  const auto two = observables::motion_in_time(s, {.frequency = w, .steps = 3});
  const auto balanced = observables::point_responses(s, {.frequency = w});
  CHECK(two.elements.at(0).normal_load_max ==
        Approx(balanced[0].point.elements[0].normal_load_max).epsilon(1e-9));
  CHECK(two.elements.at(0).normal_load_min ==
        Approx(balanced[0].point.elements[0].normal_load_min).epsilon(1e-9));
}

TEST_CASE("the wear rate is the coefficient times the power of the loop") {
  // One mass: between its extremes +-A the loop of a slider has the area 4 mu N (A - mu N/k).
  scene::Scene s = scenes::paper(9, 3);
  const double stiffness = scene::value(s, "damper.stiffness"),
               most = scene::value(s, "damper.friction_coefficient") * 3;
  const double hertz = 20;
  CHECK(std::isnan(scenes::response_at(s, hertz).elements[0].wear_rate));
  s.elements[0].wear_coefficient = 2e-13;
  const auto point = scenes::response_at(s, hertz);
  const double energy = 4 * most * (point.amplitude - most / stiffness);
  CHECK(point.elements[0].wear_rate == Approx(2e-13 * energy * hertz).epsilon(1e-9));
  // Per second, whatever a period is.
  s.harmonics.period = 3;
  s.harmonics.order = 27;
  CHECK(scenes::response_at(s, hertz).elements[0].wear_rate ==
        Approx(point.elements[0].wear_rate).epsilon(1e-9));
  s.harmonics = {.order = 101};
  const auto motion = observables::motion_in_time(s, {.frequency = hertz});
  CHECK(motion.elements.at(0).wear_rate ==
        Approx(scenes::response_at(s, hertz).elements[0].wear_rate).epsilon(1e-5));
}

TEST_CASE("a design may limit the wear of an element and of a patch") {
  scene::Scene s = scenes::paper(5, 3);
  s.elements[0].wear_coefficient = 2e-13;
  const double least = 1.2e-14;  // at the least amplitude it is 1.1e-14
  const optimize::OptimumProblem problem{
      {{"damper.normal_load", 0.1, 10}}, 18, 22, {{.observable = "damper.wear_rate", .at_least = least}}};
  const auto found = optimize::optimum(s, problem);
  CAPTURE(found.stop.message);
  REQUIRE(found.feasible);
  CHECK(found.point.elements[0].wear_rate == Approx(least).epsilon(1e-5));
  s.elements[0].wear_coefficient = 0;
  CHECK_THROWS_AS(optimize::optimum(s, problem), optimize::OptionsError);

  const optimize::OptimumProblem of_patch{
      {{"pad.pressure_factor", 0.5, 2}}, 80, 120, {{.observable = "pad.wear_rat", .at_most = 1}}};
  try {
    optimize::optimum(plate(1), of_patch);
    FAIL();
  } catch (const optimize::OptionsError& error) {
    CHECK(contains(error.what(), "did you mean \"pad.wear_rate\"?"));
  }
}

TEST_CASE("results have the totals of a patch, and its elements only with details") {
  for (const bool details : {true, false}) {
    const scene::Scene s = plate(3, details);
    const auto branches = observables::frequency_response(s, scenes::window(s));
    std::stringstream text;
    results::write_json(text, studies::results_of(s, branches));
    const auto json = nlohmann::json::parse(text.str())["branches"][0];
    REQUIRE(json["points"].size() > 3);
    for (const char* list : {"points", "events"})
      for (const auto& point : json[list]) {
        CHECK(point["elements"].size() == (details ? 3 : 0));
        const auto& total = point["patches"]["pad"];
        CHECK(total.contains("stick_estimate") == (list == std::string("events")));
        CHECK(total.size() - total.count("stick_estimate") == observables::patch_quantities().size() - 1);
        CHECK(total["energy"] == point["energy_friction"]);
        if (!details) continue;
        CHECK(point["elements"]["pad.2"]["normal_load_max"].get<double>() > 5);
      }
    std::stringstream csv;
    results::write_csv(csv, studies::results_of(s, branches), "points");
    const std::string header = csv.str().substr(0, csv.str().find('\n'));
    CHECK((header.find("pad.3.energy") != std::string::npos) == details);
    CHECK(header.find("patches.pad.normal_load_max") != std::string::npos);

    const std::vector motions{observables::motion_in_time(s, {.frequency = 95, .steps = 50})};
    std::stringstream in_time;
    results::write_json(in_time, studies::results_of(s, motions));
    const auto motion = nlohmann::json::parse(in_time.str())["motions"][0];
    CHECK(motion["elements"].size() == (details ? 3 : 0));
    CHECK(motion["history"].contains("elements") == details);
    if (details) CHECK(motion["history"]["elements"]["pad.1"]["normal_load"].size() == 51);
    CHECK(motion["patches"]["pad"].size() == 10);
  }
}
