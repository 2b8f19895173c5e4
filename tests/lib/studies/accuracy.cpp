// The study "accuracy": errors next to closed forms and exact numbers, and what it reports.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/accuracy.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace arcslip;
using observables::Accuracy;
using observables::Trial;
using observables::Way;

namespace {

std::vector<Trial> of(const Accuracy& found, Way way, int samples_per_order = 0) {
  std::vector<Trial> all;
  for (const Trial& trial : found.trials)
    if (trial.way == way && (samples_per_order == 0 || (trial.samples >= samples_per_order * trial.order &&
                                                        trial.samples < 2 * samples_per_order * trial.order)))
      all.push_back(trial);
  return all;
}

void check_best(const Accuracy& found) {
  for (const Trial& trial : found.trials) {
    CHECK(trial.seconds > 0);
    CHECK(trial.error == std::abs(trial.amplitude / found.reference_amplitude - 1));
    const bool beaten = std::any_of(found.trials.begin(), found.trials.end(), [&](const Trial& other) {
      return other.error <= trial.error && other.seconds_per_point() < trial.seconds_per_point();
    });
    CHECK(trial.best == !beaten);
  }
  const Trial* fast = observables::fastest(found, 1e-3);
  REQUIRE(fast);
  CHECK(fast->error <= 1e-3);
  for (const Trial& trial : found.trials)
    if (trial.error <= 1e-3) CHECK(fast->seconds_per_point() <= trial.seconds_per_point());
  CHECK(observables::fastest(found, -1) == nullptr);
}

}  // namespace

TEST_CASE("of a linear oscillator every order is exact, and Newmark's error at a peak is of fourth order") {
  const scene::Scene s = scenes::paper(7, 1e6);
  const Accuracy found = observables::accuracy(s, {20, 30, 9});
  CHECK(found.stop.reason == observables::reasons::compared);
  CHECK(found.reference_order == 19);
  CHECK(found.reference_error < 1e-12);
  const auto exact = of(found, Way::exact);
  REQUIRE(exact.size() == 6);  // 1, 2, 3, 5, 7, 9
  for (const Trial& trial : exact) CHECK(trial.error < 1e-12);
  // The frequency is off by h^2, at a peak the amplitude by its square.
  const auto newmark = of(found, Way::newmark);
  REQUIRE(newmark.size() == 4);
  CHECK(newmark[1].error / newmark[2].error == Approx(256).epsilon(0.05));
  CHECK(newmark[2].error / newmark[3].error == Approx(256).epsilon(0.05));
  REQUIRE(of(found, Way::shooting).size() == 1);
  CHECK(of(found, Way::shooting)[0].error < 1e-11);
  check_best(found);
}

TEST_CASE("of the paper's oscillator errors are those compared with the exact peak") {
  const auto exact = reference::exact("resonance_peaks");
  const auto& peak = *std::find_if(exact.begin(), exact.end(), [](const auto& each) {
    return each["normal_load"].template get<double>() == 3;
  });
  const double amplitude = peak["amplitude"];
  const Accuracy found = observables::accuracy(scenes::paper(7, 3), {18, 22, 27});
  INFO(found.stop.message);
  CHECK(found.stop.reason == observables::reasons::compared);
  CHECK(found.reference_order == 55);
  CHECK(std::abs(found.reference_amplitude / amplitude - 1) < 1e-7);
  const auto orders = of(found, Way::exact);
  for (const Trial& trial : orders)
    CHECK(std::abs(trial.error - std::abs(trial.amplitude / amplitude - 1)) < 1e-7);
  CHECK(orders.front().order == 1);
  CHECK(orders.back().order == 27);
  CHECK(orders.back().error < 1e-2 * orders[2].error);
  for (const Trial& trial : orders)
    if (!trial.flagged) CHECK(trial.error < 10 * trial.estimate);
  // Exact in time, at the frequency of the reference's peak.
  REQUIRE(of(found, Way::shooting).size() == 1);
  CHECK(of(found, Way::shooting)[0].error < 1e-7);
  // The error of samples does not fall with the order.
  const auto coarse = of(found, Way::sampled, 8);
  REQUIRE(coarse.size() == orders.size());
  CHECK(coarse.back().error > 10 * orders.back().error);
  CHECK(of(found, Way::sampled, 64).size() == orders.size());
  check_best(found);
  CHECK(found.stop.message.find("exact, order ") != std::string::npos);
}

TEST_CASE(
    "laws that are not sampled have no trials with samples, and smooth ones none that are exact in time") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 0.01}],
    "excitation": [{"name": "f", "at": "x", "harmonic": 2, "cosine": 0.1}], "response": {"at": "x"}})");
  const Accuracy found = observables::accuracy(s, {0.4, 0.6, 10});
  INFO(found.stop.message);
  CHECK(found.stop.reason == observables::reasons::compared);
  CHECK(of(found, Way::sampled).empty());
  CHECK(of(found, Way::shooting).empty());
  CHECK(of(found, Way::exact).front().order == 2);  // the excitation's harmonic at least
  CHECK(of(found, Way::newmark).size() == 4);
  CHECK(found.left_out.empty());
}

TEST_CASE("a comparison without a peak fails with the reason, one that is stopped keeps its trials") {
  const Accuracy none = observables::accuracy(scenes::paper(7, 3), {100, 101, 5});
  CHECK(none.status == observables::Status::failed);
  CHECK(none.stop.reason == observables::reasons::start_failed);
  CHECK(none.stop.message.find("no peak in the window") != std::string::npos);
  CHECK(none.trials.empty());
  const Accuracy stopped =
      observables::accuracy(scenes::paper(7, 3), {18, 22, 9},
                            controls::reporting([](const control::Progress& now) { return now.points < 3; }));
  CHECK(stopped.status == observables::Status::stopped);
  CHECK(stopped.stop.reason == observables::reasons::user);
  CHECK(stopped.trials.size() == 3);
}

TEST_CASE("what cannot be integrated in time is left out, and why") {
  scene::Scene s = scenes::paper(7, 3);
  scene::Part steel;
  steel.name = "steel";
  steel.type = &scene::loss_factor_type();
  steel.values = {0.01};
  s.damping = {steel};
  const Accuracy found = observables::accuracy(s, {18, 22, 5});
  CHECK(found.stop.reason == observables::reasons::compared);
  CHECK(of(found, Way::newmark).empty());
  REQUIRE(found.left_out.size() == 5);
  CHECK(found.left_out[0].find("newmark, 50 steps: ") == 0);
  CHECK(found.left_out[0].find("loss factor") != std::string::npos);
}
