// How branches of modes end, and why there is none; their figures; random structures.
#include "lib/analyses/modes_and_time/modes.hpp"
#include "lib/hbm/random_scenes.hpp"

#include <arcslip/studies/presentation/figures.hpp>

#include <algorithm>
#include <cmath>

using namespace modes;

TEST_CASE("where there is no mode to follow a branch says why") {
  using namespace observables::reasons;
  const scene::Scene s = parse(two_masses(cubic_at_x1, 3, "x2"));
  check_contains(failure(s, 3, 1e-3, 1, no_mode), "mode 3 does not exist: the structure has 2 modes");
  check_contains(
      failure(oscillator(R"({"name": "d", "type": "coulomb", "at": "x", "friction_coefficient": 0.5,
                             "normal_load": 0.4})",
                         3),
              1, 1e-3, 1, no_mode),
      "the friction of \"d\" has no stiffness");
  check_contains(failure(oscillator(R"({"name": "s", "type": "bilinear_spring", "at": "x", "stiffness": -3,
                                        "stiffness_beyond": 3, "corner": 1})",
                                    3),
                         1, 1e-3, 1, no_mode),
                 "mode 1 does not oscillate: the structure at rest is unstable");
  // A free pair of masses, first in odd harmonics and then with a mean.
  const auto floating = [](const std::string& excitation) {
    return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k12", "between": ["x1", "x2"], "value": 1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "between": ["x1", "x2"], "stiffness": 0.5}],
    "excitation": [{"name": "f", "at": "x1", "cosine": 1)" +
                 excitation + R"(}],
    "harmonics": {"order": 3}, "response": {"at": "x1"},
    "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
  };
  check_contains(
      failure(floating(""), 1, 1e-3, 1, no_mode),
      "mode 1 is a motion that no spring resists, of frequency 0; the first mode that oscillates is "
      "mode 2");
  CHECK(mode(floating(""), 2, 1e-4, 1).points.front().omega == Approx(std::sqrt(2)).epsilon(1e-6));
  check_contains(failure(floating(R"(, "harmonic": 2)"), 2, 1e-3, 1, start_failed),
                 "no spring holds the mean position of \"x1\"");
  // Mode 2 of three equal masses between walls does not move the one in the middle.
  const scene::Scene node = parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "c"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1},
                 {"name": "mc", "at": "c", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 1},
                  {"name": "kbc", "between": ["b", "c"], "value": 1}, {"name": "kc", "at": "c", "value": 1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "b", "stiffness": 0.5}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}], "harmonics": {"order": 3},
    "response": {"at": "b"}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
  check_contains(failure(node, 2, 1e-3, 1, no_mode), "mode 2 does not move the response");
  scene::Scene linear = node;
  linear.responses.front().direction = {{0, 1.0}};
  check_contains(failure(linear, 2, 1e-3, 1, no_mode),
                 "mode 2 moves no element: it is linear, of 1.4142136 rad/s and the damping ratio 0");
  // Two blades that nothing couples, and two of different stiffness: 1/k of the dampers shifts no other mode.
  const auto pair = [](double k2, const std::string& response) {
    return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", )" +
                 scenes::uncoupled({{"a", 1, 1, 0.1}, {"b", 1, k2, 0.1}}) +
                 R"(, "elements": [{"name": "s", "type": "cubic_spring", "at": "a", "stiffness": 0.5},
                                   {"name": "t", "type": "cubic_spring", "at": "b", "stiffness": 0.5}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}], "harmonics": {"order": 3},
    "response": {"at": ")" +
                 response + R"("}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
  };
  check_contains(failure(pair(1, "b"), 1, 1e-3, 1, no_mode), "mode 1 does not move the response");
  CHECK(at_end(mode(pair(1, "a"), 1, 1e-3, 1), 1).omega ==
        Approx(at_end(mode(pair(1.21, "a"), 1, 1e-3, 1), 1).omega).epsilon(1e-12));
  CHECK(mode(pair(1.21, "b"), 2, 1e-4, 1).points.front().omega == Approx(1.1).epsilon(1e-6));
  // Harmonics without the fundamental: a motion of three periods with two harmonics.
  scene::Scene subharmonic = oscillator(cubic, 2);
  subharmonic.harmonics.period = 3;
  check_contains(failure(subharmonic, 1, 1e-3, 1, no_mode), "the fundamental is not among the harmonics");
}

TEST_CASE("a mode may be stopped, and takes only amplitudes in order and a number from 1 on") {
  const scene::Scene s = oscillator(cubic, 5);
  const auto stopped = observables::nonlinear_modes(
      s, {1, 1e-3, 1}, controls::reporting([](const control::Progress& now) { return now.points < 5; }));
  CHECK(stopped.front().status == observables::Status::stopped);
  CHECK(stopped.front().stop.reason == observables::reasons::user);
  CHECK(stopped.front().points.size() == 5);
  const auto at_once = observables::nonlinear_modes(s, {1, 1e-3, 1}, controls::stopped());
  CHECK(at_once.front().stop.reason == observables::reasons::user);
  CHECK(at_once.front().points.empty());
  for (const auto& bad : {observables::ModeRange{0, 1e-3, 1}, {1, 0, 1}, {1, 1, 1}, {1, 2, 1}})
    CHECK_THROWS_AS(observables::nonlinear_modes(s, bad), std::invalid_argument);
}

