// Derivatives of amplitudes by parameters: closed forms, and differences of peaks that are found anew.

#include "catch.hpp"
#include "size.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/curves/sensitivity.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

using namespace arcslip;
using continuation::Vector;
using std::numbers::pi;
using test_size::sized;

namespace {

struct Peak {
  Vector x;  // unknowns and frequency
  bool nonsmooth;
  double amplitude;
};

struct Peaks {
  std::shared_ptr<const hbm::HbmProblem> problem;
  std::vector<Peak> all;
};

Peaks peaks_of(const scene::Scene& s, const observables::FrequencyWindow& window) {
  Peaks peaks;
  const auto record = [&](observables::Observer& observer, const continuation::Accepted& now,
                          const continuation::Event* event) {
    if (!event || event->monitor != "peak") return true;
    Vector x(now.u.size() + 1);
    x << now.u, now.parameter;
    const auto& at = static_cast<const hbm::HbmEvaluator&>(now.at);
    peaks.all.push_back({std::move(x), event->nonsmooth, observer.extreme(at, now.u).amplitude});
    return true;
  };
  const auto model = std::make_shared<const model::Model>(model::build(s));
  peaks.problem = observables::frequency_branch(model, window, window.lower, record).problem;
  return peaks;
}

observables::FrequencyWindow window_of(const scene::Scene& s) {
  const double unit = scene::to_rad_per_s(s.frequency_unit);
  return {scenes::window(s).from * unit, scenes::window(s).to * unit};
}

Vector parameters(const Peaks& peaks) {
  return hbm::parameters_at(*peaks.problem, 1);
}

double derivative(const Peaks& peaks, const Peak& peak, const std::string& name) {
  observables::Sensitivity sensitivity(peaks.problem);
  const std::vector<int> k{model::parameter_index(peaks.problem->model(), name)};
  Vector gradient(1);
  REQUIRE(sensitivity.at_resonance(peak.x, parameters(peaks), k, gradient));
  return gradient[0];
}

// Of the peak nearest to one frequency, found anew at two values of the parameter.
double difference(const scene::Scene& s, const std::string& name, const Peak& peak, double step) {
  const double omega = peak.x[peak.x.size() - 1];
  const auto amplitude_at = [&](double value) {
    scene::Scene with = s;
    scene::set(with, name, value);
    const Peaks peaks = peaks_of(with, window_of(with));
    double nearest = HUGE_VAL, amplitude = 0;
    for (const Peak& other : peaks.all) {
      const double distance = std::abs(other.x[other.x.size() - 1] - omega);
      if (distance < nearest) nearest = distance, amplitude = other.amplitude;
    }
    return amplitude;
  };
  const double value = scene::value(s, name), h = step * value;
  return (amplitude_at(value + h) - amplitude_at(value - h)) / (2 * h);
}

}  // namespace

TEST_CASE("one harmonic, no damping: the peak's derivatives are those of p^2/(p - pi f0/4)/kd") {
  for (const double load : {1.6, 2.0, pi, 5.0, 40.0, 300.0}) {
    scene::Scene s = scenes::paper(1, load);
    scene::set(s, "c.value", 0);
    const Peaks peaks = peaks_of(s, window_of(s));
    REQUIRE(peaks.all.size() == 1);
    const Peak& peak = peaks.all[0];
    const double kd = 3500, mu = 0.5, m = 1.24, p = mu * load, q = pi / 4, A = p * p / (p - q) / kd;
    const double omega = peak.x[peak.x.size() - 1], by_p = p * (p - 2 * q) / ((p - q) * (p - q)) / kd;
    CAPTURE(load);
    const auto check = [&](const std::string& name, double exact, double size) {
      CAPTURE(name);
      CHECK(std::abs(derivative(peaks, peak, name) - exact) < 1e-9 * size);
    };
    check("damper.normal_load", mu * by_p, A / load);
    check("damper.friction_coefficient", load * by_p, A / mu);
    check("damper.stiffness", -A / kd, A / kd);
    check("force.cosine", p * p * q / ((p - q) * (p - q)) / kd, A);
    check("k.value", 0, A / kd);
    check("m.value", 0, A / m);
    // The work of the force, pi f0 A, is stationary in the phase at resonance: pi f0 A = pi c w A^2 + 4 p (A
    // - p/kd).
    check("c.value", -pi * omega * A * A / (4 * p - pi), A / 0.134);
  }
}

