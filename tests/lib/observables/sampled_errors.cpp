// Errors of multipliers along branches, which are estimated at some of their points.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/observables/with_stability.hpp"

#include <arcslip/observables/responses_at.hpp>
#include <arcslip/observables/sampled_errors.hpp>
#include <arcslip/observables/stability.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using observables::Multipliers, observables::SampledErrors;

namespace {

// Which of twenty points, at uneven distances, have an estimate of their own.
std::string estimated(double (*modulus)(double), double error = 1e-6) {
  SampledErrors errors;
  std::string all;
  for (int i = 0; i < 20; ++i) {
    const double s = i + 0.3 * std::sin(i);
    const bool wanted = errors.wants({std::polar(modulus(s), s), 0.1}, s);
    if (wanted) errors.take(error);
    all += wanted ? 'x' : '-';
  }
  return all;
}

}  // namespace

TEST_CASE("multipliers have errors of their own at every fifth point and where their moduli bend") {
  const auto line = [](double s) { return 0.5 + 0.02 * s; };
  CHECK(estimated(line) == "xx----x----x----x---");  // bends are known from the third on
  CHECK(estimated([](double s) { return 0.5 + 0.02 * std::max(s, 9.5); }) == "xx----x---xx----x---");
  CHECK(estimated([](double s) { return s < 9.5 ? 0.5 : 0.7; }) == "xx----x---xx----x---");
  // Bends that are small beside the error, or add up beyond it.
  CHECK(estimated([](double s) { return s < 9.5 ? 0.5 : 0.7; }, 0.9) == "xx----x----x----x---");
  CHECK(estimated([](double s) { return 0.5 + 2e-5 * s * s; }) == "xx----x----x----x---");
  const std::string bent = estimated([](double s) { return 0.5 + 1e-4 * s * s; });  // 2e-4 at each
  CHECK(bent.find("---") == std::string::npos);
  CHECK(bent.find("xxx") == std::string::npos);
  // Where nothing is left out, or the error is not known, the next point is asked.
  CHECK(estimated(line, 0) == std::string(20, 'x'));
  CHECK(estimated(line, std::nan("")) == std::string(20, 'x'));
}

TEST_CASE(
    "points and events without an error of their own have the larger one beside, and events its place") {
  observables::ResponseBranch branch;
  const double unknown = observables::no_value;
  for (const double error : {unknown, 1e-3, unknown, unknown, 4e-3, unknown, 2e-3, unknown, unknown}) {
    auto& point = branch.points.emplace_back();
    point.omega = static_cast<double>(branch.points.size());
    point.stability.emplace();
    point.stability->multipliers = {-0.9 - 0.02 * point.omega};
    point.stability->error = error;
    point.stability->estimated = !std::isnan(error);
  }
  branch.points[7].stability->estimated = true;  // asked, and not known
  branch.points[8].stability.reset();
  branch.events.push_back({"period_doubling", false, true, branch.points[3], 4});
  branch.events.push_back({"peak", false, true, branch.points[6], 5});
  observables::complete_stability(branch);
  std::vector<double> errors;
  for (const auto& point : branch.points)
    if (point.stability && !std::isnan(point.stability->error)) errors.push_back(point.stability->error);
  CHECK(errors == std::vector{1e-3, 1e-3, 4e-3, 4e-3, 4e-3, 4e-3, 2e-3});
  CHECK(std::isnan(branch.points[7].stability->error));
  CHECK(branch.events[0].point.stability->error == 4e-3);
  CHECK(branch.events[0].point.location_estimate == Approx(4e-3 / 0.02));
  CHECK(branch.events[1].point.stability->error == 2e-3);  // its own
}

TEST_CASE("along a branch a few points have errors of their own, those of the points alone") {
  const auto s = scenes::paper(15);
  const auto branch = with_stability::response(s, 18, 22);
  std::size_t own = 0, slipping = 0;
  for (const auto& point : branch.points) {
    REQUIRE(point.stability);
    const auto& found = *point.stability;
    REQUIRE(found.error >= 0);
    slipping += point.truncation_estimate > 0;
    if (!found.estimated || point.truncation_estimate == 0) continue;
    ++own;
    observables::PointSettings settings;
    settings.frequency = point.omega / scenes::hertz;
    settings.stability = true;
    const auto alone = observables::point_responses(s, settings).front();
    REQUIRE(alone.point.stability);
    CHECK(alone.point.stability->error == Approx(found.error).epsilon(0.01));
  }
  CHECK(own < slipping / 2);
  CHECK(own >= slipping / 5);
  for (const auto& event : branch.events) CHECK(event.point.stability->error >= 0);
}
