// Stability along branches: published bifurcations, and multipliers and their error next to the exact motion.
// ARCSLIP_SCENES is the number of random structures; by default 30.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/laws/contact/contacts.hpp"
#include "lib/stability/with_stability.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"
#include "lib/time/periodic/random_contacts.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/stability/stability.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace arcslip;
using with_stability::events, with_stability::response;

namespace {

std::uint64_t scene_count() {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return 30;
}

// NLvib, example 03.
scene::Scene masses_and_stop(int order) {
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k12", "between": ["x1", "x2"], "value": 1}, {"name": "k2", "at": "x2", "value": 1}],
      "dampers": [{"name": "c12", "between": ["x1", "x2"], "value": 0.03},
                  {"name": "c2", "at": "x2", "value": 0.03}]},
    "elements": [{"name": "stop", "type": "gap_spring", "at": "x1", "stiffness": 100, "gap": 1}],
    "excitation": [{"name": "force", "at": "x2", "cosine": 0.1}], "response": {"at": "x1"}})");
  s.harmonics.order = order;
  return s;
}

scene::Scene with_element(const std::string& element, const std::string& more, double k, double c,
                          double force, int order) {
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 1}]},
    "elements": [{"name": "s", "type": ")" +
                         element + R"(", "at": "x", )" + more + R"(}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}})");
  scene::set(s, "k.value", k);
  scene::set(s, "c.value", c);
  scene::set(s, "f.cosine", force);
  s.harmonics.order = order;
  return s;
}

double nearest_to(double value, const std::vector<std::complex<double>>& all) {
  double nearest = INFINITY;
  for (const auto& each : all) nearest = std::min(nearest, std::abs(each - value));
  return nearest;
}

}  // namespace

TEST_CASE("two masses and a stop lose their stability where NLvib's example 03 does") {
  struct Found {
    double neimark_sacker, first_doubling, second_doubling;
  };
  const auto found = [](int order) {
    const auto branch = response(masses_and_stop(order), 0.57, 0.77);
    const auto tori = events(branch, "neimark_sacker"), doublings = events(branch, "period_doubling");
    REQUIRE(tori.size() == 2);
    REQUIRE(doublings.size() == 2);
    for (const auto& event : tori) {
      CHECK_FALSE(event.nonsmooth);
      REQUIRE(event.point.stability);
      const double rotation = event.point.stability->rotation;
      const auto pair = std::polar(1.0, 2 * std::acos(-1.0) * rotation);
      double distance = INFINITY;
      for (const auto& each : event.point.stability->multipliers)
        distance = std::min(distance, std::abs(each - pair));
      CHECK(distance < 1e-8);
    }
    for (const auto& event : doublings) {
      CHECK(nearest_to(-1, event.point.stability->multipliers) < 1e-8);
      CHECK(std::isnan(event.point.stability->rotation));
    }
    // By shooting 1.4e-6 above grazing; the series of N harmonics smooths the touch.
    CHECK(std::abs(tori[0].point.omega - 0.58189963904) < 1.4e-6);
    CHECK(events(branch, "fold").size() == 2);  // the lower one where the stop is touched
    CHECK(events(branch, "stability_lost").empty());
    return Found{tori[1].point.omega, doublings[0].point.omega, doublings[1].point.omega};
  };
  const Found coarse = found(40), fine = found(120);
  const auto check = [](double coarse_value, double fine_value, double exact, double tolerance) {
    CHECK(std::abs(fine_value - exact) < tolerance);
    CHECK(std::abs(fine_value - exact) < 0.3 * std::abs(coarse_value - exact));
  };
  check(coarse.neimark_sacker, fine.neimark_sacker, 0.6186069, 4e-6);
  check(coarse.first_doubling, fine.first_doubling, 0.7387830, 4e-4);
  check(coarse.second_doubling, fine.second_doubling, 0.7555862, 2e-5);
}

