// The order of the harmonics by an accuracy: what is reached next to exact numbers, and what is reported
// where it is not.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/order_selection.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

using namespace arcslip;
using observables::no_value;
using studies::OrderSelection;
using studies::Truncation;
using Json = nlohmann::json;

namespace {

/// The results of all studies.
Json results_json(const scene::Scene& s, const control::Control& control = {}) {
  std::ostringstream text;
  results::write_json(text, studies::run(s, {.control = control}));
  return Json::parse(text.str());
}

template <class S>
scene::Scene with_study(scene::Scene s, const scene::StudyType& type, S settings) {
  s.studies = {{"study", &type, scene::Settings::of(std::move(settings)), {}}};
  return s;
}

scene::Scene accurate(scene::Scene s, double accuracy, int highest = scene::largest_chosen_order) {
  s.harmonics.accuracy = accuracy;
  s.harmonics.order = highest;
  return s;
}

Json peak(const Json& branch) {
  Json highest;
  for (const Json& event : branch["events"])
    if (event["kind"] == "peak" && (highest.is_null() || event["amplitude"] > highest["amplitude"]))
      highest = event;
  return highest;
}

/// A scene with a period, and forces in these harmonics.
scene::Scene settings(double accuracy, int highest, int period = 1, std::vector<int> forces = {1}) {
  scene::Scene s = accurate(scenes::paper(7), accuracy, highest);
  s.harmonics.period = period;
  const scene::Part force = s.excitation.front();
  s.excitation.clear();
  for (const int n : forces) s.excitation.push_back(force), s.excitation.back().harmonic = n;
  return s;
}

/// The orders that a selection takes if the results have this error.
template <class Error>
std::vector<int> orders(const scene::Scene& s, const Error& error) {
  OrderSelection selection(s);
  std::vector<int> all;
  do {
    scene::Scene with = s;
    selection.set_order(with);
    CHECK(with.harmonics.accuracy == 0);
    all.push_back(with.harmonics.order);
  } while (selection.rises(error(all.back())));
  CHECK(selection.order() == all.back());
  return all;
}

}  // namespace

TEST_CASE("orders rise by the rate of the error, and not beyond what an accuracy requires") {
  for (const double rate : {1.0, 2.0, 3.0, 5.0})
    for (const double accuracy : {1e-2, 1e-4, 1e-6}) {
      CAPTURE(rate, accuracy);
      const double exact = std::pow(accuracy, -1 / rate);  // the real order that has it
      const auto taken = orders(settings(accuracy, scene::largest_order), [&](int n) {
        return Truncation{.amplitude = 2, .estimate = 2 * std::pow(n, -rate)};
      });
      CAPTURE(taken);
      if (exact > scene::largest_order) {
        CHECK(taken.back() == scene::largest_order);
      } else {
        CHECK(taken.back() >= exact);
        CHECK(taken.back() <= std::max(2.2 * exact + 2, 3.0));
        CHECK(taken.size() <= 9);
      }
      for (std::size_t i = 0; i + 1 < taken.size(); ++i) {
        CHECK(taken[i] < taken[i + 1]);
        CHECK(taken[i] % 2 == 1);
      }
    }
}

TEST_CASE("orders begin with the harmonics of the excitation, in periods of the motion") {
  const auto exact = [](int) { return Truncation{.amplitude = 1, .estimate = 0}; };
  CHECK(orders(settings(1e-3, 99), exact) == std::vector{3});
  CHECK(orders(settings(1e-3, 99, 1, {1, 7, 4}), exact) == std::vector{7});
  CHECK(orders(settings(1e-3, 99, 3), exact) == std::vector{9});
  CHECK(orders(settings(1e-3, 99, 2, {4}), exact) == std::vector{10});
  CHECK(orders(settings(1e-3, 2), exact) == std::vector{2});
  const auto rising =
      orders(settings(1e-6, 99, 2), [](int n) { return Truncation{.amplitude = 1, .estimate = 1. / n}; });
  for (std::size_t i = 0; i + 1 < rising.size(); ++i) CHECK(rising[i] % 2 == 0);
  CHECK(rising.back() == 99);
}

