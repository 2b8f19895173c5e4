// The largest amplitude in a window, followed from design to design.

#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "optimize/row.hpp"

#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>

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

// The largest difference between the second derivatives of the highest peak and central differences of its
// gradients, times the parameters, over the amplitude, or relative where they are larger than that.
double hessian_error(PeakAmplitude& peaks, const Design& design, double step = 1e-5) {
  const PeakKind kind = peaks.trace(design).peaks[peaks.state().highest].kind;
  const double amplitude = peaks.state().amplitude();
  const continuation::Matrix second = peaks.hessian(peaks.state().highest);
  if (second.size() == 0) return HUGE_VAL;
  double error = (second - second.transpose()).cwiseAbs().maxCoeff() > 0 ? HUGE_VAL : 0;
  for (std::size_t j = 0; j < design.size(); ++j) {
    continuation::Vector gradient[2];
    for (const int side : {0, 1}) {
      Design nearby = design;
      nearby[j] *= side == 0 ? 1 - step : 1 + step;
      const auto& state = peaks.at(nearby);
      if (state.peaks[state.highest].kind != kind) return HUGE_VAL;
      gradient[side] = state.peaks[state.highest].gradient;
    }
    for (std::size_t k = 0; k < design.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(j), column = static_cast<Eigen::Index>(k);
      const double difference = (gradient[1][column] - gradient[0][column]) / (2 * step * design[j]);
      const double unit = amplitude / (design[j] * design[k]) + std::abs(second(row, column));
      error = std::max(error, std::abs(second(row, column) - difference) / unit);
    }
  }
  return error;
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

TEST_CASE("what is asked at a design moves nothing that is followed from there") {
  const scene::Scene s = scenes::chain(5, false);
  const std::vector<std::string> over = {"d1.normal_load", "d2.normal_load"};
  Design design;
  for (const auto& name : over) design.push_back(scene::value(s, name));
  PeakAmplitude asked = peaks_over(s, over, 0.3, 3), silent = peaks_over(s, over, 0.3, 3);
  asked.trace(design);
  silent.trace(design);
  for (int k = 0; k < 10; ++k) {
    for (double& value : design) value *= 1.01;
    const auto &state = asked.at(design), &same = silent.at(design);
    REQUIRE(state.peaks.size() == same.peaks.size());
    for (std::size_t i = 0; i < state.peaks.size(); ++i) {
      CHECK(state.peaks[i].x == same.peaks[i].x);
      CHECK(asked.hessian(i).allFinite());
      CHECK(std::isfinite(asked.change(i, 0, [](const auto& point) { return point.energy_friction; })));
    }
  }
  CHECK(asked.work().responses == silent.work().responses);
}

TEST_CASE("random structures: peaks that are followed are those of a new response") {
  int compared = 0, missed = 0, followed = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const scene::Scene s = random_scenes::make(seed, random_scenes::Excitation::first);
    std::vector<std::string> over;
    for (const auto& element : s.elements) over.push_back(element.name + ".normal_load");
    PeakAmplitude by_following = peaks_over(s, over, scenes::window(s).from, scenes::window(s).to);
    PeakAmplitude anew = peaks_over(s, over, scenes::window(s).from, scenes::window(s).to);
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

TEST_CASE(
    "random structures in narrow windows: the longer steps of a search see the peaks of a whole curve") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    scene::Scene s = random_scenes::make(seed, static_cast<random_scenes::Excitation>(seed % 3));
    auto& window = scenes::window(s);
    window.from += (window.to - window.from) * static_cast<double>(seed % 7) / 10;
    window.to = window.from * (1.05 + 0.05 * static_cast<double>(seed % 5));
    double most = 0;
    for (const auto& branch : observables::frequency_response(s, window)) {
      for (const auto& point : branch.points) most = std::max(most, point.amplitude);
      for (const auto& event : branch.events) most = std::max(most, event.point.amplitude);
    }
    const std::string& element = s.elements[0].name;
    PeakAmplitude peaks = peaks_over(s, {element + ".normal_load"}, window.from, window.to);
    CAPTURE(seed, window.from, window.to);
    const double load = scene::value(s, element + ".normal_load");
    CHECK(peaks.trace(Design{load}).amplitude() == Approx(most).epsilon(1e-9));
  }
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

TEST_CASE("one harmonic, no damping: second derivatives by load, friction, stiffness and force are exact") {
  scene::Scene s = scenes::paper(1);
  scene::set(s, "c.value", 0);
  PeakAmplitude peaks = peaks_over(
      s, {"damper.normal_load", "damper.friction_coefficient", "damper.stiffness", "force.cosine"}, 18, 22);
  for (const double load : {1.7, 2.0, 3.0, std::numbers::pi, 5.0, 20.0, 60.0}) {
    const double mu = 0.5, kd = 3500, p = mu * load, q = std::numbers::pi / 4, r = p - q;
    // kd A = p^2/(p - q), q = pi f0/4
    const double g = p * p / r, g_p = p * (p - 2 * q) / (r * r), g_q = p * p / (r * r);
    const double g_pp = 2 * q * q / (r * r * r), g_pq = -2 * p * q / (r * r * r),
                 g_qq = 2 * p * p / (r * r * r);
    continuation::Matrix exact(4, 4);
    exact << mu * mu * g_pp, g_p + p * g_pp, -mu * g_p / kd, mu * q * g_pq,  //
        0, load * load * g_pp, -load * g_p / kd, load * q * g_pq,            //
        0, 0, 2 * g / (kd * kd), -q * g_q / kd,                              //
        0, 0, 0, q * q * g_qq;
    exact /= kd;
    const Design design = {load, mu, kd, 1};
    peaks.trace(design);
    const continuation::Matrix second = peaks.hessian(peaks.state().highest);
    REQUIRE(second.size() == 16);
    for (int j = 0; j < 4; ++j)
      for (int k = j; k < 4; ++k) {
        CAPTURE(load, j, k);
        const double unit = peaks.state().amplitude() / design[static_cast<std::size_t>(j)] /
                            design[static_cast<std::size_t>(k)];
        CHECK(std::abs(second(j, k) - exact(j, k)) < 1e-8 * (unit + std::abs(exact(j, k))));
        CHECK(second(j, k) == second(k, j));
      }
  }
}

TEST_CASE("second derivatives are the differences of gradients, from full slip to full stick") {
  PeakAmplitude peaks = peaks_over(scenes::paper(15), {"damper.normal_load", "damper.stiffness"}, 18, 22);
  for (const double load : {0.05, 0.3, 1.0, 1.6, 2.0, 3.0, 3.3, 5.0, 10.0, 30.0, 100.0, 400.0}) {
    CAPTURE(load);
    CHECK(hessian_error(peaks, {load, 3500}) < 1e-6);
  }
}

TEST_CASE("second derivatives of peaks on a chain with two dampers") {
  scene::Scene s = scenes::example("two_dampers");
  PeakAmplitude peaks = peaks_over(s, {"d1.normal_load", "d2.normal_load", "c1.value"}, 8, 45);
  for (const Design& design : {Design{2, 2, 0.3}, {0.5, 3, 0.3}, {5, 0.7, 0.1}, {0.1, 0.2, 0.3}}) {
    CAPTURE(design);
    CHECK(hessian_error(peaks, design) < 1e-6);
  }
}

TEST_CASE("second derivatives at the ends of the window and at corners") {
  for (const auto& [from, to] : {std::pair{18.0, 19.8}, std::pair{20.1, 22.0}}) {
    PeakAmplitude peaks = paper_peaks(15, from, to);
    CAPTURE(from);
    CHECK(hessian_error(peaks, {3}) < 1e-5);
  }
  std::vector<std::string> over;
  for (int i = 0; i < 6; ++i) over.push_back("d" + std::to_string(i) + ".normal_load");
  PeakAmplitude peaks = peaks_over(row(10, 6, 7), over, 8.42, 8.52);
  const Design corner = {0.69, 0.494, 0.343, 0.572, 2, 0.463};
  CHECK(hessian_error(peaks, corner) < 1e-5);
  REQUIRE(peaks.trace(corner).peaks[peaks.state().highest].kind == PeakKind::corner);
}

TEST_CASE("large factors are given up after a stop, and the best design is observed all the same") {
  constexpr int length = 120;
  scene::Scene s;
  for (int i = 0; i < length; ++i) {
    const std::string n = std::to_string(i);
    s.dofs.push_back("x" + n);
    s.masses.push_back({"m" + n, &scene::mass_type(), {{{i, 1.0}}}, {1}});
    const scene::Direction along =
        i > 0 ? scene::Direction{{i, 1.0}, {i - 1, -1.0}} : scene::Direction{{i, 1.0}};
    s.springs.push_back({"k" + n, &scene::spring_type(), {along}, {1e4}});
    s.dampers.push_back({"c" + n, &scene::damper_type(), {along}, {5.0 + i % 7}});  // no modes
  }
  s.elements.push_back({"d", &elements::jenkins(), {{{60, 1.0}}}, {1e3, 0.5, 2}});
  s.excitation.push_back({"f", &scene::force_type(), {{{7, 1.0}}}, {1, 0}, 1});
  s.harmonics.order = 3;
  s.response() = {{60, 1.0}};
  const auto model = std::make_shared<const model::Model>(model::build(s));
  long asked = 0, last = 1'000'000;
  PeakAmplitude peaks(model, {model::parameter_index(*model, "d.normal_load")}, {1, 1.4},
                      controls::polled([&] { return ++asked < last; }));
  const optimize::PeakState first = peaks.trace(Design{2.0});
  REQUIRE(first.complete);
  CHECK(asked >= 2 * peaks.work().factorizations);  // before each of two harmonics
  const auto problem = peaks.problem();
  const auto before = peaks.observe(first, problem);
  const long all = asked;
  for (const bool follow : {false, true})
    for (const long more : {1L, 2L, 5L, all / 2}) {
      CAPTURE(follow, more);
      last = 1'000'000;
      PeakAmplitude other(model, {model::parameter_index(*model, "d.normal_load")}, {1, 1.4},
                          controls::polled([&] { return ++asked < last; }));
      other.trace(Design{2.0});
      asked = 0;
      last = more;
      if (follow && more > 5) continue;  // it is done by then
      CHECK_THROWS_AS(follow ? other.at(Design{2.1}) : other.trace(Design{2.1}), optimize::Interrupted);
      CHECK(asked <= more + 40);  // a step that fails is tried again, shorter
    }
  asked = 0;
  const auto after = peaks.observe(first, problem);
  CHECK(asked == 0);
  CHECK(after.amplitude == before.amplitude);
}
