#include "catch.hpp"
#include "environment.hpp"

#include "lib/analyses/branches/same_event.hpp"
#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/observables/in_more_harmonics.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace arcslip;

namespace {

/// The norm of the change of all coefficients from one motion to another of more harmonics.
double change(const observables::ResponsePoint& from, const observables::ResponsePoint& to) {
  double square = 0;
  for (std::size_t i = 0; i < to.coefficients.size(); ++i)
    square += std::pow(to.coefficients[i] - (i < from.coefficients.size() ? from.coefficients[i] : 0), 2);
  return std::sqrt(square);
}

}  // namespace

TEST_CASE("the truncation estimate is the error of the amplitude within a factor of two, for N = 1 to 55") {
  const auto peak_of = [](int order, double load) {
    const scene::Scene s = scenes::paper(order, load);
    return observables::frequency_response(s, scenes::window(s)).front().events.at(0).point;
  };
  for (const auto& exact : reference::exact("resonance_peaks")) {
    const double load = exact["normal_load"], amplitude = exact["amplitude"];
    if (load == 500) continue;  // full stick: no error
    const observables::ResponsePoint all = peak_of(101, load);
    for (int order : {1, 3, 7, 15, 27, 55}) {
      const observables::ResponsePoint peak = peak_of(order, load);
      const double error = std::abs(peak.amplitude - amplitude);
      if (error < 2e-11 * amplitude) continue;  // the digits of the reference
      CAPTURE(order, load, error / amplitude);
      CHECK(peak.truncation_estimate > 0.5 * error);
      // A twentieth of the change of the motion, where that cancels in the amplitude.
      CHECK(peak.truncation_estimate < 2 * error + 0.06 * change(peak, all));
    }
  }
}

TEST_CASE("the estimate of the share of stick at a peak is its error, and 0 where nothing is left out") {
  const auto damper_of = [](int order, double load) {
    const scene::Scene s = scenes::paper(order, load);
    return observables::frequency_response(s, scenes::window(s)).front().events.at(0).point.elements.at(0);
  };
  for (const double load : {0.5, 2.0, 3.0, 8.0}) {
    const double exact = damper_of(101, load).stick_percent;
    for (const int order : {1, 3, 7, 15}) {
      const auto damper = damper_of(order, load);
      const double error = std::abs(damper.stick_percent - exact);
      CAPTURE(load, order, error, damper.stick_estimate);
      // Of short phases of stick, as here of 0.5 N, most is in harmonics beyond those of the estimate.
      CHECK(damper.stick_estimate > (load < 1 ? 0.25 : 0.5) * error);
      CHECK(damper.stick_estimate < 2 * error + 1e-5);
    }
  }
  CHECK(damper_of(7, 500).stick_estimate == 0);
}

TEST_CASE("the estimate of the share of stick holds where the harmonics left out move the peak far") {
  // By 0.4 rad/s, half of the width of the peak.
  scene::Scene beam =
      scene::read_file(source_folder() + "/examples/cantilever/beam.json", test_catalogue::whole());
  scene::set(beam, "damper.normal_load", 60);
  const auto damper_of = [&](int order) {
    beam.harmonics.order = order;
    const auto branch = observables::frequency_response(beam, {18, 24}).front();
    const auto highest =
        std::max_element(branch.events.begin(), branch.events.end(),
                         [](const auto& a, const auto& b) { return a.point.amplitude < b.point.amplitude; });
    REQUIRE(highest != branch.events.end());
    return highest->point.elements.at(0);
  };
  const double exact = damper_of(61).stick_percent;
  for (const int order : {1, 3, 5}) {
    CAPTURE(order);
    const auto damper = damper_of(order);
    CHECK(damper.stick_estimate == Approx(std::abs(damper.stick_percent - exact)).epsilon(0.1));
  }
}

TEST_CASE("where friction is sampled the estimate holds the error of sampling too") {
  for (double load : {0.1, 1.0, 2.0}) {
    scene::Scene s = scenes::paper(27, load);
    s.harmonics.friction = scene::Friction::sampled;
    const auto sampled = scenes::response_at(s, 20);
    const auto exact = scenes::response_at(scenes::paper(101, load), 20);
    const double error = std::abs(sampled.amplitude - exact.amplitude);
    CHECK(error > 1e-7 * exact.amplitude);
    CHECK(sampled.truncation_estimate > 0.4 * error);
    CHECK(sampled.truncation_estimate < 2.5 * error);
  }
}