TEST_CASE("without estimates, or where one is flagged, the orders before decide, too") {
  for (const double estimate : {no_value, 1e-9})
    for (const double rate : {2.0, 3.0, 6.0}) {
      CAPTURE(estimate, rate);
      const auto taken = orders(settings(1e-4, 999), [&](int n) {
        return Truncation{.amplitude = 1 + std::pow(n, -rate), .estimate = estimate, .flagged = true};
      });
      CAPTURE(taken);
      CHECK(taken.size() >= 2);
      CHECK(std::pow(taken.back(), -rate) <= 1e-4);
      CHECK(taken.back() <= 3 * std::pow(1e-4, -1 / rate) + 2);
    }
  // A landmark counts by its own size.
  const auto taken = orders(settings(1e-3, 999), [](int n) {
    return Truncation{.amplitude = 1, .landmarks = {{1e-5 * (1 + std::pow(n, -2)), 1e-5}}};
  });
  CHECK(std::pow(taken.back(), -2) <= 1e-3);
  CHECK(taken.size() > 2);
  // Results of different structure do not agree.
  const auto never = orders(settings(1e-2, 99), [](int n) {
    return Truncation{.amplitude = 1,
                      .landmarks = std::vector<studies::Landmark>(static_cast<std::size_t>(n))};
  });
  CHECK(never.back() == 99);
}

TEST_CASE("what fails twice, and what the user ends, is not computed again") {
  CHECK(orders(settings(1e-4, 99), [](int) { return Truncation{.failed = true}; }).size() == 2);
  CHECK(orders(settings(1e-4, 99), [](int) {
          return Truncation{.ended = true, .amplitude = 1, .estimate = 1};
        }).size() == 1);
}

TEST_CASE("peaks of the paper's oscillator are as accurate as was asked for, next to the exact ones") {
  const auto exact = reference::exact("resonance_peaks");
  for (const auto& each : exact) {
    const double load = each["normal_load"], amplitude = each["amplitude"];
    if (load < 1 || load > 20) continue;
    int before = 0;
    for (const double accuracy : {1e-2, 1e-4, 1e-6}) {
      CAPTURE(load, accuracy);
      const Json all = results_json(accurate(
          with_study(scenes::paper(7, load), studies::frf(), observables::FrequencyRange{17, 28}), accuracy));
      const Json& branch = all["branches"][0];
      const Json& reported = branch["accuracy"];
      CAPTURE(reported.dump());
      CHECK(reported["wanted"] == accuracy);
      CHECK(reported["error"] <= accuracy);
      CHECK(std::abs(peak(branch)["amplitude"].get<double>() / amplitude - 1) <= accuracy);
      CHECK(reported["order"] >= before);
      CHECK(reported["orders"].back() == reported["order"]);
      CHECK(!branch.contains("doubt"));
      before = reported["order"];
      // The same as with its order given for the whole response.
      const Json highest = peak(branch);
      CHECK(highest["order"] <= reported["order"]);
      const scene::Scene given = with_study(scenes::paper(highest["order"], load), studies::frf(),
                                            observables::FrequencyRange{17, 28});
      const Json there = peak(results_json(given)["branches"][0]);
      for (const char* of : {"amplitude", "frequency", "energy_friction"})
        CHECK(reference::error(highest[of], there[of]) < 1e-9);
    }
    CHECK(before > 9);
  }
}

TEST_CASE("a curve is as accurate as was asked for, compared with exact motions in time") {
  const observables::FrequencyRange range{18, 24};
  const double accuracy = 1e-5;
  scene::Scene s = accurate(with_study(scenes::paper(7, 3), studies::frf(), range), accuracy);
  const Json branch = results_json(s)["branches"][0];
  const double most = peak(branch)["amplitude"];
  int compared = 0;
  for (std::size_t i = 0; i < branch["points"].size(); i += 12) {
    const Json& point = branch["points"][i];
    const double frequency = point["frequency"];
    CAPTURE(frequency);
    const Json motion = results_json(
        with_study(scenes::paper(7, 3), studies::time(), observables::TimeSettings{frequency}))["motions"][0];
    CHECK(std::abs(point["amplitude"].get<double>() - motion["amplitude"].get<double>()) <= accuracy * most);
    ++compared;
  }
  CHECK(compared > 5);
}

