// Problems with a state, which changes with each accepted point and by nothing else.

#include "catch.hpp"
#include "contains.hpp"

#include "continuation/tracing/softening.hpp"

#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/special_points/conserved_sums.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

#include <limits>
#include <random>
#include <string>
#include <thread>

using namespace softening;

namespace {

bool same(const Vector& a, const Vector& b) {
  return a.size() == b.size() && (a.array() == b.array()).all();
}

// The points of the cusp x^3 - x = p that a trace accepts, counted by the problem itself: it has two folds.
StateFunctions counting() {
  StateFunctions all;
  all.initial = Vector::Zero(1);
  all.functions = [](AcceptedState) {
    Functions f;
    f.size = 1;
    f.parameters = {parameter("p", 0)};
    f.residual = [](In u, In p, Out F) { F[0] = p[0] + u[0] - std::pow(u[0], 3); };
    return f;
  };
  all.next = [](In, In, In state, Out next) { next[0] = state[0] + 1; };
  return all;
}

// Some steps are refused, by a residual that is not a number from the moment on that a point was accepted
// until one or more steps were rejected.
struct Refusing {
  explicit Refusing(unsigned seed) : random(seed) {}
  std::mt19937 random;
  int left = 0;

  void arm() { left = random() % 8 == 0 ? static_cast<int>(1 + random() % 2) : 0; }
  StateFunctions of(StateFunctions all) {
    all.functions = [this, make = all.functions](AcceptedState state) {
      Functions f = make(std::move(state));
      f.choosing.residual = [this, residual = f.choosing.residual](In u, In p, Choices& choose, Out F) {
        residual(u, p, choose, F);
        if (left > 0) F[0] = std::numeric_limits<double>::quiet_NaN();
      };
      return f;
    };
    return all;
  }
};

}  // namespace

TEST_CASE("a softening bar follows its snap-back, however sharp, in closed form") {
  const auto [elements, length] = GENERATE(table<int, double>(
      {{4, 20}, {4, 2}, {4, 0.1}, {10, 2}, {10, 0.01}, {10, 1e-4}, {100, 20}, {100, 0.1}, {100, 1e-4}}));
  CAPTURE(elements, length);
  for (const bool by_force : {true, false}) {
    CAPTURE(by_force);
    Bar bar = linear(elements, length);
    bar.by_force = by_force;
    const Branch branch = trace(from_functions(functions(bar)), at_rest(bar), window(0, 2), {fold_monitor()});
    CHECK(error(bar, branch) < 1e-10);
    // The end moves back if the element softens by more than the rest of the bar unloads: up to a million
    // times.
    const bool snaps_back = bar.h() < (1 - bar.h()) / length;
    CHECK(branch.events.size() == (by_force || snaps_back ? 1u : 0u));
    for (const Event& event : branch.events)
      CHECK_THAT(event.point.parameter, Catch::Matchers::WithinAbs(1, 1e-10));
    const Point& last = branch.points.back();
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.state[0] == bar.strain(last.u, last.parameter, bar.weak()));
    CHECK(branch.warnings.empty());
  }
}

TEST_CASE("the sharpest of these snap-backs is next to a reversal, and is not a branch point") {
  for (const bool by_force : {true, false}) {
    Bar bar = linear(100, 1e-4);
    bar.by_force = by_force;
    const Branch branch = trace(from_functions(functions(bar)), at_rest(bar), window(0, 2),
                                {branch_point_monitor(), kink_monitor()});
    REQUIRE(branch.events.size() == 1);
    const Kink& kink = std::get<Kink>(branch.events[0].data);
    CHECK(std::acos(kink.before.dot(kink.after)) > 3.13);
    CHECK(error(bar, branch) < 1e-10);
  }
}

TEST_CASE("a bar that softens exponentially snaps back until its end moves on again") {
  const auto [elements, length] =
      GENERATE(table<int, double>({{4, 0.5}, {10, 0.1}, {10, 1e-3}, {100, 1e-3}}));
  CAPTURE(elements, length);
  Bar bar = exponential(elements, length);
  bar.by_force = false;
  const Branch branch = trace(from_functions(functions(bar)), at_rest(bar), window(0, 2), {fold_monitor()});
  CHECK(error(bar, branch) < 1e-8);
  // At the second fold h + (1 - h) s'(w) = 0.
  const auto folds = events_named(branch, fold_event);
  REQUIRE(folds.size() == 2);
  const double w = 1 + length * std::log((1 - bar.h()) / (bar.h() * length));
  CHECK(folds[0].nonsmooth);
  CHECK(!folds[1].nonsmooth);
  CHECK_THAT(folds[0].point.parameter, Catch::Matchers::WithinAbs(1, 1e-10));
  CHECK_THAT(folds[1].point.parameter, Catch::Matchers::WithinRel(bar.end(w), 1e-10));
  CHECK(branch.stop.reason == StopReason::boundary);
}

