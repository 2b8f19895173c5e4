// Parts of a response with more harmonics than the rest: which ones, how they are joined, and next to the
// whole response with as many harmonics.

#include "catch.hpp"
#include "controls.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/branches/harmonic_refinement.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/histories.hpp>
#include <arcslip/observables/observe.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

using namespace arcslip;
using continuation::Vector;
using observables::Part;
using observables::parts_to_refine;
using observables::ResponseBranch;
using observables::ResponseEvent;
using observables::ResponsePoint;

namespace {

/// Points at these frequencies, with the estimate 1 at those of `rough` and 0 elsewhere.
ResponseBranch branch_of(const std::vector<double>& omegas, const std::set<std::size_t>& rough) {
  ResponseBranch branch;
  branch.harmonics = {1, 3};
  for (const double omega : omegas) {
    ResponsePoint point;
    point.omega = omega;
    point.amplitude = 1 + omega;
    point.truncation_estimate = rough.contains(branch.points.size()) ? 1 : 0;
    point.coefficients = {omega, 2, 3, 4};
    point.unknowns = {1, 2, 3, 4};
    point.order = 3;
    branch.points.push_back(point);
  }
  branch.solver.points = static_cast<long>(omegas.size());
  return branch;
}

std::vector<double> rising(std::size_t n) {
  std::vector<double> omegas;
  for (std::size_t i = 0; i < n; ++i) omegas.push_back(static_cast<double>(i));
  return omegas;
}

ResponseEvent event_after(const ResponseBranch& branch, std::size_t point, const std::string& kind = "peak") {
  ResponseEvent event;
  event.kind = kind;
  event.after = point;
  event.point = branch.points[point];
  event.point.omega += 0.5;
  return event;
}

const observables::FrequencyRange& range_of(const scene::Scene& s) {
  for (const auto& study : s.studies)
    if (study.type->name() == "frf") return study.settings.as<observables::FrequencyRange>();
  throw std::runtime_error("no frequency response");
}

std::vector<ResponseBranch> response(scene::Scene s, int order) {
  s.harmonics.accuracy = 0;
  s.harmonics.order = order;
  return observables::frequency_response(s, range_of(s));
}

double largest(const ResponseBranch& branch) {
  double most = 0;
  for (const ResponsePoint& point : branch.points) most = std::max(most, point.amplitude);
  for (const ResponseEvent& event : branch.events) most = std::max(most, event.point.amplitude);
  return most;
}

/// Amplitudes of responses of many harmonics next to others of fewer.
class Reference {
 public:
  Reference(scene::Scene s, int order) {
    s.harmonics.accuracy = 0;
    s.harmonics.order = order;
    model_ = std::make_shared<const model::Model>(model::build(s));
    of_.harmonics.clear();
    for (int i = 0; i < model_->harmonics.cosines(); ++i)
      of_.harmonics.push_back(model_->harmonics.cosine_order(i));
    problem_ = std::make_shared<const hbm::HbmProblem>(model_, model_->harmonics, 1e-3, 1);
    observer_ = std::make_unique<observables::Observer>(problem_);
  }

  /// NaN where there is none.
  double amplitude(const ResponsePoint& point, const ResponseBranch& from) {
    const ResponsePoint wide = observables::in_harmonics(point, from, of_);
    const Eigen::Map<const Vector> guess(wide.unknowns.data(),
                                         static_cast<Eigen::Index>(wide.unknowns.size()));
    Vector p = hbm::parameters_at(*problem_, point.omega);
    if (!from.over.empty()) p[model::parameter_index(*model_, from.over)] = point.over;
    const auto u = hbm::response_near(*problem_, p, guess);
    if (!u) return std::nan("");
    const auto at = problem_->hbm_evaluator();
    at->move_to(*u, p, continuation::Needs::residual);
    return observer_->extreme(*at, *u).amplitude;
  }

