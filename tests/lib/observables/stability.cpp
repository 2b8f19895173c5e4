// Stability along branches: published bifurcations, and multipliers and their error beside the exact motion.
// ARCSLIP_SCENES is the number of random structures; by default 30.
#include "catch.hpp"

#include "lib/elements/contacts.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/observables/reference.hpp"
#include "lib/time/beside_exact.hpp"
#include "lib/time/random_contacts.hpp"

#include <arcslip/observables/curves.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/responses_at.hpp>
#include <arcslip/observables/stability.hpp>
#include <arcslip/studies/columns.hpp>
#include <arcslip/time/from_harmonics.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace arcslip;
using observables::ResponseBranch;
using observables::ResponseEvent;

namespace {

std::uint64_t scene_count() {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return 30;
}

std::vector<ResponseEvent> events(const ResponseBranch& branch, const std::string& kind) {
  std::vector<ResponseEvent> found;
  for (const auto& event : branch.events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

ResponseBranch response(const scene::Scene& s, double from, double to) {
  const auto branches = observables::frequency_response(s, {from, to, true});
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  return branches[0];
}

// A bar of unit length, mass and stiffness, held at one end and excited at the other.
scene::Scene long_chain(int n, const std::string& elements) {
  const std::string k = std::to_string(n), c = std::to_string(0.02 * n), last = "x" + std::to_string(n - 1);
  std::string dofs, masses, springs, dampers;
  for (int i = 0; i < n; ++i) {
    const std::string comma = i == 0 ? "" : ", ", x = "x" + std::to_string(i), number = std::to_string(i);
    const std::string place =
        i == 0 ? R"("at": "x0")" : R"("between": ["x)" + std::to_string(i - 1) + R"(", ")" + x + R"("])";
    dofs += comma + "\"" + x + "\"";
    masses += comma + R"({"name": "m)" + number + R"(", "at": ")" + x + R"(", "value": )" +
              std::to_string(1.0 / n) + "}";
    springs += comma + R"({"name": "k)" + number + R"(", )" + place + R"(, "value": )" + k + "}";
    dampers += comma + R"({"name": "c)" + number + R"(", )" + place + R"(, "value": )" + c + "}";
  }
  return scenes::parse(
      R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [)" + dofs +
      R"(], "masses": [)" + masses + R"(], "springs": [)" + springs + R"(], "dampers": [)" + dampers +
      R"(]}, "elements": [)" + elements + R"(], "excitation": [{"name": "f", "at": ")" + last +
      R"(", "cosine": 0.3}], "response": {"at": ")" + last + R"("}, "harmonics": {"order": 15}})");
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

scene::Scene duffing(const std::string& element, const std::string& more, double k, double c, double force,
                     int order) {
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

TEST_CASE("the small orbit of the double well doubles its period at the force known from elsewhere") {
  // x = 1 + y: -x + x^3 = 2 y + 3 y^2 + y^3.
  const auto s = duffing("polynomial_spring", R"("coefficients": {"2": 3, "3": 1})", 2, 0.3, 0.1, 24);
  const auto branches = observables::parameter_response(s, {"f.cosine", 0.05, 0.3, 1.2, true});
  REQUIRE(branches.size() == 1);
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
  REQUIRE(branches.size() == 3);
  for (std::size_t k = 1; k < 3; ++k) {
    const auto doublings = events(branches[k], "period_doubling");
    REQUIRE(doublings.size() == 1);
    CHECK(nearest_to(1, branches[k].points.front().stability->multipliers) < 1e-8);
    for (std::size_t i = 0; i < branches[k].points.size(); ++i)
      CHECK(branches[k].points[i].stability->unstable == (i > doublings[0].after ? 1 : 0));
  }
}

TEST_CASE("a Duffing oscillator is unstable between its folds alone, where a multiplier is 1") {
  const auto s = duffing("cubic_spring", R"("stiffness": 0.1)", 1, 0.05, 0.18, 15);
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
  const auto s = duffing("cubic_spring", R"("stiffness": 1)", 1, 0.1, 3, 21);
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
          [](const observables::Progress& progress) { return progress.points < 1; });
      CAPTURE(branches.front().stop.message);
      REQUIRE_FALSE(branches.front().points.empty());
      const auto& point = branches.front().points.front();
      REQUIRE(point.stability);
      const auto pair = beside_exact::balanced(s, at);
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
  const auto s = duffing("cubic_spring", R"("stiffness": 0.1)", 1, 0.05, 0.18, 9);
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
    "a pair on the circle is found beside many lightly damped modes, where its damping changes its sign") {
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

TEST_CASE("a loss of stability next to a fold that does not explain it is told") {
  // Two oscillators that nothing couples: a Duffing oscillator, and one that is self-excited in stick and
  // stable in slip, whose slip is born 1e-9 above the force of the second fold.
  const auto two = [&](double limit) {
    auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", )" +
                           scenes::uncoupled({{"a", 1, 5, 0}, {"b", 1, 1, 0.1}}) + R"(,
      "elements": [{"name": "feed", "type": "van_der_pol", "at": "a", "coefficient": 0.02, "amplitude": 1e6},
        {"name": "damper", "type": "jenkins", "at": "a", "stiffness": 1, "friction_coefficient": 1,
         "normal_load": 1},
        {"name": "cubic", "type": "cubic_spring", "at": "b", "stiffness": 0.1}],
      "excitation": [{"name": "force", "at": "b", "cosine": 1}], "response": {"at": "a"},
      "harmonics": {"order": 9}})");
    s.excitation[0].directions = {{{0, 1.0}, {1, 1.0}}};
    scene::set(s, "damper.normal_load", limit);
    return observables::parameter_response(s, {"force.cosine", 0.2, 3, 1.4, true}).at(0);
  };
  const double stuck = std::hypot(5 + 1 - 1.4 * 1.4, 0.02 * 1.4);
  const auto folds = events(two(1e3), "fold");
  REQUIRE(folds.size() == 2);
  const double force = folds[1].point.over * (1 + 1e-9);
  const auto branch = two(force / stuck);
  const auto lost = events(branch, "stability_lost");
  REQUIRE(lost.size() == 2);  // and once before, far from the folds
  for (const auto& event : lost) CHECK(reference::error(event.point.over, force) < 1e-7);
  CHECK(events(branch, "fold").size() == 2);
}

