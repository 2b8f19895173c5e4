// Stability of equilibria along branches, against eigenvalues in closed form.

#include "catch.hpp"

#include "continuation/events/hopf_problems.hpp"

#include <Eigen/LU>

#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/stability/spectrum_finder.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <algorithm>
#include <numbers>
#include <random>

using namespace problems;

namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

SparseMatrix sparse(int n, const Entries& entries) {
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// -1 .. -reals on the diagonal, and the pair real +- i w, turned by a chain of small rotations would fill:
// the unknowns are coupled upwards, which leaves the eigenvalues as they are.
SparseMatrix reals_and_pair(int reals, double real, double w) {
  Entries entries;
  for (int i = 0; i < reals; ++i) {
    entries.emplace_back(i, i, -1.0 - i);
    if (i + 1 < reals) entries.emplace_back(i, i + 1, 0.5);
  }
  entries.emplace_back(reals, reals, real);
  entries.emplace_back(reals + 1, reals + 1, real);
  entries.emplace_back(reals, reals + 1, -w);
  entries.emplace_back(reals + 1, reals, w);
  entries.emplace_back(3, reals, 0.3);
  return sparse(reals + 2, entries);
}

bool covers(const Spectrum& found, double w) {
  return std::any_of(found.found_near.begin(), found.found_near.end(),
                     [&](const AxisRange& each) { return each.lower <= w && w <= each.upper; });
}

// u_t = u_xx + p u, u = 0 at both ends: eigenvalues p - (2 (n + 1) sin(k pi / 2 (n + 1)))^2.
std::shared_ptr<const Problem> heat(int n, double skew = 0) {
  Functions f;
  f.size = n;
  f.parameters = {parameter("p", 0)};
  const double rate = (n + 1.0) * (n + 1.0);
  const auto matrix = [=](double p) {
    Entries entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, p - 2 * rate);
      if (i + 1 < n)
        entries.emplace_back(i, i + 1, rate * (1 + skew)), entries.emplace_back(i + 1, i, rate / (1 + skew));
    }
    return sparse(n, entries);
  };
  f.residual = [=](In u, In p, Out F) { F = matrix(p[0]) * u; };
  f.sparse_jacobian = [=](In, In p, SparseMatrix& J) { J = matrix(p[0]); };
  f.scales = Vector::Constant(n, std::sqrt(n));
  return from_functions(std::move(f));
}

double mode(int n, int k) {
  return std::pow(2 * (n + 1) * std::sin(k * std::numbers::pi / (2 * (n + 1))), 2);
}

int unstable_modes(int n, double p) {
  int count = 0;
  while (count < n && mode(n, count + 1) < p) ++count;
  return count;
}

}  // namespace

TEST_CASE(
    "the Brusselator is stable up to its Hopf point, with the eigenvalues of its trace and determinant") {
  Options options = window(0.5, 4);
  options.stability.emplace();
  const auto problem = brusselator();
  const Branch branch =
      trace(problem, {Vector{{1.0, 0.5}}, Vector{{1.0, 0.5}}, 1, 1}, options, hopf_monitors(*problem));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  for (const Point& point : branch.points) {
    REQUIRE(point.spectrum);
    const double half = (point.parameter - 2) / 2;
    CHECK(point.spectrum->complete);
    CHECK(point.spectrum->unstable == (half > 0 ? 2 : 0));
    REQUIRE(point.spectrum->leading.size() == 2);
    CHECK(std::abs(point.spectrum->leading[0] - (half + std::sqrt(std::complex<double>(half * half - 1)))) <
          1e-6);
  }
  const auto ranges = stability_ranges(branch);
  REQUIRE(ranges.size() == 2);
  CHECK(ranges[0].unstable == 0);
  CHECK(ranges[1].unstable == 2);
  CHECK(ranges[0].last + 1 == ranges[1].first);
  CHECK(ranges[0].complete);
  REQUIRE(branch.events.size() == 1);
  CHECK(branch.events[0].after == ranges[0].last);
}

TEST_CASE("without being asked for, points have no spectrum and a branch no ranges") {
  const Branch branch = trace(brusselator(), {Vector{{1.0, 0.5}}, Vector{{1.0, 0.5}}, 1, 1}, window(0.5, 1));
  for (const Point& point : branch.points) CHECK(!point.spectrum);
  CHECK(stability_ranges(branch).empty());
}