TEST_CASE("figures of modes are over the amplitude: the frequency, the damping ratio, and stick") {
  const scene::Scene s = scenes::paper(1);
  const std::vector branches{mode(s, 1, 1e-5, 1e-2)};
  const results::FigureData data = studies::figures_of(s, studies::BranchKind::modes, branches);
  REQUIRE(data.columns.size() == 4);
  CHECK(data.columns[0].words == "amplitude");
  CHECK(data.columns[0].scale == results::Scale::logarithmic);
  CHECK(data.columns[1].unit == "Hz");
  CHECK(data.columns[2].words == "damping ratio");
  CHECK(data.columns[2].scale == results::Scale::linear);
  REQUIRE(data.figures.size() == 4);
  const char* names[] = {"frequency", "damping_ratio", "stick", "contact"};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(data.figures[i].name == names[i]);
    CHECK(data.figures[i].x == 0);
    if (i < 3) CHECK(data.figures[i].y == i + 1);
  }
  const ResponsePoint& point = branches[0].points[60];
  CHECK(data.lines[0].parts[0][60] == results::Record{point.amplitude, point.omega / scenes::hertz,
                                                      point.damping_ratio, point.elements[0].stick_percent});
  REQUIRE(data.lines[0].marks.size() == 1);  // no mark at the ends
  CHECK(data.lines[0].marks[0].kind == "maximum");
}

TEST_CASE("where the motion outgrows that of the response a branch ends, and says so") {
  // At high energy mode 3 leaves the mass c behind, which only the damper of b still moves: by c_bc b/(m_c
  // w).
  const ResponseBranch branch = mode(scenes::chain(3, false), 3, 1e-3, 30);
  CHECK(branch.status == observables::Status::failed);
  CHECK(branch.stop.reason == observables::reasons::state_too_large);
  check_contains(branch.stop.message, "grew more than 1e8 times over that of the response");
  check_contains(branch.stop.message, "choose another response");
}

TEST_CASE("a branch that meets another mode at three times its frequency ends there, and says so") {
  // Through an internal resonance: the fundamental vanishes, and what remains is mode 2, stuck.
  const scene::Scene s = random_scenes::make(1, random_scenes::Excitation::first);
  const ResponseBranch branch = mode(s, 1, 1e-7, 1e-1);
  CHECK(branch.status == observables::Status::failed);
  CHECK(branch.stop.reason == observables::reasons::step_too_small);
  check_contains(branch.stop.message, "the motion came to be one of 3 times the frequency, of another mode");
  const ResponsePoint second = mode(s, 2, 1e-7, 1e-6).points.front(), last = branch.points.back();
  CHECK(3 * last.omega == Approx(second.omega).epsilon(1e-8));
  CHECK(last.damping_ratio == Approx(3 * second.damping_ratio).epsilon(1e-6));  // of 2 zeta omega M
}

TEST_CASE(
    "the in-phase mode of two masses folds at 1:3 with the other mode, follows the tongue, and ends on that "
    "mode") {
  // The tongue of Kerschen et al. (2009), figure 9: from the fold the third harmonic grows, of the
  // out-of-phase mode.
  const scene::Scene s = parse(two_masses(cubic_at_x1, 27, "x1"));
  const ResponseBranch branch = mode(s, 1, 0.05, 60);
  CHECK(branch.stop.reason == observables::reasons::step_too_small);
  check_contains(branch.stop.message, "the motion came to be one of 3 times the frequency, of another mode");
  REQUIRE(branch.events.size() == 3);
  CHECK(branch.events[1].kind == "fold");
  const ResponsePoint& last = branch.points.back();
  CHECK(last.energy < 0.1 * branch.events[1].point.energy);
  const ResponsePoint other = at_end(mode(s, 2, 0.5 * last.amplitude, last.amplitude), last.amplitude);
  // Up to what is left of the fundamental: a hundredth of the motion of x2.
  CHECK(3 * last.omega == Approx(other.omega).epsilon(1e-4));
  CHECK(last.energy == Approx(other.energy).epsilon(1e-3));
}

TEST_CASE("random structures: most modes are whole, and what they lose is what the negative damping gives") {
  using random_scenes::Excitation;
  int branches = 0, complete = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed)
    for (const scene::Scene& s : {random_scenes::make(seed, Excitation::first),
                                  random_scenes::make(seed, Excitation::first_and_second),
                                  random_scenes::hard(seed), random_scenes::make_hardening(seed)})
      for (int number = 1; number <= std::min(3, static_cast<int>(s.dofs.size())); ++number) {
        const ResponseBranch branch = mode(s, number, 1e-7, 1e-1);
        CAPTURE(seed, number, s.dofs.size(), branch.stop.message, branch.points.size());
        ++branches;
        const bool whole = branch.status == observables::Status::complete;
        complete += whole ? 1 : 0;
        // Others end at another mode, or where the response has a sharp corner.
        CHECK((whole || branch.stop.reason == observables::reasons::step_too_small));
        double worst = 0;
        for (const ResponsePoint& point : branch.points)
          worst = std::max(worst, std::abs(point.energy_input - point.energy_total()) /
                                      (std::abs(point.energy_total()) + 1e-9 * point.energy));
        CHECK(worst < 1e-7);
      }
  CHECK(branches > 200);
  CHECK(complete >= 0.97 * branches);
}
