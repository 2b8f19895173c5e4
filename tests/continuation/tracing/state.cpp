// A trace that is saved, or saved and resumed, is the one that was not, bit for bit.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/special_points/stationary.hpp>

using namespace problems;

namespace {

bool same(const Vector& a, const Vector& b) {
  return a.size() == b.size() && (a.array() == b.array()).all();
}

void check_same(const Branch& a, const Branch& b) {
  REQUIRE(a.points.size() == b.points.size());
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    CHECK(same(a.points[k].u, b.points[k].u));
    CHECK(same(a.points[k].tangent, b.points[k].tangent));
    CHECK(a.points[k].parameter == b.points[k].parameter);
    CHECK(a.points[k].arclength == b.points[k].arclength);
  }
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t k = 0; k < a.events.size(); ++k) {
    CHECK(same(a.events[k].point.u, b.events[k].point.u));
    CHECK(a.events[k].point.parameter == b.events[k].point.parameter);
    CHECK(a.events[k].data.index() == b.events[k].data.index());
    if (const auto* fold = std::get_if<Fold>(&a.events[k].data))
      CHECK(fold->curvature == std::get<Fold>(b.events[k].data).curvature);
  }
  CHECK(a.stop.reason == b.stop.reason);
  CHECK(a.stop.message == b.stop.message);
  CHECK(a.counts.factorizations == b.counts.factorizations);
  CHECK(a.linear_solver == b.linear_solver);
}

// The trace that is never saved, those that are saved after some points, in the middle of things, and at the
// end, and go on, and those that are resumed there.
void check_resumed(const std::shared_ptr<const Problem>& problem, const Start& start, const Options& options,
                   const std::vector<Monitor>& monitors) {
  Tracer never_saved(problem, start, options, monitors);
  while (never_saved.step()) {
  }
  const std::string end = to_json(never_saved.save());
  for (int points : {0, 1, 2, 17, 60, 100000}) {
    Tracer whole(problem, start, options, monitors);
    for (int k = 0; k < points && whole.step(); ++k) {
    }
    const std::string saved = to_json(whole.save());
    while (whole.step()) {
    }
    Tracer resumed(problem, state_from_json(saved), options, monitors);
    while (resumed.step()) {
    }
    CAPTURE(points);
    check_same(whole.branch(), resumed.branch());
    CHECK(to_json(whole.save()) == end);
    CHECK(to_json(resumed.save()) == end);
  }
}

}  // namespace

TEST_CASE(
    "a trace goes on from its state as if it had not been stopped: dense, sparse and a curve of folds") {
  check_resumed(cusp(), {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, window(-1, 1),
                {fold_monitor()});
  check_resumed(chan(20), {Vector::Zero(20), Vector::Zero(1), 0, 1}, window(0, 5), {fold_monitor()});
  check_resumed(folds(cusp(), 0), {Vector{{-0.6, 0.4}}, Vector{{0.0, 1.0}}, 1, -1}, window(-1, 2),
                {cusp_monitor()});
}

TEST_CASE("what is not a state is refused, and a state of another problem too") {
  CHECK_THROWS_AS(state_from_json("{"), std::invalid_argument);
  CHECK_THROWS_AS(state_from_json("{\"format\": \"arcslip-state-1\"}"), std::invalid_argument);
  CHECK_THROWS_WITH(state_from_json("{\"format\": \"arcslip-state-9\"}"),
                    "the format is \"arcslip-state-9\", not \"arcslip-state-1\"");
  Tracer tracer(cusp(), {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, window(-1, 1));
  tracer.step();
  CHECK_THROWS_WITH(Tracer(chan(20), tracer.save(), window(0, 5)),
                    "the state has 1 unknowns, 2 parameters and 0 monitors, the problem has 20, 1 and 0");
}

TEST_CASE("a monitor that is infinite at a point, as decibels at rest are, leaves a state that can be read") {
  const auto line = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  const Monitor decibels{"dB", [](const Accepted& now) { return 20 * std::log10(std::abs(now.u[0])); }};
  check_resumed(line, {Vector{{0.0}}, Vector{{0.0}}, 0, 1}, window(0, 2), {decibels});
  const Monitor undefined{"0/0", [](const Accepted& now) { return now.u[0] > 0.5 ? std::nan("") : 1.0; }};
  check_resumed(line, {Vector{{0.0}}, Vector{{0.0}}, 0, 1}, window(0, 2), {undefined});
}

TEST_CASE("warnings are part of a state, and a state from before there were any is read") {
  const auto line = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  const Monitor undefined{"0/0", [](const Accepted& now) { return now.u[0] > 0.1 ? std::nan("") : 1.0; }};
  Tracer tracer(line, {Vector{{0.0}}, Vector{{0.0}}, 0, 1}, window(0, 2), {undefined});
  for (int k = 0; k < 30; ++k) tracer.step();
  std::string saved = to_json(tracer.save());
  REQUIRE(tracer.branch().warnings.size() == 1);
  CHECK(state_from_json(saved).branch.warnings == tracer.branch().warnings);
  const auto begin = saved.find(",\"warnings\":["), end = saved.find(']', begin);
  REQUIRE(begin != std::string::npos);
  saved.erase(begin, end + 1 - begin);
  const State old = state_from_json(saved);
  CHECK(old.branch.warnings.empty());
  Tracer resumed(line, old, window(0, 2), {undefined});
  while (resumed.step()) {
  }
  while (tracer.step()) {
  }
  check_same(tracer.branch(), resumed.branch());
}

TEST_CASE("what a problem says in another encoding does not keep a state from being saved") {
  const auto problem = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) {
    if (p[0] > 0.5) throw std::runtime_error("Werkstoff ung\xfcltig");
    F[0] = u[0] - p[0];
  });
  Tracer tracer(problem, {Vector{{0.0}}, Vector{{0.0}}, 0, 1}, window(0, 2));
  while (tracer.step()) {
  }
  CHECK(state_from_json(to_json(tracer.save())).branch.points.size() == tracer.branch().points.size());
}

