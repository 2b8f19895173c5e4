// Studies in four threads, built with the thread sanitizer: it ends the program at the first race. Their
// results are those of one thread.

#include "catch.hpp"

#include <arcslip/optimize/studies.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <sstream>
#include <string>

using namespace arcslip;

namespace {

// Combinations, load cases of an optimum, curves, and the elements of one response.
constexpr const char* text = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["a", "b", "c"],
    "masses": [{"name": "m1", "at": "a", "value": 1}, {"name": "m2", "at": "b", "value": 0.8},
               {"name": "m3", "at": "c", "value": 0.5}],
    "springs": [{"name": "k1", "at": "a", "value": 1}, {"name": "k2", "between": ["a", "b"], "value": 2},
                {"name": "k3", "between": ["b", "c"], "value": 1.5}],
    "dampers": [{"name": "c1", "at": "a", "value": 0.05}, {"name": "c3", "between": ["b", "c"], "value": 0.02}]},
  "elements": [
    {"name": "d1", "type": "jenkins", "at": "a", "stiffness": 0.5, "friction_coefficient": 0.4, "normal_load": 1},
    {"name": "d2", "type": "jenkins", "between": ["a", "b"], "stiffness": 0.6, "friction_coefficient": 0.3,
     "normal_load": 0.7},
    {"name": "s", "type": "cubic_spring", "at": "c", "stiffness": 0.01}],
  "excitation": [{"name": "f", "at": "c", "cosine": 0.6}], "harmonics": {"order": 3}, "response": {"at": "c"},
  "studies": [
    {"name": "frf", "kind": "frf", "from": 0.3, "to": 1.2, "stability": true,
     "for_each": {"d1.normal_load": [0.2, 0.5, 1, 2, 4, 8]}},
    {"name": "one", "kind": "frf", "from": 0.3, "to": 1.2},
    {"name": "peaks", "kind": "peaks", "over": "d1.normal_load", "from": 0.5, "to": 5, "frequency": [0.3, 1.2]},
    {"name": "time", "kind": "time", "frequency": 0.7, "for_each": {"f.cosine": [0.2, 0.4, 0.6, 0.8]}},
    {"name": "best", "kind": "optimum", "over": ["d1.normal_load", "d2.normal_load"],
     "bounds": [[0.2, 8], [0.2, 8]], "frequency": [0.3, 1.2],
     "cases": [{"set": {"f.cosine": 0.6}}, {"set": {"f.cosine": 0.9}, "weight": 0.6}]}]})";

std::string tables(const scene::Scene& scene, const char* study, int threads) {
  scene::Scene one = scene;
  std::erase_if(one.studies, [&](const scene::Study& each) { return each.name != study; });
  const results::Results results = studies::run(one, {.threads = threads});
  std::ostringstream out;
  for (const std::string& table : results::table_keys(results.schemas))
    results::write_csv(out, results, table);
  return out.str();
}

}  // namespace

TEST_CASE("studies in four threads have no race, and the results of one thread") {
  scene::Catalogue catalogue = studies::catalogue();
  optimize::add_studies(catalogue);
  std::istringstream in(text);
  const scene::Scene scene = scene::read(in, catalogue);
  for (const char* study : {"frf", "one", "peaks", "time", "best"}) {
    CAPTURE(study);
    const std::string alone = tables(scene, study, 1);
    CHECK(alone.size() > 100);
    CHECK(tables(scene, study, 4) == alone);
  }
}
