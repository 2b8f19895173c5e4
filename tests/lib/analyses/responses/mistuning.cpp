// Amplification by mistuning of linear rings with one degree of freedom per sector and equal masses and
// dampers, next to the limit of Whitehead (1966), (1 + sqrt N)/2.
//
// Z = K - w^2 m + i w c with a real symmetric K of any stiffnesses is normal, with eigenvalues on a line at
// the distance w c from 0: Z^-1 = (1 + U)/(2 i w c) with a unitary U. So under a wave of forces of size F a
// blade moves by at most F (1 + sqrt N)/(2 w c), whatever the mistuning; all blades of the tuned ring by
// F/(w c) at resonance. A wave of real forces, of engine order 0 or N/2, is amplified to that limit by a mode
// that is the sum of the wave and of one blade alone, far enough from all others.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/problem.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

using namespace arcslip;
using continuation::Vector;

namespace {

constexpr double coupling = 0.01;  // N/m, between blades of 1 N/m and 1 kg

scene::Scene mistuned_ring(const std::vector<double>& factors, int order, double damping) {
  std::ostringstream list;
  list.precision(17);
  for (std::size_t i = 0; i < factors.size(); ++i) list << (i > 0 ? ", " : "") << factors[i];
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"cyclic": {"sectors": )"
       << factors.size() << ", \"engine_order\": " << order << R"(, "full": true, "mistuning": {"k.value": [)"
       << list.str() << R"(]}}, "dofs": ["blade"], "masses": [{"name": "m", "at": "blade", "value": 1}],
    "springs": [{"name": "k", "at": "blade", "value": 1},
                {"name": "q", "between": ["blade", {"next": "blade"}], "value": )"
       << coupling << R"(}], "dampers": [{"name": "c", "at": "blade", "value": )" << damping << R"(}]},
    "excitation": [{"name": "f", "at": "blade", "cosine": 1}], "harmonics": {"order": 1}})";
  return scenes::parse(text.str());
}

// The largest amplitude of a blade between two frequencies, times w c: over that of the tuned ring.
double amplification(const scene::Scene& s, double damping, double from, double to, int points) {
  const model::Model model = model::build(s);
  const hbm::Coordinates coordinates = hbm::coordinates(model, 1);
  hbm::DynamicStiffness stiffness(model, coordinates, model.harmonics);
  Vector p = model::defaults(model), u(model.harmonics.size());
  double largest = 0;
  for (int i = 0; i < points; ++i) {
    const double w = from + (to - from) * i / (points - 1);
    p[model::frequency] = w;
    REQUIRE(stiffness.move_to(p));
    stiffness.force(u);
    stiffness.solve(u);
    const double amplitude = stiffness.motion(coordinates.P, u, 1).colwise().norm().maxCoeff();
    largest = std::max(largest, amplitude * w * damping);
  }
  return largest;
}

double limit(std::size_t sectors) {
  return 0.5 * (1 + std::sqrt(static_cast<double>(sectors)));
}

}  // namespace

TEST_CASE("no random mistuning of a ring amplifies beyond the limit of Whitehead") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(1, 0.02);
  double most = 0;
  for (const std::size_t sectors : {3u, 6u, 24u})
    for (const int order : {0, 1, 3})
      for (int pattern = 0; pattern < 10; ++pattern) {
        std::vector<double> factors(sectors);
        for (double& factor : factors) factor = normal(random);
        const double damping = pattern % 2 == 0 ? 0.002 : 0.0005;
        const double found = amplification(mistuned_ring(factors, order, damping), damping, 0.95, 1.08, 1000);
        CAPTURE(sectors, order, pattern);
        CHECK(found <= limit(sectors) * (1 + 1e-10));
        most = std::max(most, found / limit(sectors));
      }
  CHECK(most > 0.5);
}

TEST_CASE("the tuned ring is amplified by 1 at its resonance") {
  const double damping = 0.002;
  CHECK(amplification(mistuned_ring(std::vector<double>(24, 1.0), 3, damping), damping, 1, 1.02, 4001) ==
        Approx(1).epsilon(1e-5));
}

// Stiffnesses with which (wave + blade 1) is a mode, and the square of its frequency is 1.
TEST_CASE("the worst pattern for a wave of real forces comes to 0.9 of the limit and more") {
  for (const std::size_t sectors : {6u, 24u}) {
    const double damping = 2e-6, share = 1 / std::sqrt(static_cast<double>(sectors));
    std::vector<double> mode(sectors, share), factors(sectors);
    mode[0] += 1;
    for (std::size_t i = 0; i < sectors; ++i) {
      const double before = mode[(i + sectors - 1) % sectors], after = mode[(i + 1) % sectors];
      factors[i] = 1 - coupling * (2 * mode[i] - before - after) / mode[i];
    }
    const double found = amplification(mistuned_ring(factors, 0, damping), damping, 1 - 2e-6, 1 + 2e-6, 401);
    CAPTURE(sectors, found, limit(sectors));
    CHECK(found > 0.9 * limit(sectors));
    CHECK(found <= limit(sectors) * (1 + 1e-8));
  }
}