TEST_CASE("the state after a hundred rejected steps is that of the same points without any") {
  const Bar bar = linear(10, 2);
  int rejections = 0;
  for (unsigned seed = 1; rejections < 100; ++seed) {
    Refusing refusing(seed);
    Options options = window(0, 2);
    options.keep_states = true;
    options.on_rejection = [&](const Rejection& each) {
      rejections += each.why == Rejected::not_evaluated;
      if (refusing.left > 0) --refusing.left;
    };
    Tracer tracer(from_functions(refusing.of(functions(bar))), at_rest(bar), options, {fold_monitor()});
    while (tracer.step()) refusing.arm();
    const Branch branch = tracer.take();
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(error(bar, branch) < 1e-12);
    double largest = 1;
    for (const Point& point : branch.points) {
      // An elastic strain of 1 is rounded; beyond, each state is the strain of its own point.
      largest = std::max(largest, bar.strain(point.u, point.parameter, bar.weak()));
      CHECK(point.state[0] == largest);
    }
    CHECK_THAT(branch.state[0], Catch::Matchers::WithinAbs(3, 1e-12));
  }
}

TEST_CASE("rejected steps, events, normal forms and checks of derivatives leave the state as it is") {
  Options options = window(-1, 1);
  options.stability.emplace();
  long rejected = 0, checks = 0;
  for (const double largest : {0.0, 0.05, 2.0}) {
    options.step.largest = largest;
    options.step.initial = 1.5;
    options.step.largest_parameter = 1;
    const auto problem = from_functions(counting());
    const Branch branch =
        trace(problem, at(-1.3, -1), options, {fold_monitor(), branch_point_monitor(), kink_monitor()});
    REQUIRE(branch.events.size() == 2);
    CHECK(std::get<Fold>(branch.events[0].data).quadratic.known());
    CHECK(branch.state[0] == static_cast<double>(branch.points.size()));
    rejected += branch.counts.rejected_steps;
    checks += branch.counts.points > 64;
  }
  CHECK(rejected > 0);
  CHECK(checks > 0);
}

TEST_CASE("a terminal event is the last point and leaves a state, those before it leave none") {
  Options options = window(-1, 1);
  options.keep_states = true;
  const Monitor zero{.name = "zero", .value = [](const Accepted& now) { return now.u[0]; }, .terminal = true};
  const Branch branch = trace(from_functions(counting()), at(-1.3, -1), options, {fold_monitor(), zero});
  REQUIRE(branch.events.size() == 2);
  CHECK(branch.stop.reason == StopReason::event);
  for (std::size_t k = 0; k < branch.points.size(); ++k)
    CHECK(branch.points[k].state[0] == static_cast<double>(k + 1));
  CHECK(branch.events[0].point.state.size() == 0);
  CHECK(branch.state[0] == static_cast<double>(branch.points.size()));
}

TEST_CASE("a terminal event that was uncertain for some points leaves the state of its own step") {
  // p = 1e6 - 1e-12 u^2: near the fold p changes by less than its rounding over many points.
  StateFunctions flat = counting();
  flat.functions = [](AcceptedState) {
    Functions f;
    f.size = 1;
    f.parameters = {{"p", "", 1e6, 1, -1e300, 1e300}};
    f.residual = [](In u, In p, Out F) { F[0] = p[0] - 1e6 + 1e-12 * u[0] * u[0]; };
    f.jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 2e-12 * u[0]; };
    f.derivative = [](In, In, int, Out dF) { dF[0] = 1; };
    return f;
  };
  Options options = window(1e6 - 1, 1e6 + 1);
  options.keep_states = true;
  options.points = 2000;
  Monitor fold = fold_monitor();
  fold.terminal = true;
  long shown = 0;
  const Start start{Vector::Constant(1, -400.0), Vector::Constant(1, 1e6 - 1.6e-7), 0, 1, Vector{{1.0, 0.0}}};
  const Branch branch =
      trace(from_functions(flat), start, options, {fold}, [&](const Accepted&, const Event* event) {
        if (event == nullptr) ++shown;
        return true;
      });
  REQUIRE(branch.stop.reason == StopReason::event);
  CHECK(shown > static_cast<long>(branch.points.size()));  // points beyond it were accepted, and dropped
  CHECK(branch.state[0] == static_cast<double>(branch.points.size()));
  CHECK(branch.points.back().state[0] == branch.state[0]);
}

