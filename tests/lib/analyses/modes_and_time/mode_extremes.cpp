// Modes of equal frequencies, and modes at the ends of what is possible.
#include "lib/analyses/modes_and_time/modes.hpp"

#include <algorithm>
#include <cmath>

using namespace modes;

namespace {

// Three masses of 1, each on a spring of 1, coupled by springs of 0.3 in a ring: frequencies 1, and twice
// sqrt 1.9. element: of mass {i}.
scene::Scene ring(const std::string& element, const std::string& excitation, int order = 1) {
  std::string elements;
  for (const char* i : {"0", "1", "2"}) {
    std::string each = element;
    for (auto at = each.find("{i}"); at != std::string::npos; at = each.find("{i}")) each.replace(at, 3, i);
    elements += (elements.empty() ? "" : ", ") + each;
  }
  return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x0", "x1", "x2"],
      "masses": [{"name": "m0", "at": "x0", "value": 1}, {"name": "m1", "at": "x1", "value": 1},
                 {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k0", "at": "x0", "value": 1}, {"name": "k1", "at": "x1", "value": 1},
                  {"name": "k2", "at": "x2", "value": 1}, {"name": "k01", "between": ["x0", "x1"], "value": 0.3},
                  {"name": "k12", "between": ["x1", "x2"], "value": 0.3},
                  {"name": "k20", "between": ["x2", "x0"], "value": 0.3}]},
    "elements": [)" +
               elements + R"(], "excitation": [)" + excitation + R"(], "harmonics": {"order": )" +
               std::to_string(order) + R"(}, "response": {"at": "x0"},
    "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
}

constexpr const char* cubic_at_each =
    R"({"name": "s{i}", "type": "cubic_spring", "at": "x{i}", "stiffness": 1})";
constexpr const char* contact_at_each =
    R"({"name": "d{i}", "type": "jenkins", "at": "x{i}", "stiffness": 0.25, "friction_coefficient": 0.5,
        "normal_load": 0.4})";
constexpr const char* engine_order =
    R"({"name": "f0", "at": "x0", "cosine": 1},
       {"name": "f1", "at": "x1", "cosine": -0.5, "sine": 0.86602540378443865},
       {"name": "f2", "at": "x2", "cosine": -0.5, "sine": -0.86602540378443865})";

}  // namespace

TEST_CASE("of two modes of one frequency in a ring, an engine order drives the wave that travels") {
  for (const int number : {2, 3}) {
    const ResponseBranch wave = mode(ring(cubic_at_each, engine_order), number, 1e-3, 10);
    at_end(wave, 10);
    for (const ResponsePoint& point : wave.points)
      CHECK(point.omega == Approx(std::sqrt(1.9 + 0.75 * point.amplitude * point.amplitude)).epsilon(1e-11));
  }
}

TEST_CASE("a travelling wave of slipping contacts is that of one mass, and none is alone while they stick") {
  const scene::Scene s = ring(contact_at_each, engine_order);
  const ResponseBranch wave = mode(s, 2, 1, 100);
  at_end(wave, 100);
  for (const ResponsePoint& point : wave.points) {
    // As in nonlinear_modes.cpp: limit 0.2, onset 0.8.
    const double A = point.amplitude, theta = std::acos(1 - 1.6 / A);
    const double stiffness = 0.25 / std::numbers::pi * (theta - 0.5 * std::sin(2 * theta));
    const double omega = std::sqrt(1.9 + stiffness);
    CHECK(point.omega == Approx(omega).epsilon(1e-11));
    CHECK(point.damping_ratio ==
          Approx(0.8 * (A - 0.8) / (2 * std::numbers::pi * omega * omega * A * A)).epsilon(1e-10));
  }
  check_contains(failure(s, 2, 0.1, 100, observables::reasons::no_mode),
                 "while all contacts stick, every combination is one");
  // All alike they move the first mode only.
  const scene::Scene uniform =
      ring(cubic_at_each, R"({"name": "f0", "at": "x0", "cosine": 1}, {"name": "f1", "at": "x1", "cosine": 1},
                             {"name": "f2", "at": "x2", "cosine": 1})");
  check_contains(failure(uniform, 3, 1e-3, 1, observables::reasons::no_mode), "drives none of them");
  CHECK(mode(uniform, 1, 1e-3, 1).points.front().omega == Approx(1).epsilon(1e-6));
}

TEST_CASE("amplitudes of 1e-8 and 1e8 on one branch: a hardening spring and a contact in closed form") {
  const ResponseBranch hardening = mode(oscillator(cubic, 1), 1, 1e-8, 1e8);
  at_end(hardening, 1e8);
  for (const ResponsePoint& point : hardening.points)
    CHECK(point.omega == Approx(std::sqrt(1 + 0.75 * point.amplitude * point.amplitude)).epsilon(1e-11));
  const ResponseBranch friction = mode(oscillator(
                                           R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.25,
                                               "friction_coefficient": 0.5, "normal_load": 0.4})",
                                           1),
                                       1, 1e-8, 1e8);
  at_end(friction, 1e8);
  for (const ResponsePoint& point : friction.points) {
    const double A = point.amplitude, loss = A > 0.8 ? 0.8 * (A - 0.8) : 0;
    CHECK(point.damping_ratio ==
          Approx(loss / (2 * std::numbers::pi * std::pow(point.omega * A, 2))).epsilon(1e-7).margin(1e-14));
    if (A < 0.8) CHECK(point.omega == Approx(std::sqrt(1.25)).epsilon(1e-12));
    if (A > 1e6) CHECK(point.omega == Approx(1).epsilon(1e-8));
  }
}

TEST_CASE("a contact that always slips, and a gap that is never reached, leave a linear mode") {
  const ResponseBranch slips = mode(oscillator(
                                        R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.25,
                                            "friction_coefficient": 0.5, "normal_load": 1e-12})",
                                        5),
                                    1, 1e-3, 10);
  at_end(slips, 10);
  for (const ResponsePoint& point : slips.points) {
    CHECK(point.omega == Approx(1).epsilon(1e-8));
    CHECK(point.damping_ratio ==
          Approx(2 * 1e-12 * 0.5 / (std::numbers::pi * point.amplitude)).epsilon(1e-3));
  }
  const ResponseBranch gap =
      mode(oscillator(R"({"name": "g", "type": "gap_spring", "at": "x", "stiffness": 8, "gap": 0.5})", 7), 1,
           1e-8, 0.4999);
  at_end(gap, 0.4999);
  for (const ResponsePoint& point : gap.points) {
    CHECK(point.omega == Approx(1).epsilon(1e-13));
    CHECK(std::abs(point.damping_ratio) < 1e-14);
    CHECK(point.energy == Approx(0.5 * point.amplitude * point.amplitude).epsilon(1e-12));
  }
}
