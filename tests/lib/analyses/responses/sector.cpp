// One sector of a ring next to the full ring of the same scene.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/frequency_sweep.hpp>
#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

using namespace arcslip;
using std::numbers::pi;

namespace {

constexpr int sector_count = 8;  // by which the samples of laws that are sampled are divided

struct Given {
  int order = 1;
  std::string elements{}, excitation = R"({"name": "f", "at": "tip", "cosine": 1})";
  int harmonics = 5;
  std::string settings{};
};

// A ring of disks with a blade on each.
scene::Scene bladed_ring(const Given& given, bool full) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "cyclic": {"sectors": )" +
                       std::to_string(sector_count) + ", \"engine_order\": " + std::to_string(given.order) +
                       (full ? ", \"full\": true" : "") + R"(},
    "dofs": ["tip", "disk"],
    "masses": [{"name": "mt", "at": "tip", "value": 1}, {"name": "md", "at": "disk", "value": 3}],
    "springs": [{"name": "kb", "between": ["tip", "disk"], "value": 1}, {"name": "kd", "at": "disk", "value": 2},
                {"name": "kn", "between": ["disk", {"next": "disk"}], "value": 1.5},
                {"name": "ks", "between": ["tip", {"next": "disk"}], "value": 0.1}],
    "dampers": [{"name": "cb", "between": ["tip", "disk"], "value": 0.02}, {"name": "cd", "at": "disk", "value": 0.03}]},
    "elements": [)" + given.elements +
                       "], \"excitation\": [" + given.excitation + R"(],
    "harmonics": {"order": )" +
                       std::to_string(given.harmonics) + given.settings + R"(}, "response": {"at": "tip"}})");
}

const std::string dampers = R"({"name": "damper", "type": "jenkins", "between": ["tip", {"next": "tip"}],
  "stiffness": 0.4, "friction_coefficient": 0.5, "normal_load": 0.8})";

void check_point(const observables::ResponsePoint& one, const observables::ResponsePoint& all) {
  const auto same = [](double a, double b) { return Approx(b).epsilon(1e-10).margin(1e-11) == a; };
  CHECK(std::abs(one.amplitude / all.amplitude - 1) < 1e-10);
  CHECK(std::abs(std::remainder(one.phase - all.phase, 2 * pi)) < 1e-9);
  CHECK(same(sector_count * one.energy_friction, all.energy_friction));
  CHECK(same(sector_count * one.energy_viscous, all.energy_viscous));
  CHECK(std::abs(one.energy_input / one.energy_total() - 1) < 1e-10);
  REQUIRE(all.elements.size() == sector_count * one.elements.size());
  for (std::size_t e = 0; e < one.elements.size(); ++e) {
    const auto &of_one = one.elements[e], &of_all = all.elements[e * sector_count];
    CHECK(same(of_one.energy, of_all.energy));
    CHECK(std::abs(of_one.stick_percent - of_all.stick_percent) < 1e-6);
  }
}

}  // namespace

TEST_CASE("one sector moves as each of the full ring, with all kinds of laws within and between sectors") {
  const std::string gap = R"({"name": "stop", "type": "gap_spring", "between": ["tip", "disk"],
    "stiffness": 2, "gap": 1.5})";
  const std::string contact = R"({"name": "shroud", "type": "contact_2d",
    "tangential": {"between": ["tip", {"next": "disk"}]}, "normal": {"between": [{"next": "tip"}, "tip"]},
    "tangential_stiffness": 0.5, "normal_stiffness": 0.3, "friction_coefficient": 0.4, "normal_load": 0.7})";
  const std::string cubic = R"({"name": "cubic", "type": "cubic_spring",
    "direction": {"tip": 1, "disk": -0.5, "next": {"disk": -0.5}}, "stiffness": 0.02})";
  const std::string memory = R"({"name": "memory", "type": "bouc_wen", "between": ["tip", {"next": "tip"}],
    "stiffness": 0.3, "elastic_share": 0.2, "yield_displacement": 0.6})";
  const std::string sampled = R"(, "friction": "sampled", "samples": 512)";
  const std::string several = R"({"name": "mean", "at": "tip", "harmonic": 0, "cosine": 0.3},
    {"name": "f", "at": "tip", "cosine": 1, "sine": 0.2}, {"name": "second", "at": "disk", "harmonic": 2, "cosine": 0.4},
    {"name": "third", "direction": {"tip": 1, "disk": -1}, "harmonic": 3, "sine": 0.3})";
  for (const Given& given :
       {Given{2, dampers}, Given{3, dampers, several}, Given{-1, dampers + ", " + cubic}, Given{5, gap},
        Given{1, gap, several, 4}, Given{1, contact, several, 6}, Given{2, cubic + ", " + contact},
        Given{2, memory, Given{}.excitation, 5, sampled}, Given{0, dampers + ", " + gap, several}}) {
    const scene::Scene one = bladed_ring(given, false), all = bladed_ring(given, true);
    REQUIRE(one.dofs.size() == 2);
    REQUIRE(all.dofs.size() == 2 * sector_count);
    for (const double w : {0.75, 1.6}) {
      CAPTURE(given.order, given.elements, given.excitation, w);
      const auto of_one = observables::point_responses(one, {.frequency = w});
      const auto of_all = observables::point_responses(all, {.frequency = w});
      REQUIRE(of_one.size() >= 1);
      REQUIRE(of_all.size() >= of_one.size());
      for (const auto& each : of_one) {
        REQUIRE(each.status == observables::Status::complete);
        const auto off = [&](const auto& other) {
          return std::abs(other.point.amplitude - each.point.amplitude);
        };
        const auto nearest = std::min_element(of_all.begin(), of_all.end(),
                                              [&](const auto& a, const auto& b) { return off(a) < off(b); });
        REQUIRE(nearest->status == observables::Status::complete);
        check_point(each.point, nearest->point);
      }
    }
  }
}

