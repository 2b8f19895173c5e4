// Combinations of for_each in several threads: results, their order, and what ends them.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
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

Json results_json_in_threads(const scene::Scene& s, int threads, const control::Control& control = {}) {
  std::ostringstream text;
  results::write_json(text, studies::run(s, {.control = control, .threads = threads}));
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
  const Json all = results_json_in_threads(s, 4, controls::reporting([&](const control::Progress& now) {
                                             alone = alone && ++inside == 1;
                                             forward = forward && now.branch >= last && now.branches == 8;
                                             last = now.branch;
                                             ++calls;
                                             --inside;
                                             return true;
                                           }));
  CHECK(alone);
  CHECK(forward);
  CHECK(calls > 8 * 50);
  CHECK(all["branches"].size() == 8);

  calls = 0;
  const Json stopped = results_json_in_threads(
      s, 4, controls::reporting([&](const control::Progress&) { return ++calls < 100; }));
  CHECK(stopped["branches"].size() <= 5);
  CHECK(stopped["branches"].back()["stop"]["reason"] == observables::reasons::user.code);
  CHECK(calls <= 100 + 3);
}