TEST_CASE("a state whose free parameter the problem does not have is refused") {
  Tracer tracer(cusp(), {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, window(-1, 1));
  tracer.step();
  State state = tracer.save();
  state.free = 2;
  CHECK_THROWS_WITH(Tracer(cusp(), state, window(-1, 1)),
                    "of the state: the free parameter has index 2, but the problem has 2 parameters, with "
                    "indices from 0");
}

TEST_CASE("a trace that is saved at each point is the one that is not, as is one that is resumed from each") {
  const auto sparse = from_functions(rod(30));
  const auto bent = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) {
    F[0] = u[0] * u[0] * u[0] - 2 * u[0] - p[0] + 0.1 * std::sin(5 * u[0]);
  });
  const auto gap = from_functions({.size = 2,
                                   .parameters = {{"p", ""}},
                                   .residual =
                                       [](In u, In p, Out F) {
                                         F << u[0] + 2 * std::max(0.0, u[0] - 0.2) + 0.5 * u[1] - p[0],
                                             u[1] * u[1] * u[1] + u[1] - 0.5 * u[0];
                                       },
                                   .piece = [](In u, In) { return u[0] > 0.2 ? 1 : 2; }});
  struct Case {
    std::shared_ptr<const Problem> problem;
    Start start;
    Options options;
    std::vector<Monitor> monitors;
  };
  const Monitor level{"level", [](const Accepted& now) { return now.u[0] - 0.11; }};
  for (const Case& c :
       {Case{sparse,
             {Vector::Zero(30), Vector{{5.0}}, 0, 1},
             window(5, 120),
             {branch_point_monitor(), fold_monitor()}},
        Case{bent, {Vector{{-2.0}}, Vector{{-4.0}}, 0, 1}, window(-6, 6), {fold_monitor(), level}},
        Case{gap, {Vector::Zero(2), Vector{{0.0}}, 0, 1}, window(-1, 1), {kink_monitor(), level}}}) {
    Tracer plain(c.problem, c.start, c.options, c.monitors), saved(c.problem, c.start, c.options, c.monitors);
    auto resumed = std::make_unique<Tracer>(c.problem, c.start, c.options, c.monitors);
    while (plain.step()) {
    }
    while (saved.step()) saved.save();
    while (resumed->step())
      resumed = std::make_unique<Tracer>(c.problem, state_from_json(to_json(resumed->save())), c.options,
                                         c.monitors);
    CHECK(plain.branch().points.size() > 20);
    const std::string end = to_json(plain.save());
    CHECK(to_json(saved.save()) == end);
    CHECK(to_json(resumed->save()) == end);
  }
}