TEST_CASE("a terminal event has the spectrum of its place, also where not every point has one") {
  for (const int n : {5, 60}) {
    CAPTURE(n);
    Options options = window(0, 40);
    options.stability = StabilityOptions{};
    Monitor here{"here", [](const Accepted& now) { return now.parameter - 12.5; }};
    here.terminal = true;
    const Branch branch = trace(heat(n), {.u = Vector::Zero(n), .p = Vector{{0.0}}}, options, {here});
    CHECK(branch.stop.reason == StopReason::event);
    CHECK(branch.points.back().parameter == Approx(12.5));
    REQUIRE(branch.points.back().spectrum);
    for (const Point& point : branch.points) {
      if (n > 50 && !point.spectrum) continue;
      REQUIRE(point.spectrum);
      CHECK(point.spectrum->unstable == unstable_modes(n, point.parameter));
      CHECK(std::abs(point.spectrum->leading.front() - (point.parameter - mode(n, 1))) < 1e-8);
    }
  }
}

TEST_CASE("a corner of the branch has the spectrum of the piece before it, and the next point that beyond") {
  // u' = p - k u with the stiffness k = 1 below u = 1, and 3 beyond.
  Functions f;
  f.size = 1;
  f.parameters = {parameter("p", 0)};
  f.residual = [](In u, In p, Out F) { F[0] = p[0] - (u[0] < 1 ? u[0] : 1 + 3 * (u[0] - 1)); };
  f.jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = u[0] < 1 ? -1 : -3; };
  f.piece = [](In u, In) { return static_cast<std::uint64_t>(u[0] < 1 ? 0 : 1); };
  const auto problem = from_functions(f);
  for (const SpectrumAt at : {SpectrumAt::every_point, SpectrumAt::events}) {
    Options options = window(0.1, 2);
    options.stability.emplace();
    options.stability->at = at;
    const Branch branch = trace(problem, {Vector{{0.5}}, Vector{{0.5}}, 0, 1}, options, {kink_monitor()});
    REQUIRE(branch.events.size() == 1);
    const std::size_t corner = branch.events[0].after + 1;
    REQUIRE(corner + 1 < branch.points.size());
    REQUIRE(std::abs(branch.points[corner].parameter - 1) < 1e-8);
    REQUIRE(branch.points[corner].spectrum);
    CHECK(branch.points[corner].spectrum->leading.at(0) == -1.0);
    REQUIRE(branch.points[corner + 1].spectrum);
    CHECK(branch.points[corner + 1].spectrum->leading.at(0) == -3.0);
    const Branch stopped = trace(problem, {Vector{{0.5}}, Vector{{0.5}}, 0, 1}, options, {kink_monitor()},
                                 [](const Accepted&, const Event* event) { return event == nullptr; });
    CHECK(stopped.stop.reason == StopReason::user);
    CHECK(stopped.points.back().parameter < 1.5);
  }
}

TEST_CASE("infinite eigenvalues of a singular mass are dropped, in dense and in sparse problems") {
  // x' = p x - y, y' = x + p y, 0 = z - x, 0 = v + y - z: mu = p +- i. Beyond them a chain of -1, -2, ..
  for (const int chain : {0, 600}) {
    const int n = 4 + chain;
    Entries of_J{{0, 1, -1.0}, {1, 0, 1.0}, {2, 2, 1.0}, {2, 0, -1.0},
                 {3, 3, 1.0},  {3, 1, 1.0}, {3, 2, -1.0}},
        of_M;
    of_M.emplace_back(0, 0, 1);
    of_M.emplace_back(1, 1, 1);
    for (int i = 0; i < chain; ++i) {
      of_M.emplace_back(4 + i, 4 + i, 2);
      of_J.emplace_back(4 + i, 4 + i, -2.0 * (i + 1));
    }
    for (const double p : {-0.25, 0.25}) {
      Entries entries = of_J;
      entries.emplace_back(0, 0, p);
      entries.emplace_back(1, 1, p);
      StabilityOptions options;
      options.mass = std::make_shared<const SparseMatrix>(sparse(n, of_M));
      SpectrumFinder finder(options);
      const Spectrum found = finder.at(sparse(n, entries));
      CAPTURE(chain, p);
      CHECK(found.unstable == (p > 0 ? 2 : 0));
      CHECK(found.complete == (chain == 0));
      REQUIRE(found.leading.size() >= 2);
      CHECK(std::abs(found.leading[0] - std::complex<double>(p, 1)) < 1e-8);
      CHECK(std::abs(found.leading[1] - std::complex<double>(p, -1)) < 1e-8);
      options.second_opinion = true;
      if (const auto nearest = SpectrumFinder(options).at(sparse(n, entries)).nearest)
        CHECK(std::abs(*nearest - std::complex<double>(p, 1)) < 1e-8);
      else
        CHECK(chain == 0);
      if (chain == 0) {
        CHECK(found.leading.size() == 2);
        CHECK(SpectrumFinder(options).at(Matrix(sparse(n, entries))).leading.size() == 2);
      }
    }
  }
}