TEST_CASE("an observer sees a point in the state that it was computed from, and may ask for the next one") {
  std::vector<double> next;
  const Observer look = [&](const Accepted& now, const Event* event) {
    Vector state(1);
    now.at.next_state(state);
    if (!event) next.push_back(state[0]);
    return next.size() < 7;
  };
  Options options = window(-1, 1);
  options.keep_states = true;
  const Branch branch = trace(from_functions(counting()), at(-1.3, -1), options, {fold_monitor()}, look);
  CHECK(branch.stop.reason == StopReason::user);
  REQUIRE(next.size() == branch.points.size());
  for (std::size_t k = 0; k < next.size(); ++k) CHECK(next[k] == branch.points[k].state[0]);
}

TEST_CASE("a damaged bar unloads along its secant, and softens on from where it was") {
  const Bar bar = linear(10, 2);
  const auto problem = from_functions(functions(bar));
  const Monitor half{.name = "half",
                     .value = [=](const Accepted& now) { return bar.strain(now.u, 0, bar.weak()) - 2; },
                     .terminal = true};
  const Branch pulled = trace(problem, at_rest(bar), window(0, 2), {half});
  REQUIRE_THAT(pulled.state[0], Catch::Matchers::WithinAbs(2, 1e-12));
  const Point& end = pulled.points.back();
  Start released{
      .u = 0.9 * end.u, .p = Vector{{0.9 * end.parameter}}, .direction = -1, .state = pulled.state};
  const Branch back = trace(problem, released, window(0, 2));
  for (const Point& point : back.points)
    CHECK((point.u - point.parameter / end.parameter * end.u).norm() < 1e-12);
  CHECK(same(back.state, pulled.state));
  const Start again{.u = Vector::Zero(10), .p = Vector{{0.0}}, .state = back.state};
  const Branch broken = trace(problem, again, window(0, 2), {fold_monitor()});
  REQUIRE(broken.events.size() == 1);
  CHECK_THAT(broken.events[0].point.parameter, Catch::Matchers::WithinAbs(0.5, 1e-12));
  for (const Point& point : broken.points)
    if (const double w = bar.strain(point.u, 0, bar.weak()); w > 2)
      CHECK_THAT(point.parameter, Catch::Matchers::WithinAbs(bar.strength(w), 1e-12));
  CHECK_THAT(broken.state[0], Catch::Matchers::WithinAbs(3, 1e-12));
}

TEST_CASE("a trace of a problem with a state resumes bit for bit") {
  const int elements = GENERATE(4, 10);  // with dense LU, and with KLU, which reuses pivots
  const Bar bar = exponential(elements, 0.1);
  const auto problem = from_functions(functions(bar));
  Options options = window(0.01, 2);
  options.keep_states = true;
  const Start start{.u = Vector::Zero(elements), .p = Vector{{0.01}}};
  Tracer whole(problem, start, options, {fold_monitor()});
  std::vector<std::string> saved;
  while (whole.step()) saved.push_back(to_json(whole.save()));
  const std::string end = to_json(whole.save());
  REQUIRE(saved.size() > 60);
  for (std::size_t k = 0; k < saved.size(); k += 7) {
    Tracer resumed(problem, state_from_json(saved[k]), options, {fold_monitor()});
    while (resumed.step()) {
    }
    CAPTURE(k);
    CHECK(to_json(resumed.save()) == end);
  }
}

