// examples/bladed_disk: with one harmonic the sector's response is a closed form; its full ring is read.
#include "catch.hpp"
#include "environment.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>

#include <cmath>
#include <complex>
#include <numbers>

using namespace arcslip;
using std::numbers::pi;

namespace {

using Complex = std::complex<double>;

// Force over displacement of a slider of stiffness k with the given limit, at an amplitude a, of one
// harmonic.
Complex slider(double k, double a, double limit) {
  if (k * a <= limit) return k;
  const double angle = std::acos(1 - 2 * limit / (k * a));
  return {k / pi * (angle - std::sin(angle) * std::cos(angle)), 4 * limit / (pi * a) * (1 - limit / (k * a))};
}

// The force that a blade's amplitude a takes in the wave of engine order 3 of 24 sectors.
double force_of(double a, double w, double load) {
  const double apart = 2 * std::sin(pi * 3 / 24);  // |1 - t|
  const Complex blade(480000, 0.8 * w);
  const Complex disk = blade + 2e6 + apart * apart * 1e7 - 1.5 * w * w;
  const Complex damper = apart * apart * slider(40000, apart * a, 0.3 * load);
  return a * std::abs(blade + damper - 0.3 * w * w - blade * blade / disk);
}

}  // namespace

TEST_CASE("the sector of the bladed disk has the amplitude of the describing function") {
  scene::Scene s = scenes::example("bladed_disk");
  s.harmonics.order = 1;
  for (const double load : {1.0, 5.0, 20.0, 80.0}) {
    CAPTURE(load);
    scene::set(s, "damper.normal_load", load);
    const auto branches = observables::frequency_response(s, scenes::window(s));
    REQUIRE(branches.size() == 1);
    REQUIRE(branches[0].status == observables::Status::complete);
    REQUIRE(branches[0].points.size() > 20);
    for (const auto& point : branches[0].points)
      CHECK(std::abs(force_of(point.amplitude, point.omega, load) - 1) < 1e-11);
  }
}

TEST_CASE("the mistuned bladed disk is the same sector 24 times, with other blades") {
  const scene::Scene one = scenes::example("bladed_disk");
  const scene::Scene all =
      scene::read_file(source_folder() + "/examples/bladed_disk/mistuned.json", test_catalogue::whole());
  CHECK(all.dofs.size() == 48);
  CHECK(all.elements.size() == 24);
  CHECK(all.responses.size() == 24);
  for (const char* same : {"mb.value", "md.value", "kd.value", "link.value", "cb.value", "damper.stiffness"})
    CHECK(scene::value(one, same) == scene::value(all, same));
  CHECK(scene::value(all, "kb2.value") == 480000 * 1.007);
}
