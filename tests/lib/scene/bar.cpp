// Beams and rods as structures: natural frequencies in closed form, and their faults.

#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/model/reduction_report.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip;

namespace {

// L = 2 m, E I = 10 N m^2, rho A = 5 kg/m, E A = 20 N.
std::string bar(const std::string& kind, int elements, const std::string& ends,
                const std::string& more = "") {
  return "\"" + kind + "\": {\"elements\": " + std::to_string(elements) +
         R"(, "length": 2, "young": 40, "density": 10, "area": 0.5,)" +
         (kind == "beam" ? R"( "inertia": 0.25,)" : "") + " \"ends\": [" + ends + "]" + more + "}";
}

std::string bar_scene(const std::string& structure, const std::string& at) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {)" + structure + R"(},
    "elements": [{"name": "d", "type": "jenkins", "at": ")" +
         at + R"(", "stiffness": 30, "friction_coefficient": 0.5, "normal_load": 0.1}],
    "excitation": [{"name": "f", "at": ")" +
         at + R"(", "cosine": 1}], "response": {"at": ")" + at +
         R"("}, "harmonics": {"order": 5},
    "studies": [{"kind": "frf", "from": 2, "to": 20}]})";
}

std::string bar_fault(const std::string& structure) {
  try {
    observables::prepare(scenes::parse(bar_scene(structure, "p")), {});
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "none";
}

Eigen::VectorXd natural_frequencies(const std::string& structure) {
  const model::Model model = model::build(scenes::parse(bar_scene(structure, "p")));
  const auto p = model::defaults(model);
  return continuation::symmetric_eigenvalues(model::stiffness_matrix(model, p), model::mass_matrix(model, p))
      .cwiseMax(0.0)
      .cwiseSqrt();
}

// (k L)^2 of the lowest modes.
double kL(const std::string& ends, int elements, int mode) {
  const auto all = natural_frequencies(bar("beam", elements, ends, R"(, "points": {"p": 1})"));
  return 2 * std::sqrt(all[mode - 1] * std::sqrt(5.0 / 10));
}

}  // namespace

TEST_CASE("beams have the natural frequencies of the closed form") {
  // Blevins, Formulas for Natural Frequency and Mode Shape (1979), table 8-1.
  const std::string clamped = "\"clamped\"", pinned = "\"pinned\"", free = "\"free\"";
  // Relative error (k L/elements)^4/2880.
  CHECK(kL(clamped + "," + free, 30, 1) == Approx(1.8751040687).epsilon(1e-8));
  CHECK(kL(clamped + "," + free, 110, 2) == Approx(4.6940911330).epsilon(1e-8));
  CHECK(kL(clamped + "," + free, 110, 3) == Approx(7.8547574382).epsilon(2e-8));
  CHECK(kL(clamped + "," + pinned, 60, 1) == Approx(3.9266023120).epsilon(1e-8));
  CHECK(kL(clamped + "," + pinned, 110, 2) == Approx(7.0685827456).epsilon(2e-8));
  CHECK(kL(clamped + "," + clamped, 80, 1) == Approx(4.7300407449).epsilon(1e-8));
  CHECK(kL(pinned + "," + clamped, 60, 1) == Approx(3.9266023120).epsilon(1e-8));
  CHECK(kL(free + "," + free, 80, 3) == Approx(4.7300407449).epsilon(1e-8));  // after two rigid-body motions
  CHECK(kL(pinned + "," + pinned, 60, 1) == Approx(std::numbers::pi).epsilon(1e-8));
}

TEST_CASE("rods have the natural frequencies of linear elements in closed form") {
  // w^2 = 6 E/(rho l^2) (1 - cos h)/(2 + cos h), h = (2 k - 1) pi/(2 elements)
  const auto all = natural_frequencies(bar("rod", 12, R"("clamped", "free")", R"(, "points": {"p": 1})"));
  for (int k = 1; k <= 12; ++k) {
    const double h = (2 * k - 1) * std::numbers::pi / 24, l = 2.0 / 12;
    const double square = 6 * 4 / (l * l) * (1 - std::cos(h)) / (2 + std::cos(h));
    CHECK(all[k - 1] == Approx(std::sqrt(square)).epsilon(1e-12));
  }
}