TEST_CASE("a linear structure takes the lowest order, and a smooth spring few more") {
  const std::string duffing = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 0.5}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.5}], "response": {"at": "x"},
    "harmonics": {"accuracy": 1e-8}})";
  scene::Scene s = with_study(scenes::parse(duffing), studies::frf(), observables::FrequencyRange{0.7, 2.5});
  CHECK(s.harmonics.order == scene::largest_chosen_order);
  const Json smooth = results_json(s)["branches"][0];
  CHECK(smooth["accuracy"]["error"] <= 1e-8);
  CHECK(smooth["accuracy"]["order"] <= 31);
  s.harmonics.accuracy = 0;
  s.harmonics.order = 61;
  CHECK(std::abs(peak(smooth)["amplitude"].get<double>() /
                     peak(results_json(s)["branches"][0])["amplitude"].get<double>() -
                 1) <= 1e-8);

  s = accurate(s, 1e-8);
  s.elements.clear();
  const Json linear = results_json(s)["branches"][0];
  CHECK(linear["accuracy"]["orders"] == Json{3});
  CHECK(linear["accuracy"]["error"] < 1e-14);
}

TEST_CASE("sampled friction has samples for the accuracy") {
  scene::Scene s =
      accurate(with_study(scenes::paper(7, 3), studies::frf(), observables::FrequencyRange{18, 24}), 1e-4);
  s.harmonics.friction = scene::Friction::sampled;
  const Json sampled = results_json(s)["branches"][0];
  CHECK(sampled["accuracy"]["error"] <= 1e-4);
  scene::Scene exact = with_study(scenes::paper(101, 3), studies::frf(), observables::FrequencyRange{18, 24});
  CHECK(std::abs(peak(sampled)["amplitude"].get<double>() /
                     peak(results_json(exact)["branches"][0])["amplitude"].get<double>() -
                 1) <= 1e-4);
}

TEST_CASE("an accuracy that is not reached is reported") {
  const Json all = results_json(accurate(
      with_study(scenes::paper(7, 3), studies::frf(), observables::FrequencyRange{17, 28}), 1e-9, 15));
  const Json& branch = all["branches"][0];
  CHECK(branch["status"] == "complete");
  CHECK(branch["accuracy"]["order"] == 15);
  CHECK(branch["accuracy"]["error"] > 1e-9);
  const std::string doubt = branch["doubt"];
  CHECK(doubt.starts_with("the accuracy 1e-09 is not reached: "));
  CHECK(doubt.ends_with(" with harmonics up to 15"));
}

TEST_CASE("an accuracy is not known where the estimate is larger than the response") {
  const scene::Scene isolator = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}]},
    "elements": [{"name": "fr", "type": "jenkins", "at": "x", "stiffness": 1e4, "friction_coefficient": 1,
      "normal_load": 0.5}],
    "excitation": [{"name": "base", "type": "base_displacement", "cosine": 1}], "response": {"at": "x"},
    "studies": [{"kind": "frf", "from": 0.3, "to": 0.9}]})");
  const Json all = results_json(accurate(isolator, 1e-4, 15));
  const Json& branch = all["branches"][0];
  CHECK(branch["status"] == "complete");
  CHECK(branch["accuracy"]["error"].is_null());
  const std::string doubt = branch["doubt"];
  CHECK(doubt == "the accuracy 1e-04 is not reached: the error is not known with harmonics up to 15");
}

