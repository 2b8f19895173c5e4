// Harmonic balance against the exact periodic motion, at every instant.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <algorithm>
#include <cmath>

using namespace arcslip;

using compared_with_exact::balanced;
using compared_with_exact::difference;

TEST_CASE(
    "harmonic balance with 55, 101 and 201 is within 1.5e-7, 2.5e-8 and 4e-9 of A_max at every instant") {
  const std::pair<int, double> bounds[] = {{55, 1.5e-7}, {101, 2.5e-8}, {201, 4e-9}};
  for (const double hertz : {20.0, 19.9952846841786})  // the second: the peak
    for (const auto& [order, bound] : bounds) {
      CAPTURE(hertz, order);
      CHECK(difference(balanced(scenes::paper(order), hertz), 4001).displacement < bound);
    }
}

TEST_CASE("at 0.2 Hz and 0.1 N the exact motion slips ten times in a period, and so does harmonic balance") {
  const auto pair = balanced(scenes::paper(401, 0.1), 0.2);
  const auto found = difference(pair, 20001);
  const auto& period = found.exact.period;
  CHECK(period.events.size() == 20);
  CHECK(std::abs(100 * period.friction[0].stick_time / period.time - 41.4) < 0.05);
  CHECK(found.displacement < 3e-6);  // the structure's resonance is near the 100th harmonic: like 4 of 1
  CHECK(difference(balanced(scenes::paper(801, 0.1), 0.2), 20001).displacement < 3e-6 / 8);
  const auto at = pair.problem->hbm_evaluator();
  at->move_to(pair.u, pair.p, continuation::Needs::residual);
  elements::FrictionState contact;
  at->element(0).friction(contact);
  std::vector<double> onsets;
  for (const auto& event : period.events)
    if (event.from == "stick") onsets.push_back(pair.equation.omega * event.time);
  REQUIRE(contact.slip_onsets.size() == onsets.size());
  for (std::size_t i = 0; i < onsets.size(); ++i) CHECK(std::abs(contact.slip_onsets[i] - onsets[i]) < 1e-4);
}

TEST_CASE("next to full stick and full slip harmonic balance and the exact motion agree") {
  const double w = 20 * scenes::hertz;
  const double limit = 3500 / std::hypot(21390 - 1.24 * w * w, 0.134 * w) / 0.5;
  for (const double load : {limit * (1 - 1e-3), limit * (1 + 1e-3), limit * (1 - 1e-6), limit * (1 + 1e-6),
                            limit * (1 - 1e-9), limit * (1 + 1e-9), 1e-3, 1e-6, 1e-9}) {
    CAPTURE(load);
    CHECK(difference(balanced(scenes::paper(55, load), 20), 999).displacement < 1e-7);
  }
}

TEST_CASE(
    "with even harmonics a resting slider has the same centre in harmonic balance and in the exact motion") {
  const auto chain = [](double load) {
    return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["a", "b"],
        "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 0.6}],
        "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8}],
        "dampers": [{"name": "ca", "at": "a", "value": 0.1}, {"name": "cb", "at": "b", "value": 0.05}]},
      "elements": [
        {"name": "d1", "type": "jenkins", "at": "a", "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": )" +
                         std::to_string(load) + R"(},
        {"name": "d2", "type": "jenkins", "between": ["a", "b"], "stiffness": 0.3, "friction_coefficient": 0.5,
         "normal_load": 20}],
      "excitation": [{"name": "f", "at": "b", "cosine": 1, "sine": 0.3},
                     {"name": "g", "at": "a", "harmonic": 2, "cosine": 0.4}],
      "harmonics": {"order": 60}, "response": {"at": "b"}, "studies": [{"kind": "frf", "from": 0.3, "to": 2.2}]})");
  };
  for (const double load : {20.0, 0.5}) {
    CAPTURE(load);
    const auto found = difference(balanced(chain(load), 0.7), 2001);
    CHECK(found.exact.period.events.empty() == (load == 20));
    CHECK(found.exact.shooting.multipliers.size() == (load == 20 ? 4 : 5));
    CHECK(found.displacement < (load == 20 ? 1e-12 : 1e-6));
  }
}

TEST_CASE("next to the resonance of the undamped stuck structure shooting converges from harmonic balance") {
  const double w = 20.903 * scenes::hertz, stuck = 1 / (21390 - 1.24 * w * w);  // m, without slip
  for (const double part : {0.1, 1e-3, 1e-6}) {
    CAPTURE(part);
    auto s = scenes::paper(55, 3500 * stuck / 0.5 * (1 - part));
    scene::set(s, "c.value", 0);
    const auto found = difference(balanced(s, 20.903), 999);
    const auto& period = found.exact.period;
    CHECK(found.displacement < 1e-7);
    // Where the defect is at rounding, the state is as good as its last correction.
    const double known = std::max(1e-9, found.exact.shooting.correction);
    CHECK(std::abs(period.energy.friction - period.energy.input) < known * period.energy.input);
    CHECK(known < 1e-8);
    const double reach = stuck * (1 - part);
    CHECK(period.amplitude > reach);
    CHECK(period.amplitude < reach * (1 + 1e-4));  // a little slip takes all that the force gives
  }
}