TEST_CASE("bifurcations tell how far the harmonics left out may move them") {
  const struct {
    const char* kind;
    double at;
  } exact[] = {{"neimark_sacker", 0.6186069}, {"period_doubling", 0.7387830}, {"period_doubling", 0.7555862}};
  for (const int order : {41, 61, 161}) {
    const auto branch = response(masses_and_stop(order), 0.57, 0.77);
    for (const auto& [kind, at] : exact) {
      CAPTURE(order, kind, at);
      const observables::ResponsePoint* nearest = nullptr;
      for (const auto& event : branch.events)
        if (event.kind == kind &&
            (!nearest || std::abs(event.point.omega - at) < std::abs(nearest->omega - at)))
          nearest = &event.point;
      REQUIRE(nearest);
      const double error = std::abs(nearest->omega - at);
      CHECK(nearest->location_estimate > 0.3 * error);
      CHECK(nearest->location_estimate < 10 * error);
    }
  }
}

TEST_CASE("a fold next to grazing is stable but for its own multiplier, whose error is above its estimate") {
  const auto folds = events(response(masses_and_stop(63), 0.57, 0.77), "fold");
  REQUIRE(folds.size() == 2);
  const auto& grazing = *folds[1].point.stability;
  const double off = nearest_to(1, grazing.multipliers);
  CHECK(off > 1.5 * grazing.error);
  CHECK(off < 5 * grazing.error);
  for (const auto& fold : folds) CHECK(fold.point.stability->unstable == 0);
}

TEST_CASE("the small orbit of the double well doubles its period at the force known from elsewhere") {
  // x = 1 + y: -x + x^3 = 2 y + 3 y^2 + y^3.
  const auto s = with_element("polynomial_spring", R"("coefficients": {"2": 3, "3": 1})", 2, 0.3, 0.1, 24);
  const auto branches = observables::parameter_response(s, {"f.cosine", 0.05, 0.3, 1.2, true});
  REQUIRE(branches.size() == 2);
  const auto found = events(branches[0], "period_doubling");
  REQUIRE(found.size() == 1);
  CHECK(std::abs(found[0].point.over - 0.265581786056) < 1e-12);
  CHECK(nearest_to(-1, found[0].point.stability->multipliers) < 1e-9);
  CHECK(found[0].point.stability->unstable == 0);
  for (const auto& point : branches[0].points) {
    REQUIRE(point.stability);
    CHECK((point.stability->unstable == 1) == (point.over > found[0].point.over));
    // Liouville: the product of the multipliers is exp(-c T).
    const auto& both = point.stability->multipliers;
    CHECK(std::abs(both.at(0) * both.at(1) - std::exp(-0.3 * 2 * std::acos(-1.0) / 1.2)) < 1e-10);
  }
}

TEST_CASE("branches that begin at a period doubling are stable up to their own one") {
  const auto s = scenes::example("double_well");
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 4);
  CHECK(branches[3].isolated);  // about the hilltop
  for (std::size_t k = 1; k < 3; ++k) {
    const auto doublings = events(branches[k], "period_doubling");
    REQUIRE(doublings.size() == 1);
    CHECK(nearest_to(1, branches[k].points.front().stability->multipliers) < 1e-8);
    for (std::size_t i = 0; i < branches[k].points.size(); ++i)
      CHECK(branches[k].points[i].stability->unstable == (i > doublings[0].after ? 1 : 0));
  }
}

TEST_CASE("a Duffing oscillator is unstable between its folds alone, where a multiplier is 1") {
  const auto s = with_element("cubic_spring", R"("stiffness": 0.1)", 1, 0.05, 0.18, 15);
  const auto branch = response(s, 0.5, 1.6);
  const auto folds = events(branch, "fold");
  REQUIRE(folds.size() == 2);
  CHECK(branch.events.size() == 3);  // and the peak
  for (const auto& fold : folds) {
    CHECK(nearest_to(1, fold.point.stability->multipliers) < 1e-7);
    CHECK(fold.point.stability->unstable == 0);
  }
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const bool between = i > folds[0].after && i <= folds[1].after;
    CHECK(branch.points[i].stability->unstable == (between ? 1 : 0));
  }
  CHECK(studies::unstable_ranges(s, branch) == "unstable from 1.269602 to 1.1157003 rad/s");
}

