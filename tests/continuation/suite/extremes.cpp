#include "catch.hpp"

#include "continuation/suite/cases.hpp"

#include <cmath>

using namespace suite;

TEST_CASE("u and p in units 1e12 larger or smaller make the same branch, with the same points and folds") {
  for (const char* name :
       {"cusp", "freudenstein_roth", "ab", "duffing_1harmonic", "duffing_jenkins_omega", "bratu_numerov",
        "chan", "aircraft_2", "trigger_circuit", "moore_spence", "oden_1"}) {
    const Case c = named(name);
    const int free = c.start.free.in(*c.problem);
    const Branch unit = trace(c);
    for (double in_u : {1e-12, 1.0, 1e12})
      for (double in_p : {1e-12, 1.0, 1e12}) {
        CAPTURE(name, in_u, in_p);
        Case other = c;
        other.problem = rescaled(c.problem, in_u, free, in_p);
        other.start.u *= in_u;
        other.start.p[free] *= in_p;
        other.lower *= in_p;
        other.upper *= in_p;
        const Branch branch = trace(other);
        CHECK(branch.stop.reason == unit.stop.reason);
        CHECK(branch.points.size() == unit.points.size());
        REQUIRE(branch.events.size() == unit.events.size());
        for (std::size_t i = 0; i < unit.events.size(); ++i) {
          const double expected = unit.events[i].point.parameter;
          CHECK(std::abs(branch.events[i].point.parameter / in_p - expected) <
                1e-12 * (1 + std::abs(expected)));
        }
      }
  }
}
