// Random structures of the harder kind and all invariances: the same peaks and folds, each located, in all
// units, names, orders and directions. ARCSLIP_INVARIANCES is how many structures; by default 8, or 200 with
// ARCSLIP_FULL=1.

#include "catch.hpp"

#include "lib/analyses/branches/invariances.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "volume.hpp"

#include <algorithm>

using namespace arcslip;

namespace {

constexpr Volume structures{"ARCSLIP_INVARIANCES", 8, 200};

bool same_bits(const invariances::Response& one, const invariances::Response& other) {
  return std::equal(
      one.points.begin(), one.points.end(), other.points.begin(), other.points.end(),
      [](const auto& a, const auto& b) { return a.omega == b.omega && a.amplitude == b.amplitude; });
}

}  // namespace

TEST_CASE(
    "random structures: the same events to 1e-10 under all invariances, and the same bits in units of two") {
  for (std::uint64_t seed = 0; seed < structures.count(); ++seed) {
    const scene::Scene s = random_scenes::hard(seed);
    const auto as_it_is = invariances::response(s);
    for (const auto& variant : invariances::all(s, seed)) {
      CAPTURE(seed, variant.name);
      const auto response = invariances::response(variant);
      CHECK(invariances::difference(as_it_is, response, 1e-10) == "");
      if (variant.powers_of_two) CHECK(same_bits(as_it_is, response));
    }
  }
}
