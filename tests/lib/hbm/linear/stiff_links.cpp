// Springs and contacts that are many decades stiffer or softer than the rest.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

using namespace arcslip;

namespace {

// Two masses; the second one carries its friction damper at the end "tip" of a link with a small mass, and a
// cubic spring at "b" itself, so that the elongation of the link is known from the displacements of elements.
// A force in the second harmonic, which brings in the mean, where `even`.
scene::Scene linked(double link, bool even) {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "tip", "far"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 0.9},
                 {"name": "mt", "at": "tip", "value": 0.1}, {"name": "mf", "at": "far", "value": 0.2}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8},
                  {"name": "link", "between": ["tip", "b"], "value": 1},
                  {"name": "link2", "between": ["far", "a"], "value": 1}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.03}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "tip", "stiffness": 0.6, "friction_coefficient": 0.4,
                  "normal_load": 0.5},
                 {"name": "s", "type": "cubic_spring", "between": ["b", "a"], "stiffness": 0.05}],
    "excitation": [{"name": "f", "at": "a", "cosine": 0.3}], "harmonics": {"order": 6}, "response": {"at": "tip"},
    "studies": [{"kind": "frf", "from": 0.3, "to": 1.6}]})");
  if (even) {
    s.excitation.push_back(s.excitation.front());
    s.excitation.back().name = "g";
    s.excitation.back().harmonic = 2;
    s.excitation.back().values = {0.05, 0.02};
  }
  scene::set(s, "link.value", link);
  scene::set(s, "link2.value", 3 * link);
  return s;
}

// The same with the ends of the links in one.
scene::Scene rigid(bool even) {
  scene::Scene s = linked(1, even);
  s.dofs = {"a", "b"};
  s.masses.resize(2);
  s.masses[0].values = {1.2};
  s.masses[1].values = {1.0};
  s.springs.resize(2);
  s.elements[0].directions = {{{1, 1.0}}};
  s.response() = {{1, 1.0}};
  return s;
}

}  // namespace

TEST_CASE(
    "links of 1e4 to 1e24 times the stiffness of the rest are as good as rigid, by the ratio and rounding") {
  for (const bool even : {false, true}) {
    const scene::Scene limit = rigid(even);
    const auto expected = observables::frequency_response(limit, scenes::window(limit)).front();
    REQUIRE(expected.status == observables::Status::complete);
    REQUIRE(!expected.events.empty());
    for (double link = 1e4; link < 1e25; link *= 100) {
      CAPTURE(even, link);
      const scene::Scene s = linked(link, even);
      const auto found = observables::frequency_response(s, scenes::window(s)).front();
      REQUIRE(found.status == observables::Status::complete);
      REQUIRE(found.events.size() == expected.events.size());
      for (std::size_t k = 0; k < found.events.size(); ++k) {
        const auto &here = found.events[k].point, &there = expected.events[k].point;
        CHECK(std::abs(here.omega - there.omega) < 3 / link + 1e-8);
        CHECK(std::abs(here.amplitude / there.amplitude - 1) < 100 / link + 1e-8);
      }
    }
  }
}

TEST_CASE("springs of 1e-10 of the rest are as good as none") {
  scene::Scene s = linked(1e8, false);
  s.springs.push_back({"soft", &scene::spring_type(), {{{1, 1.0}}}, {1e-10}});
  const auto with = observables::frequency_response(s, scenes::window(s)).front();
  s.springs.pop_back();
  const auto without = observables::frequency_response(s, scenes::window(s)).front();
  REQUIRE(with.events.size() == without.events.size());
  for (std::size_t k = 0; k < with.events.size(); ++k)
    CHECK(std::abs(with.events[k].point.amplitude / without.events[k].point.amplitude - 1) < 1e-8);
}

namespace {

// The largest A over w of (k - m w^2)^2 A^2 + (c w A + 4 mu Fn/pi)^2 = f0^2: one harmonic and Coulomb
// friction (Den Hartog's oscillator in the first approximation), for the paper's numbers.
double coulomb_peak(double load) {
  const double k = 17890, m = 1.24, c = 0.134, P = 4 * 0.5 * load / std::numbers::pi;
  double best = 0;
  for (int i = -20000; i <= 20000; ++i) {
    const double w = std::sqrt(k / m) * (1 + 1e-8 * i);
    const double a = (k - m * w * w) * (k - m * w * w) + c * c * w * w, b = c * w * P, e = P * P - 1;
    best = std::max(best, (-b + std::sqrt(b * b - a * e)) / a);
  }
  return best;
}

}  // namespace

TEST_CASE(
    "a contact of any stiffness is Coulomb friction or nothing in the limit, or its stiffness is named") {
  int complete = 0;
  for (double ratio = 1e-10; ratio < 1e21; ratio *= 100) {
    scene::Scene s = scenes::paper(1, 1);
    scene::set(s, "damper.stiffness", 17890 * ratio);
    const auto branch = observables::frequency_response(s, scenes::window(s)).front();
    CAPTURE(ratio, branch.stop.message);
    const bool is_named = branch.stop.message.find("damper.stiffness = ") != std::string::npos;
    CHECK(is_named == (ratio > 2e12));
    CHECK(branch.stop.message.find("Jacobian") == std::string::npos);
    if (is_named) continue;
    CHECK(branch.status == observables::Status::complete);
    ++complete;
    if (ratio > 1e-3 && ratio < 1e3) continue;
    REQUIRE(branch.events.size() == 1);
    const double expected = ratio < 1 ? coulomb_peak(0) : coulomb_peak(1);
    CHECK(std::abs(branch.events[0].point.amplitude / expected - 1) <
          1e-8 + 100 * std::min(ratio, 1 / ratio));
  }
  CHECK(complete >= 11);
}
