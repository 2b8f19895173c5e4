// Elements shared among threads.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <string>

using namespace arcslip;

namespace {

// Masses on two springs each, each rubbing on a plane of its own, coupled in a row.
scene::Scene rubbing(int masses) {
  std::string dofs, springs, elements, list;
  const auto add = [](std::string& to, const std::string& what) { to += (to.empty() ? "" : ", ") + what; };
  for (int i = 0; i < masses; ++i) {
    const std::string n = std::to_string(i), next = std::to_string((i + 1) % masses);
    for (const std::string axis : {"x", "y", "z"}) {
      add(dofs, "\"" + axis + n + "\"");
      add(list, R"({"name": "m)" + axis + n + R"(", "at": ")" + axis + n + R"(", "value": 1})");
      add(springs, R"({"name": "k)" + axis + n + R"(", "at": ")" + axis + n + R"(", "value": )" +
                       std::to_string(1 + 0.1 * i) + "}");
    }
    add(springs,
        R"({"name": "l)" + n + R"(", "between": ["x)" + n + R"(", "x)" + next + R"("], "value": 0.05})");
    add(elements,
        R"({"name": "c)" + n + R"(", "type": "contact_3d",
      "tangential_1": {"at": "x)" +
            n + R"("}, "tangential_2": {"at": "y)" + n + R"("}, "normal": {"at": "z)" + n +
            R"("}, "tangential_stiffness": 0.5, "normal_stiffness": 0.5, "friction_coefficient": 0.3,
      "normal_load": 0.4})");
  }
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": [)" +
                       dofs + R"(], "masses": [)" + list + R"(], "springs": [)" + springs + R"(],
      "damping": [{"name": "r", "type": "rayleigh", "alpha": 0.02, "beta": 0.02}]},
    "elements": [)" + elements +
                       R"(],
    "excitation": [{"name": "f", "at": "x0", "cosine": 0.2}, {"name": "g", "at": "y1", "sine": 0.1},
                   {"name": "h", "at": "z1", "cosine": 0.3}],
    "harmonics": {"order": 3}, "response": {"at": "x0"}, "studies": [{"kind": "frf", "from": 0.9, "to": 1.1}]})");
}

}  // namespace

TEST_CASE("responses do not depend on the number of threads among which elements are shared") {
  scene::Scene s = rubbing(4);
  const auto one = observables::frequency_response(s, scenes::window(s));
  REQUIRE(one.front().points.size() > 10);
  for (const int threads : {2, 3, 16}) {
    CAPTURE(threads);
    s.threads.count = threads;
    const auto several = observables::frequency_response(s, scenes::window(s));
    REQUIRE(several.size() == one.size());
    REQUIRE(several.front().points.size() == one.front().points.size());
    for (std::size_t i = 0; i < one.front().points.size(); ++i) {
      CHECK(several.front().points[i].unknowns == one.front().points[i].unknowns);
      CHECK(several.front().points[i].amplitude == one.front().points[i].amplitude);
    }
  }
  CHECK(s == [&] {
    scene::Scene of_one = s;
    of_one.threads.count = 1;
    return of_one;
  }());
}
