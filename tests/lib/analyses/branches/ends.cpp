// How branches begin and end: starts that have no response, and windows that are not covered.

#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/reasons.hpp>

#include <cmath>

using namespace arcslip;

namespace {

std::vector<observables::ResponseBranch> branches_of(const scene::Scene& s) {
  return observables::frequency_response(s, scenes::window(s));
}

// Two masses, of which a slider alone holds the second one; a second harmonic brings in the mean.
scene::Scene held_by_friction() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "structure": {"dofs": ["a", "b"],
    "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1}],
    "springs": [{"name": "k", "at": "a", "value": 1e4}], "dampers": [{"name": "c", "at": "a", "value": 1}]},
    "elements": [{"name": "d", "type": "jenkins", "between": ["a", "b"], "stiffness": 5000,
      "friction_coefficient": 0.5, "normal_load": 1}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}, {"name": "g", "at": "a", "harmonic": 2, "cosine": 0.5}],
    "harmonics": {"order": 5}, "response": {"at": "a"}, "studies": [{"kind": "frf", "from": 10, "to": 12}]})");
}

bool says(const observables::ResponseBranch& branch, const std::string& text) {
  return branch.stop.message.find(text) != std::string::npos;
}

// One harmonic of a Duffing oscillator: ((k - m w^2 + 3/4 k3 A^2)^2 + (c w)^2) A^2 = f^2 with k = m = 1.
double duffing_defect(double omega, double amplitude, double damping, double cubic, double force) {
  const double stiffness = 1 - omega * omega + 0.75 * cubic * amplitude * amplitude;
  return std::hypot(stiffness, damping * omega) * amplitude / force - 1;
}

scene::Scene softening() {
  scene::Scene s = scenes::example("duffing");
  scene::set(s, "hardening.stiffness", -0.05);
  scene::set(s, "force.cosine", 0.1);
  s.harmonics.order = 1;
  return s;
}

}  // namespace

// A window that ends before the corner at which a step was to go on once left a corner without a tangent.
TEST_CASE("a mass that next to nothing holds has no response, or one that is a solution") {
  const auto branches = branches_of(scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k12", "between": ["x2", "x1"], "value": -1e-12}, {"name": "k2", "at": "x2", "value": 1}],
      "dampers": [{"name": "c12", "between": ["x2", "x1"], "value": 0.03},
                  {"name": "c2", "at": "x2", "value": 0.03}]},
    "elements": [{"name": "stop", "type": "gap_spring", "at": "x1", "two_sided": false, "stiffness": 100, "gap": 1}],
    "excitation": [{"name": "force", "at": "x2", "cosine": -100}], "harmonics": {"order": 7},
    "response": {"at": "x1"}, "studies": [{"kind": "frf", "from": 0.3, "to": 1}]})"));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].points.empty() == (branches[0].status == observables::Status::failed));
  CHECK(branches[0].stop.reason == observables::reasons::start_failed);
}

TEST_CASE("a mass whose mean only friction would hold is named, and what would hold it") {
  const auto branches = branches_of(held_by_friction());
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::failed);
  CHECK(branches[0].stop.reason == observables::reasons::start_failed);
  CHECK(branches[0].stop.value == 10);
  CHECK(branches[0].solver.linear_solver.empty());
  CHECK(says(branches[0], "no spring holds the mean position of \"b\""));
  CHECK(says(branches[0], "add a spring between it and the ground"));
}

TEST_CASE("a soft spring through others holds a mean, and odd harmonics have none") {
  scene::Scene linear = held_by_friction();
  linear.springs.push_back({"kb", &scene::spring_type(), {{{0, -1.0}, {1, 1.0}}}, {10}});
  scene::Scene odd = held_by_friction();
  odd.excitation.back().harmonic = 3;
  for (const auto& s : {linear, odd}) CHECK(branches_of(s)[0].status == observables::Status::complete);
}

TEST_CASE("a cubic spring holds a mean unless its stiffness is zero") {
  scene::Scene s = held_by_friction();
  s.elements.push_back({"kc", &elements::cubic_spring(), {{{1, 1.0}}}, {1e9}});
  for (const bool stiff : {true, false}) {
    if (!stiff) scene::set(s, "kc.stiffness", 0);
    const auto model = std::make_shared<const model::Model>(model::build(s));
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    CHECK(model::drifting_dof(*model, hbm::parameters_at(problem, 60)).has_value() != stiff);
  }
}

TEST_CASE("two masses that only hold each other drift") {
  scene::Scene s = held_by_friction();
  s.dofs.push_back("c");
  s.masses.push_back({"mc", &scene::mass_type(), {{{2, 1.0}}}, {1e-3}});
  s.springs.push_back({"kbc", &scene::spring_type(), {{{1, 1.0}, {2, -1.0}}}, {1e4}});
  const auto branches = branches_of(s);
  CHECK(branches[0].stop.reason == observables::reasons::start_failed);
  CHECK(says(branches[0], "holds the mean position of"));
}