TEST_CASE("the symmetry of a motion breaks where its Jacobian in all harmonics is singular") {
  const auto s = with_element("cubic_spring", R"("stiffness": 1)", 1, 0.1, 3, 21);
  const auto branch = response(s, 0.5, 1.5);
  const auto found = events(branch, "symmetry_breaking");
  REQUIRE(found.size() == 2);
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem odd(model, model->harmonics, 1, 1);
  REQUIRE(odd.harmonics().odd);
  const hbm::HbmProblem all(odd, elements::Harmonics{21}, {});
  for (const auto& event : found) {
    CHECK(nearest_to(1, event.point.stability->multipliers) < 1e-8);
    // The determinant of the even harmonics changes its sign within 1e-6 of the event.
    double determinant[2];
    for (int i = 0; i < 2; ++i) {
      const auto p = hbm::parameters_at(odd, event.point.omega + (i == 0 ? -1e-6 : 1e-6));
      const continuation::Vector guess =
          Eigen::Map<const continuation::Vector>(event.point.unknowns.data(), odd.size());
      const auto u = hbm::response_near(odd, p, guess);
      REQUIRE(u);
      continuation::Vector wide(all.size());
      elements::transfer(odd.harmonics(), *u, all.harmonics(), wide);
      const auto at = all.hbm_evaluator();
      REQUIRE(at->move_to(wide, p, continuation::Needs::jacobian) == continuation::Evaluated::ok);
      determinant[i] = std::get<Eigen::MatrixXd>(at->jacobian()).partialPivLu().determinant();
    }
    CHECK(determinant[0] * determinant[1] < 0);
  }
}

TEST_CASE("multipliers of random structures are within five times their error of the exact ones") {
  double worst = 0;
  int points = 0, opens = 0;
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed) {
    auto s = random_scenes::make(
        seed, seed % 2 == 0 ? random_scenes::Excitation::first : random_scenes::Excitation::first_and_second);
    s.harmonics.order = 15;
    const auto window = scenes::window(s);
    const double middle = 0.5 * (window.from + window.to);
    if (seed % 3 == 1) s = random_contacts::with_stops(s, seed, middle);
    if (seed % 3 == 2) s = random_contacts::with_contacts(s, seed, middle);
    for (const double part : {0.35, 0.65}) {
      const double at = window.from + part * (window.to - window.from);
      CAPTURE(seed, part);
      const auto branches = observables::frequency_response(
          s, {at, 1.001 * at, true},
          controls::reporting([](const control::Progress& progress) { return progress.points < 1; }));
      CAPTURE(branches.front().stop.message);
      REQUIRE_FALSE(branches.front().points.empty());
      const auto& point = branches.front().points.front();
      REQUIRE(point.stability);
      const auto pair = compared_with_exact::balanced(s, at);
      time::EventDriven integrator(pair.equation);
      const auto exact = time::periodic_motion(integrator, time::state_of(*pair.problem, pair.u, pair.p));
      REQUIRE(exact.converged());
      const auto& multipliers = point.stability->multipliers;
      const double error = std::max(observables::distance(multipliers, exact.shooting.multipliers),
                                    observables::distance(exact.shooting.multipliers, multipliers));
      ++points;
      opens += std::any_of(exact.period.events.begin(), exact.period.events.end(),
                           [](const auto& event) { return event.to == "open"; });
      CHECK(error < 5 * point.stability->error + 1e-10);
      worst = std::max(worst, error / (point.stability->error + 1e-10));
      const double largest = std::abs(exact.shooting.multipliers.front());
      if (std::abs(largest - 1) > point.stability->error)
        CHECK((point.stability->unstable > 0) == (largest > 1));
    }
  }
  INFO(worst);
  CHECK(points == 2 * static_cast<int>(scene_count()));
  CHECK(opens > points / 10);
}

TEST_CASE("an undamped structure has no bifurcations by rounding") {
  // All multipliers are on the unit circle, and pass -1 where a natural frequency is a multiple of half of
  // that of the excitation.
  for (const double load : {0.0, 1e3}) {
    auto s = scenes::paper(5, load);
    scene::set(s, "c.value", 0);
    const auto branch = response(s, 5, 17);
    for (const auto& event : branch.events) {
      CAPTURE(load, event.kind, event.point.omega);
      CHECK(event.kind == "peak");
    }
    for (const auto& point : branch.points) {
      REQUIRE(point.stability);
      CHECK(point.stability->unstable == 0);
    }
  }
}

