// Joints, modes, bladed disks and absorbers as a user computes them, from a scene file by its studies, next
// to numbers of other methods: shooting and integration in time by Runge-Kutta steps, closed forms, linear
// equations, published tables.
#include "catch.hpp"

#include "lib/studies/reports.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/optimize/studies.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace arcslip;
using namespace reports;

TEST_CASE("an Iwan joint is as 200 sliders in time, and its estimates cover the harmonics left out") {
  const std::vector<std::pair<double, double>> in_time = {{1.015, 13.23163}, {1.041, 15.66991}};
  for (const int order : {3, 15}) {
    scene::Scene s = scene_of("iwan_joint", studies::point());
    s.harmonics.order = order;
    const Json found = responses_at(s);
    REQUIRE(found.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      CAPTURE(order, in_time[k].first);
      CHECK(found[k]["status"] == "complete");
      CHECK(found[k]["frequency"].get<double>() == Approx(in_time[k].first).epsilon(1e-12));
      const double estimate = found[k]["truncation_estimate"];
      // 200 sliders are a joint within 2e-5.
      CHECK(std::abs(found[k]["amplitude"].get<double>() - in_time[k].second) <=
            2 * estimate + 2e-5 * in_time[k].second);
    }
  }
}

TEST_CASE("a wedge on its static offset between two masses moves as by integration in time") {
  // Runge-Kutta steps, in five digits.
  for (const auto& [from, frequency, amplitude] :
       {std::tuple(145.0, 162.7, "3.7330e-4"), std::tuple(200.0, 217.54, "1.8847e-4")}) {
    CAPTURE(frequency);
    const scene::Scene s = scene_of("wedge_damper", studies::frf());
    const Json branches =
        branches_of(with_study(s, studies::frf(), observables::FrequencyRange{from, frequency}));
    REQUIRE(branches.size() == 1);
    check_complete(branches[0]);
    const Json& last = branches[0]["points"].back();
    REQUIRE(last["frequency"].get<double>() == Approx(frequency).epsilon(1e-12));
    check(last["amplitude"], amplitude, last["truncation_estimate"]);
    // Shooting from event to event.
    const Json motion = all_of(
        studies::run(with_study(s, studies::time(), observables::TimeSettings{frequency})))["motions"][0];
    CHECK(motion["status"] == "complete");
    check(motion["amplitude"], amplitude);
    CHECK(std::abs(last["amplitude"].get<double>() - motion["amplitude"].get<double>()) <=
          2 * last["truncation_estimate"].get<double>());
  }
  // Newton's method from rest ends next to the response, at what is none.
  scene::Scene seven = at_frequency("wedge_damper", 162.7);
  seven.harmonics.order = 7;
  const Json found = responses_at(seven);
  REQUIRE(found.size() == 1);
  CHECK(found[0]["status"] == "complete");
  check(found[0]["amplitude"], "3.7330e-4", found[0]["truncation_estimate"]);

  const Json whole = branches_of(scene_of("wedge_damper", studies::frf()));
  REQUIRE(whole.size() == 1);
  check_complete(whole[0]);
  CHECK(count(whole[0], "peak") == 2);
}

TEST_CASE("the mode of a cantilever with a cubic spring at its tip has the frequencies of one harmonic") {
  // Of finite elements and one harmonic, solved apart.
  for (const auto& [amplitude, frequency] : {std::pair(1.1e-3, "32.570765"), std::pair(2e-3, "45.921326")}) {
    scene::Scene s = mode_of("cantilever_with_tip_spring", 1e-6, amplitude);
    s.harmonics.order = 1;
    const Json mode = branches_of(s)[0];
    CAPTURE(amplitude);
    check_complete(mode);
    CHECK(mode["points"].back()["amplitude"].get<double>() == Approx(amplitude).epsilon(1e-12));
    check(mode["points"].back()["frequency"], frequency);
  }
}