 private:
  ResponseBranch of_;
  std::shared_ptr<const model::Model> model_;
  std::shared_ptr<const hbm::HbmProblem> problem_;
  std::unique_ptr<observables::Observer> observer_;
};

/// A response in parts next to the whole one with as many harmonics, and one with many more.
void check_parts(const observables::RefinedResponse& refined, const ResponseBranch& coarse,
                 const ResponseBranch& whole, Reference& many, double accuracy) {
  REQUIRE(refined.branches.size() == 1);
  const ResponseBranch& branch = refined.branches.front();
  const int lower = coarse.harmonics.back(), higher = whole.harmonics.back();
  const double allowed = accuracy * largest(branch);
  CHECK(refined.change >= std::abs(largest(branch) / largest(coarse) - 1) - 1e-15);
  CHECK(branch.harmonics == whole.harmonics);
  CHECK(branch.over == whole.over);
  CHECK(branch.status == observables::Status::complete);
  using observables::place_of;
  CHECK(place_of(branch, branch.points.front()) == place_of(whole, whole.points.front()));
  CHECK(place_of(branch, branch.points.back()) == place_of(whole, whole.points.back()));

  std::set<int> orders;
  double worst = 0;
  for (const ResponsePoint& point : branch.points) {
    orders.insert(point.order);
    CHECK(point.unknowns.size() == branch.points.front().unknowns.size());
    CHECK(point.coefficients.size() == 2 * branch.harmonics.size());
    if (point.order != lower) continue;
    CHECK(std::abs(point.truncation_estimate) <= allowed);
    CHECK_FALSE(point.truncation_flagged);
    worst = std::max(worst, std::abs(many.amplitude(point, branch) - point.amplitude));
  }
  CHECK(orders == std::set{lower, higher});
  CHECK(worst <= 2 * allowed);  // estimates are of first order

  REQUIRE(branch.events.size() == whole.events.size());
  for (std::size_t i = 0; i < branch.events.size(); ++i) {
    const ResponseEvent &here = branch.events[i], &there = whole.events[i];
    CAPTURE(i, here.kind, here.point.omega, here.point.over);
    CHECK(here.kind == there.kind);
    CHECK(here.after < branch.points.size());
    const bool is_same = here.point.order == higher;
    CHECK(std::abs(here.point.amplitude - there.point.amplitude) <=
          (is_same ? 1e-8 * there.point.amplitude : 2 * allowed));
    if (is_same) CHECK(place_of(branch, here.point) == Approx(place_of(whole, there.point)).epsilon(1e-8));
  }
}

}  // namespace

TEST_CASE("a part takes the neighbours of its points with it, and those that are close are one") {
  CHECK(parts_to_refine(branch_of(rising(30), {}), 0.5).empty());
  CHECK(parts_to_refine(branch_of(rising(30), {10}), 0.5) == std::vector<Part>{{7, 13}});
  CHECK(parts_to_refine(branch_of(rising(30), {10, 12}), 0.5) == std::vector<Part>{{7, 15}});
  CHECK(parts_to_refine(branch_of(rising(40), {10, 20}), 0.5) == std::vector<Part>{{7, 23}});
  CHECK(parts_to_refine(branch_of(rising(40), {10, 21}), 0.5) == std::vector<Part>{{7, 13}, {18, 24}});
  CHECK(parts_to_refine(branch_of(rising(30), {1, 28}), 0.5) == std::vector<Part>{{0, 4}, {25, 29}});
  auto flagged = branch_of(rising(30), {});
  flagged.points[10].truncation_flagged = true;
  CHECK(parts_to_refine(flagged, 0.5) == std::vector<Part>{{7, 13}});
  auto unknown = branch_of(rising(30), {});
  unknown.points[10].truncation_estimate = std::nan("");
  CHECK(parts_to_refine(unknown, 0.5) == std::vector<Part>{{7, 13}});
}