TEST_CASE("a long beam is reduced, with the response of the whole one") {
  const std::string whole = bar("beam", 100, R"("clamped", "free")", R"(, "points": {"p": 1, "tip": 2})");
  std::string reduced = whole;
  reduced.insert(reduced.size() - 1, R"(, "highest_frequency": 500)");
  for (const double omega : {0.8, 1.9, 7.0}) {
    const auto a = scenes::response_at(scenes::parse(bar_scene(whole, "p")), omega),
               b = scenes::response_at(scenes::parse(bar_scene(reduced, "p")), omega);
    CHECK(b.amplitude == Approx(a.amplitude).epsilon(1e-7));
    CHECK(b.energy_input == Approx(a.energy_input).epsilon(1e-7));
  }
}

TEST_CASE("points of a beam are degrees of freedom, written and read again") {
  const scene::Scene s = scenes::parse(bar_scene(
      bar("beam", 4, R"("clamped", "pinned")", R"(, "points": {"root": 0, "p": 0.5, "end": 2})"), "p"));
  CHECK(s.dofs == std::vector<std::string>{"p", "p.slope", "end.slope"});
  CHECK(scenes::parse(scene::write(s)) == s);
  scene::check(s);
  CHECK(scene::hash(s) != scene::hash(scenes::parse(bar_scene(
                              bar("beam", 5, R"("clamped", "pinned")", R"(, "points": {"p": 0.8})"), "p"))));
  // A rectangular section.
  std::string section = bar("beam", 4, R"("clamped", "pinned")", R"(, "points": {"p": 0.5})");
  section.replace(section.find(R"("area": 0.5, "inertia": 0.25)"), 28, R"("width": 0.3, "height": 0.2)");
  CHECK(scenes::parse(bar_scene(section, "p")).matrices->bar->area == Approx(0.06).epsilon(1e-14));
  CHECK(scenes::parse(bar_scene(section, "p")).matrices->bar->inertia == Approx(0.0002).epsilon(1e-14));
}

TEST_CASE("a spring by a natural frequency needs a mass that is not in matrices") {
  CHECK(contains(bar_fault(bar("beam", 4, R"("clamped", "free")", R"(, "points": {"p": 1})") +
                           R"(, "springs": [{"name": "k", "at": "p", "frequency": 3}])"),
                 "found the degree of freedom \"p\" of a structure from matrices, must be a \"value\""));
}

TEST_CASE("what is wrong with a beam is reported") {
  const std::string ends = R"("clamped", "free")", points = R"(, "points": {"p": 1})";
  CHECK(bar_fault(bar("beam", 4, ends, points)) == "none");
  CHECK(contains(bar_fault(bar("beam", 0, ends, points)), "/structure/beam/elements: found 0"));
  CHECK(
      contains(bar_fault(bar("beam", 4, R"("clamped")", points)), "found 1 ends, must be a list of two of"));
  CHECK(contains(bar_fault(bar("rod", 4, R"("pinned", "free")", points)),
                 "must be one of \"clamped\", \"free\" for a rod"));
  CHECK(contains(bar_fault(bar("beam", 4, ends, R"(, "points": {"p": 0.7})")),
                 "/structure/beam/points/p: found 0.7 m, must be at a node, a multiple of length/elements"));
  CHECK(contains(bar_fault(bar("beam", 4, ends, R"(, "points": {"p": 3})")),
                 "/structure/beam/points/p: found 3"));
  CHECK(contains(bar_fault(bar("beam", 4, ends, R"(, "points": {"p": 0})")), "found no point that moves"));
  CHECK(contains(bar_fault(bar("rod", 1, R"("clamped", "clamped")", R"(, "points": {"p": 0})")),
                 "found no node that moves"));
  CHECK(contains(bar_fault(bar("beam", 4, ends, R"(, "points": {"ground": 1})")),
                 "reserved for the fixed frame"));
  CHECK(contains(bar_fault(bar("beam", 4, ends, R"(, "points": {"p": 1}, "width": 1)")),
                 "next to \"width\" and \"height\", which stand in its place"));
  CHECK(contains(bar_fault(bar("beam", 400, ends, points)), "800 rows without \"highest_frequency\""));
  CHECK(contains(bar_fault(bar("beam", 4, ends, points) + ", " + bar("rod", 4, ends, points)),
                 "/structure/rod: found the key \"rod\" next to \"beam\", must be one of them"));
  std::string huge = bar("beam", 4, ends, points);
  huge.replace(huge.find("\"young\": 40"), 11, "\"young\": 1e308");
  huge.replace(huge.find("\"inertia\": 0.25"), 15, "\"inertia\": 1e9");
  CHECK(contains(bar_fault(huge), "whose products overflow"));
}