TEST_CASE("a mode ends in an internal resonance, in a motion of another mode, and says so") {
  const Json five = branches_of(scene_of("cantilever_with_tip_spring", studies::modes()))[0];
  CHECK(five["status"] == "failed");
  CHECK(five["stop"]["reason"] == observables::reasons::step_too_small.code);
  const std::string of_five = five["stop"]["message"];
  CHECK(of_five.find("one of 5 times the frequency, of another mode") != std::string::npos);
  REQUIRE(count(five, "fold") > 0);
  for (const Json& event : five["events"])
    if (event["kind"] == "fold") CHECK(std::abs(event["frequency"].get<double>() - 30.0) < 0.15);

  const Json three = branches_of(scene_of("mode_to_internal_resonance", studies::modes()))[0];
  CHECK(three["status"] == "failed");
  CHECK(three["stop"]["reason"] == observables::reasons::step_too_small.code);
  const std::string of_three = three["stop"]["message"];
  CHECK(of_three.find("one of 3 times the frequency, of another mode") != std::string::npos);
  REQUIRE(count(three, "fold") == 1);
  const Json& fold = nearest(three["events"], "amplitude", 67.9, "fold");
  CHECK(std::abs(fold["amplitude"].get<double>() - 67.9) < 0.05);
  CHECK(std::abs(std::log10(fold["energy"].get<double>()) - 3.7) < 0.05);
  // It cannot be begun beyond.
  for (const double beyond : {100.0, 300.0}) {
    const Json none = branches_of(mode_of("mode_to_internal_resonance", beyond, 1.5 * beyond))[0];
    CHECK(none["status"] == "failed");
    CHECK(none["stop"]["reason"] == observables::reasons::start_failed.code);
    CHECK(none["stop"]["message"].get<std::string>().starts_with("mode 1 was not found at "));
    CHECK(none["points"].empty());
  }
}

TEST_CASE("below its internal resonance the mode of two masses has the frequency and energy of shooting") {
  for (const int order : {9, 21}) {
    scene::Scene s = mode_of("mode_to_internal_resonance", 0.1, 10);
    s.harmonics.order = order;
    const Json mode = branches_of(s)[0];
    CAPTURE(order);
    check_complete(mode);
    const Json& last = mode["points"].back();
    const double omega = last["omega"], energy = last["energy"];
    CHECK(std::abs(omega / 1.3131034346 - 1) < (order == 9 ? 1e-8 : 1e-10));
    CHECK(std::abs(energy / 90.895718 - 1) < (order == 9 ? 2e-5 : 1e-8));
  }
}

namespace {

using Complex = std::complex<double>;

/// Of a sector's d, b1 and b2, and with a ring of its r, which move in a wave of this engine order over 24 of
/// them.
Eigen::MatrixXd sector_stiffness(int engine_order, bool ring) {
  const double wave = 2 * (1 - std::cos(2 * std::numbers::pi * engine_order / 24));
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(ring ? 4 : 3, ring ? 4 : 3);
  K.topLeftCorner(3, 3) << 6e5 + wave * 5e7 + 1e6, -1e6, 0,  //
      -1e6, 3e6, -2e6,                                       //
      0, -2e6, 2e6;
  if (ring) K(3, 3) = wave * 1e5;
  return K;
}

/// Of b2, under a force there. K: with its damping, at this frequency (Hz).
double amplitude_of_b2(Eigen::MatrixXcd K, double force, double frequency) {
  constexpr double masses[] = {1.2, 0.35, 0.25, 0.02};
  const double w = scenes::hertz * frequency;
  for (Eigen::Index i = 0; i < K.rows(); ++i) K(i, i) -= w * w * masses[i];
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(K.rows());
  f[2] = force;
  return std::abs(K.partialPivLu().solve(f)[2]);
}

/// A peak is as high as the linear equations have it, and higher than they are next to it.
template <class Amplitude>
void check_linear_peak(const Json& peak, const Amplitude& amplitude, double nearby) {
  const double frequency = peak["frequency"], highest = peak["amplitude"];
  CAPTURE(frequency, highest);
  CHECK(std::abs(highest / amplitude(frequency) - 1) < 1e-8);
  CHECK(amplitude(frequency * (1 - nearby)) < amplitude(frequency));
  CHECK(amplitude(frequency * (1 + nearby)) < amplitude(frequency));
}

}  // namespace

