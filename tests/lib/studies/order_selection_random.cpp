// The order by an accuracy on random structures, next to a much higher order.

#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "volume.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/studies/order_selection.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace arcslip;

namespace {

constexpr Volume structures{"ARCSLIP_ORDERS", 3, 250};  // of each kind
constexpr double digits = 1e-9;                         // of amplitudes

double highest(const std::vector<observables::ResponseBranch>& branches) {
  double most = 0;
  for (const auto& branch : branches) {
    for (const auto& point : branch.points) most = std::max(most, point.amplitude);
    for (const auto& event : branch.events) most = std::max(most, event.point.amplitude);
  }
  return most;
}

bool is_whole(const std::vector<observables::ResponseBranch>& branches) {
  return std::all_of(branches.begin(), branches.end(),
                     [](const auto& branch) { return branch.status == observables::Status::complete; });
}

}  // namespace

TEST_CASE("the highest peak of random structures is within the accuracy that chose the order") {
  using random_scenes::Excitation;
  const std::function<scene::Scene(std::uint64_t)> kinds[] = {
      [](std::uint64_t seed) { return random_scenes::make(seed, Excitation::first); },
      [](std::uint64_t seed) { return random_scenes::make(seed, Excitation::first_and_second); },
      [](std::uint64_t seed) { return random_scenes::make_hardening(seed); }};
  int compared = 0, beyond = 0, missed = 0;
  for (const auto& kind : kinds)
    for (std::uint64_t seed = 0; seed < structures.count(); ++seed)
      for (const double accuracy : {1e-2, 1e-4}) {
        scene::Scene s = kind(seed);
        const auto range = scenes::window(s);
        s.harmonics.accuracy = accuracy;
        s.harmonics.order = 99;
        studies::OrderSelection selection(s);
        std::vector<observables::ResponseBranch> branches;
        do {
          selection.set_order(s);
          branches = observables::frequency_response(s, range);
        } while (selection.rises(studies::truncation_of(branches)));
        if (!is_whole(branches)) continue;
        if (!selection.is_reached()) {
          ++missed;
          continue;
        }
        s.harmonics.order = 2 * selection.order() + 21;
        const auto finer = observables::frequency_response(s, range);
        if (!is_whole(finer)) continue;
        const double error = std::abs(highest(branches) / highest(finer) - 1);
        CAPTURE(seed, accuracy, selection.order(), selection.error(), error);
        ++compared;
        if (error > accuracy) ++beyond;
        CHECK(error <= 10 * accuracy + digits);
      }
  CAPTURE(compared, beyond, missed);
  CHECK(100 * (beyond - 1) <= compared);  // one more by chance, where they are few
  CHECK(20 * missed <= compared);
  CHECK(compared > 4 * static_cast<int>(structures.count()));
}
