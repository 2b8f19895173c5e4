// The largest amplitude in a window, followed from design to design.

#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/observables/reference.hpp"
#include "optimize/row.hpp"

#include <arcslip/optimize/peak_amplitude.hpp>

#include <cmath>

using namespace arcslip;
using optimize::PeakAmplitude;
using optimize::PeakKind;
using Design = std::vector<double>;

namespace {

PeakAmplitude peaks_over(const scene::Scene& s, const std::vector<std::string>& over, double from,
                         double to) {
  const auto model = std::make_shared<const model::Model>(model::build(s));
  const double unit = scene::to_rad_per_s(s.frequency_unit);
  std::vector<int> indices;
  for (const auto& name : over) indices.push_back(model::parameter_index(*model, name));
  return PeakAmplitude(model, indices, {from * unit, to * unit});
}

PeakAmplitude paper_peaks(int order, double from = 18, double to = 22, double damping = 0.134) {
  scene::Scene s = scenes::paper(order);
  scene::set(s, "c.value", damping);
  return peaks_over(s, {"damper.normal_load"}, from, to);
}

double gradient_error(PeakAmplitude& peaks, double load) {
  const double h = 1e-6 * load;
  const auto& state = peaks.trace(Design{load});
  const double gradient = state.peaks[state.highest].gradient[0], amplitude = state.amplitude();
  const double above = peaks.trace(Design{load + h}).amplitude();
  const double below = peaks.trace(Design{load - h}).amplitude();
  return std::abs(gradient - (above - below) / (2 * h)) * load / amplitude;
}

}  // namespace

TEST_CASE("peaks that are followed come to the exact peaks, without another response") {
  PeakAmplitude peaks = paper_peaks(101);
  peaks.trace(Design{3});
  for (const double load : {5, 4, 3, 2, 3}) {
    const double amplitude = peaks.at(Design{load}).amplitude();
    for (const auto& exact : reference::exact("resonance_peaks"))
      if (exact["normal_load"] == load) CHECK(reference::error(amplitude, exact["amplitude"]) < 5e-9);
  }
  CHECK(peaks.work().responses == 1);
  CHECK(peaks.work().followed == 5);
}

TEST_CASE("the same design again costs nothing") {
  PeakAmplitude peaks = paper_peaks(7);
  peaks.at(Design{3});
  peaks.at(Design{3});
  CHECK(peaks.work().responses == 1);
  CHECK(peaks.work().followed == 0);
}

TEST_CASE("the largest amplitude may stand at an end of the window") {
  for (const auto& [from, to, kind] :
       {std::tuple{18.0, 19.8, PeakKind::upper_end}, std::tuple{20.1, 22.0, PeakKind::lower_end}}) {
    PeakAmplitude peaks = paper_peaks(15, from, to);
    for (const double load : {2.9, 3.0}) {  // traced, then followed
      CAPTURE(from, to, load);
      const auto& state = peaks.at(Design{load});
      const auto& highest = state.peaks[state.highest];
      CHECK(highest.kind == kind);
      const double end = kind == PeakKind::upper_end ? to : from;
      CHECK(reference::error(highest.omega(), end * scenes::hertz) < 1e-14);
      const double amplitude = scenes::response_at(scenes::paper(15, load), end).amplitude;
      CHECK(reference::error(state.amplitude(), amplitude) < 1e-10);
    }
    CHECK(peaks.work().responses == 1);
    CHECK(gradient_error(peaks, 3) < 1e-6);
  }
}

TEST_CASE("a peak that comes into the window or leaves it is noticed where it is followed") {
  PeakAmplitude peaks = paper_peaks(15, 18, 20);  // the peak is at 20.45 Hz at 5 N, at 19.44 Hz at 2 N
  const auto kind = [&](double load) {
    const auto& state = peaks.at(Design{load});
    return state.peaks[state.highest].kind;
  };
  CHECK(kind(2) == PeakKind::resonance);
  CHECK(kind(5) == PeakKind::upper_end);
}

TEST_CASE("without damping the amplitude is infinite up to Fn = pi f0/(4 mu), and finite beyond") {
  PeakAmplitude peaks = paper_peaks(1, 18, 22, 0);
  CHECK(peaks.at(Design{2}).amplitude() == Approx(1 / (1 - std::numbers::pi / 4) / 3500).epsilon(1e-9));
  CHECK(std::isinf(peaks.at(Design{1.5}).amplitude()));
  CHECK(peaks.state().unbounded);
  CHECK(peaks.state().message.find("the resonance is unbounded") == 0);
  CHECK(std::isfinite(peaks.at(Design{1.6}).amplitude()));
  CHECK(std::isinf(peaks.at(Design{1.57}).amplitude()));
}

