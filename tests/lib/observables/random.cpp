// Random structures with friction, from one end of their windows to the other. ARCSLIP_SCENES is how many of
// each kind of excitation; by default 40, or 1000 with ARCSLIP_FULL=1.

#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

using namespace arcslip;

namespace {

using observables::ResponseBranch;
using observables::ResponsePoint;

constexpr double rounding = 1e-9;  // relative, of an amplitude
constexpr int bisections = 24;
constexpr double continuous = 0.05;  // of the change over a step, left in the part of it that changes most

std::uint64_t scenes_of_each_kind() {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return std::getenv("ARCSLIP_FULL") ? 1000 : 40;
}

bool has_peak_between(const ResponseBranch& branch, double lower, double upper) {
  return std::any_of(branch.events.begin(), branch.events.end(), [&](const auto& event) {
    return event.kind == "peak" && event.point.omega >= lower && event.point.omega <= upper;
  });
}

// A point above both of its neighbours has a peak between them.
void check_no_peak_is_hidden(const ResponseBranch& branch) {
  const auto& points = branch.points;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double higher = points[i].amplitude * (1 - rounding);
    if (!(higher > points[i - 1].amplitude && higher > points[i + 1].amplitude)) continue;
    CAPTURE(points[i].omega / scenes::hertz);
    CHECK(has_peak_between(branch, points[i - 1].omega, points[i + 1].omega));
  }
}

// The change of amplitude over the step after point i shrinks with the step: responses in between, each found
// from nothing, leave no gap.
void check_continuous(const scene::Scene& s, const ResponseBranch& branch, std::size_t i) {
  double a = branch.points[i].omega, b = branch.points[i + 1].omega;
  double A = branch.points[i].amplitude, B = branch.points[i + 1].amplitude;
  const double change = std::abs(B - A);
  for (int k = 0; k < bisections && std::abs(B - A) > continuous * change; ++k) {
    const double middle = 0.5 * (a + b);
    const double M = scenes::response_at(s, middle / scenes::hertz).amplitude;
    const bool first_half = std::abs(M - A) > std::abs(B - M);
    (first_half ? b : a) = middle;
    (first_half ? B : A) = M;
  }
  CAPTURE(a / scenes::hertz, A, B);
  CHECK(std::abs(B - A) <= continuous * change);
}

// Where it changes most, absolutely and relative to itself.
void check_continuous(const scene::Scene& s, const ResponseBranch& branch) {
  std::size_t most = 0, relatively = 0;
  double largest = -1, largest_relative = -1;
  for (std::size_t i = 0; i + 1 < branch.points.size(); ++i) {
    const double A = branch.points[i].amplitude, B = branch.points[i + 1].amplitude;
    const double change = std::abs(B - A), relative = change / std::min(A, B);
    if (change > largest) largest = change, most = i;
    if (relative > largest_relative) largest_relative = relative, relatively = i;
  }
  check_continuous(s, branch, most);
  check_continuous(s, branch, relatively);
}

void check_scenes(random_scenes::Excitation excitation) {
  for (std::uint64_t seed = 0; seed < scenes_of_each_kind(); ++seed) {
    CAPTURE(seed);
    const scene::Scene s = random_scenes::make(seed, excitation);
    const auto& study = s.studies.front();
    const auto branches = observables::frequency_response(s, study);
    REQUIRE(branches.size() == 1);
    const ResponseBranch& branch = branches.front();
    CAPTURE(branch.stop.message);
    CHECK(branch.status == observables::Status::complete);
    if (branch.status != observables::Status::complete) continue;
    CHECK(std::all_of(branch.points.begin(), branch.points.end(),
                      [](const ResponsePoint& point) { return std::isfinite(point.amplitude); }));
    // Friction and dampers only take energy out: there is one response at each frequency, and no fold.
    CHECK(std::is_sorted(branch.points.begin(), branch.points.end(),
                         [](const auto& p, const auto& q) { return p.omega < q.omega; }));
    check_no_peak_is_hidden(branch);
    check_continuous(s, branch);
  }
}

}  // namespace

TEST_CASE("random structures excited in one harmonic: whole branches, continuous, with all of their peaks") {
  check_scenes(random_scenes::Excitation::first);
}

TEST_CASE(
    "random structures excited in two odd harmonics: whole branches, continuous, with all of their peaks") {
  check_scenes(random_scenes::Excitation::first_and_third);
}

TEST_CASE(
    "random structures excited in an even harmonic: whole branches, continuous, with all of their peaks") {
  check_scenes(random_scenes::Excitation::first_and_second);
}
