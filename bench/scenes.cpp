#include "scenes.hpp"

#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace arcslip::bench {
namespace {

// The scene of a file with other words in place of one that it has.
scene::Scene with(const std::string& file, const std::string& word, const std::string& instead) {
  std::ifstream in("examples/" + file);
  std::ostringstream all;
  all << in.rdbuf();
  std::string text = all.str();
  if (text.find(word) == std::string::npos) throw std::runtime_error(file + " has no " + word);
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += instead.size())
    text.replace(at, word.size(), instead);
  std::istringstream scene(text);
  return scene::read(scene, catalogue());
}

}  // namespace

scene::Scene chain(int n, int contacts) {
  scene::Scene s;
  s.frequency_unit = scene::FrequencyUnit::radian_per_second;
  const double k = 4.0 * n * n / (std::numbers::pi * std::numbers::pi);
  for (int i = 0; i < n; ++i) {
    const std::string name = std::to_string(i);
    s.dofs.push_back("x" + name);
    const scene::Direction along =
        i > 0 ? scene::Direction{{i, 1.0}, {i - 1, -1.0}} : scene::Direction{{i, 1.0}};
    s.masses.push_back({"m" + name, &scene::mass_type(), {{{i, 1.0}}}, {1.0}});
    s.springs.push_back({"k" + name, &scene::spring_type(), {along}, {k}});
    s.dampers.push_back({"c" + name, &scene::damper_type(), {along}, {0.02 * k}});
  }
  for (int i = 1; i <= contacts; ++i)
    s.elements.push_back({"d" + std::to_string(i),
                          &elements::jenkins(),
                          {{{i * n / contacts - 1, 1.0}}},
                          {0.1 * n / contacts, 0.5, 2.0 / contacts}});
  s.excitation.push_back({"f", &scene::force_type(), {{{n / 2, 1.0}}}, {1.0, 0.0}});
  s.harmonics.order = 7;
  s.response() = {{n - 1, 1.0}};
  return s;
}

scene::Scene damped_chain() {
  std::istringstream text(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": [{"repeat": 6, "name": "x{i}"}],
      "masses": [{"repeat": 6, "name": "m{i}", "at": "x{i}", "value": 1}],
      "springs": [{"name": "k0", "at": "x1", "value": 1},
                  {"repeat": 5, "name": "k{i}", "between": ["x{i}", "x{i+1}"], "value": 1}],
      "dampers": [{"repeat": 6, "name": "c{i}", "at": "x{i}", "value": 0.01}]},
    "elements": [
      {"name": "d0", "type": "jenkins", "at": "x1", "stiffness": 0.5, "friction_coefficient": 0.5, "normal_load": 0.2},
      {"repeat": 5, "name": "d{i}", "type": "jenkins", "between": ["x{i}", "x{i+1}"],
       "stiffness": 0.5, "friction_coefficient": 0.5, "normal_load": 0.2}],
    "excitation": [{"name": "force", "at": "x6", "cosine": 0.1}], "response": {"at": "x6"},
    "harmonics": {"order": 7}})");
  return scene::read(text, catalogue());
}

scene::Scene rubbing_masses(int n) {
  const std::string repeat = R"("repeat": {"count": )" + std::to_string(n) + R"(, "cyclic": true}, )";
  std::string dofs, masses, springs;
  for (const std::string axis : {"x", "y", "z"}) {
    dofs += (dofs.empty() ? "" : ", ") + ("{" + repeat + R"("name": ")" + axis + R"({i}"})");
    masses += (masses.empty() ? "" : ", ") +
              ("{" + repeat + R"("name": "m)" + axis + R"({i}", "at": ")" + axis + R"({i}", "value": 1})");
    springs += "{" + repeat + R"("name": "k)" + axis + R"({i}", "at": ")" + axis + R"({i}", "value": 1}, )";
  }
  std::istringstream text(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": [)" +
                          dofs + R"(], "masses": [)" + masses + R"(],
      "springs": [)" + springs +
                          "{" + repeat +
                          R"("name": "link{i}", "between": ["x{i}", "x{i+1}"], "value": 0.05}],
      "damping": [{"name": "r", "type": "rayleigh", "alpha": 0.02, "beta": 0.02}]},
    "elements": [{)" + repeat +
                          R"("name": "c{i}", "type": "contact_3d", "tangential_1": {"at": "x{i}"},
      "tangential_2": {"at": "y{i}"}, "normal": {"at": "z{i}"}, "tangential_stiffness": 0.5,
      "normal_stiffness": 0.5, "friction_coefficient": 0.3, "normal_load": 0.4}],
    "excitation": [{"name": "f", "at": "x1", "cosine": 1.2}, {"name": "g", "at": "y2", "sine": 1},
                   {"name": "h", "at": "z2", "cosine": 0.5}],
    "harmonics": {"order": 5}, "response": {"at": "x1"}, "studies": [{"kind": "frf", "from": 0.95, "to": 1.05}]})");
  return scene::read(text, catalogue());
}

scene::Scene beam(int n) {
  return with("cantilever/beam.json", R"("elements": 40)", R"("elements": )" + std::to_string(n));
}

scene::Scene ring(int n) {
  scene::Scene scene = with("bladed_ring/scene.json", "12", std::to_string(n));
  if (scene.dofs.size() != static_cast<std::size_t>(n) || scene.elements.size() != scene.dofs.size())
    throw std::runtime_error("examples/bladed_ring is written in another way");
  scene::set(scene, "load", 5);
  return scene;
}

}  // namespace arcslip::bench