TEST_CASE("a study that the user ends has the order that it had") {
  long calls = 0;
  const Json all = results_json(
      accurate(with_study(scenes::paper(7, 3), studies::frf(), observables::FrequencyRange{17, 28}), 1e-6),
      controls::reporting([&](const control::Progress& now) {
        CHECK(now.order == 3);
        return ++calls < 40;
      }));
  const Json& branch = all["branches"][0];
  CHECK(branch["stop"]["reason"] == observables::reasons::user.code);
  CHECK(branch["accuracy"]["orders"].size() == 1);
  CHECK(!branch.contains("doubt"));
}

TEST_CASE("a study that the user ends in a higher order has the whole results of the order before") {
  const scene::Scene s =
      accurate(with_study(scenes::paper(7, 3), studies::frf(), observables::FrequencyRange{17, 28}), 1e-6);
  for (const int after : {0, 10, 20}) {  // reports of the second order
    CAPTURE(after);
    int calls = 0;
    const Json branch = results_json(s, controls::reporting([&](const control::Progress& now) {
                                       return now.order == 3 || ++calls <= after;
                                     }))["branches"][0];
    CHECK(calls == after + 1);
    CHECK(branch["status"] == "complete");
    CHECK(branch["accuracy"]["orders"] == Json{3});
    const std::string doubt = branch["doubt"];
    CHECK(doubt.starts_with("the accuracy 1e-06 is not reached: "));
    CHECK(doubt.ends_with(" with harmonics up to 3, since a higher order was interrupted"));
    scene::Scene given = s;
    given.harmonics.accuracy = 0;
    given.harmonics.order = 3;
    Json points = branch["points"];
    for (Json& point : points) {
      CHECK(point["order"] == 3);
      point.erase("order");
    }
    CHECK(results_json(given)["branches"][0]["points"] == points);
  }
}

TEST_CASE("a failing study is tried with two orders") {
  scene::Scene s =
      accurate(with_study(scenes::paper(7, 3), studies::frf(), observables::FrequencyRange{17, 28}), 1e-6);
  scene::set(s, "damper.normal_load", 1e6);  // stuck
  scene::set(s, "c.value", 0);
  const Json all = results_json(s);
  CAPTURE(all.dump());
  CHECK(all["branches"][0]["accuracy"]["orders"].size() <= 2);
}

TEST_CASE("what was searched in vain with too few harmonics is searched again with more") {
  observables::ResponseBranch none;
  none.status = observables::Status::failed;
  CHECK(studies::truncation_of({&none, 1}).failed);
  none.found_none = {.amplitude = 2, .estimate = 0.1, .flagged = false};
  const Truncation vain = studies::truncation_of({&none, 1});
  CHECK(!vain.failed);
  CHECK((vain.amplitude == 2 && vain.estimate == 0.1));

  // With 9 harmonics the window has no break of symmetry, which is at 1.2027 rad/s. By shooting at 25 N:
  // 1.23527688 and 1.65078397 rad/s.
  const auto s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "nl", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "force", "at": "x", "cosine": 25}], "response": {"at": "x"},
    "harmonics": {"accuracy": 1e-4},
    "studies": [{"kind": "bifurcations", "of": "period_doubling", "over": "force.cosine", "from": 25,
      "to": 25.05, "frequency": [1.2, 1.7], "branches": "all", "doublings": 0}]})");
  const Json found = results_json(s)["branches"];
  REQUIRE(found.size() == 2);
  CHECK(std::abs(found[0]["points"][0]["frequency"].get<double>() - 1.23527688) < 1e-6);
  CHECK(std::abs(found[1]["points"][0]["frequency"].get<double>() - 1.65078397) < 1e-6);
}