TEST_CASE("a window that begins on an unbounded resonance begins with its peak") {
  const double resonance = std::sqrt(17890 / 1.24) / scenes::hertz;
  for (double off : {0.0, 1e-12, -1e-12, 1e-9, -1e-9, -1e-6})
    for (double load : {0.0, 1.0, 1.5}) {
      scene::Scene s = scenes::paper(7, load);
      scene::set(s, "c.value", 0);
      scenes::window(s).from = resonance * (1 + off);
      const auto branches = branches_of(s);
      CAPTURE(off, load);
      REQUIRE(branches.size() == 2);
      CHECK(branches[0].status == observables::Status::complete);
      CHECK(branches[0].stop.reason == observables::reasons::unbounded);
      REQUIRE(branches[0].events.size() == 1);
      CHECK(branches[0].events[0].point.unbounded);
      CHECK(reference::error(branches[0].events[0].point.omega / scenes::hertz, resonance) < 1e-7);
      CHECK(branches[1].stop.reason == observables::reasons::boundary);
      CHECK(branches[1].events.empty());
      CHECK(branches[0].parent == 0);
      CHECK(branches[1].parent == 1);
    }
}

TEST_CASE("a window that begins on an undamped resonance that friction bounds begins with a response") {
  scene::Scene s = scenes::paper(7, 1.6);  // pi f0/(4 mu) = 1.5708 N bounds it
  scene::set(s, "c.value", 0);
  scenes::window(s).from = std::sqrt(17890 / 1.24) / scenes::hertz;
  const auto branches = branches_of(s);
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  CHECK(branches[0].events.size() == 1);
}

TEST_CASE(
    "friction bounds a resonance of the third harmonic at the load at which it bounds that of the first") {
  for (double load : {1.5, 1.6}) {
    scene::Scene s = scenes::paper(9, load);
    scene::set(s, "c.value", 0);
    s.excitation.front().harmonic = 3;
    scenes::window(s).from = std::sqrt(17890 / 1.24) / scenes::hertz / 3;
    const auto branches = branches_of(s);
    CAPTURE(load);
    REQUIRE(branches[0].events.size() == 1);
    CHECK(branches[0].events[0].point.unbounded == (load == 1.5));
  }
}

TEST_CASE("a window of twelve decades is traced from end to end") {
  for (double from : {1e-12, 1e-9, 1e-3}) {
    scene::Scene s = softening();
    scene::set(s, "hardening.stiffness", 0.1);
    scenes::window(s).from = from;
    const auto branches = branches_of(s);
    CAPTURE(from);
    CHECK(branches[0].status == observables::Status::complete);
    for (const auto& point : branches[0].points)
      CHECK(std::abs(duffing_defect(point.omega, point.amplitude, 0.05, 0.1, 0.1)) < 1e-9);
  }
}

TEST_CASE("a window that begins within a hysteresis is covered by a branch that turns back and another one") {
  // The folds of the closed form lie at 0.93657 rad/s, which is met first, and at 0.90145 rad/s.
  scene::Scene s = softening();
  scenes::window(s).from = 0.92;
  const auto branches = branches_of(s);
  REQUIRE(branches.size() == 2);
  for (const auto& branch : branches) {
    CHECK(branch.status == observables::Status::complete);
    CHECK(branch.stop.reason == observables::reasons::boundary);
    CHECK(branch.stop.limit == Approx(1.6));
    CHECK(branch.points.front().omega == 0.92);
    for (const auto& point : branch.points)
      CHECK(std::abs(duffing_defect(point.omega, point.amplitude, 0.05, -0.05, 0.1)) < 1e-9);
  }
  const auto& first = branches[0];
  CHECK(says(first, "turned back at 0.93657"));
  CHECK(says(first, "left the window at its lower end, 0.92 rad/s; another branch reaches the upper end"));
  CHECK(first.points.back().omega == 0.92);
  CHECK(first.stop.value == Approx(0.92));
  CHECK(first.points.back().amplitude > 1.5 * first.points.front().amplitude);
  CHECK(branches[1].points.back().omega == Approx(1.6));
  CHECK(says(branches[1], "from another response at 0.92 rad/s: reached the end of the window at 1.6 rad/s"));

  scenes::window(s).from = 0.5;
  CHECK(branches_of(s)[0].status == observables::Status::complete);
}

TEST_CASE("the work of a search from rest is counted, also in that of the branch which begins there") {
  const auto s = scenes::paper(9, 2);
  const double omega = 20 * scenes::hertz;
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1e-4, 25);
  const auto p = hbm::parameters_at(*problem, omega);
  const auto found = hbm::steady_state(problem, p);
  REQUIRE(found.u);
  CHECK(found.work.points == 0);
  CHECK(found.work.residuals > 30);  // Newton's method cycles from rest, and another way follows
  CHECK(found.work.factorizations > 30);

  // From the solution, one correction that is accepted takes a residual or two.
  continuation::Counts work;
  REQUIRE(hbm::response_near(*problem, p, *found.u, work));
  CHECK(work.residuals >= 1);
  CHECK(work.residuals <= 3);

  const observables::FrequencyWindow window{omega, 1.01 * omega};
  const auto first = observables::first_response(model, omega, window.upper - window.lower);
  REQUIRE(first.u);
  CHECK(first.work.residuals > 30);
  const auto steps = observables::Steps::curve;
  const auto whole = observables::frequency_branch(model, window, omega, {}, 1, steps).branch.counts;
  const auto rest = observables::frequency_branch_part(first.problem, window, omega, window.upper, *first.u,
                                                       {}, 1, steps, {}, {})
                        .branch.counts;
  CHECK(whole.points == rest.points);
  CHECK(whole.residuals == rest.residuals + first.work.residuals);
  CHECK(whole.factorizations == rest.factorizations + first.work.factorizations);
}
