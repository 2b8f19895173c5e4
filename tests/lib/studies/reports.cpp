// Oscillators, isolators and a rotor as a user computes them, from a scene file by its studies, next to
// numbers of other methods: shooting and integration in time by Runge-Kutta steps, closed forms, linear
// equations, published tables.
#include "catch.hpp"

#include "lib/studies/reports.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace arcslip;
using namespace reports;

TEST_CASE("frequency responses have their peaks, folds and bifurcations where other methods find them",
          "[numbers]") {
  const std::vector<Response> all = {
      {"softening_duffing",  // shooting
       0,
       {{"fold", "0.8927792131"}, {"fold", "0.8627056001"}, {"peak", "0.86595194", "0.5680629469"}}},
      {"well_about_its_bottom",  // shooting
       0,
       {{"fold", "0.86656707"},
        {"fold", "0.45499347"},
        {"period_doubling", "0.45501853"},
        {"period_doubling", "0.70097701"}}},
      {"well_next_to_hilltop",  // the same oscillator
       1,
       {{"fold", "0.86656707"},
        {"fold", "0.45499347"},
        {"period_doubling", "0.45501853"},
        {"period_doubling", "0.70097701"}}},
      {"damping_with_amplitude",  // shooting; its peak, closed form of one harmonic
       0,
       {{"fold", "1.1084603599"}, {"fold", "1.0607535941"}, {"peak", "1.1067", "0.5503"}}},
      {"duffing_superharmonics",  // shooting
       0,
       {{"symmetry_breaking", "0.69524189"},
        {"symmetry_breaking", "0.73556864"},
        {"peak", "4.23537876", "4.85187385"}}},
      {"softening_isola",  // at 0.33 N, shooting
       0,
       {{"fold", "0.9745652"}, {"fold", "0.8502391"}, {"peak", "0.8502644", "38.138190"}}},
      {"softening_isola",  // shooting; at 0.33 N further responses may be found
       0,
       {{"fold", "0.7543104555"}},
       8},
      {"three_equal_oscillators",  // shooting
       0,
       {{"neimark_sacker", "1.00214368"}, {"neimark_sacker", "1.01458549"}}},
      {"two_to_one",  // closed form of the threshold
       0,
       {{"period_doubling", "1.94977385"}, {"period_doubling", "2.04927705"}}},
      {"cross_coupled_bearings",  // linear equations
       0,
       {{"peak", "61.787509", "3.172161e-3"}}},
  };
  std::string before;
  Json branches;
  for (const Response& each : all) {
    CAPTURE(each.scene, each.branch);
    if (before != each.scene) branches = branches_of(scene_of(each.scene, studies::frf()));
    before = each.scene;
    std::size_t index = each.branch;
    if (each.force != 0)
      while (index < branches.size() && branches[index]["set"]["f.cosine"] != each.force) ++index;
    REQUIRE(branches.size() > index);
    check_complete(branches[index]);
    check_events(branches[index], each.events);
  }
}

TEST_CASE("a response is reported to be unstable where shooting has a multiplier outside of the unit circle",
          "[numbers]") {
  struct Reported {
    const char* scene;
    std::vector<Parts> unstable;  // of each branch
  };
  const Parts well = {{0.86656707, 0.45499347}, {0.45501853, 0.70097701}}, hilltop = {{0.4, 1.2}};
  const std::vector<Reported> all = {
      {"softening_duffing", {{{0.89277921, 0.86270560}}}},
      // It is stable between the fold at 0.45499347 rad/s and the period doubling next to it.
      {"well_about_its_bottom", {well, hilltop}},
      {"well_next_to_hilltop", {hilltop, well}},
      {"two_to_one", {{{1.94977385, 2.04927705}}}},
  };
  Json softening;
  for (const Reported& each : all) {
    const results::Results found = studies::run(scene_of(each.scene, studies::frf()));
    const Json branches = all_of(found)["branches"];
    if (softening.is_null()) softening = branches[0];
    CAPTURE(each.scene);
    REQUIRE(found.results.size() >= each.unstable.size());
    for (std::size_t k = 0; k < each.unstable.size(); ++k) {
      CAPTURE(k, found.results[k].end.remark);
      const Parts reported = unstable_parts(found.results[k].end.remark);
      REQUIRE(reported.size() == each.unstable[k].size());
      for (std::size_t i = 0; i < reported.size(); ++i) {
        CHECK(std::abs(reported[i].first - each.unstable[k][i].first) < 1e-7);
        CHECK(std::abs(reported[i].second - each.unstable[k][i].second) < 1e-7);
      }
      if (each.unstable[k] != hilltop) continue;
      for (const Json& point : branches[k]["points"]) CHECK(point["stable"] == false);
    }
  }
  CHECK(softening["points"].front()["stable"] == true);
  CHECK(softening["points"].back()["stable"] == true);
  const auto multipliers = moduli(highest_peak(softening)["multipliers"]);
  REQUIRE(multipliers.size() == 2);
  CHECK(std::abs(multipliers[0] - 0.59659771) < 1e-7);
  CHECK(std::abs(multipliers[1] - 0.81133921) < 1e-7);
}