TEST_CASE("light damping and many sliders: multipliers next to 1 and at 0") {
  auto s = scenes::paper(7);
  scene::set(s, "c.value", 1.24e-6);
  const auto branch = response(s, 10, 30);
  for (const auto& point : branch.points) {
    REQUIRE(point.stability);
    CHECK(point.stability->unstable == 0);
    // A volume shrinks in stick as well: by exp(-c T/m) and with each slip.
    const auto& all = point.stability->multipliers;
    if (point.elements[0].stick_percent == 100)
      CHECK(std::abs(std::abs(all[0]) - std::exp(-0.5e-6 * 2 * std::acos(-1.0) / point.omega)) < 1e-12);
    else
      CHECK(std::abs(all.back()) < 1e-14);
  }
  CHECK(branch.doubt.empty());
}

TEST_CASE("curves of peaks and folds have the stability of their points") {
  const auto s = with_element("cubic_spring", R"("stiffness": 0.1)", 1, 0.05, 0.18, 9);
  const observables::CurveRange range{"f.cosine", 0.15, 0.25, 0.5, 1.8, true};
  for (const auto& branch : observables::fold_curves(s, range)) {
    CHECK(branch.points.size() > 10);
    for (const auto& point : branch.points) {
      CHECK(nearest_to(1, point.stability->multipliers) < 1e-6);
      CHECK(point.stability->unstable == 0);  // the other one is within the circle
    }
  }
  for (const auto& branch : observables::resonance_peaks(s, range))
    for (const auto& point : branch.points) CHECK(point.stability->unstable == 0);
  auto without = range;
  without.stability = false;
  for (const auto& branch : observables::resonance_peaks(s, without))
    for (const auto& point : branch.points) CHECK_FALSE(point.stability);
}

TEST_CASE(
    "a pair on the circle is found next to many lightly damped modes, where its damping changes its sign") {
  // van der Pol's force along the first mode q of a chain of equal masses, which leaves the other five
  // linear, with products 1 - |mu|^2 of a few percent. By Liouville's formula the pair of q is on the circle
  // where the mean of coefficient (q^2/a^2 - 1) is minus the viscous damping of q.
  const int n = 6;
  const double damping = 1e-3, feed = 0.05;
  std::vector<scenes::Oscillator> masses;
  for (const char* dof : {"x0", "x1", "x2", "x3", "x4", "x5"}) masses.push_back({dof, 1, 1, damping});
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", )" +
                         scenes::uncoupled(masses) + R"(,
    "elements": [{"name": "feed", "type": "van_der_pol", "at": "x0", "coefficient": 0.05, "amplitude": 1}],
    "excitation": [{"name": "force", "at": "x0", "cosine": 1}], "response": {"at": "x0"},
    "harmonics": {"order": 9}})");
  for (int i = 0; i <= n; ++i) {
    scene::Direction spring;
    if (i < n) spring.push_back({i, 1.0});
    if (i > 0) spring.push_back({i - 1, -1.0});
    s.springs.push_back({"link" + std::to_string(i), &scene::spring_type(), {spring}, {1.0}});
  }
  auto& mode = s.elements[0].directions[0];
  mode.clear();
  for (int i = 0; i < n; ++i)
    mode.push_back({i, std::sqrt(2.0 / (n + 1)) * std::sin(std::acos(-1.0) * (i + 1) / (n + 1))});
  const auto branches = observables::parameter_response(s, {"force.cosine", 0.5, 8, 0.5, true});
  REQUIRE(branches.size() == 1);
  const auto& branch = branches[0];
  const auto found = events(branch, "neimark_sacker");
  REQUIRE(found.size() == 1);
  CHECK(events(branch, "stability_lost").empty());
  for (const auto& point : branch.points)
    CHECK(point.stability->unstable == (point.over < found[0].point.over ? 2 : 0));
  CHECK(found[0].point.stability->unstable == 0);
  // The motion of q at the event.
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  auto p = hbm::parameters_at(problem, found[0].point.omega);
  for (std::size_t k = 0; k < model->parameters.size(); ++k)
    if (model->parameters[k].name == "force.cosine") p[static_cast<Eigen::Index>(k)] = found[0].point.over;
  const Eigen::Map<const continuation::Vector> u(found[0].point.unknowns.data(), problem.size());
  const Eigen::MatrixXd x = time::dof_coefficients(problem, u, p);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(x.rows());
  for (const scene::Term& term : mode) q += term.weight * x.col(term.dof);
  const double mean_square = 0.5 * q.squaredNorm();  // its mean is zero
  CHECK(std::abs(feed * (mean_square - 1) + damping) < 1e-9);
}