TEST_CASE("a pair at w = 50 beyond 600 real eigenvalues is found, or reported as not looked for") {
  for (const double real : {-0.1, 0.1}) {
    const SparseMatrix J = reals_and_pair(600, real, 50);
    StabilityOptions options;
    const Spectrum found = SpectrumFinder(options).at(J);
    CHECK(!found.complete);
    CHECK(covers(found, 50));
    CHECK(found.unstable == (real > 0 ? 2 : 0));
    REQUIRE(!found.leading.empty());
    CHECK(std::abs(found.leading[0] - std::complex<double>(real, 50)) < 1e-6);

    options.largest_frequency = 60;
    CHECK(SpectrumFinder(options).at(J).unstable == found.unstable);
    options.shifts = 1;
    const Spectrum near_zero = SpectrumFinder(options).at(J);
    CHECK(near_zero.unstable == 0);
    CHECK(!covers(near_zero, 50));
    REQUIRE(near_zero.found_near.size() == 1);
    CHECK(near_zero.found_near[0].lower == 0);
    CHECK(near_zero.found_near[0].upper > 7);
    CHECK(near_zero.found_near[0].upper < 9);

    options.shifts = 2;
    options.frequencies = {48};
    const Spectrum asked = SpectrumFinder(options).at(J);
    CHECK(covers(asked, 50));
    CHECK(asked.unstable == found.unstable);
  }
}

TEST_CASE("the second opinion finds the pair that the shifts have not looked for, at whatever frequency") {
  for (const double w : {5.0, 50.0, 700.0})
    for (const double real : {-0.1, -1e-5, 1e-5, 0.1}) {
      CAPTURE(w, real);
      const SparseMatrix J = reals_and_pair(600, real, w);
      StabilityOptions options;
      options.shifts = 1;
      options.near_shift = 3;
      options.krylov = 30;
      CHECK(SpectrumFinder(options).at(J).unstable == 0);
      CHECK(!SpectrumFinder(options).at(J).nearest);
      options.second_opinion = true;
      SpectrumFinder finder(options);
      for (int again = 0; again < 2; ++again) {  // begun at random, and with what was found before
        const Spectrum found = finder.at(J);
        REQUIRE(found.nearest);
        CHECK(std::abs(*found.nearest - std::complex<double>(real, w)) < 1e-8 * w);
        CHECK(found.unstable == (real > 0 ? 2 : 0));
        CHECK(std::abs(found.leading.at(0) - std::complex<double>(real, w)) < 1e-6 * w);
        CHECK(std::abs(found.leading.at(1) - std::complex<double>(real, -w)) < 1e-6 * w);
        CHECK(covers(found, w));
      }
    }
}

TEST_CASE(
    "the second opinion of the Brusselator on a line is its eigenvalue next to the axis, in closed form") {
  const Line line{300};
  const double A = 2;
  for (const double from_hopf : {-0.3, -0.01, 1e-4, 0.2}) {
    const double B = line.B(1, A) + from_hopf;
    CAPTURE(B);
    // Of mode k: mu^2 - trace mu + determinant = 0.
    std::complex<double> nearest(-1e9, 0);
    for (int k = 1; k <= line.nodes; ++k) {
      const double a = B - 1 - line.d1 * line.wave(k), d = -A * A - line.d2 * line.wave(k);
      const std::complex<double> root = std::sqrt(std::complex<double>((a - d) * (a - d) / 4 - A * A * B));
      for (const auto& mu : {(a + d) / 2 + root, (a + d) / 2 - root})
        if (std::abs(mu.real()) < std::abs(nearest.real())) nearest = {mu.real(), std::abs(mu.imag())};
    }
    const auto problem = line.problem();
    const auto at = problem->evaluator();
    at->move_to(line.homogeneous(A, B), Vector{{B, A}}, Needs::jacobian);
    StabilityOptions options;
    options.second_opinion = true;
    const Spectrum found = SpectrumFinder(options).at(at->jacobian());
    REQUIRE(found.nearest);
    CHECK(std::abs(*found.nearest - nearest) < 1e-8);
  }
}

