// Branches that leave others: their motions compared with the motion in time, where they begin and end, and
// what is reported.
#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/fourier/series.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace arcslip;
using observables::Branches;
using observables::ResponseBranch;
using observables::ResponsePoint;
using observables::Symmetry;

namespace {

constexpr double pi = std::numbers::pi;

// x'' + c x' + k x + a x^2 + b x^3 = f cos(w t).
struct Oscillator {
  double k, c, a, b, f;

  scene::Scene scene(int order) const {
    std::string element = R"({"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 1})";
    if (a != 0)
      element = R"({"name": "s", "type": "polynomial_spring", "at": "x", "coefficients": {"2": 3, "3": 1}})";
    auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
        "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 1}]},
      "elements": [)" + element +
                           R"(],
      "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}})");
    scene::set(s, "k.value", k);
    scene::set(s, "c.value", c);
    scene::set(s, "f.cosine", f);
    if (a == 0) scene::set(s, "s.stiffness", b);
    s.harmonics.order = order;
    return s;
  }

  // After a number of periods of the excitation, by Runge-Kutta steps of order 4.
  Eigen::Vector2d after(Eigen::Vector2d y, double omega, int periods, int steps = 3000) const {
    const double h = 2 * pi / omega / steps;
    const auto rate = [&](double t, const Eigen::Vector2d& at) -> Eigen::Vector2d {
      const double x = at[0];
      return {at[1], f * std::cos(omega * t) - c * at[1] - x * (k + x * (a + x * b))};
    };
    for (long i = 0; i < static_cast<long>(steps) * periods; ++i) {
      const double t = h * static_cast<double>(i % steps);
      const Eigen::Vector2d k1 = rate(t, y), k2 = rate(t + h / 2, y + h / 2 * k1),
                            k3 = rate(t + h / 2, y + h / 2 * k2), k4 = rate(t + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y;
  }
};

// (x, x') at t = 0 of a response with these harmonics.
Eigen::Vector2d start_of(const ResponsePoint& point, const elements::Harmonics& h) {
  const Eigen::Map<const Eigen::VectorXd> u(point.unknowns.data(), h.size());
  const auto x = elements::series_values(h, u, 0);
  return {x.x, h.base_frequency(point.omega) * x.d1};
}

elements::Harmonics harmonics_of(const ResponseBranch& branch, int order) {
  return {order * branch.period, branch.symmetry == Symmetry::antisymmetric, branch.period};
}

std::vector<ResponseBranch> all(const scene::Scene& s, double from, double to,
                                observables::BranchLimits limits = {}) {
  return observables::frequency_response(
      s, {.from = from, .to = to, .branches = Branches::all, .limits = limits});
}

const Oscillator double_well{2, 0.3, 3, 1, 0.265581786056};  // x = 1 + y: -x + x^3 = 2 y + 3 y^2 + y^3
const Oscillator symmetric{1, 0.1, 0, 1, 3};

}  // namespace

namespace {

// How far the motion is from one that repeats after some periods, by the motion in time.
double defect(const Oscillator& of, const ResponsePoint& point, const elements::Harmonics& h, int periods) {
  const Eigen::Vector2d start = start_of(point, h);
  return (of.after(start, point.omega, periods) - start).norm() / start.norm();
}

// The derivative of the motion after some periods by its start, by differences.
Eigen::Matrix2d monodromy(const Oscillator& of, const Eigen::Vector2d& start, double omega, int periods) {
  const double h = 1e-5;
  Eigen::Matrix2d M;
  for (int j = 0; j < 2; ++j) {
    const Eigen::Vector2d d = h * Eigen::Vector2d::Unit(j);
    M.col(j) = (of.after(start + d, omega, periods) - of.after(start - d, omega, periods)) / (2 * h);
  }
  return M;
}

// Every point of a branch: it repeats after its period and not before, with its multipliers. tolerance: of
// the harmonics left out.
void check_in_time(const Oscillator& of, const ResponseBranch& branch, int order, double tolerance,
                   std::size_t stride) {
  const auto h = harmonics_of(branch, order);
  REQUIRE(branch.points.size() > 2 * stride);
  for (std::size_t i = stride; i + stride < branch.points.size(); i += stride) {
    const ResponsePoint& point = branch.points[i];
    CAPTURE(i, point.omega, branch.period);
    CHECK(defect(of, point, h, branch.period) < tolerance);
    if (branch.period > 1) CHECK(defect(of, point, h, branch.period / 2) > 1e3 * tolerance);
    REQUIRE(point.stability);
    const Eigen::EigenSolver<Eigen::Matrix2d> exact(
        monodromy(of, start_of(point, h), point.omega, branch.period));
    for (int k = 0; k < 2; ++k) {
      double nearest = INFINITY;
      for (const auto& each : point.stability->multipliers)
        nearest = std::min(nearest, std::abs(each - exact.eigenvalues()[k]));
      CHECK(nearest < 1e3 * tolerance);
    }
  }
}

}  // namespace

