#pragma once
// Scenes for tests, and single responses of them.

#include "catalogue.hpp"
#include "controls.hpp"
#include "environment.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace scenes {

using namespace arcslip;

inline constexpr double hertz = 2 * std::numbers::pi;

/// folder: of the files that it names.
inline scene::Scene parse(const std::string& text, const std::string& folder = {}) {
  std::istringstream in(text);
  return scene::read(in, test_catalogue::whole(), folder);
}

struct Oscillator {
  const char* dof;
  double mass, stiffness, damping;
};

/// A section "structure" of oscillators that nothing couples: masses m_DOF, springs k_DOF, dampers c_DOF.
inline std::string uncoupled(const std::vector<Oscillator>& oscillators) {
  std::ostringstream dofs, masses, springs, dampers;
  const char* comma = "";
  for (const Oscillator& each : oscillators) {
    const auto part = [&](const char* letter, double value) {
      std::ostringstream text;
      text << comma << R"({"name": ")" << letter << "_" << each.dof << R"(", "at": ")" << each.dof
           << R"(", "value": )" << value << "}";
      return text.str();
    };
    dofs << comma << '"' << each.dof << '"';
    masses << part("m", each.mass);
    springs << part("k", each.stiffness);
    dampers << part("c", each.damping);
    comma = ", ";
  }
  return R"("structure": {"dofs": [)" + dofs.str() + R"(], "masses": [)" + masses.str() +
         R"(], "springs": [)" + springs.str() + R"(], "dampers": [)" + dampers.str() + "]}";
}

/// The window of the scene's first study, one of frequency responses.
inline observables::FrequencyRange& window(scene::Scene& s) {
  return s.studies.front().settings.as<observables::FrequencyRange>();
}
inline const observables::FrequencyRange& window(const scene::Scene& s) {
  return s.studies.front().settings.as<observables::FrequencyRange>();
}

inline scene::Scene example(const std::string& name) {
  return scene::read_file(source_folder() + "/examples/" + name + "/scene.json", test_catalogue::whole());
}

/// Fields with one value, which a new constant sets.
inline void tie(scene::Scene& s, const std::string& name, const std::vector<std::string>& fields) {
  s.constants.push_back({.name = name,
                         .value = scene::value(s, fields.front()),
                         .lower = -scene::infinity,
                         .upper = scene::infinity});
  for (const std::string& field : fields) scene::set_text(s, field, name);
}

/// The paper's oscillator with one load.
inline scene::Scene paper(int order, double load = 3) {
  scene::Scene s = example("al_sayed_2011");
  s.harmonics.order = order;
  s.studies.front().for_each.clear();
  scene::set(s, "damper.normal_load", load);
  return s;
}

/// Three masses, one of them seen by no element, friction to ground and between masses, a cubic spring along
/// a general direction, forces in two harmonics and, if `even`, in the second.
inline scene::Scene chain(int order, bool even) {
  return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "c"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1.5},
                 {"name": "mc", "at": "c", "value": 0.7}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 0.8},
                  {"name": "kbc", "between": ["b", "c"], "value": 1.2}, {"name": "kc", "at": "c", "value": 0.5}],
      "dampers": [{"name": "ca", "at": "a", "value": 0.03}, {"name": "cbc", "between": ["b", "c"], "value": 0.02}]},
    "elements": [
      {"name": "d1", "type": "jenkins", "at": "a", "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 0.9},
      {"name": "d2", "type": "jenkins", "between": ["a", "b"], "stiffness": 0.3, "friction_coefficient": 0.5,
       "normal_load": 0.5},
      {"name": "s", "type": "cubic_spring", "direction": {"a": 0.5, "b": -1}, "stiffness": 0.2}],
    "excitation": [{"name": "f", "at": "c", "cosine": 1, "sine": 0.3},
                   {"name": "g", "at": "b", "harmonic": )" +
               std::string(even ? "2" : "3") + R"(, "cosine": 0.2}],
    "harmonics": {"order": )" +
               std::to_string(order) + R"(},
    "response": {"at": "c"},
    "studies": [{"kind": "frf", "from": 0.3, "to": 2.2}]})");
}

/// m = k = 1, c = 0.02, a cubic spring of 0.5, and a Jenkins element with k_d = mu = 0.5, forced by 0.5.
inline scene::Scene duffing_jenkins(int order = 1) {
  scene::Scene s = parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.02}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 0.5},
      {"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.5, "friction_coefficient": 0.5, "normal_load": 0.8}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.5}], "response": {"at": "x"},
    "studies": [{"kind": "frf", "from": 0.2, "to": 3}]})");
  s.harmonics.order = order;
  return s;
}

/// The frequency responses of a scene in its window, for each combination of the lists.
inline std::vector<observables::ResponseBranch> frequency_responses(const scene::Scene& s,
                                                                    const scene::ValueLists& lists,
                                                                    const control::Control& control = {}) {
  const auto compute = [](const studies::Case& at, const control::Control& of_case) {
    return observables::frequency_response(at.scene, window(at.scene), of_case);
  };
  return studies::for_each<observables::ResponseBranch>(s, lists, compute, control);
}

/// The response at one frequency, in the scene's unit.
inline observables::ResponsePoint response_at(scene::Scene s, double frequency) {
  const auto branches = observables::frequency_response(
      s, {frequency, 1.001 * frequency},
      controls::reporting([](const control::Progress& progress) { return progress.points < 1; }));
  if (branches.front().points.empty()) throw std::runtime_error(branches.front().stop.message);
  return branches.front().points.front();
}

}  // namespace scenes