TEST_CASE("a bladed disk has its peaks at the natural frequencies of its engine orders") {
  // A published table of these frequencies, Hz. With a loss factor of 1e-6 peaks are within 1e-9 of them.
  const std::vector<std::pair<int, std::vector<double>>> table = {
      {0, {88.26374399}}, {1, {169.3441295}}, {3, {193.0496227, 810.0067973}}};
  for (const auto& [engine_order, frequencies] : table) {
    scene::Scene s = scene_of("bladed_disk", studies::frf());
    REQUIRE(s.cyclic);
    s.cyclic->engine_order = engine_order;
    const Json branches = branches_of(s);
    CAPTURE(engine_order);
    REQUIRE(branches.size() == 1);
    check_complete(branches[0]);
    CHECK(count(branches[0], "peak") == 3);
    for (const double frequency : frequencies) {
      const Json& peak = nearest(branches[0]["events"], "frequency", frequency, "peak");
      CHECK(std::abs(peak["frequency"].get<double>() / frequency - 1) < 1e-9);
    }
    const Eigen::MatrixXcd K = Complex(1, 1e-6) * sector_stiffness(engine_order, false).cast<Complex>();
    for (const Json& event : branches[0]["events"])
      if (event["kind"] == "peak")
        check_linear_peak(event, [&](double hertz) { return amplitude_of_b2(K, 1, hertz); }, 1e-8);
  }
}

TEST_CASE("a friction ring that sticks is as the linear equations of its sector have it") {
  // Damping in proportion to all springs but the contact.
  const Eigen::MatrixXd K = sector_stiffness(3, true);
  Eigen::MatrixXd stuck = K;
  stuck(0, 0) += 1e5, stuck(3, 3) += 1e5, stuck(0, 3) -= 1e5, stuck(3, 0) -= 1e5;
  const Json branches = branches_of(scene_of("friction_ring", studies::frf()));
  REQUIRE(branches.size() == 1);
  check_complete(branches[0]);
  REQUIRE(count(branches[0], "peak") == 1);
  const Json peak = highest_peak(branches[0]);
  check_linear_peak(
      peak,
      [&](double hertz) {
        const Complex damping(0, 1e-6 * scenes::hertz * hertz);
        return amplitude_of_b2(stuck.cast<Complex>() + damping * K.cast<Complex>(), 2, hertz);
      },
      1e-6);
  check(peak["frequency"], "193.05193749");
  check(peak["amplitude"], "2.31516266e-3");
}

TEST_CASE("a sector of a friction ring is all 24 of them, in stick and in slip", "[numbers]") {
  for (const double factor : {1.0, 10.0}) {
    CAPTURE(factor);
    std::vector<Json> peaks;
    for (const char* name : {"friction_ring", "friction_ring_of_all_sectors"}) {
      scene::Scene s = scene_of(name, studies::frf());
      for (scene::Part& force : s.excitation)
        for (double& value : force.values) value *= factor;
      const Json branches = branches_of(s);
      CAPTURE(name);
      REQUIRE(branches.size() == 1);
      check_complete(branches[0]);
      REQUIRE(count(branches[0], "peak") == 1);
      peaks.push_back(highest_peak(branches[0]));
    }
    for (const char* of : {"frequency", "amplitude"})
      CHECK(std::abs(peaks[0][of].get<double>() / peaks[1][of].get<double>() - 1) < 1e-9);
    if (factor == 1) continue;
    check(peaks[0]["frequency"], "193.0505");
    check(peaks[0]["amplitude"], "2.3007e-2");
  }
}