TEST_CASE("a part ends where the branch has left the frequencies of it, without an event next to it") {
  // An S: up to 14, back to 8.5 and up again.
  std::vector<double> omegas = rising(11);
  for (const double omega : {11.0, 12.0, 13.0, 14.0, 12.5, 11.5, 9.5, 8.5, 9.2, 10.5})
    omegas.push_back(omega);
  for (int i = 0; i < 10; ++i) omegas.push_back(14.5 + i);
  CHECK(parts_to_refine(branch_of(omegas, {16}), 0.5) == std::vector<Part>{{13, 21}});
  CHECK(parts_to_refine(branch_of(omegas, {12}), 0.5) == std::vector<Part>{{9, 21}});
  // On the way back a part needs no turns.
  omegas = rising(30);
  for (int i = 0; i < 20; ++i) omegas.push_back(28.5 - i);
  for (int i = 0; i < 30; ++i) omegas.push_back(10.2 + i);
  CHECK(parts_to_refine(branch_of(omegas, {40}), 0.5) == std::vector<Part>{{37, 43}});
  CHECK(parts_to_refine(branch_of(omegas, {29}), 0.5) == std::vector<Part>{{26, 33}});
  auto with_peak = branch_of(rising(30), {10});
  with_peak.events.push_back(event_after(with_peak, 7));
  with_peak.events.push_back(event_after(with_peak, 12));
  CHECK(parts_to_refine(with_peak, 0.5) == std::vector<Part>{{5, 15}});
  auto at_event = branch_of(rising(30), {});
  at_event.events.push_back(event_after(at_event, 12));
  at_event.events.back().point.truncation_flagged = true;
  CHECK(parts_to_refine(at_event, 0.5) == std::vector<Part>{{9, 16}});
}

TEST_CASE("a branch with parts in place has their points and events, and the others' in their harmonics") {
  auto coarse = branch_of(rising(20), {10});
  coarse.events = {event_after(coarse, 2), event_after(coarse, 10), event_after(coarse, 17, "fold")};
  const std::vector<Part> parts{{7, 13}};
  ResponseBranch fine;
  fine.harmonics = {1, 3, 5};
  for (const double omega : {7.0, 9.0, 11.0, 13.0}) {
    ResponsePoint point;
    point.omega = omega;
    point.coefficients = {1, 2, 3, 4, 5, 6};
    point.unknowns = {1, 2, 3, 4, 5, 6};
    point.order = 5;
    fine.points.push_back(point);
  }
  fine.events = {event_after(fine, 1)};
  fine.solver.points = 4;
  const ResponseBranch all = observables::with_parts(coarse, parts, {fine});
  REQUIRE(all.points.size() == 17);
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    const bool is_fine = i >= 7 && i < 11;
    CHECK(all.points[i].order == (is_fine ? 5 : 3));
    CHECK(all.points[i].coefficients.size() == 6);
    if (i > 0) CHECK(all.points[i].omega > all.points[i - 1].omega);
    if (is_fine) continue;
    CHECK(all.points[i].unknowns == std::vector<double>{1, 2, 0, 3, 4, 0});
    CHECK(all.points[i].coefficients == std::vector<double>{all.points[i].omega, 2, 3, 4, 0, 0});
  }
  REQUIRE(all.events.size() == 3);
  CHECK(all.events[0].after == 2);
  CHECK(all.events[1].after == 8);
  CHECK(all.events[2].after == 14);
  CHECK(all.events[2].kind == "fold");
  for (const ResponseEvent& event : all.events) {
    CHECK(event.point.omega > all.points[event.after].omega);
    CHECK(event.point.omega < all.points[event.after + 1].omega);
    CHECK(event.point.coefficients.size() == 6);
  }
  CHECK(all.solver.points == 24);
}

TEST_CASE("a response of which parts have more harmonics is that of so many, within the accuracy") {
  const auto [name, lower, higher, accuracy] = GENERATE(table<std::string, int, int, double>({
      {"unilateral_oscillator", 7, 21, 1e-3},
      {"gap_limited_chain", 9, 21, 1e-3},
      {"duffing_jenkins", 7, 21, 1e-5},
      {"rubbing_pad", 5, 15, 1e-4},
  }));
  const scene::Scene s = scenes::example(name);
  CAPTURE(name);
  scene::Scene finer = s;
  finer.harmonics.accuracy = 0;
  finer.harmonics.order = higher;
  const auto coarse = response(s, lower);
  const auto refined = observables::refined_response(finer, range_of(s), coarse, accuracy);
  REQUIRE(refined);
  Reference many(s, 2 * higher + 21);
  check_parts(*refined, coarse.front(), response(s, higher).front(), many, accuracy);
  const ResponseBranch& branch = refined->branches.front();
  // Points of fewer harmonics are read in those of the branch.
  for (const ResponsePoint* point : {&branch.points.front(), &branch.points.back()}) {
    const std::vector<double> angles = observables::even_angles(360);
    const auto motion = observables::history(finer, branch, *point, angles);
    double most = 0;
    for (const double x : motion.displacement) most = std::max(most, std::abs(x));
    CHECK(most == Approx(point->amplitude).epsilon(1e-3));
  }
}

