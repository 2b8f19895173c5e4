// The studies of the example scenes.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/optimize/optimum_study.hpp>

#include <cmath>

using namespace arcslip;

namespace {

scene::Scene example(const std::string& file) {
  return scene::read_file(ARCSLIP_SOURCE_DIR "/examples/" + file);
}

// At the scene's own values, and at half and twice these: every watched peak against responses beside it.
int check_gradients(const scene::Scene& s, const scene::Study& study) {
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const double unit = scene::to_rad_per_s(s.frequency_unit);
  std::vector<int> over;
  std::vector<double> own;
  for (const auto& variable : study.design) {
    over.push_back(model::parameter_index(*model, variable.name));
    own.push_back(scene::value(s, variable.name));
  }
  int checked = 0;
  for (const double factor : {0.5, 1.0, 2.0}) {
    std::vector<double> design = own;
    for (double& value : design) value *= factor;
    optimize::PeakAmplitude peaks(model, over, {study.frequency_from * unit, study.frequency_to * unit});
    const auto here = peaks.trace(design);
    for (std::size_t k = 0; k < design.size(); ++k) {
      const double h = 1e-6 * design[k];
      auto above = design, below = design;
      above[k] += h;
      below[k] -= h;
      const auto more = peaks.trace(above), less = peaks.trace(below);
      CAPTURE(factor, study.design[k].name);
      REQUIRE(more.peaks.size() == here.peaks.size());
      REQUIRE(less.peaks.size() == here.peaks.size());
      for (std::size_t i = 0; i < here.peaks.size(); ++i) {
        const double difference = (more.peaks[i].amplitude - less.peaks[i].amplitude) / (2 * h);
        CHECK(std::abs(here.peaks[i].gradient[static_cast<Eigen::Index>(k)] - difference) * design[k] <
              1e-6 * here.peaks[i].amplitude);
        ++checked;
      }
    }
  }
  return checked;
}

}  // namespace

TEST_CASE("the examples' optima are certified: gradients cancel, no other response is higher") {
  for (const char* file : {"two_dampers/scene.json", "blade_row/scene.json", "blade_row/mistuned.json"}) {
    const scene::Scene s = example(file);
    for (const scene::Study& study : s.studies) {
      CAPTURE(file, study.name);
      const auto results = optimize::optimum_study(s, study);
      REQUIRE(results.size() == 1);
      const auto& found = results[0].optimum;
      CAPTURE(found.stop.message);
      CHECK(found.status == observables::Status::complete);
      CHECK(found.feasible);
      REQUIRE(found.certificate);
      CHECK(found.certificate->others_lower);
      if (study.constraints.empty()) CHECK(found.certificate->stationarity < 1e-5);
    }
  }
}

TEST_CASE("less wear costs amplitude: the limit on the energy is met and active") {
  const scene::Scene s = example("two_dampers/scene.json");
  REQUIRE(s.studies.size() == 2);
  const auto free = optimize::optimum_study(s, s.studies[0])[0].optimum;
  const auto limited = optimize::optimum_study(s, s.studies[1])[0].optimum;
  // At both of the peaks that are equally high, in frequency responses of their own.
  const auto energy = [&](const std::vector<double>& loads) {
    scene::Scene at = s;
    for (std::size_t k = 0; k < loads.size(); ++k) scene::set(at, s.studies[0].design[k].name, loads[k]);
    scene::Study frf;
    frf.from = 8;
    frf.to = 45;
    double highest = 0, most = 0;
    const auto branches = observables::frequency_response(at, frf);
    for (const auto& event : branches.front().events) highest = std::max(highest, event.point.amplitude);
    for (const auto& event : branches.front().events)
      if (event.kind == "peak" && event.point.amplitude > 0.99 * highest)
        most = std::max(most, event.point.energy_friction);
    return most;
  };
  REQUIRE(energy(free.design) > 1e-3);
  CHECK(energy(limited.design) <= 1e-3 * (1 + 1e-6));
  CHECK(limited.amplitude > free.amplitude);
}

TEST_CASE("the examples' gradients are differences of responses") {
  for (const char* file : {"two_dampers/scene.json", "blade_row/scene.json", "blade_row/mistuned.json"}) {
    CAPTURE(file);
    const scene::Scene s = example(file);
    CHECK(check_gradients(s, s.studies[0]) >= 6);
  }
}