TEST_CASE("without a nearest eigenvalue that converges there is no second opinion") {
  Entries entries;  // 600 pairs -1 +- i w: all are as near to the axis
  for (int i = 0; i < 600; ++i) {
    entries.emplace_back(2 * i, 2 * i, -1.0);
    entries.emplace_back(2 * i + 1, 2 * i + 1, -1.0);
    entries.emplace_back(2 * i, 2 * i + 1, -3.0 - i);
    entries.emplace_back(2 * i + 1, 2 * i, 3.0 + i);
  }
  StabilityOptions options;
  options.second_opinion = true;
  options.lyapunov_space = 8;
  const Spectrum found = SpectrumFinder(options).at(sparse(1200, entries));
  CHECK(!found.nearest);
  CHECK(found.unstable == 0);
}

TEST_CASE("the second opinion is nearest to the axis also where others are unstable, or were found before") {
  StabilityOptions options;
  options.shifts = 1;
  options.near_shift = 3;
  options.krylov = 30;
  options.second_opinion = true;
  SpectrumFinder finder(options);
  for (const double w : {50.0, 300.0, 20.0}) {  // one after the other
    CAPTURE(w);
    SparseMatrix J = reals_and_pair(600, -1e-3, w);
    J.coeffRef(7, 7) = 5.5;
    const Spectrum found = finder.at(J);
    REQUIRE(found.nearest);
    CHECK(std::abs(*found.nearest - std::complex<double>(-1e-3, w)) < 1e-7 * w);
  }
}

TEST_CASE("no eigenvalue is missing within the range of a shift, also where those next to it converge last") {
  // Pairs next to each other, which Arnoldi's method separates last, some further ones, and many far away.
  std::mt19937 random(1);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * std::uniform_real_distribution<double>(0, 1)(random);
  };
  int within = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const int close = 1 + static_cast<int>(uniform(0, 6)), further = 1 + static_cast<int>(uniform(0, 3));
    const double apart = std::pow(10, uniform(-3, -0.3)), far = uniform(4, 30), step = uniform(0.02, 1),
                 real = -std::pow(10, uniform(-2, 0.5)), coupling = uniform(0, 0.5);
    std::vector<std::complex<double>> all;
    for (int i = 0; i < close; ++i) all.emplace_back(real * uniform(0.5, 1), 1 + i * apart);
    for (int i = 0; i < further; ++i) all.emplace_back(-0.2, 2 + 0.7 * i);
    for (int i = 0; i < 255; ++i) all.emplace_back(-uniform(0.5, 1.5), far + step * i);
    std::shuffle(all.begin(), all.end(), random);
    Entries entries;
    for (int i = 0; i < static_cast<int>(all.size()); ++i) {
      const auto& mu = all[static_cast<std::size_t>(i)];
      for (const int k : {0, 1}) entries.emplace_back(2 * i + k, 2 * i + k, mu.real());
      entries.emplace_back(2 * i, 2 * i + 1, -mu.imag());
      entries.emplace_back(2 * i + 1, 2 * i, mu.imag());
      if (i + 1 < static_cast<int>(all.size())) entries.emplace_back(2 * i, 2 * i + 2, coupling);
    }
    StabilityOptions options;
    options.shifts = 1;
    options.leading = 100;
    options.near_shift = 2 * (1 + static_cast<int>(uniform(0, 6)));
    options.krylov = 2 * options.near_shift + 1 + static_cast<int>(uniform(0, 10));
    options.restarts = 1 + static_cast<int>(uniform(0, 6));
    const Spectrum found = SpectrumFinder(options).at(sparse(2 * static_cast<int>(all.size()), entries));
    for (const AxisRange& range : found.found_near)
      for (const auto& mu : all) {
        if (std::abs(mu) > range.upper * (1 - 1e-6)) continue;
        ++within;
        CAPTURE(trial, apart, range.upper, mu);
        CHECK(std::any_of(found.leading.begin(), found.leading.end(),
                          [&](const auto& each) { return std::abs(each - mu) < 0.05 * apart + 1e-4; }));
      }
  }
  CHECK(within > 1000);
}