TEST_CASE("traces of one problem, in turn, in threads and in both directions, have states of their own") {
  const Bar bar = linear(10, 2);
  const auto problem = from_functions(functions(bar));
  const Branch alone = trace(problem, at_rest(bar), window(0, 2));
  Tracer first(problem, at_rest(bar), window(0, 2)), second(problem, at_rest(bar), window(0, 2));
  for (int k = 0; k < 60; ++k) first.step();
  while (second.step()) first.step();
  while (first.step()) {
  }
  std::vector<Branch> branches(4);
  std::vector<std::thread> threads;
  for (Branch& each : branches)
    threads.emplace_back([&] { each = trace(problem, at_rest(bar), window(0, 2)); });
  for (std::thread& each : threads) each.join();
  branches.push_back(first.take());
  branches.push_back(second.take());
  for (const Branch& each : branches) {
    CHECK(same(each.state, alone.state));
    CHECK(same(each.points.back().u, alone.points.back().u));
  }

  const Start middle{.u = Vector::LinSpaced(10, 0.05, 0.5), .p = Vector{{0.5}}, .direction = -1};
  const WholeBranch whole = trace_both(problem, middle, window(0, 2));
  CHECK(whole.branch.state[0] == 1);  // that of its last point, at the force 0; the way there is elastic
  const double w = bar.strain(whole.branch.points.front().u, 0, bar.weak());
  CHECK_THAT(w, Catch::Matchers::WithinAbs(3, 1e-12));  // the other end, in a state of its own
}

TEST_CASE("a lagged factor is that of the point before, for points and for events") {
  StateFunctions lagged;  // u = (1 + 0.2 u_before) p
  lagged.initial = Vector::Zero(1);
  lagged.functions = [](AcceptedState before) {
    Functions f;
    f.size = 1;
    f.parameters = {parameter("p", 0)};
    f.residual = [=](In u, In p, Out F) { F[0] = u[0] - (1 + 0.2 * before[0]) * p[0]; };
    return f;
  };
  lagged.next = [](In u, In, In, Out next) { next = u; };
  const auto level = [](const char* name, double u) {
    return Monitor{.name = name, .value = [u](const Accepted& now) { return now.u[0] - u; }};
  };
  const Branch branch =
      trace(from_functions(lagged), at(0, 0), window(0, 1), {level("low", 0.3), level("high", 0.8)});
  REQUIRE(branch.stop.reason == StopReason::boundary);
  double before = 0;
  for (const Point& point : branch.points) {
    CHECK_THAT(point.u[0], Catch::Matchers::WithinAbs((1 + 0.2 * before) * point.parameter, 1e-14));
    before = point.u[0];
  }
  REQUIRE(branch.events.size() == 2);  // trials from the point before them
  for (const Event& event : branch.events) {
    const double lag = branch.points[event.after].u[0];
    CHECK_THAT(event.point.u[0], Catch::Matchers::WithinAbs((1 + 0.2 * lag) * event.point.parameter, 1e-14));
  }
}

TEST_CASE(
    "a wrong Jacobian of a problem with a state is found, and a right one is not doubted as it softens") {
  const Bar bar = exponential(10, 0.5);
  StateFunctions wrong = functions(bar);
  wrong.functions = [make = wrong.functions](AcceptedState state) {
    Functions f = make(std::move(state));
    f.choosing.sparse_jacobian = [right = f.choosing.sparse_jacobian](In u, In p, Choices& made,
                                                                      SparseMatrix& J) {
      right(u, p, made, J);
      if (made[0] == 0) J *= 1.01;
    };
    return f;
  };
  const Start start{.u = Vector::Zero(10), .p = Vector{{0.01}}};
  const Branch doubted = trace(from_functions(wrong), start, window(0.01, 2));
  REQUIRE(!doubted.warnings.empty());
  CHECK(contains(doubted.warnings[0], "the Jacobian is wrong"));
  Options options = window(0.01, 2);
  options.step.largest = 0.003;  // 512 points and more
  const Branch right = trace(from_functions(functions(bar)), start, options);
  CHECK(right.points.size() > 512);
  CHECK(right.warnings.empty());
}

TEST_CASE("a sum that is conserved takes the state of its problem along") {
  StateFunctions reaction = counting();
  reaction.functions = [](AcceptedState) {
    Functions f;
    f.size = 2;
    f.parameters = {parameter("k", 1)};
    f.residual = [](In u, In p, Out F) { F << p[0] * u[0] - u[1], u[1] - p[0] * u[0]; };
    return f;
  };
  const auto problem = from_functions(reaction);
  const Vector u0{{0.5, 0.5}};
  const auto closed =
      with_conserved_sums(problem, conserved_sums(*problem, u0, parameter_values(*problem)), u0);
  const Branch branch = trace(closed, {.u = u0, .p = parameter_values(*closed)}, window(0.5, 2));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  CHECK(branch.state[0] == static_cast<double>(branch.points.size()));
}