TEST_CASE("where the birth of slip is a fold, the fold tells the multiplier that becomes unstable") {
  // Two masses, the first one fed, the second one damped, stable in stick. The force at the first one is |D|
  // A with its dynamic stiffness D of the stuck structure; slip adds 4i/pi k_t (A - A_0), which makes that
  // fall: |D|^2 + 4/pi k_t Im D < 0.
  const double w = 3.1, kt = 6;
  const std::complex<double> second(7.5 - w * w, 0.5 * w);
  const std::complex<double> D = std::complex<double>(8.5 - w * w, -0.2 * w) - 1.5 * 1.5 / second;
  REQUIRE(std::norm(D) + 4 / std::acos(-1.0) * kt * D.imag() < 0);
  const auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "at": "b", "value": 6},
                  {"name": "kab", "between": ["a", "b"], "value": 1.5}],
      "dampers": [{"name": "cb", "at": "b", "value": 0.5}]},
    "elements": [{"name": "feed", "type": "van_der_pol", "at": "a", "coefficient": 0.2, "amplitude": 1e5},
      {"name": "damper", "type": "jenkins", "at": "a", "stiffness": 6, "friction_coefficient": 0.5,
       "normal_load": 12}],
    "excitation": [{"name": "force", "at": "a", "cosine": 1}], "response": {"at": "a"},
    "harmonics": {"order": 9}})");
  const auto branches = observables::parameter_response(s, {"force.cosine", 0.05, 2, w, true});
  REQUIRE(branches.size() == 1);
  const auto& branch = branches[0];
  const auto folds = events(branch, "fold");
  REQUIRE(folds.size() == 2);
  CHECK(folds[0].nonsmooth);
  CHECK(reference::error(folds[0].point.over, std::abs(D)) < 1e-9);  // A_0 = 1 m
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const bool between = i > folds[0].after && i <= folds[1].after;
    CHECK(branch.points[i].stability->unstable == (between ? 1 : 0));
  }
  CHECK(std::abs(branch.points[folds[0].after + 1].stability->multipliers.front()) > 1.01);
  CHECK(events(branch, "stability_lost").empty());
}

TEST_CASE("at a fold just after grazing a multiplier goes steeply through 1, and the fold alone tells it") {
  // Next to grazing it grows like a root of the amplitude.
  const auto s = scenes::example("unilateral_oscillator");
  for (const double from : {0.3, 0.37, 0.45, 0.62}) {
    CAPTURE(from);
    const auto branch = response(s, from, 0.9);
    const auto folds = events(branch, "fold");
    REQUIRE_FALSE(folds.empty());
    CHECK(reference::error(folds.back().point.omega, 0.6534401344692) < 1e-10);
    CHECK(events(branch, "stability_lost").empty());
  }
}