TEST_CASE("from full slip to full stick the peak's derivatives are differences of peaks found anew") {
  for (const double load : {0.01, 0.3, 1.0, 2.0, 3.0899, 5.0, 20.0, 100.0, 390.0, 450.0}) {
    const scene::Scene s = scenes::paper(15, load);
    const Peaks peaks = peaks_of(s, window_of(s));
    REQUIRE(peaks.all.size() == 1);
    const Peak& peak = peaks.all[0];
    for (const std::string name : {"damper.normal_load", "damper.friction_coefficient", "damper.stiffness",
                                   "force.cosine", "k.value", "m.value", "c.value"}) {
      CAPTURE(load, name);
      const double size = peak.amplitude / std::abs(scene::value(s, name));
      CHECK(std::abs(derivative(peaks, peak, name) - difference(s, name, peak, 1e-5)) < 1e-6 * size);
    }
  }
}

TEST_CASE("beyond full stick no derivative by the damper's load is left") {
  const scene::Scene s = scenes::paper(7, 450);
  const Peaks peaks = peaks_of(s, window_of(s));
  CHECK(derivative(peaks, peaks.all[0], "damper.normal_load") == 0);
  CHECK(derivative(peaks, peaks.all[0], "damper.friction_coefficient") == 0);
}

TEST_CASE("a tie's derivative is the sum of those of its members") {
  const std::string dampers = R"([{"name": "d1", "type": "jenkins", "at": "a", "stiffness": 0.3,
      "friction_coefficient": 0.4, "normal_load": 0.9}, {"name": "d2", "type": "jenkins", "at": "b",
      "stiffness": 0.5, "friction_coefficient": 0.5, "normal_load": 0.9}])";
  const auto make = [&](const std::string& ties) {
    return scenes::parse(
        R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"], "masses": [{"name": "ma", "at": "a", "value": 1},
      {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "between": ["a", "b"], "value": 1}],
      "dampers": [{"name": "c", "at": "a", "value": 0.05}]},
    "elements": )" +
        dampers + ties +
        R"(, "excitation": [{"name": "f", "at": "a", "cosine": 1}], "harmonics": {"order": 5},
    "response": {"at": "b"}, "studies": [{"kind": "frf", "from": 0.3, "to": 2.5}]})");
  };
  const scene::Scene apart = make("");
  const scene::Scene tied = make(R"(, "ties": {"load": ["d1.normal_load", "d2.normal_load"]})");
  const Peaks of_apart = peaks_of(apart, window_of(apart)), of_tied = peaks_of(tied, window_of(tied));
  REQUIRE(of_apart.all.size() == of_tied.all.size());
  REQUIRE(of_tied.all.size() >= 1);
  for (std::size_t i = 0; i < of_tied.all.size(); ++i) {
    if (of_tied.all[i].nonsmooth) continue;
    const double sum = derivative(of_apart, of_apart.all[i], "d1.normal_load") +
                       derivative(of_apart, of_apart.all[i], "d2.normal_load");
    CHECK(std::abs(derivative(of_tied, of_tied.all[i], "load") - sum) < 1e-9 * std::abs(sum));
    CHECK(std::abs(sum - difference(tied, "load", of_tied.all[i], 1e-5)) < 1e-6 * of_tied.all[i].amplitude);
  }
}

