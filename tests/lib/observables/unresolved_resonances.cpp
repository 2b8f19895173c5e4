// Natural modes with all elements at their maximum stiffness, and their responses at resonance.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/observables/unresolved_resonances.hpp>

#include <algorithm>
#include <complex>

using namespace arcslip;
using Complex = std::complex<double>;

namespace {

scene::Scene two_masses(const std::string& damping, const std::string& structure_keys) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 2}],
      "springs": [{"name": "ka", "at": "a", "value": 100}, {"name": "kb", "between": ["a", "b"], "value": 60}],
      "dampers": [)" + damping +
                       "]" + structure_keys + R"(},
    "elements": [{"name": "d", "type": "jenkins", "at": "b", "stiffness": 50, "friction_coefficient": 0.4,
                  "normal_load": 0.9},
                 {"name": "e", "type": "jenkins", "between": ["a", "b"], "stiffness": 7, "friction_coefficient": 0.4,
                  "normal_load": 0.9}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}],
    "response": {"at": "a"},
    "studies": [{"kind": "frf", "from": 1, "to": 20}]})");
}

// The largest response of a at omega to a unit force of an element: [-w^2 M + i w C + K] x = d.
double largest_response(double omega, const Eigen::Matrix2d& C, const Eigen::Matrix2d& loss) {
  const Complex i(0, 1);
  Eigen::Matrix2cd Z;
  Z << 100 + 60 + 7, -67, -67, 60 + 7 + 50;
  Z(0, 0) -= omega * omega;
  Z(1, 1) -= 2 * omega * omega;
  Z += i * omega * C + i * loss;
  const Complex determinant = Z(0, 0) * Z(1, 1) - Z(0, 1) * Z(1, 0);
  const auto response = [&](double at_a, double at_b) {
    return std::abs((Z(1, 1) * at_a - Z(0, 1) * at_b) / determinant);
  };
  return std::max(response(0, 1), response(-1, 1));
}

}  // namespace

TEST_CASE("the gain of a mode is the response at its resonance to a force of an element") {
  Eigen::Matrix2d K, none = Eigen::Matrix2d::Zero(), C = none;
  K << 160, -60, -60, 60;
  const auto check = [](const scene::Scene& s, const Eigen::Matrix2d& damping, const Eigen::Matrix2d& loss) {
    const model::Model model = model::build(s);
    const auto modes = observables::resonant_modes(model, model::defaults(model));
    REQUIRE(modes);
    REQUIRE(modes->size() == 2);
    CHECK(modes->back().omega ==
          Approx(observables::highest_natural_frequency(model, model::defaults(model))).epsilon(1e-13));
    // The other mode adds the square of the loss, or the ratio of their responses in quadrature.
    for (const auto& mode : *modes)
      CHECK(mode.gain == Approx(largest_response(mode.omega, damping, loss)).epsilon(1e-4));
  };
  C(1, 1) = 1e-3;
  check(two_masses(R"({"name": "c", "at": "b", "value": 1e-3})", ""), C, none);
  check(two_masses("", R"(, "damping": [{"name": "r", "type": "rayleigh", "alpha": 2e-4, "beta": 1e-5}])"),
        2e-4 * Eigen::Vector2d(1, 2).asDiagonal().toDenseMatrix() + 1e-5 * K, none);
  check(two_masses("", R"(, "damping": [{"name": "r", "type": "loss_factor", "loss_factor": 3e-5}])"), none,
        3e-5 * K);
}

TEST_CASE("modes without damping have no bound, and those of large structures are not computed") {
  const model::Model model = model::build(two_masses("", ""));
  const auto modes = observables::resonant_modes(model, model::defaults(model));
  REQUIRE(modes);
  for (const auto& mode : *modes) CHECK(mode.gain == HUGE_VAL);
  model::Model large = model;
  large.dofs = 201;
  CHECK_FALSE(observables::resonant_modes(large, model::defaults(model)));
}