TEST_CASE("the tuned mass damper of the least peak is that of the closed form") {
  const Json found =
      all_of(studies::run(scene_of("tuned_mass_damper", optimize::optimum_type())))["optima"][0];
  CHECK(found["status"] == "complete");
  // Nishihara and Asami (2002), of an undamped host.
  const double mu = 0.05, root = std::sqrt(4 + 3 * mu);
  const double ratio =
      2 / (1 + mu) *
      std::sqrt(2 * (16 + 23 * mu + 9 * mu * mu + 2 * (2 + mu) * root) / (3 * (64 + 80 * mu + 27 * mu * mu)));
  const double zeta = 0.25 * std::sqrt((8 + 9 * mu - 4 * root) / (1 + mu));
  const Json& optimum = found["optimum"];
  CHECK(std::abs(optimum["ka.value"].get<double>() / (mu * ratio * ratio) - 1) < 1e-8);
  CHECK(std::abs(optimum["ca.value"].get<double>() / (2 * zeta * mu * ratio) - 1) < 1e-7);
  check(optimum["ka.value"], "0.045350626");
  check(optimum["ca.value"], "0.012755855");
  check(optimum["amplitude"], "6.40792077");
  // The highest peak of the closed form of the response, over either parameter.
  const Json& ranges = found["certificate"]["ranges"];
  CHECK(ranges["ka.value"][0]["share"] == 0.01);
  check(ranges["ka.value"][0]["upper"], "0.0454986");
  CHECK(ranges["ca.value"][1]["share"] == 0.05);
  check(ranges["ca.value"][1]["lower"], "0.010487");
}

TEST_CASE("a friction absorber at its optimum has two equal peaks, and a load just below leaves a high one",
          "[numbers]") {
  scene::Scene s = scene_of("friction_absorber", optimize::optimum_type());
  s.studies[0].settings.as<optimize::OptimumSettings>().search.starts = 1;  // a fifth of the time
  const Json found = all_of(studies::run(s))["optima"][0];
  CHECK(found["status"] == "complete");
  const Json& optimum = found["optimum"];
  const double best = optimum["amplitude"], ka = optimum["ka.value"], load = optimum["fr.normal_load"];
  CHECK(std::abs(best - 7.54) < 0.005);
  const auto peak = [&](double stiffness, double normal_load, int order) {
    scene::Scene moved =
        with_study(scene_of("friction_absorber"), studies::frf(), observables::FrequencyRange{0.5, 1.6});
    moved.harmonics.order = order;
    scene::set(moved, "ka.value", stiffness);
    scene::set(moved, "fr.normal_load", normal_load);
    return highest_peak(branches_of(moved)[0]);
  };
  const Json& peaks = found["certificate"]["peaks"];
  REQUIRE(peaks.size() == 2);
  for (const Json& each : peaks) CHECK(std::abs(each["amplitude"].get<double>() / best - 1) < 1e-8);
  for (const char* over : {"ka.value", "fr.normal_load"})
    for (const Json& range : found["certificate"]["ranges"][over])
      for (const char* side : {"lower", "upper"}) {
        CAPTURE(over, side, range.dump());
        const double end = range[side], share = range["share"];
        const bool of_load = std::string(over) == "fr.normal_load";
        const double there = peak(of_load ? ka : end, of_load ? end : load, 7)["amplitude"];
        CHECK(std::abs(there / ((1 + share) * best) - 1) < 1e-6);
      }
  CHECK(found["certificate"]["ranges"]["fr.normal_load"][1]["lower"] > 0.48);
  // Runge-Kutta.
  const Json far = peak(0.03894, 0.38, 31);
  check(far["amplitude"], "104.342");
  check(far["frequency"], "1.06156");
}