TEST_CASE("of a symmetric Jacobian the number of unstable eigenvalues is exact, by its inertia") {
  const int n = 2000;
  Options options = window(1, 300);
  options.step.largest_parameter = 25;
  options.stability.emplace().at = SpectrumAt::every_point;
  const Branch branch = trace(heat(n), {Vector::Zero(n), Vector{{1.0}}, 0, 1}, options);
  REQUIRE(branch.points.size() > 10);
  for (const Point& point : branch.points) {
    REQUIRE(point.spectrum);
    CHECK(point.spectrum->complete);
    CHECK(point.spectrum->unstable == unstable_modes(n, point.parameter));
  }
  CHECK(branch.points.back().spectrum->unstable == 5);
  CHECK(stability_ranges(branch).size() >= 4);
  // The eigenvalue nearest to 0 is among those kept.
  const auto& first = branch.points.front().spectrum->leading;
  REQUIRE(!first.empty());
  CHECK(std::abs(first[0] - (1 - mode(n, 1))) < 1e-6);
}

TEST_CASE("a large Jacobian without symmetry has the eigenvalues of its similar symmetric one") {
  const int n = 1500;
  const auto problem = heat(n, 0.01);
  const auto at = problem->evaluator();
  for (const double p : {5.0, 45.0, 100.0}) {
    at->move_to(Vector::Zero(n), Vector{{p}}, Needs::jacobian);
    const Spectrum found = SpectrumFinder(StabilityOptions{}).at(at->jacobian());
    CHECK(!found.complete);
    CHECK(found.unstable == unstable_modes(n, p));
    REQUIRE(!found.leading.empty());
    CHECK(std::abs(found.leading[0] - (p - mode(n, 1))) < 1e-5);
  }
}

TEST_CASE("beyond 50 unknowns spectra are those of the first point and of points that follow an event") {
  const Line line{30};
  Options options = window(4, line.B(2, 2) + 0.05);
  options.stability.emplace();
  const auto problem = line.problem();
  const Start start{line.homogeneous(2, 4), Vector{{4.0, 2.0}}, 0, 1};
  const Branch branch = trace(problem, start, options, hopf_monitors(*problem, {.normal_form = false}));
  REQUIRE(branch.events.size() == 2);
  const auto with = std::count_if(branch.points.begin(), branch.points.end(),
                                  [](const Point& each) { return each.spectrum.has_value(); });
  CHECK(with >= 2);
  CHECK(with <= 3);
  const auto ranges = stability_ranges(branch);
  REQUIRE(!ranges.empty());
  CHECK(ranges.front().unstable == 0);
  CHECK(ranges.back().unstable == 4);
}

TEST_CASE("the user's eigensolver is asked in place of others, with the last spectrum and the mass") {
  int calls = 0;
  bool had_before = false;
  Options options = window(0.5, 1);
  options.stability.emplace();
  options.stability->mass = std::make_shared<const SparseMatrix>(sparse(2, {{0, 0, 1.0}, {1, 1, 3.0}}));
  options.stability->solver = [&](const Jacobian& J, const SparseMatrix* M, const Spectrum* before) {
    CHECK(std::get<Matrix>(J).rows() == 2);
    REQUIRE(M);
    CHECK(M->coeff(1, 1) == 3);
    had_before = before && before->unstable == 7;
    ++calls;
    Spectrum mine;
    mine.unstable = 7;
    return mine;
  };
  const Branch branch = trace(brusselator(), {Vector{{1.0, 0.5}}, Vector{{1.0, 0.5}}, 1, 1}, options);
  CHECK(calls == static_cast<int>(branch.points.size()));
  CHECK(had_before);
  CHECK(stability_ranges(branch).at(0).unstable == 7);
}

TEST_CASE("a spectrum that cannot be computed is a warning, and the branch is traced") {
  Options options = window(0.5, 1);
  options.stability.emplace().solver = [](const Jacobian&, const SparseMatrix*, const Spectrum*) -> Spectrum {
    throw std::runtime_error("no memory left");
  };
  const Branch branch = trace(brusselator(), {Vector{{1.0, 0.5}}, Vector{{1.0, 0.5}}, 1, 1}, options);
  CHECK(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.warnings.size() == 1);
  CHECK_THAT(branch.warnings[0],
             Catch::Matchers::Contains("no stability at 0.5") && Catch::Matchers::Contains("no memory left"));
  CHECK(!branch.points[0].spectrum);
}

