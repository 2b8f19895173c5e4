// Energies of modes with contacts.
#include "lib/analyses/modes_and_time/modes.hpp"

using namespace modes;

TEST_CASE("two contacts in parallel hold the energy of one with two sliders") {
  const char* pair =
      R"({"name": "a", "type": "jenkins", "at": "x", "stiffness": 0.25, "friction_coefficient": 0.5,
          "normal_load": 0.4},
         {"name": "b", "type": "jenkins", "at": "x", "stiffness": 0.1, "friction_coefficient": 0.5,
          "normal_load": 0.04})";
  const char* table =
      R"({"name": "i", "type": "iwan", "at": "x", "distribution": "table", "table": [[0.25, 0.2], [0.1, 0.02]]})";
  // Beyond the onset of one (0.2) and of both (0.8).
  for (const double A : {0.1, 0.5, 2.0}) {
    const double with_pair = at_end(mode(oscillator(pair, 9), 1, 0.5 * A, A), A).energy;
    const double with_table = at_end(mode(oscillator(table, 9), 1, 0.5 * A, A), A).energy;
    CAPTURE(A);
    CHECK(with_table == Approx(with_pair).epsilon(1e-10));
  }
}