TEST_CASE("the double well doubles its period where it is known to, and again, with the motions in time") {
  const int order = 16;
  const auto branches = all(double_well.scene(order), 1.12, 1.3);
  REQUIRE(branches.size() >= 3);
  CHECK(branches[0].leaves.kind.empty());
  CHECK(branches[0].parent == 0);
  CHECK(branches[0].period == 1);
  CHECK(branches[0].symmetry == Symmetry::none);
  const ResponseBranch& doubled = branches[1];
  CHECK(doubled.parent == 1);
  CHECK(doubled.period == 2);
  CHECK(doubled.leaves.kind == "period_doubling");
  // Where another program has it: at 1.2 rad/s with this force.
  CHECK(std::abs(doubled.leaves.omega - 1.2) < 1e-9);
  REQUIRE(doubled.leaves.event < branches[0].events.size());
  const auto& from = branches[0].events[doubled.leaves.event];
  CHECK(from.kind == "period_doubling");
  CHECK(std::abs(from.point.omega - doubled.leaves.omega) < 1e-9);
  const Eigen::Vector2d start = start_of(doubled.points.front(), harmonics_of(doubled, order));
  CHECK(std::abs(start[0] + 1 - 0.4075754662) < 1e-8);
  CHECK(std::abs(start[1] - 0.3226140050) < 1e-8);
  // The multipliers over two periods begin at the squares.
  REQUIRE(doubled.points.front().stability);
  for (const auto& each : from.point.stability->multipliers) {
    double nearest = INFINITY;
    for (const auto& other : doubled.points.front().stability->multipliers)
      nearest = std::min(nearest, std::abs(other - each * each));
    CHECK(nearest < 1e-7);
  }
  check_in_time(double_well, doubled, order, 1e-7, 12);
  const auto again =
      std::find_if(branches.begin(), branches.end(), [](const auto& each) { return each.period == 4; });
  REQUIRE(again != branches.end());
  CHECK(again->leaves.kind == "period_doubling");
  CHECK(branches[static_cast<std::size_t>(again - branches.begin() - again->parent)].period == 2);
  check_in_time(double_well, *again, order, 1e-6, 12);
  for (const auto& branch : branches) {
    CHECK(branch.status == observables::Status::complete);
    if (branch.period < 4) continue;  // its doublings are beyond the two in a row
    for (const auto& why : branch.untraced) CHECK(why.find("doubled 2 times already") != std::string::npos);
  }
}

TEST_CASE("the intervals between period doublings shrink by Feigenbaum's number in the end") {
  const auto branches = all(scenes::example("double_well"), 1.12, 1.3, {.doublings = 3});
  std::vector<double> at;
  for (const auto& branch : branches)
    for (const auto& event : branch.events)
      if (event.kind == "period_doubling") at.push_back(event.point.omega);
  REQUIRE(at.size() == 4);
  CHECK(branches.size() == 5);  // and the motion about the hilltop
  const double first = (at[0] - at[1]) / (at[1] - at[2]), second = (at[1] - at[2]) / (at[2] - at[3]);
  CHECK(std::abs(second - 4.669201609) < 0.15);
  CHECK(std::abs(second - 4.669201609) < 0.2 * std::abs(first - 4.669201609));
}

TEST_CASE("next to a period doubling the new harmonics grow with the root of the distance") {
  const int order = 16;
  const auto branches = all(double_well.scene(order), 1.12, 1.3, {.doublings = 1});
  REQUIRE(branches.size() >= 2);
  const ResponseBranch& doubled = branches[1];
  const auto h = harmonics_of(doubled, order);
  std::vector<double> ratios, squares;
  for (std::size_t i = 1; i < 5; ++i) {
    const ResponsePoint& point = doubled.points[i];
    double square = 0;
    for (int n = 1; n <= h.order; n += 2)
      square += std::pow(point.unknowns[static_cast<std::size_t>(h.cosine_index(n))], 2) +
                std::pow(point.unknowns[static_cast<std::size_t>(h.sine_index(n))], 2);
    squares.push_back(square);
    ratios.push_back((point.omega - doubled.leaves.omega) / square);
  }
  // omega - omega_0 = c a^2 + O(a^4).
  for (std::size_t i = 1; i < ratios.size(); ++i)
    CHECK(std::abs(ratios[i] / ratios[0] - 1) < 100 * squares[i]);
  CHECK(squares.back() > 10 * squares.front());
}