TEST_CASE("options of stability that are not valid are refused with their value and bound") {
  const auto refused = [](auto&& change, const std::string& words) {
    Options options = window(0.5, 1);
    change(options.stability.emplace());
    CHECK_THROWS_WITH(trace(brusselator(), {Vector{{1.0, 0.5}}, Vector{{1.0, 0.5}}, 1, 1}, options),
                      Catch::Matchers::Contains(words));
  };
  refused([](auto& o) { o.leading = 0; }, "stability.leading is 0");
  refused([](auto& o) { o.dense = 2; }, "stability.dense is 2");
  refused([](auto& o) { o.every_point = -1; }, "stability.every_point is -1");
  refused([](auto& o) { o.near_shift = 0; }, "stability.near_shift is 0");
  refused([](auto& o) { o.krylov = 16; }, "stability.krylov is 16");
  refused([](auto& o) { o.restarts = 0; }, "stability.restarts is 0");
  refused([](auto& o) { o.tolerance = 0; }, "stability.tolerance is 0");
  refused([](auto& o) { o.shifts = 0; }, "stability.shifts is 0");
  refused([](auto& o) { o.lyapunov_space = 7; }, "stability.lyapunov_space is 7");
  refused([](auto& o) { o.largest_frequency = -1; }, "stability.largest_frequency is -1");
  refused([](auto& o) { o.frequencies = {std::nan("")}; }, "stability.frequencies is nan");
  refused([](auto& o) { o.mass = std::make_shared<const SparseMatrix>(3, 3); },
          "stability.mass is 3 x 3 for 2 unknowns");
}

TEST_CASE("spectra survive saving") {
  Options options = window(0.5, 4);
  options.stability.emplace();
  Tracer tracer(brusselator(), {Vector{{1.0, 0.5}}, Vector{{1.0, 0.5}}, 1, 1}, options);
  for (int k = 0; k < 5; ++k) tracer.step();
  const State state = state_from_json(to_json(tracer.save()));
  const auto &kept = state.branch.points.back().spectrum, &made = tracer.branch().points.back().spectrum;
  REQUIRE(kept);
  CHECK(kept->leading == made->leading);
  CHECK(kept->unstable == made->unstable);
  CHECK(kept->complete);
  CHECK(kept->found_near[0].upper == made->found_near[0].upper);
}

TEST_CASE("Hopf points of the Brusselator along a line of 10^4 unknowns are those of its modes") {
  const Line line{5000};
  const auto problem = line.problem();
  const double A = 2;
  Options options = window(line.B(1, A) - 0.05, line.B(2, A) + 0.02);
  options.step.largest_parameter = 0.1;
  HopfOptions hopf;
  hopf.spectrum.shifts = 2;
  const Start start{line.homogeneous(A, options.lower), Vector{{options.lower, A}}, 0, 1};
  const Branch branch = trace(problem, start, options, hopf_monitors(*problem, hopf));
  CAPTURE(branch.stop.message);
  REQUIRE(branch.events.size() == 2);
  for (int k : {1, 2}) {
    const Event& event = branch.events[static_cast<std::size_t>(k - 1)];
    const Hopf& at = std::get<Hopf>(event.data);
    CHECK(std::abs(event.point.parameter / line.B(k, A) - 1) < 1e-8);
    CHECK(std::abs(at.frequency / line.frequency(k, A) - 1) < 1e-8);
    CHECK(std::abs(at.growth.value - 0.5) < 1e-6);
    CHECK(at.criticality == Criticality::supercritical);
  }
}

TEST_CASE("Hopf points of large problems ask for a sparse Jacobian, and for a pair to watch") {
  const auto full = from_functions(
      501, {parameter("p", 0)}, [](In u, In p, Out F) { F = (p[0] - 2) * u; },
      [](In, In p, Eigen::Ref<Matrix> J) { J = (p[0] - 2) * Matrix::Identity(501, 501); });
  CHECK_THROWS_WITH(hopf_monitors(*full),
                    Catch::Matchers::Contains("501 unknowns, more than 500, require a sparse"));
  const auto large = heat(501);
  CHECK_THROWS_WITH(hopf_monitors(*large, {.pairs = 0}), Catch::Matchers::Contains("is 0, must be >= 1"));
  HopfOptions options;
  options.spectrum.krylov = 3;
  CHECK_THROWS_WITH(hopf_monitors(*large, options), Catch::Matchers::Contains("stability.krylov is 3"));
}