TEST_CASE("a response over a parameter of which parts have more harmonics is that of so many") {
  struct Row {
    const char *name, *over;
    double from, to, frequency;
    int lower, higher;
    double accuracy;
  };
  const Row row = GENERATE(values<Row>({
      {"rubbing_pad", "pad.normal_load", 1, 100, 110, 3, 9, 1e-4},
      {"gap_limited_chain", "force.cosine", 0.01, 1, 1, 7, 21, 1e-4},
      {"al_sayed_2011", "damper.normal_load", 30, 0.1, 20, 9, 21, 1e-6},
      {"duffing_jenkins", "force.cosine", 0.05, 2, 1.6, 7, 21, 1e-5},
  }));
  CAPTURE(row.name);
  scene::Scene s = scenes::example(row.name);
  s.harmonics.accuracy = 0;
  const observables::ParameterRange range{row.over, row.from, row.to, row.frequency};
  const auto of_order = [&](int order) {
    scene::Scene with = s;
    with.harmonics.order = order;
    return with;
  };
  const auto coarse = observables::parameter_response(of_order(row.lower), range);
  REQUIRE(coarse.size() == 1);
  const scene::Scene finer = of_order(row.higher);
  const auto refined = observables::refined_response(finer, range, coarse, row.accuracy);
  REQUIRE(refined);
  Reference many(s, 2 * row.higher + 21);
  check_parts(*refined, coarse.front(), observables::parameter_response(finer, range).front(), many,
              row.accuracy);
  auto several = coarse;
  several.push_back(several.front());
  CHECK_FALSE(observables::refined_response(finer, range, several, row.accuracy));
  auto by_shooting = range;
  by_shooting.method = observables::ResponseMethod::shooting;
  CHECK_FALSE(observables::refined_response(finer, by_shooting, coarse, row.accuracy));
  long asked = 0;
  CHECK_FALSE(observables::refined_response(finer, range, coarse, row.accuracy,
                                            controls::polled([&] { return ++asked < 3; })));
  CHECK(asked == 3);
}

TEST_CASE("parts are not refined where all has to be traced anew") {
  const scene::Scene s = scenes::example("duffing_jenkins");
  scene::Scene finer = s;
  finer.harmonics.accuracy = 0;
  finer.harmonics.order = 15;
  const auto range = range_of(s);
  const auto coarse = response(s, 7);
  REQUIRE(observables::refined_response(finer, range, coarse, 1e-5));
  SECTION("nothing is too inaccurate") {
    auto sure = coarse;
    for (auto& point : sure.front().points) point.truncation_flagged = false;
    for (auto& event : sure.front().events) event.point.truncation_flagged = false;
    CHECK_FALSE(observables::refined_response(finer, range, sure, 1));
  }
  SECTION("most of it is") {
    CHECK_FALSE(observables::refined_response(finer, range, coarse, 1e-12));
  }
  SECTION("all branches are asked for") {
    auto all = range;
    all.branches = observables::Branches::all;
    CHECK_FALSE(observables::refined_response(finer, all, coarse, 1e-5));
  }
  SECTION("by shooting") {
    auto shooting = range;
    shooting.method = observables::ResponseMethod::shooting;
    CHECK_FALSE(observables::refined_response(finer, shooting, coarse, 1e-5));
  }
  SECTION("the response ended early, or there are several") {
    auto early = coarse;
    early.front().status = observables::Status::stopped;
    CHECK_FALSE(observables::refined_response(finer, range, early, 1e-5));
    auto two = coarse;
    two.push_back(two.front());
    CHECK_FALSE(observables::refined_response(finer, range, two, 1e-5));
  }
  SECTION("another response is found at the end of a part") {
    auto other = coarse;
    const auto parts = parts_to_refine(other.front(), 1e-5 * largest(other.front()));
    other.front().points[parts.front().last].coefficients[0] += 0.1 * largest(other.front());
    CHECK_FALSE(observables::refined_response(finer, range, other, 1e-5));
  }
  SECTION("the user ends it") {
    long asked = 0;
    CHECK_FALSE(observables::refined_response(finer, range, coarse, 1e-5,
                                              controls::polled([&] { return ++asked < 10; })));
    CHECK(asked == 10);
  }
}