TEST_CASE("all responses at one frequency are found, as large as by other methods") {
  struct At {
    const char* scene;
    double frequency;  // 0: of the scene
    std::size_t count;
    std::vector<Right> amplitudes;
  };
  const std::vector<At> all = {
      {"duffing_far_below_resonance", 0, 1, {"0.9280296"}},                         // shooting
      {"well_about_its_bottom", 0, 4, {"0.18882525", "0.63635766", "0.75993002"}},  // shooting
      {"well_next_to_hilltop", 0, 4, {"1.17499413", "1.43764837", "1.45559681"}},   // shooting
      {"weak_cubic_spring", 0, 2, {"3.0275193e-3", "2.8572074e-2"}},                // shooting
      {"block_on_lubricated_steel", 0, 1, {"1.781394e-3"}},                         // Den Hartog, closed form
      // Shooting; three at 0.2 N, one at 1 N and one at 7.5 N.
      {"pure_cubic_spring", 0, 5, {"0.20657546", "1.05774863", "1.27517927", "1.56776971", "2.8931890"}},
      // Den Hartog, closed form, of the absolute motion.
      {"friction_isolator", 0.8, 1, {"1.631256"}},
      {"friction_isolator", 1.2, 1, {"2.048043"}},
      {"friction_isolator", 1.24, 1, {"1.712770"}},
      {"friction_isolator", 1.3, 1, {"1.372551"}},
      {"three_harmonics_of_force", 0, 1, {"3.434803577e-3"}},  // linear equations, superposed
      {"cross_coupled_bearings", 0, 1, {"1.716264e-3"}},       // linear equations
  };
  for (const At& each : all) {
    CAPTURE(each.scene, each.frequency);
    const scene::Scene s = each.frequency == 0 ? scene_of(each.scene, studies::point())
                                               : at_frequency(each.scene, each.frequency);
    const Json found = responses_at(s);
    CHECK(found.size() == each.count);
    for (const Json& response : found) {
      CHECK(response["status"] == "complete");
      CHECK(response["stop"]["reason"] == observables::reasons::solved.code);
    }
    for (const Right& amplitude : each.amplitudes) {
      const Json& response = nearest(found, "amplitude", amplitude.value);
      check(response["amplitude"], amplitude, response["truncation_estimate"]);
    }
  }
}

TEST_CASE("each place of a rotor on cross-coupled bearings moves as the linear equations have it") {
  const Json found = responses_at(scene_of("cross_coupled_bearings", studies::point()));
  REQUIRE(found.size() == 1);
  const Json& places = found[0]["responses"];
  check(places["xd"]["amplitude"], "1.716264e-3");
  check(places["yd"]["amplitude"], "1.439872e-3");
}

TEST_CASE("without a linear stiffness the unstable responses have the multipliers of shooting") {
  const Json found = responses_at(scene_of("pure_cubic_spring", studies::point()));
  for (const auto& [amplitude, largest] : {std::pair(1.0577486, 3.53156), std::pair(2.893189, 13.00374)}) {
    const Json& response = nearest(found, "amplitude", amplitude);
    CAPTURE(amplitude);
    CHECK(response["stable"] == false);
    const auto multipliers = moduli(response["multipliers"]);
    REQUIRE(multipliers.size() == 2);
    CHECK(std::abs(multipliers[1] / largest - 1) < 2e-6);
  }
  for (const double amplitude : {0.2065755, 1.2751793, 1.5677697})
    CHECK(nearest(found, "amplitude", amplitude)["stable"] == true);
}

