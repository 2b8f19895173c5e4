// Combinations of for_each in several threads: results, their order, and what ends them.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/control/ordered_parallel_for.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <thread>

using namespace arcslip;
using Json = nlohmann::json;
using namespace std::chrono_literals;

namespace {

/// Longer for some k than for others, so that results are ready out of order.
void take_time(std::size_t k) {
  std::this_thread::sleep_for(std::chrono::microseconds(k % 3 == 0 ? 2000 : 100 * (k % 5)));
}

Json results_json_in_threads(const scene::Scene& s, int threads,
                             const results::ProgressCallback& progress = {}) {
  std::ostringstream text;
  results::write_json(text, studies::run(s, {.progress = progress, .threads = threads}));
  return Json::parse(text.str());
}

void remove_seconds(Json& node) {
  if (node.is_object()) node.erase("seconds");
  if (node.is_structured())
    for (Json& each : node) remove_seconds(each);
}

template <class S>
scene::Study over_loads(const scene::StudyType& type, S settings) {
  return {std::string(type.name()),
          &type,
          scene::Settings::of(std::move(settings)),
          {{"damper.normal_load", {1, 2, 3, 4, 5, 6, 8, 10}}}};
}

}  // namespace

TEST_CASE("results of several threads are taken in order, in the calling thread, by few of them at a time") {
  for (const int threads : {0, 1, 2, 3, 8, 100}) {
    CAPTURE(threads);
    std::atomic<bool> goes_on = true;
    std::atomic<int> running = 0, most = 0;
    std::atomic<std::size_t> taken = 0, farthest = 0;
    const auto caller = std::this_thread::get_id();
    bool in_order = true, in_caller = true;
    studies::in_order(
        60, threads, goes_on,
        [&](std::size_t k) {
          most = std::max(most.load(), ++running);
          farthest = std::max(farthest.load(), k - std::min(k, taken.load()));
          take_time(k);
          --running;
          return k;
        },
        [&](std::size_t k) {
          in_order = in_order && k == taken;
          in_caller = in_caller && std::this_thread::get_id() == caller;
          ++taken;
        });
    CHECK(taken == 60);
    CHECK(in_order);
    CHECK(in_caller);
    CHECK(most <= std::max(threads, 1));
    CHECK(farthest <= 2 * static_cast<std::size_t>(std::max(threads, 1)));
    CHECK(goes_on);
  }
}

TEST_CASE("an exception of one computation comes after the results before it, and ends the others") {
  for (const int threads : {1, 2, 8}) {
    CAPTURE(threads);
    std::atomic<bool> goes_on = true;
    std::vector<std::size_t> taken;
    const auto all = [&] {
      studies::in_order(
          1000, threads, goes_on,
          [&](std::size_t k) {
            take_time(k);
            if (k == 7) throw std::runtime_error("seven");
            return k;
          },
          [&](std::size_t k) { taken.push_back(k); });
    };
    CHECK_THROWS_WITH(all(), "seven");
    CHECK(taken == std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6});
  }
}

TEST_CASE("an exception where a result is taken ends the computations") {
  std::atomic<bool> goes_on = true;
  std::atomic<int> begun = 0;
  const auto all = [&] {
    studies::in_order(
        1000, 4, goes_on,
        [&](std::size_t k) {
          ++begun;
          take_time(k);
          return k;
        },
        [](std::size_t k) {
          if (k == 3) throw std::runtime_error("the disk is full");
        });
  };
  CHECK_THROWS_WITH(all(), "the disk is full");
  CHECK_FALSE(goes_on);
  CHECK(begun <= 4 + 8 + 1);
}

TEST_CASE("after a stop what is begun is taken, and no more is begun") {
  for (const int threads : {1, 2, 8}) {
    CAPTURE(threads);
    std::atomic<bool> goes_on = true;
    std::atomic<std::size_t> begun = 0;
    std::size_t taken = 0;
    studies::in_order(
        1000, threads, goes_on,
        [&](std::size_t k) {
          ++begun;
          take_time(k);
          if (k == 20) goes_on = false;
          return k;
        },
        [&](std::size_t k) { CHECK(k == taken++); });
    CHECK(taken == begun);
    CHECK(taken >= 21);
    CHECK(taken <= 21 + 2 * static_cast<std::size_t>(threads));
  }
}

TEST_CASE("studies of every kind have the same results in one thread and in several") {
  scene::Scene s = scenes::paper(5);
  s.studies = {over_loads(studies::frf(), observables::FrequencyRange{19, 21}),
               over_loads(studies::trace(), observables::ParameterRange{"c.value", 0.05, 0.2, 20}),
               over_loads(studies::peaks(), observables::CurveRange{"c.value", 0.1, 0.2, 19, 22}),
               over_loads(studies::point(), observables::PointSettings{.frequency = 20}),
               over_loads(studies::time(), observables::TimeSettings{20}),
               over_loads(studies::modes(), observables::ModeRange{1, 1e-4, 1e-2})};
  for (const double accuracy : {0.0, 1e-3}) {
    s.harmonics.accuracy = accuracy;
    if (accuracy > 0) s.harmonics.order = 55;
    Json one = results_json_in_threads(s, 1);
    remove_seconds(one);
    for (const int threads : {2, 8}) {
      CAPTURE(accuracy, threads);
      Json several = results_json_in_threads(s, threads);
      remove_seconds(several);
      CHECK(several == one);
    }
  }
}

TEST_CASE(
    "progress comes from one thread at a time, of the first combination that is computed, and stops all") {
  scene::Scene s = scenes::paper(5);
  s.studies = {over_loads(studies::frf(), observables::FrequencyRange{19, 21})};
  std::atomic<int> inside = 0;
  long calls = 0;
  int last = 0;
  bool alone = true, forward = true;
  const Json all = results_json_in_threads(s, 4, [&](const results::Progress& now) {
    alone = alone && ++inside == 1;
    forward = forward && now.branch >= last && now.branches == 8;
    last = now.branch;
    ++calls;
    --inside;
    return true;
  });
  CHECK(alone);
  CHECK(forward);
  CHECK(calls > 8 * 50);
  CHECK(all["branches"].size() == 8);

  calls = 0;
  const Json stopped = results_json_in_threads(s, 4, [&](const results::Progress&) { return ++calls < 100; });
  CHECK(stopped["branches"].size() <= 5);
  CHECK(stopped["branches"].back()["stop"]["reason"] == observables::reasons::user.code);
  CHECK(calls <= 100 + 3);
}