TEST_CASE("a branch ends where the state that a point leaves cannot be computed") {
  StateFunctions all = counting();
  all.next = [](In u, In, In state, Out next) {
    if (u[0] > -1) throw std::runtime_error("the damage is larger than 1");
    next = state;
  };
  const Branch thrown = trace(from_functions(all), at(-1.3, -1), window(-1, 1));
  CHECK(thrown.stop.reason == StopReason::not_evaluated);
  CHECK(contains(thrown.stop.message, "the state that the point at"));
  CHECK(contains(thrown.stop.message, "the damage is larger than 1"));
  all.next = [](In u, In, In, Out next) { next[0] = std::log(-1 - u[0]); };
  const Branch undefined = trace(from_functions(all), at(-1.3, -1), window(-1, 1));
  CHECK(undefined.stop.reason == StopReason::not_evaluated);
  CHECK(contains(undefined.stop.message, "the state is not finite"));
}

TEST_CASE("a closed curve of a problem whose state has changed on the way is not a closed branch") {
  // A circle, of which the state counts the points, or the rounds: back at its start, the state is another
  // one.
  const auto circle = [](auto&& next) {
    StateFunctions all;
    all.initial = Vector::Constant(1, 3);
    all.functions = [](AcceptedState) {
      Functions f;
      f.size = 1;
      f.parameters = {parameter("p", 0)};
      f.residual = [](In u, In p, Out F) { F[0] = u[0] * u[0] + p[0] * p[0] - 1; };
      return f;
    };
    all.next = next;
    return from_functions(all);
  };
  Options options{.lower = -2, .upper = 2};
  options.points = 400;
  const Start start{.u = Vector{{0.8}}, .p = Vector{{0.6}}};
  const Branch counted =
      trace(circle([](In, In, In state, Out next) { next[0] = state[0] + 1; }), start, options);
  CHECK(counted.stop.reason == StopReason::point_limit);
  CHECK(counted.points.size() == 400);
  const Branch same = trace(circle([](In, In, In state, Out next) { next[0] = state[0]; }), start, options);
  CHECK(same.stop.reason == StopReason::closed);
  // Of a state that is 0 at the start but for rounding.
  const Branch back = trace(circle([](In u, In p, In, Out next) {
                              next[0] =
                                  (u[0] - 0.8) * (u[0] - 0.8) + (p[0] - 0.6) * (p[0] - 0.6) + 1e-17 * u[0];
                            }),
                            start, options);
  CHECK(back.stop.reason == StopReason::closed);
  CHECK(same.points.size() < 200);
}

TEST_CASE("states that do not fit are refused with their sizes, and problems with a state where it is lost") {
  const auto problem = from_functions(counting());
  Start start = at(-1.3, -1);
  start.state = Vector::Zero(3);
  CHECK_THROWS_WITH(trace(problem, start, window(-1, 1)),
                    "the state of the start has 3 numbers, that of the problem 1");
  start.state = Vector::Constant(1, std::numeric_limits<double>::infinity());
  CHECK_THROWS_WITH(trace(problem, start, window(-1, 1)), "the state of the start is not finite");
  start.state = Vector::Zero(1);
  const auto line = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  CHECK_THROWS_WITH(trace(line, start, window(-1, 1)),
                    "the state of the start has 1 numbers, that of the problem 0");
  State other = Tracer(problem, at(-1.3, -1), window(-1, 1)).save();
  other.accepted.resize(0);
  CHECK_THROWS_WITH(Tracer(problem, other, window(-1, 1)),
                    "the state of the trace has 0 numbers, that of the problem 1");
  CHECK_THROWS_WITH(
      folds(problem, 0),
      "a curve of special points is of a problem without a state: other parameters leave another state, "
      "which the points of the curve do not pass");
  CHECK_THROWS_WITH(trace_diagram(problem, at(-1.3, -1), window(-1, 1), {}),
                    "a diagram is of a problem without a state: branches that meet have left different ones");
  StateFunctions none = counting();
  none.initial.resize(0);
  CHECK_THROWS_WITH(from_functions(none), "a problem with a state needs an initial one, of finite numbers");
  none = counting();
  none.next = {};
  CHECK_THROWS_WITH(from_functions(none), "a problem with a state needs its functions, and the next state");
}
