#include "catch.hpp"

#include "lib/laws/contact/contacts.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/fourier/series_maximum.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using continuation::Vector;

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
    const auto exact =
        observables::motion_in_time(contacts::line_pad(5, each.f_t, each.f_n), {.frequency = 95});
    REQUIRE(exact.status == observables::Status::complete);
    CHECK(exact.integrator == "event-driven");
    if (each.x_t > 0) CHECK(std::abs(exact.amplitude / each.x_t - 1) < 1e-8);
    CHECK(std::abs(exact.elements[0].stick_percent / 100 - each.stick) < 1e-9);
    CHECK(std::abs(exact.elements[0].open_percent / 100 - each.open) < 1e-9);
    const auto stepped = observables::motion_in_time(
        contacts::line_pad(5, each.f_t, each.f_n),
        {.frequency = 95, .method = observables::TimeMethod::newmark_shooting, .steps = 2000});
    REQUIRE(stepped.status == observables::Status::complete);
    CHECK(std::abs(stepped.amplitude / exact.amplitude - 1) < 1e-4);
    CHECK(std::abs(stepped.elements[0].stick_percent / 100 - each.stick) < 1e-3);
    CHECK(std::abs(stepped.elements[0].open_percent / 100 - each.open) < 1e-3);
    double last = 1;
    for (const int order : {3, 7, 15, 27, 55, 101}) {
      const auto balanced = compared_with_exact::balanced(contacts::line_pad(order, each.f_t, each.f_n), 95);
      elements::LargestValue largest(balanced.problem->harmonics());
      last = std::abs(largest.of(balanced.u.head(2 * order + 1)) / exact.amplitude - 1);
      CAPTURE(order, last);
      CHECK(last < 0.2 * std::pow(order, -3.0));
    }
    CHECK(last < each.error);
  }
}

TEST_CASE("a frequency response with stick, slip and separation is traced to its end, as the march has it") {
  scene::Scene s = contacts::line_pad(21, 20, 12);
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
    scene::Scene s = contacts::line_pad(9, 20 * factor, 12 * factor);
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
  scene::Scene s = contacts::line_pad(7, 20, 12);
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
  scene::Scene s = contacts::line_pad(5, 20, 12);
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
