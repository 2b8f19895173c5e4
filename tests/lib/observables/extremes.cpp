#include "lib/observables/extremes.hpp"

#include <cmath>
#include <numbers>

namespace extremes {
namespace {

using arcslip::scene::Scene;
constexpr double pi = std::numbers::pi;
constexpr double m = 1.24, k = 17890, c = 0.134, kd = 3500, f0 = 1;

// Peak of a linear oscillator: f/(c sqrt(k/m - c^2/(4 m^2))).
double linear_peak(double stiffness, double force = f0) {
  return force / (c * std::sqrt(stiffness / m - c * c / (4 * m * m)));
}

// One harmonic, no damping, at resonance: kd A = p/(1 - pi f0/(4 p)), p = Fn/2.
double undamped_peak(double normal_load) {
  const double p = 0.5 * normal_load;
  return p / (1 - pi * f0 / (4 * p)) / kd;
}

std::function<void(Scene&)> set(std::vector<std::pair<std::string, double>> values, int order = 15) {
  return [=](Scene& scene) {
    scene.harmonics.order = order;
    for (const auto& [name, value] : values) arcslip::scene::set(scene, name, value);
  };
}

std::function<void(Scene&)> window(double from, double to, std::vector<std::pair<std::string, double>> values,
                                   int order = 15) {
  return [=](Scene& scene) {
    set(values, order)(scene);
    scene.studies.front().from = from;
    scene.studies.front().to = to;
  };
}

}  // namespace

const std::vector<Extreme>& all() {
  static const std::string whole = "the whole window";
  static const std::vector<Extreme> rows = {
      {"Fn = 0",
       set({{"damper.normal_load", 0}}),
       {"boundary"},
       1,
       linear_peak(k),
       1e-11,
       false,
       "linear response of the free structure, stick 0 %"},
      {"Fn = 1e-12 N",
       set({{"damper.normal_load", 1e-12}}),
       {"boundary"},
       1,
       linear_peak(k),
       1e-11,
       false,
       "linear response of the free structure"},
      {"Fn = 1e9 N",
       set({{"damper.normal_load", 1e9}}),
       {"boundary"},
       1,
       linear_peak(k + kd),
       1e-11,
       false,
       "linear response of the stuck structure, stick 100 %"},
      {"mu = 0",
       set({{"damper.friction_coefficient", 0}}),
       {"boundary"},
       1,
       linear_peak(k),
       1e-11,
       false,
       "linear response of the free structure"},
      {"c = 0, Fn = 0",
       set({{"c.value", 0}, {"damper.normal_load", 0}}),
       {"unbounded", "boundary"},
       0,
       0,
       0,
       false,
       "unbounded peak, said with its energies; both sides traced"},
      {"c = 0, Fn = 1 N",
       set({{"c.value", 0}, {"damper.normal_load", 1}}),
       {"unbounded", "boundary"},
       0,
       0,
       0,
       false,
       "unbounded peak (Fn <= pi f0/(4 mu) = 1.5708 N); both sides traced"},
      {"c = 0, Fn = 1.5707 N, just unbounded",
       set({{"c.value", 0}, {"damper.normal_load", 1.5707}}, 1),
       {"unbounded", "boundary"},
       0,
       0,
       0,
       false,
       "unbounded peak; both sides traced"},
      {"c = 0, Fn = 1.571 N, just bounded",
       set({{"c.value", 0}, {"damper.normal_load", 1.571}}, 1),
       {"boundary"},
       1,
       undamped_peak(1.571),
       1e-9,
       true,
       "bounded by slip alone, closed form of one harmonic"},
      {"c = 0, Fn = 3 N",
       set({{"c.value", 0}}, 1),
       {"boundary"},
       1,
       undamped_peak(3),
       1e-4,
       true,
       "bounded by slip alone"},
      {"c = 0, Fn = 500 N",
       set({{"c.value", 0}, {"damper.normal_load", 500}}),
       {"boundary"},
       1,
       0.0716537,
       1e-6,
       false,
       "bounded by slip alone, A_max = 0.0716537 m"},
      {"kd = 1e-6 k",
       set({{"damper.stiffness", 1e-6 * k}}),
       {"boundary"},
       1,
       linear_peak(k * (1 + 1e-6)),
       1e-11,
       false,
       "stuck throughout, on a soft spring"},
      {"kd = 1e6 k, Fn = 3 N",
       set({{"damper.stiffness", 1e6 * k}}),
       {"boundary"},
       0,
       0,
       0,
       false,
       "stuck throughout: friction holds more than f0"},
      {"kd = 1e6 k, Fn = 0.5 N",
       set({{"damper.stiffness", 1e6 * k}, {"damper.normal_load", 0.5}}),
       {"boundary"},
       1,
       (f0 - 4 * 0.25 / pi) / (c * std::sqrt(k / m)),
       1e-4,
       true,
       "Coulomb friction: c w A = f0 - 4 p/pi at the peak; flagged, since the stuck resonance is out of "
       "reach"},
      {"f0 = 0", set({{"force.cosine", 0}}), {"boundary"}, 0, 0, 0, false, "rest"},
      {"f0 = 1e-12 N",
       set({{"force.cosine", 1e-12}}),
       {"boundary"},
       1,
       linear_peak(k + kd, 1e-12),
       1e-11,
       false,
       "linear response of the stuck structure"},
      {"f0 = 1e6 N",
       set({{"force.cosine", 1e6}}),
       {"boundary"},
       1,
       linear_peak(k, 1e6 - 4 * 1.5 / pi),
       1e-8,
       false,
       "nearly free: c w A = f0 - 4 p/pi"},
      {"0.01 Hz to 1 kHz", window(0.01, 1000, {}), {"boundary"}, 1, 0.000884970009333055, 1e-5, false, whole},
      {"0.05 Hz to 25 Hz, Fn = 0.1 N",
       window(0.05, 25, {{"damper.normal_load", 0.1}}),
       {"boundary"},
       -1,
       0.0581755741412022,
       1e-6,
       false,
       whole + ", with superharmonic peaks and up to 8 slip phases a period"},
      {"N = 1", set({}, 1), {"boundary"}, 1, 0.000884970009333055, 2e-4, true, whole},
      {"N = 201", set({}, 201), {"boundary"}, 1, 0.000884970009333055, 2e-10, false, whole},
      {"m = 1e-9 kg, 600 to 800 kHz",
       window(6e5, 8e5, {{"m.value", 1e-9}}),
       {"boundary"},
       0,
       0,
       0,
       false,
       "damped beyond resonance"},
      {"m = 1e9 kg, 0.6 to 0.8 mHz",
       window(6e-4, 8e-4, {{"m.value", 1e9}}, 1),
       {"boundary"},
       1,
       undamped_peak(3),
       1e-4,
       true,
       "as undamped: c w is negligible"},
  };
  return rows;
}

}  // namespace extremes
