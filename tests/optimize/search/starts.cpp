// From anywhere to the same optimum, and structures that take their time.

#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"
#include "optimize/row.hpp"

#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

using namespace arcslip;

TEST_CASE("from each of 50 loads between 0.1 N and 100 N the search comes to the exact optimum") {
  for (const auto& exact : reference::exact("optima")) {
    scene::Scene s = scenes::paper(101);
    scene::set(s, "c.value", exact["c"]);
    std::size_t most = 0;
    for (int k = 0; k < 50; ++k) {
      const double start = 0.1 * std::pow(1000.0, k / 49.0);
      scene::set(s, "damper.normal_load", start);
      const auto found =
          optimize::optimum(s, {{{"damper.normal_load", 0.1, 100}}, 18, 22}, {.certificate = false});
      CAPTURE(exact["c"].get<double>(), start, found.stop.message);
      CHECK(found.status == observables::Status::complete);
      REQUIRE(found.design.size() == 1);
      CHECK(std::abs(found.design[0] - exact["normal_load"].get<double>()) < 1e-5);
      CHECK(reference::error(found.amplitude, exact["amplitude"]) < 5e-9);
      CHECK(std::abs(found.point.elements[0].stick_percent - exact["stick_percent"].get<double>()) < 0.005);
      const bool unbounded = exact["c"] == 0.0 && start <= std::numbers::pi / 2;
      CHECK(unbounded == std::isinf(found.evaluations.front().amplitude));
      if (unbounded) CHECK_FALSE(found.notes.empty());
      most = std::max(most, found.evaluations.size());
    }
    CHECK(most <= 40);
  }
}

TEST_CASE("six dampers on ten masses: the search by gradients is as good as that without") {
  const scene::Scene s = row(10, 6, 7);
  const auto problem = over_loads(6, 2, 20);
  const auto found = optimize::optimum(s, problem);
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  REQUIRE(found.certificate);
  CHECK(found.certificate->stationarity < 1e-6);
  CHECK(found.certificate->others_lower);
  CHECK(highest_peak(s, found.design, 2, 20) == Approx(found.amplitude).epsilon(1e-9));
  const auto by_models =
      optimize::optimum(s, problem, {.algorithm = "LN_BOBYQA", .evaluations = 200, .certificate = false});
  CHECK(found.amplitude <= by_models.amplitude * (1 + 1e-8));
  CHECK(by_models.amplitude == Approx(found.amplitude).epsilon(1e-3));
}

TEST_CASE(
    "six dampers on ten masses: from each of 20 random designs, most of which stick, the same optimum") {
  scene::Scene s = row(10, 6, 7);
  const auto problem = over_loads(6, 2, 20);
  const auto best = optimize::optimum(s, problem, {.certificate = false});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> logarithm(std::log(0.05), std::log(50.0));
  for (int start = 0; start < 20; ++start) {
    for (int i = 0; i < 6; ++i)
      scene::set(s, "d" + std::to_string(i) + ".normal_load", std::exp(logarithm(random)));
    const auto found = optimize::optimum(s, problem, {.certificate = false, .starts = 1});
    CAPTURE(start, found.stop.message);
    CHECK(found.status == observables::Status::complete);
    CHECK(found.amplitude == Approx(best.amplitude).epsilon(1e-10));
    for (std::size_t i = 0; i < 6; ++i) CHECK(found.design[i] == Approx(best.design[i]).epsilon(1e-5));
  }
}

// Three dampers on five masses: several_peaks.cpp.
TEST_CASE("six dampers on ten masses: a global search without gradients comes to the same optimum") {
  const scene::Scene s = row(10, 6, 7);
  const auto problem = over_loads(6, 2, 20);
  const auto best = optimize::optimum(s, problem, {.certificate = false});
  const bool full = std::getenv("ARCSLIP_FULL") != nullptr;  // about a minute
  const auto coarse = optimize::optimum(
      s, problem,
      {.algorithm = "G_MLSL_LDS",
       .evaluations = full ? 3000 : 100,
       .local =
           optimize::LocalOptions{"LN_BOBYQA", {.x_relative = 0, .x_absolute = 1e-3, .f_relative = 0}, 150},
       .population = 4,
       .certificate = false});
  CAPTURE(coarse.stop.message);
  CHECK(coarse.amplitude >= best.amplitude * (1 - 1e-10));
  if (!full) return;
  CHECK(coarse.amplitude <= best.amplitude * 1.02);
  scene::Scene there = s;
  for (std::size_t i = 0; i < 6; ++i)
    scene::set(there, "d" + std::to_string(i) + ".normal_load", coarse.design[i]);
  const auto fine = optimize::optimum(there, problem, {.algorithm = "LN_BOBYQA", .certificate = false});
  CAPTURE(fine.stop.message);
  CHECK(std::none_of(fine.notes.begin(), fine.notes.end(),
                     [](const std::string& note) { return note.find("sticks") != std::string::npos; }));
  CHECK(fine.amplitude == Approx(best.amplitude).epsilon(1e-10));
}