namespace {

// Of the peak by the load of each element, at its corner where it is nonsmooth. Returns how many were looked
// at.
int check_loads(const scene::Scene& s, const Peaks& peaks, const Peak& peak) {
  observables::Sensitivity sensitivity(peaks.problem);
  std::optional<hbm::Corner> corner;
  int checked = 0;
  Vector gradient(1);
  const auto u = peak.x.head(peaks.problem->size());
  for (const auto& each : hbm::corners_near(*peaks.problem, u, parameters(peaks), 1e-8)) corner = each;
  if (peak.nonsmooth && !corner) return 0;
  for (const auto& element : s.elements) {
    const std::string name = element.name + ".normal_load";
    CAPTURE(name, peak.nonsmooth, peak.x[peak.x.size() - 1]);
    const std::vector<int> k{model::parameter_index(peaks.problem->model(), name)};
    if (peak.nonsmooth)
      REQUIRE(sensitivity.at_corner(*corner, peak.x, parameters(peaks), k, gradient));
    else
      REQUIRE(sensitivity.at_resonance(peak.x, parameters(peaks), k, gradient));
    const double size = peak.amplitude / scene::value(s, name);
    CHECK(std::abs(gradient[0] - difference(s, name, peak, 1e-5)) < 2e-6 * size);
    ++checked;
  }
  return checked;
}

}  // namespace

TEST_CASE("random structures: derivatives of peaks, at corners and not, are differences of new peaks") {
  int smooth = 0, corners = 0;
  for (std::uint64_t seed = 0; seed < sized(8u, 2u); ++seed)
    for (const double load : {0.4, 1.0, 2.0, 5.0, 10.0}) {
      scene::Scene s = random_scenes::make(seed, random_scenes::Excitation::first);
      scene::set(s, s.elements[0].name + ".normal_load", load);
      const Peaks peaks = peaks_of(s, window_of(s));
      CAPTURE(seed, load);
      for (const Peak& peak : peaks.all)
        if (peak.nonsmooth)
          corners += check_loads(s, peaks, peak);
        else if (load == 1)
          smooth += check_loads(s, peaks, peak);
    }
  CHECK(smooth >= sized(20, 2));
  if (!test_size::sanitized) CHECK(corners >= 4);
}

TEST_CASE("at a fixed frequency the derivatives of a stuck oscillator are those of the linear one") {
  const scene::Scene s = scenes::paper(5, 450);
  const Peaks peaks = peaks_of(s, window_of(s));
  const double w = 125, m = 1.24, c = 0.134, K = 21390;
  const std::complex<double> i(0, 1), Z = K - m * w * w + i * c * w, X = 1.0 / Z;
  const auto by = [&](std::complex<double> dZ) {
    return (std::conj(X) * (-X * X * dZ)).real() / std::abs(X);
  };
  const auto& h = peaks.problem->harmonics();
  Vector x = Vector::Zero(peaks.problem->size() + 1), gradient(4);
  x[h.cosine_index(1)] = X.real();
  x[h.sine_index(1)] = -X.imag();
  x[x.size() - 1] = w;
  std::vector<int> k;
  for (const char* name : {"m.value", "c.value", "k.value", "damper.stiffness"})
    k.push_back(model::parameter_index(peaks.problem->model(), name));
  observables::Sensitivity sensitivity(peaks.problem);
  REQUIRE(sensitivity.at_frequency(x, parameters(peaks), k, gradient));
  CHECK(gradient[0] == Approx(by(-w * w)).epsilon(1e-11));
  CHECK(gradient[1] == Approx(by(i * w)).epsilon(1e-11));
  CHECK(gradient[2] == Approx(by(1)).epsilon(1e-11));
  CHECK(gradient[3] == Approx(by(1)).epsilon(1e-11));
  CHECK(sensitivity.multiplier() == Approx(by(-2 * m * w + i * c)).epsilon(1e-11));  // dA/domega
  CHECK(sensitivity.amplitude() == Approx(std::abs(X)).epsilon(1e-13));
}