TEST_CASE("every kind of study by harmonic balance takes an accuracy, and others have no order to choose") {
  const scene::Scene paper = accurate(scenes::paper(7, 3), 1e-4);
  const Json trace = results_json(with_study(
      paper, studies::trace(), observables::ParameterRange{"damper.normal_load", 1, 20, 20}))["branches"][0];
  CHECK(trace["accuracy"]["error"] <= 1e-4);
  const Json peaks = results_json(with_study(
      paper, studies::peaks(), observables::CurveRange{"damper.normal_load", 1, 20, 17, 28}))["branches"][0];
  CHECK(peaks["accuracy"]["error"] <= 1e-4);
  const Json point = results_json(
      with_study(paper, studies::point(), observables::PointSettings{.frequency = 20}))["responses"][0];
  CHECK(point["accuracy"]["error"] <= 1e-4);
  const Json motion =
      results_json(with_study(paper, studies::time(), observables::TimeSettings{20}))["motions"][0];
  CHECK(!motion.contains("accuracy"));
  CHECK(std::abs(point["amplitude"].get<double>() / motion["amplitude"].get<double>() - 1) <= 1e-4);
  const Json shooting = results_json(
      with_study(paper, studies::frf(),
                 observables::FrequencyRange{
                     .from = 19, .to = 21, .method = observables::ResponseMethod::shooting}))["branches"][0];
  CHECK(!shooting.contains("accuracy"));
}

TEST_CASE("optima and curves of optima take an accuracy") {
  scene::Scene s = scenes::example("al_sayed_2011");
  std::erase_if(s.studies, [](const scene::Study& study) { return study.type->name() != "optimum"; });
  REQUIRE(s.studies.size() == 1);
  auto& settings = s.studies[0].settings.as<optimize::OptimumSettings>();
  REQUIRE(settings.problem.over.size() == 1);
  for (const bool along : {false, true}) {
    CAPTURE(along);
    if (along) settings.along = optimize::DesignVariable{"force.cosine", 90, 110};
    const char* list = along ? "optimum_curves" : "optima";
    const auto amplitude = [&](const Json& all) {
      const Json& result = all[list][0];
      return (along ? result["points"].back()["amplitude"] : result["optimum"]["amplitude"]).get<double>();
    };
    const Json all = results_json(accurate(s, 1e-6));
    const Json& reported = all[list][0]["accuracy"];
    CAPTURE(reported.dump());
    CHECK(reported["error"] <= 1e-6);
    CHECK(reported["order"] > 3);
    scene::Scene finer = s;
    finer.harmonics.order = 99;
    CHECK(std::abs(amplitude(all) / amplitude(results_json(finer)) - 1) <= 1e-6);
  }
}

TEST_CASE("an accuracy holds at a cusp, at whose load more harmonics have no fold or two") {
  const scene::Scene s = accurate(with_study(scenes::duffing_jenkins(), studies::folds(),
                                             observables::CurveRange{"d.normal_load", 0.8, 3, 0.5, 4}),
                                  1e-4);
  const auto cusp = [](const Json& results) {
    for (const Json& branch : results["branches"])
      for (const Json& event : branch["events"])
        if (event["kind"] == "cusp") return event;
    return Json();
  };
  const Json all = results_json(s), found = cusp(all), reported = all["branches"][0]["accuracy"];
  REQUIRE(found.is_object());
  CHECK(found["truncation_estimate"].is_number());
  CHECK(found["truncation_flagged"] == false);
  CHECK(reported["error"] <= 1e-4);
  CHECK(reported["order"] < 20);  // with the estimate at a fixed load it is not reached by 173
  scene::Scene finer = s;
  finer.harmonics.accuracy = 0;
  finer.harmonics.order = 45;
  const Json exact = cusp(results_json(finer));
  REQUIRE(exact.is_object());
  for (const char* of : {"amplitude", "frequency", "d.normal_load"}) {
    CAPTURE(of);
    CHECK(std::abs(found[of].get<double>() / exact[of].get<double>() - 1) <= 1e-4);
  }
}

TEST_CASE("modes have no estimates: two orders agree") {
  const scene::Scene s = accurate(
      with_study(scenes::paper(7, 3), studies::modes(), observables::ModeRange{1, 1e-4, 1e-2}), 1e-5);
  const Json mode = results_json(s)["branches"][0];
  CAPTURE(mode["stop"].dump());
  CHECK(mode["accuracy"]["orders"].size() >= 2);
  CHECK(mode["accuracy"]["error"] <= 1e-5);
  scene::Scene finer = s;
  finer.harmonics.accuracy = 0;
  finer.harmonics.order = 151;
  const Json exact = results_json(finer)["branches"][0];
  const Json &a = mode["points"].back(), &b = exact["points"].back();
  CHECK(std::abs(a["frequency"].get<double>() / b["frequency"].get<double>() - 1) <= 1e-5);
  CHECK(std::abs(a["damping_ratio"].get<double>() / b["damping_ratio"].get<double>() - 1) <= 1e-5);
}