TEST_CASE("where the stiffness over a mass overflows, the stability is not known, and that is said") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y", "z"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 2.225e-308},
                 {"name": "mz", "at": "z", "value": 1}],
      "springs": [{"name": "kx", "at": "x", "value": 1}, {"name": "kxy", "between": ["x", "y"], "value": 1},
                  {"name": "kyz", "between": ["y", "z"], "value": 1}, {"name": "kz", "at": "z", "value": 1}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.02}]},
    "elements": [{"name": "s", "type": "jenkins", "between": ["x", "y"], "stiffness": 20,
        "friction_coefficient": 1, "normal_load": 1},
      {"name": "n", "type": "cubic_spring", "at": "y", "stiffness": 1}],
    "excitation": [{"name": "f", "at": "y", "cosine": 1}], "response": {"at": "x"}, "harmonics": {"order": 3}})");
  const auto branch = response(s, 0.5, 0.6);
  CHECK(branch.unknown_stability == "a mass is so small that the stiffness or the damping over it overflows");
  for (const auto& point : branch.points) CHECK_FALSE(point.stability);
}

TEST_CASE("a branch whose stability is not known says why") {
  auto s = contacts::plane_pad(5, 25, 8);
  s.masses[0].values[0] = 0;
  const auto branch = response(s, 60, 75);
  const std::string reason = "degree of freedom \"a\" has no mass of its own (M is singular)";
  CHECK(branch.unknown_stability == reason);
  CHECK(studies::doubt_of(branch) == "without its stability: " + reason);
  for (const auto& point : branch.points) CHECK_FALSE(point.stability);
  CHECK(studies::unstable_ranges(s, branch).empty());
}

TEST_CASE("with hysteresis one multiplier is unstable between two folds, and is 1 at them to its error") {
  // The folds are singular Jacobians of harmonic balance, the multipliers those of the motion in time.
  for (const int order : {9, 31}) {
    auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
        "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
      "elements": [{"name": "cubic", "type": "cubic_spring", "at": "x", "stiffness": 0.5},
        {"name": "wire", "type": "bouc_wen", "at": "x", "stiffness": 0.3, "elastic_share": 0.1,
         "yield_displacement": 0.1, "exponent": 1.5, "shape": 0.7}],
      "excitation": [{"name": "f", "at": "x", "cosine": 0.15}], "response": {"at": "x"}})");
    s.harmonics.order = order;
    CAPTURE(order);
    const auto branch = response(s, 0.8, 2);
    CHECK(branch.unknown_stability.empty());
    const auto folds = events(branch, "fold");
    REQUIRE(folds.size() == 2);
    for (const auto& fold : folds) {
      const auto& stability = *fold.point.stability;
      const double from_1 = nearest_to(1, stability.multipliers);
      CAPTURE(from_1, stability.error);
      CHECK(from_1 < 5 * stability.error + 1e-8);
      CHECK(from_1 < 0.4 / (order * order));
    }
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      const auto& stability = branch.points[i].stability;
      REQUIRE(stability);
      CHECK(stability->multipliers.size() == 3);
      const bool between = i > folds[0].after && i <= folds[1].after;
      if (std::abs(std::abs(stability->multipliers.front()) - 1) > stability->error)
        CHECK(stability->unstable == (between ? 1 : 0));
    }
  }
}

TEST_CASE("points have multipliers on request") {
  const auto s = scenes::paper(3);
  observables::PointSettings settings;
  settings.frequency = 20;
  CHECK_FALSE(observables::point_responses(s, settings).front().point.stability);
  settings.stability = true;
  const auto known = observables::point_responses(s, settings);
  REQUIRE(known.front().point.stability);
  CHECK(known.front().point.stability->unstable == 0);
}
