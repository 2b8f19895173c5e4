// Random structures with contacts in planes: harmonic balance next to Newmark's method with shooting.
// ARCSLIP_SCENES is how many; by default 10, or 100 with ARCSLIP_FULL=1.
#include "catch.hpp"

#include "lib/time/periodic/compared_with_exact.hpp"
#include "random.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/fourier/series_maximum.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <cmath>
#include <cstdlib>
#include <sstream>

using namespace arcslip;
using test_random::Random;

namespace {

std::uint64_t scene_count() {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return std::getenv("ARCSLIP_FULL") ? 100 : 10;
}

std::string dof(int mass, int axis) {
  return std::string(1, "xyz"[axis]) + std::to_string(mass);
}

// One to four masses with three coordinates each, springs to the ground and in any direction between them,
// forces in the first three harmonics, at 95 rad/s.
scene::Scene structure(std::uint64_t seed) {
  Random random(seed);
  const int masses = random.count(1, 4);
  std::ostringstream text, parts[4], forces;  // dofs, masses, springs, dampers
  text.precision(17);
  for (auto& part : parts) part.precision(17);
  forces.precision(17);
  const auto separated = [](std::ostringstream& list) { return list.tellp() > 0 ? ", " : ""; };
  for (int m = 0; m < masses; ++m)
    for (int i = 0; i < 3; ++i) {
      const std::string at = dof(m, i);
      parts[0] << separated(parts[0]) << '"' << at << '"';
      parts[1] << separated(parts[1]) << R"({"name": "m)" << at << R"(", "at": ")" << at << R"(", "value": )"
               << random.between(0.5, 2) << "}";
      parts[2] << separated(parts[2]) << R"({"name": "k)" << at << R"(", "at": ")" << at << R"(", "value": )"
               << random.logarithmic(2e3, 4e4) << "}";
      parts[3] << separated(parts[3]) << R"({"name": "c)" << at << R"(", "at": ")" << at << R"(", "value": )"
               << random.between(2, 10) << "}";
      for (int n = 1; n <= 3; ++n)
        if (n == 1 || random.count(0, 3) == 0)
          forces << separated(forces) << R"({"name": "f)" << n << at << R"(", "at": ")" << at
                 << R"(", "harmonic": )" << n << R"(, "cosine": )" << random.between(-20, 20) / n
                 << R"(, "sine": )" << random.between(-20, 20) / n << "}";
    }
  for (int k = 0; k < 2 * masses; ++k) {
    const int a = random.count(0, masses - 1), b = random.count(0, masses - 1);
    const int i = random.count(0, 2), j = (i + random.count(1, 2)) % 3;
    parts[2] << R"(, {"name": "s)" << k << R"(", "direction": {")" << dof(a, i) << R"(": )"
             << random.between(-1, 1) << R"(, ")" << dof(b, j) << R"(": )" << random.between(-1, 1)
             << R"(}, "value": )" << random.logarithmic(1e3, 2e4) << "}";
  }
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [)"
       << parts[0].str() << R"(], "masses": [)" << parts[1].str() << R"(], "springs": [)" << parts[2].str()
       << R"(], "dampers": [)" << parts[3].str() << R"(]}, "elements": [], "excitation": [)" << forces.str()
       << R"(], "response": {"at": "x0"}, "harmonics": {"order": 5}})";
  std::istringstream in(text.str());
  return scene::read(in, studies::catalogue());
}

// One or two contacts between a mass and the ground or another mass, with loads from a gap to such as never
// open.
scene::Scene with_planes(scene::Scene s, std::uint64_t seed) {
  const auto free = compared_with_exact::balanced(s, 95);
  const auto amplitudes = time::dof_coefficients(*free.problem, free.u, free.p);
  Random random(seed + 1000);
  const int masses = static_cast<int>(s.dofs.size()) / 3;
  for (int k = random.count(1, 2); k > 0; --k) {
    const int mass = random.count(0, masses - 1), other = random.count(0, masses - 1);
    const int normal = random.count(0, 2), first = (normal + 1) % 3, second = (normal + 2) % 3;
    const double turn = random.between(0, 3), c = std::cos(turn), si = std::sin(turn);
    const auto along = [&](int axis, double weight, double tilt, int tilted) {
      scene::Direction d{{3 * mass + axis, weight}};
      if (tilt != 0) d.push_back({3 * mass + tilted, tilt});
      if (other == mass) return d;
      d.push_back({3 * other + axis, -weight});
      if (tilt != 0) d.push_back({3 * other + tilted, -tilt});
      return d;
    };
    const double stiffness = random.logarithmic(2e3, 4e4);
    const double reach = amplitudes.col(3 * mass + normal).norm();
    scene::Part contact;
    contact.name = "plane" + std::to_string(k);
    contact.type = &elements::contact_3d();
    contact.directions = {along(first, c, si, second), along(first, -si, c, second), along(normal, 1, 0, 0)};
    contact.values = {random.logarithmic(2e3, 4e4), stiffness, random.between(0.1, 0.7),
                      stiffness * reach * random.between(-0.3, 1.5)};
    s.elements.push_back(contact);
  }
  return s;
}

}  // namespace

TEST_CASE("random structures with contacts in planes have the periodic motion of small steps in time") {
  int opened = 0, slipped = 0, compared = 0;
  for (std::uint64_t seed = 1; seed <= scene_count(); ++seed) {
    CAPTURE(seed);
    scene::Scene s = with_planes(structure(seed), seed);
    double balanced[2];
    for (const int k : {0, 1}) {
      s.harmonics.order = k == 0 ? 21 : 41;
      const auto pair = compared_with_exact::balanced(s, 95);
      const auto coefficients = time::dof_coefficients(*pair.problem, pair.u, pair.p);
      elements::LargestValue largest(pair.problem->harmonics());
      balanced[k] = largest.of(coefficients.col(0));
    }
    double stepped[3];
    bool complete = true, stable = true, rests = false;
    for (int k = 0; k < 3 && complete; ++k) {
      const auto motion = observables::motion_in_time(
          s, {.frequency = 95, .method = observables::TimeMethod::newmark_shooting, .steps = 1000 << k});
      complete = motion.status == observables::Status::complete;
      stepped[k] = motion.amplitude;
      stable = stable && std::abs(motion.multipliers.front()) < 1;
      if (k > 0) continue;
      for (const auto& element : motion.elements) {
        rests = rests || element.stick_percent > 99.9;
        opened += element.open_percent > 0;
        slipped += element.stick_percent < 99;
      }
    }
    CHECK(complete);
    if (!complete || !stable) continue;  // a second motion, where there are several
    ++compared;
    // Of second order in the steps, of third order in the harmonics; in time, the place of a slider that
    // rests comes from a few harmonics.
    const double coarse = (4 * stepped[1] - stepped[0]) / 3, fine = (4 * stepped[2] - stepped[1]) / 3;
    CAPTURE(balanced[0], balanced[1], coarse, fine);
    CHECK(std::abs(balanced[1] - fine) <=
          std::abs(fine - coarse) + std::abs(balanced[1] - balanced[0]) + (rests ? 1e-5 : 1e-7) * fine);
    CHECK(std::abs(balanced[1] / fine - 1) < 1e-3);
  }
  CHECK(opened > compared / 5);
  CHECK(slipped > compared / 2);
}