TEST_CASE(
    "the symmetry of a Duffing oscillator breaks to one branch between two points, of pairs of motions") {
  const int order = 27;
  const auto branches = all(symmetric.scene(order), 0.5, 1.5, {.doublings = 0});
  REQUIRE(branches.size() >= 2);
  CHECK(branches[0].symmetry == Symmetry::antisymmetric);
  const ResponseBranch& pair = branches[1];
  CHECK(pair.symmetry == Symmetry::mirror_pair);
  CHECK(pair.period == 1);
  CHECK(pair.leaves.kind == "symmetry_breaking");
  const auto h = harmonics_of(pair, order);
  for (std::size_t i = 4; i + 4 < pair.points.size(); i += 10) {
    const Eigen::Vector2d start = start_of(pair.points[i], h);
    CAPTURE(i, pair.points[i].omega);
    CHECK(defect(symmetric, pair.points[i], h, 1) < 1e-7);
    // The mirror image, half a period later, is another motion with the same period.
    Oscillator reversed = symmetric;
    reversed.f = -reversed.f;
    CHECK((reversed.after(-start, pair.points[i].omega, 1) + start).norm() < 1e-6 * start.norm());
  }
  // Both breaks of symmetry are ends of the same branch, or each has its own to the window.
  std::size_t ends = 0;
  for (const auto& branch : branches)
    if (branch.leaves.kind == "symmetry_breaking") ends += branch.stop.reason.code == "branch_point" ? 2 : 1;
  CHECK(ends + branches[0].untraced.size() == 2);
}

TEST_CASE("a linear structure and one with friction have one branch, the same as without asking for all") {
  auto linear = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}})");
  for (const auto& [s, from, to] : {std::tuple{linear, 0.5, 1.5}, std::tuple{scenes::paper(7), 10.0, 30.0}}) {
    const auto branches = all(s, from, to, {.searches = 3});
    const auto one = observables::frequency_response(s, {.from = from, .to = to, .stability = true});
    REQUIRE(branches.size() == 1);
    REQUIRE(one.size() == 1);
    CHECK(branches[0].untraced.empty());
    CHECK(branches[0].points.size() == one[0].points.size());
    REQUIRE(branches[0].events.size() == one[0].events.size());
    for (std::size_t e = 0; e < one[0].events.size(); ++e) {
      CHECK(branches[0].events[e].kind == one[0].events[e].kind);
      CHECK(branches[0].events[e].point.omega == Approx(one[0].events[e].point.omega).epsilon(1e-12));
    }
  }
}

TEST_CASE("branches beyond the limits asked for are reported") {
  const auto s = double_well.scene(12);
  const auto none = all(s, 1.12, 1.3, {.doublings = 0});
  REQUIRE(none.size() == 2);  // with the motion about the hilltop, which has no doubling
  CHECK(none[1].isolated);
  REQUIRE(none[0].untraced.size() == 1);
  CHECK(none[0].untraced[0] ==
        "the branch that leaves at the period doubling at 1.2 rad/s: the period was doubled 0 times already "
        "(doublings)");
  const auto few = all(s, 1.12, 1.3, {.most_branches = 1, .searches = 1});
  REQUIRE(few.size() == 1);
  REQUIRE(few[0].untraced.size() == 2);
  CHECK(few[0].untraced[1] ==
        "branches that no other reaches: as many branches as asked for were traced already (most_branches: "
        "1)");
  CHECK(
      few[0].untraced[0] ==
      "the branch that leaves at the period doubling at 1.2 rad/s: as many branches as asked for were traced "
      "already (most_branches: 1)");
}