TEST_CASE("observables change along a followed peak as they do between responses") {
  PeakAmplitude peaks = paper_peaks(15);
  const std::vector<PeakAmplitude::Observable> all = {
      [](const auto& point) { return point.energy_friction; }, [](const auto& point) { return point.omega; },
      [](const auto& point) { return point.elements[0].stick_percent; }};
  for (const double load : {1.0, 3.0, 10.0}) {
    for (const auto& observable : all) {
      const auto at = [&](double value) {
        const auto& state = peaks.trace(Design{value});
        return observable(peaks.observe(state.peaks[state.highest]));
      };
      const double h = 1e-4 * load, difference = (at(load + h) - at(load - h)) / (2 * h), value = at(load);
      const double change = peaks.change(peaks.state().highest, 0, observable);
      CHECK(std::abs(change - difference) < 1e-6 * std::abs(value) / load);
    }
  }
}

TEST_CASE("random structures: peaks that are followed are those of a new response") {
  int compared = 0, missed = 0, followed = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const scene::Scene s = random_scenes::make(seed, random_scenes::Excitation::first);
    std::vector<std::string> over;
    for (const auto& element : s.elements) over.push_back(element.name + ".normal_load");
    PeakAmplitude by_following = peaks_over(s, over, s.studies[0].from, s.studies[0].to);
    PeakAmplitude anew = peaks_over(s, over, s.studies[0].from, s.studies[0].to);
    Design start;
    for (const auto& name : over) start.push_back(scene::value(s, name));
    by_following.trace(start);
    for (const double factor : {1.05, 1.3, 1.7, 2.5, 4.0, 6.0, 6.5, 7.0, 2.0, 1.0, 0.6, 0.4}) {
      Design design = start;
      for (double& value : design) value /= std::sqrt(factor);
      design[0] = start[0] * factor;
      CAPTURE(seed, factor);
      const double amplitude = by_following.at(design).amplitude(), exact = anew.trace(design).amplitude();
      CHECK(amplitude <= (1 + 1e-8) * exact);
      ++compared;
      missed += !(amplitude >= (1 - 1e-8) * exact);
    }
    followed += by_following.work().followed;
  }
  CHECK(compared == 120);
  CHECK(missed <= 2);  // a peak that came up from below half of the highest
  CHECK(followed >= 50);
}

TEST_CASE("peaks at corners, where an element begins to slip, are followed along them") {
  scene::Scene s = row(10, 6, 7);
  const std::vector<std::pair<Design, double>> corners = {{{0.69, 0.494, 0.343, 0.572, 2, 0.463}, 8.47},
                                                          {{0.676, 0.447, 0.366, 0.576, 2, 0.377}, 11.66}};
  for (const auto& [loads, at] : corners) {
    std::vector<std::string> over;
    for (std::size_t i = 0; i < loads.size(); ++i) over.push_back("d" + std::to_string(i) + ".normal_load");
    PeakAmplitude peaks = peaks_over(s, over, at - 0.05, at + 0.05);
    const auto& state = peaks.trace(loads);
    CAPTURE(at, state.peaks.size());
    REQUIRE(state.peaks[state.highest].kind == PeakKind::corner);
    const int element = state.peaks[state.highest].corner->element;
    for (std::size_t k = 0; k < loads.size(); ++k) {
      CAPTURE(k);
      const double gradient = peaks.trace(loads).peaks[peaks.state().highest].gradient[static_cast<int>(k)];
      Design above = loads, below = loads;
      above[k] *= 1 + 1e-5;
      below[k] *= 1 - 1e-5;
      const double difference =
          (peaks.trace(above).amplitude() - peaks.trace(below).amplitude()) / (2e-5 * loads[k]);
      CHECK(std::abs(gradient - difference) * loads[k] < 1e-6 * peaks.state().amplitude());
    }
    peaks.trace(loads);
    const int before = peaks.work().followed;
    Design design = loads;
    for (double& load : design) load *= 1.002;
    const double followed = peaks.at(design).amplitude();
    CHECK(peaks.work().followed == before + 1);
    CHECK(peaks.state().peaks[peaks.state().highest].corner->element == element);
    CHECK(reference::error(followed, peaks.trace(design).amplitude()) < 1e-10);
  }
}