TEST_CASE("a branch whose stability is not known says why") {
  const auto s = contacts::plane_pad(5, 25, 8);
  const auto branch = response(s, 60, 75);
  CHECK(branch.unknown_stability == "the memory of \"pad\" is not piecewise linear");
  CHECK(studies::doubt_of(branch) == "without its stability: the memory of \"pad\" is not piecewise linear");
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

TEST_CASE("where slip is born, a self-excited structure that is unstable in stick becomes stable at once") {
  // A force c x' along the motion; in stick the multipliers are exp(c T/2m) in size. The birth of slip is at
  // the amplitude limit/k_t of the stuck structure.
  const double c = 0.05, m = 1.24, k = 17890 + 3500, hertz = 25;
  const auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1.24}],
      "springs": [{"name": "k", "at": "x", "value": 17890}]},
    "elements": [{"name": "feed", "type": "van_der_pol", "at": "x", "coefficient": 0.05, "amplitude": 1e3},
      {"name": "damper", "type": "jenkins", "at": "x", "stiffness": 3500, "friction_coefficient": 0.5,
       "normal_load": 3}],
    "excitation": [{"name": "force", "at": "x", "cosine": 1}], "response": {"at": "x"},
    "harmonics": {"order": 9}})");
  const auto branches = observables::parameter_response(s, {"force.cosine", 0.05, 10, hertz, true});
  REQUIRE(branches.size() == 1);
  const auto lost = events(branches[0], "stability_lost");
  REQUIRE(lost.size() == 1);
  CHECK(lost[0].nonsmooth);
  const double omega = hertz * scenes::hertz;
  const double amplitude = 3 * 0.5 / 3500;
  const double force = amplitude * std::hypot(k - m * omega * omega, c * omega);
  CHECK(reference::error(lost[0].point.over, force) < 1e-8);
  for (const auto& point : branches[0].points) {
    if (point.over > 2 * force) continue;
    CHECK(point.stability->unstable == (point.over < force ? 2 : 0));
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

TEST_CASE("a large structure has the multipliers of its low modes, with an error for the others") {
  const auto s = long_chain(150, R"({"name": "d", "type": "jenkins", "at": "x70", "stiffness": 2,
    "friction_coefficient": 0.5, "normal_load": 0.3}, {"name": "stop", "type": "gap_spring", "at": "x149",
    "stiffness": 0.5, "gap": 0.3})");
  const double omega = 1.5;
  observables::PointSettings settings;
  settings.frequency = omega;
  settings.stability = true;
  const auto response = observables::point_responses(s, settings).front();
  REQUIRE(response.point.stability);
  const auto& stability = *response.point.stability;
  CHECK(response.point.elements.at(0).stick_percent < 99);
  CHECK(response.point.amplitude > 0.35);  // beyond the gap
  CHECK(stability.multipliers.size() <= 2 * 50 + 1);

  // Of the same motion with all modes.
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const auto at = observables::responses_at(model, omega);
  REQUIRE_FALSE(at.u.empty());
  const auto p = hbm::parameters_at(*at.problem, omega);
  const auto evaluator = at.problem->hbm_evaluator();
  evaluator->move_to(at.u.front(), p, continuation::Needs::residual);
  std::vector<time::ElementCourse> courses;
  time::courses_of(*at.problem, *evaluator, courses);
  time::Floquet whole(time::equation_of_motion(*model, p));
  REQUIRE(whole.compute(omega, at.problem->harmonics(), courses));
  REQUIRE(whole.modes() == 150);
  const double left_out = observables::distance(stability.multipliers, whole.multipliers());
  CAPTURE(left_out, stability.error);
  CHECK(left_out > 1e-7);
  CHECK(left_out < stability.error);
  CHECK(stability.error < 0.02);
  CHECK(std::abs(std::abs(stability.multipliers[0]) - std::abs(whole.multipliers()[0])) < 2e-4);
}

TEST_CASE("structures that are too large for multipliers say so") {
  const std::string told =
      "without its stability: the structure has 101 degrees of freedom, and at most 100 are supported by "
      "Hill's "
      "method, with unsymmetric matrices or with laws that are not piecewise linear";
  observables::PointSettings settings;
  settings.frequency = 1.5;
  settings.stability = true;
  const auto cubic = observables::point_responses(
      long_chain(101, R"({"name": "s", "type": "cubic_spring", "at": "x100", "stiffness": 1})"), settings);
  REQUIRE(cubic.front().status == observables::Status::complete);
  CHECK_FALSE(cubic.front().point.stability);
  CHECK(cubic.front().doubt == told);
  settings.stability.by_hill = true;
  const auto by_hill = observables::point_responses(
      long_chain(101, R"({"name": "s", "type": "gap_spring", "at": "x100", "stiffness": 1, "gap": 0.3})"),
      settings);
  REQUIRE(by_hill.front().status == observables::Status::complete);
  CHECK_FALSE(by_hill.front().point.stability);
  CHECK(by_hill.front().doubt == told);
}