TEST_CASE(
    "two masses and a stop: the motion of twice the period between NLvib's doublings, next to the exact "
    "one") {
  auto s = scenes::example("unilateral_oscillator");
  s.harmonics.order = 40;
  const auto branches = all(s, 0.57, 0.77, {.doublings = 1});
  REQUIRE(branches.size() == 2);
  CHECK(branches[0].untraced.empty());
  const ResponseBranch& doubled = branches[1];
  CHECK(doubled.period == 2);
  CHECK(doubled.status == observables::Status::complete);
  REQUIRE(doubled.stop.reason.code == observables::reasons::branch_point.code);
  // By shooting (NLvib).
  CHECK(std::abs(doubled.leaves.omega - 0.7387830) < 3e-6);
  CHECK(std::abs(doubled.points.back().omega - 0.7555862) < 3e-6);
  CHECK(doubled.events.back().kind == "end");
  for (const auto& why : doubled.untraced) CHECK(why.find("doubled 1 time already") != std::string::npos);
  s.harmonics.order *= 2;
  s.harmonics.period = 2;
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
  for (std::size_t i = 10; i + 10 < doubled.points.size(); i += 20) {
    const ResponsePoint& point = doubled.points[i];
    CAPTURE(i, point.omega);
    const auto p = hbm::parameters_at(problem, point.omega);
    const Eigen::Map<const continuation::Vector> u(point.unknowns.data(), problem.size());
    time::EventDriven integrator(time::equation_of_motion(*model, p));
    const auto exact = time::periodic_motion(integrator, time::state_of(problem, u, p));
    REQUIRE(exact.converged());
    CHECK(std::abs(exact.period.amplitude - point.amplitude) < 2e-3 * point.amplitude);
    // It is not the motion of one period.
    const auto half = integrator.integrate(exact.shooting.start, 0, 2 * pi / point.omega);
    CHECK((half.end.x - exact.shooting.start.x).norm() > 0.02 * exact.shooting.start.x.norm());
  }
}

TEST_CASE(
    "symmetric masses in antiphase leave it on two branches, each other's image by the exchange of both") {
  auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "at": "b", "value": 1},
                  {"name": "kc", "between": ["a", "b"], "value": 0.1}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.02}, {"name": "cb", "at": "b", "value": 0.02}]},
    "elements": [{"name": "sa", "type": "cubic_spring", "at": "a", "stiffness": 0.5},
                 {"name": "sb", "type": "cubic_spring", "at": "b", "stiffness": 0.5}],
    "excitation": [{"name": "fa", "at": "a", "cosine": 0.05}, {"name": "fb", "at": "b", "cosine": -0.05}],
    "response": [{"name": "a", "at": "a"}, {"name": "b", "at": "b"}], "harmonics": {"order": 5}})");
  const auto branches = all(s, 0.8, 2);
  REQUIRE(branches.size() == 3);
  CHECK(std::count_if(branches[0].events.begin(), branches[0].events.end(),
                      [](const auto& event) { return event.kind == "branch_point"; }) == 2);
  for (const std::size_t k : {1, 2}) {
    CHECK(branches[k].leaves.kind == "branch_point");
    CHECK(branches[k].parent == static_cast<int>(k));
    CHECK(branches[k].symmetry == Symmetry::antisymmetric);
    CHECK(branches[k].stop.reason.code == "branch_point");
    CHECK(branches[k].points.front().omega == branches[0].events[branches[k].leaves.event].point.omega);
  }
  // The fold is the same motion with a and b exchanged.
  std::vector<const ResponsePoint*> folds;
  for (const std::size_t k : {1, 2})
    for (const auto& event : branches[k].events)
      if (event.kind == "fold") folds.push_back(&event.point);
  REQUIRE(folds.size() == 2);
  CHECK(folds[0]->omega == Approx(folds[1]->omega).epsilon(1e-10));
  CHECK(folds[0]->responses[0].amplitude == Approx(folds[1]->responses[1].amplitude).epsilon(1e-7));
  CHECK(folds[0]->responses[1].amplitude == Approx(folds[1]->responses[0].amplitude).epsilon(1e-7));
  CHECK(std::abs(folds[0]->responses[0].amplitude - folds[0]->responses[1].amplitude) > 1);
}

TEST_CASE("a search finds the subharmonic motions of a Duffing oscillator, which no branch reaches") {
  const Oscillator of{1, 0.01, 0, 0.5, 1};
  const int order = 7;
  auto s = of.scene(3 * order);
  s.harmonics.period = 3;
  const auto branches = all(s, 3.2, 6, {.searches = 2});
  std::size_t subharmonic = 0, isolated = 0;
  for (const auto& branch : branches) {
    CHECK(branch.period == 3);
    isolated += branch.isolated ? 1 : 0;
    const elements::Harmonics h{3 * order, true, 3};
    const std::size_t middle = branch.points.size() / 2;
    CHECK(defect(of, branch.points[middle], h, 3) < 2e-3);  // order 7
    if (defect(of, branch.points[middle], h, 1) > 0.1) ++subharmonic;
  }
  CHECK(subharmonic == 2);  // one is stable; of each all images are one branch
  CHECK(isolated >= 2);
  CHECK_FALSE(branches[0].isolated);
  // At the ends of the window as well.
  const auto at_ends = all(s, 3.2, 6);
  CHECK(std::count_if(at_ends.begin(), at_ends.end(), [&](const ResponseBranch& branch) {
          return defect(of, branch.points[branch.points.size() / 2], {3 * order, true, 3}, 1) > 0.1;
        }) >= 2);
}