TEST_CASE("with one harmonic the responses are those of closed forms") {
  // (k - m w^2 + 3/4 k3 A^2)^2 + (c w)^2 = (F/A)^2
  scene::Scene weak = scene_of("weak_cubic_spring", studies::point());
  weak.harmonics.accuracy = 0;
  weak.harmonics.order = 1;
  const Json weak_responses = responses_at(weak);
  REQUIRE(weak_responses.size() == 2);
  for (const Json& response : weak_responses) {
    const double k = response["set"]["k.value"];
    const double exact =
        zero_of([&](double A) { return std::hypot(k - 100 + 0.75 * 1.1e5 * A * A, 400) * A - 30; }, 0, 1);
    CHECK(std::abs(response["amplitude"].get<double>() / exact - 1) < 1e-10);
  }

  // sqrt(F^2 - (4 mu N / pi)^2) / |k - m w^2|
  scene::Scene steel = scene_of("block_on_lubricated_steel", studies::point());
  steel.harmonics.accuracy = 0;
  steel.harmonics.order = 1;
  const double w = 20 * std::numbers::pi, friction = 4 * 0.07 * 98.1 / std::numbers::pi;
  const double block = std::sqrt(2500 - friction * friction) / std::abs(12000 - 10 * w * w);
  CHECK(std::abs(block - 1.79157e-3) < 0.5e-8);
  CHECK(std::abs(responses_at(steel)[0]["amplitude"].get<double>() / block - 1) < 1e-8);

  // Damping g = 0.01 + 0.3 A^2/4 and stiffness s = 1 + 3/4 A^2: at the peak w^2 = s - g^2/2 and
  // g^2 (s - g^2/4) = (F/A)^2.
  scene::Scene damped = scene_of("damping_with_amplitude", studies::frf());
  damped.harmonics.accuracy = 0;
  damped.harmonics.order = 1;
  const auto g = [](double A) { return 0.01 + 0.3 * A * A / 4; };
  const auto s = [](double A) { return 1 + 0.75 * A * A; };
  const double A =
      zero_of([&](double a) { return g(a) * std::sqrt(s(a) - g(a) * g(a) / 4) * a - 0.02; }, 0, 1);
  const Json peak = highest_peak(branches_of(damped)[0]);
  CHECK(std::abs(peak["amplitude"].get<double>() / A - 1) < 1e-9);
  CHECK(std::abs(peak["omega"].get<double>() / std::sqrt(s(A) - g(A) * g(A) / 2) - 1) < 1e-6);
}

TEST_CASE("a closed branch of a softening oscillator begins at a fold over the force") {
  scene::Scene s = scene_of("softening_isola", studies::trace());
  s.harmonics.order = 32;
  const Json branches = branches_of(s);
  bool found = false;
  for (const Json& branch : branches) {
    check_complete(branch);
    for (const Json& event : branch["events"]) {
      if (event["kind"] != "fold" || event["f.cosine"] > 1) continue;
      check(event["f.cosine"], "0.313699486");  // multiple shooting
      found = true;
    }
  }
  CHECK(found);
}

TEST_CASE("an isolator with Coulomb friction has no bounded response at its natural frequency") {
  const scene::Scene s = scene_of("friction_isolator", studies::frf());
  const Json branches = branches_of(with_study(s, studies::frf(), observables::FrequencyRange{0.8, 1.5}));
  REQUIRE(branches.size() == 2);
  CHECK(branches[0]["stop"]["reason"] == observables::reasons::unbounded.code);
  REQUIRE(count(branches[0], "peak") == 1);
  const Json& peak = nearest(branches[0]["events"], "frequency", 1, "peak");
  CHECK(peak.value("unbounded", false));
  CHECK(std::abs(peak["frequency"].get<double>() - 1) < 1e-9);
  check_complete(branches[1]);

  // At 0.3 rad/s it stops: rigid friction has no response there, and the message says what to do.
  const Json stopped = branches_of(s);
  REQUIRE(stopped.size() == 1);
  CHECK(stopped[0]["status"] == "failed");
  CHECK(stopped[0]["stop"]["reason"] == observables::reasons::start_failed.code);
  const std::string message = stopped[0]["stop"]["message"];
  CHECK(message.find("the friction of \"fr\" has no stiffness") != std::string::npos);
  CHECK(message.ends_with("give the contact a stiffness"));
}