TEST_CASE("a wave of the other sense is another motion of the ring") {
  const Given given{2, dampers, R"({"name": "f", "direction": {"tip": 1, "disk": 0.4}, "cosine": 1})"};
  Given other = given;
  other.order = -2;
  const auto one = observables::point_responses(bladed_ring(given, false), {.frequency = 0.95});
  const auto back = observables::point_responses(bladed_ring(other, true), {.frequency = 0.95});
  CHECK(std::abs(one[0].point.amplitude / back[0].point.amplitude - 1) > 1e-4);
}

TEST_CASE("the peaks of one sector, and the curve of its peaks over the load, are those of the full ring") {
  const Given given{2, dampers};
  const scene::Scene one = bladed_ring(given, false), all = bladed_ring(given, true);
  const auto of_one = observables::frequency_response(one, {0.6, 1.4});
  const auto of_all = observables::frequency_response(all, {0.6, 1.4});
  const auto peaks = [](const std::vector<observables::ResponseBranch>& branches) {
    std::vector<observables::ResponsePoint> found;
    REQUIRE(branches.size() == 1);
    REQUIRE(branches[0].status == observables::Status::complete);
    for (const auto& event : branches[0].events)
      if (event.kind == "peak") found.push_back(event.point);
    return found;
  };
  const auto a = peaks(of_one), b = peaks(of_all);
  REQUIRE(a.size() >= 1);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(std::abs(a[i].omega / b[i].omega - 1) < 1e-8);
    CHECK(std::abs(a[i].amplitude / b[i].amplitude - 1) < 1e-10);
    CHECK(a[i].truncation_estimate == Approx(b[i].truncation_estimate).epsilon(1e-4));
    CHECK(a[i].truncation_flagged == b[i].truncation_flagged);
  }
  // The best load: one parameter in both.
  const observables::CurveRange range{"damper.normal_load", 0.3, 3, 0.6, 1.4};
  const auto best = [&](const scene::Scene& s) {
    const auto curves = observables::resonance_peaks(s, range);
    observables::ResponsePoint least;
    for (const auto& curve : curves)
      for (const auto& event : curve.events)
        if (event.kind == "minimum" && (least.amplitude == 0 || event.point.amplitude < least.amplitude))
          least = event.point;
    return least;
  };
  const auto of_sector = best(one), of_ring = best(all);
  REQUIRE(of_sector.amplitude > 0);
  CHECK(std::abs(of_sector.amplitude / of_ring.amplitude - 1) < 1e-10);
  CHECK(std::abs(of_sector.over / of_ring.over - 1) < 1e-6);
}

TEST_CASE("studies of the motion in time refuse one sector, and say what to give") {
  const Given given{2, dampers};
  const scene::Scene one = bladed_ring(given, false);
  const auto in_time = observables::motion_in_time(one, {0.9});
  CHECK(in_time.status == observables::Status::failed);
  CHECK(in_time.stop.reason == observables::reasons::sector);
  CHECK_THAT(in_time.stop.message, Catch::Contains("\"full\": true"));
  const auto modes = observables::nonlinear_modes(one, {.mode = 1, .from = 0.1, .to = 1});
  CHECK(modes[0].status == observables::Status::failed);
  CHECK_THAT(modes[0].stop.message, Catch::Contains("\"full\": true"));
  const auto swept = observables::frequency_sweep(one, {.from = 0.8, .to = 0.9});
  CHECK(swept[0].status == observables::Status::failed);
  CHECK(swept[0].stop.reason == observables::reasons::sector);
}