TEST_CASE(
    "the mode of a conservative structure reaches an accuracy: its damping ratio of 0 changes by nothing") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}]},
    "elements": [{"name": "nl", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}})");
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    const Json mode = results_json(accurate(
        with_study(s, studies::modes(), observables::ModeRange{1, 0.1, 5}), accuracy))["branches"][0];
    CHECK(mode["accuracy"]["error"] <= accuracy);
    CHECK(mode["accuracy"]["order"] <= 65);
    for (const Json& point : mode["points"]) {  // pi sqrt(1 + A^2) / (2 K(m)), m = A^2/(2 (1 + A^2))
      const double a = point["amplitude"], m = a * a / (2 * (1 + a * a));
      const double exact = std::numbers::pi * std::sqrt(1 + a * a) / (2 * std::comp_ellint_1(std::sqrt(m)));
      CHECK(std::abs(point["omega"].get<double>() / exact - 1) <= accuracy);
    }
  }
}

TEST_CASE("the accuracy of a mode holds between the ends of its range, or is not said to be reached") {
  // A light mass on a stiff contact: the higher harmonics count where it begins to slip, and at neither end.
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 0.02}, {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "k2", "between": ["a", "b"], "value": 40}, {"name": "k3", "at": "b", "value": 600}]},
    "elements": [{"name": "fr", "type": "jenkins", "at": "a", "friction_coefficient": 1, "normal_load": 5, "stiffness": 1e5}],
    "excitation": [{"name": "f", "at": "b", "cosine": 1}], "response": {"at": "b"}})");
  const Json mode = results_json(accurate(
      with_study(s, studies::modes(), observables::ModeRange{1, 0.03, 10}), 1e-4, 55))["branches"][0];
  CHECK(mode["accuracy"]["order"] == 55);
  CHECK(mode["accuracy"]["error"] > 1e-4);
  // At 0.15953 m, by shooting: 24.696264 rad/s and 0.0386406.
  const Json* nearest = nullptr;
  for (const Json& point : mode["points"])
    if (!nearest || std::abs(point["amplitude"].get<double>() - 0.15953) <
                        std::abs((*nearest)["amplitude"].get<double>() - 0.15953))
      nearest = &point;
  REQUIRE(nearest);
  CHECK(std::abs((*nearest)["omega"].get<double>() / 24.696264 - 1) < 2e-3);
  CHECK(std::abs((*nearest)["damping_ratio"].get<double>() / 0.0386406 - 1) < 2e-2);
}

TEST_CASE(
    "responses that were searched for need two orders that find as many, or it is said that none confirms "
    "them") {
  const auto run = [](int highest, const std::vector<int>& counts) {
    OrderSelection selection(settings(1e-3, highest));
    std::size_t k = 0;
    for (bool rises = true; rises; ++k)
      rises = selection.rises(
          {.amplitude = 1, .estimate = 1e-6, .responses = counts[std::min(k, counts.size() - 1)]});
    results::End end;
    selection.tell(end);
    return std::pair(k, end.doubt);
  };
  CHECK(run(55, {0}) == std::pair<std::size_t, std::string>(1, ""));  // none was made
  CHECK(run(55, {2}) == std::pair<std::size_t, std::string>(2, ""));
  CHECK(run(55, {1, 3}) == std::pair<std::size_t, std::string>(3, ""));
  CHECK(run(7, {1, 3}).second ==
        "the number of responses changes with the harmonics, to 3 with harmonics up to 7");
  CHECK(run(3, {2}).second == "no second order confirms the number of responses, 2 with harmonics up to 3");
}