TEST_CASE("a linear response has no truncation error and no flag") {
  const auto stuck = scenes::response_at(scenes::paper(7, 1e6), 20);
  CHECK(stuck.truncation_estimate < 1e-12 * stuck.amplitude);
  CHECK_FALSE(stuck.truncation_flagged);
}

TEST_CASE("estimates of a structure with many modes above the harmonics are those of its error") {
  // Without a second correction four errors of the beam are above twice the estimate, one above ten times,
  // and without the modes beyond its harmonics two; with the highest mode alone nearly all points are
  // flagged.
  struct Case {
    const char* example;
    std::vector<int> orders;
    std::size_t every;
    double load;
  };
  for (const Case& each :
       {Case{"cantilever/beam.json", {3, 7, 9}, 1, 5}, {"disk_sector/scene.json", {3, 9}, 4, 3}}) {
    CAPTURE(each.example);
    scene::Scene s = scene::read_file(source_folder() + "/examples/" + each.example, test_catalogue::whole());
    scene::set(s, "damper.normal_load", each.load);
    in_more_harmonics::Compared compared;
    for (const int order : each.orders) {
      s.harmonics.order = order;
      const auto branch = observables::frequency_response(s, scenes::window(s)).front();
      const elements::Harmonics kept = model::build(s).harmonics;
      s.harmonics.order = 61;
      in_more_harmonics::compare(std::make_shared<const model::Model>(model::build(s)), kept, branch,
                                 each.every, 1e-7, compared);
    }
    CAPTURE(compared.points, compared.flagged);
    CHECK(compared.points > 70);
    CHECK(20 * compared.flagged < compared.points);
    CHECK(compared.above_twice == 0);
    CHECK(compared.above_ten_times == 0);
    // Without damping nothing bounds the resonances beyond the harmonics of the estimate.
    s.harmonics.order = 3;
    scene::set(s, "steel.beta", 0);
    const auto undamped = observables::frequency_response(s, scenes::window(s)).front();
    REQUIRE(undamped.points.size() > 50);
    CHECK(std::all_of(undamped.points.begin(), undamped.points.end(), [](const auto& point) {
      return point.truncation_flagged || point.truncation_estimate == 0;
    }));
  }
}

TEST_CASE("the flag follows the damping along a branch over it") {
  scene::Scene beam =
      scene::read_file(source_folder() + "/examples/cantilever/beam.json", test_catalogue::whole());
  scene::set(beam, "damper.normal_load", 5);
  beam.harmonics.order = 3;
  const auto branch =
      observables::parameter_response(beam, {.over = "steel.beta", .from = 0, .to = 2e-5, .frequency = 19.5})
          .front();
  REQUIRE(branch.points.size() > 3);
  CHECK(branch.points.front().truncation_flagged);
  CHECK_FALSE(branch.points.back().truncation_flagged);
}

TEST_CASE("at folds the estimate is the error of their amplitude within a factor of two") {
  int folds = 0;
  const auto check = [&](scene::Scene s) {
    const auto low = same_event::response(s);
    s.harmonics.order = 45;
    const auto high = same_event::response(s);
    for (const auto& event : low.events) {
      if (event.kind != "fold") continue;
      const auto* exact = same_event::find(event, high);
      REQUIRE(exact);
      const double error = std::abs(event.point.amplitude - exact->amplitude);
      if (error < 1e-10 * exact->amplitude) continue;  // to which folds are located
      CAPTURE(s.title, event.point.omega, event.nonsmooth, error / exact->amplitude);
      CHECK(event.point.truncation_estimate > 0.5 * error);
      CHECK(event.point.truncation_estimate < 2 * error + 0.06 * change(event.point, *exact));
      ++folds;
    }
  };
  for (int order : {3, 5, 7}) {
    scene::Scene duffing = scenes::example("duffing");
    duffing.harmonics.order = order;
    check(duffing);
  }
  for (int order : {5, 9, 15})
    for (double load : {0.3, 0.5, 0.8, 1.2, 2.0, 2.5}) {
      scene::Scene both = scenes::example("duffing_jenkins");
      both.harmonics.order = order;
      scene::set(both, "damper.normal_load", load);
      scenes::window(both).from = 1;
      scenes::window(both).to = 3.5;
      check(both);
    }
  CHECK(folds > 30);
}
