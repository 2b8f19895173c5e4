// A scene file, section by section, in the order of the format.
#include <arcslip/scene/checks.hpp>
#include <arcslip/scene/json_tree.hpp>
#include <arcslip/scene/read_parts.hpp>
#include <arcslip/scene/read_studies.hpp>
#include <arcslip/scene/read_text.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/scene_file.hpp>
#include <arcslip/scene/words.hpp>

namespace arcslip::scene {
namespace detail {
namespace {

void read_format(const Keys& keys, Faults& faults) {
  const std::string wanted = quoted(format_name);
  const Place place = keys.require("format", wanted, faults);
  const auto text = read_string(place, wanted, faults);
  if (text && *text != format_name) {
    faults.add(place.pointer, "found " + shown(*text) + ", must be " + wanted);
  }
}

Harmonics read_harmonics(const Place& place, Faults& faults) {
  Harmonics harmonics;
  if (place.node != nullptr) {
    const Keys keys(place, {"order", "friction", "samples"}, faults);
    harmonics.order = read_integer(keys.find("order"), 1, largest_order, faults).value_or(harmonics.order);
    harmonics.friction = read_choice(keys.find("friction"), friction_methods, harmonics.friction, faults);
    harmonics.samples = read_integer(keys.find("samples"), 1, largest_samples, faults,
                                     ", and at least 4*order + 4 where it is used")
                            .value_or(harmonics.samples);
  }
  return harmonics;
}

Direction read_response(const Place& place, const Dofs& dofs, Faults& faults) {
  if (place.node != nullptr) {
    const Keys keys(place, {"at", "between", "direction"}, faults);
    return read_direction(keys, dofs, faults).value_or(Direction{});
  }
  if (dofs.complete && dofs.names.size() != 1) {
    faults.add(
        place.pointer,
        "found no key \"response\", which is required where there are several degrees of freedom: must be an "
        "object with one of \"at\", \"between\", \"direction\"");
  }
  return {{0, 1.0}};
}

std::vector<Part> read_excitation(const Keys& root, const Dofs& dofs, Names& names, Faults& faults) {
  constexpr const char* wanted = "a list of at least one force";
  const Place place = root.require("excitation", wanted, faults);
  std::vector<Part> forces = read_parts(place, &force_type, dofs, names, faults);
  if (place.node != nullptr && place.node->get<Node::List>() != nullptr && forces.empty()) {
    faults.add(place.pointer, std::string("found an empty list, must be ") + wanted);
  }
  return forces;
}

Scene read_scene(const Node& node, Faults& faults) {
  Scene scene;
  const Keys root({&node, ""},
                  {"format", "title", "frequency_unit", "structure", "elements", "excitation", "ties",
                   "harmonics", "response", "studies"},
                  faults);
  if (!root.is_object()) {
    return scene;
  }
  // Faults up to a section: a check that needs sound sections waits until they are.
  const auto is_sound = [&faults](std::size_t before) { return faults.count() == before; };

  read_format(root, faults);
  scene.title = read_string(root.find("title"), "a string", faults).value_or(scene.title);
  scene.frequency_unit =
      read_choice(root.find("frequency_unit"), frequency_units, scene.frequency_unit, faults);

  const std::size_t before_parts = faults.count();
  Names names;
  const Place structure_place = root.require("structure", "an object with the degrees of freedom", faults);
  const Keys structure(structure_place, {"dofs", "masses", "springs", "dampers"}, faults);
  if (!structure.is_object()) {
    names.set_incomplete();
  }
  const Dofs dofs = read_dofs(structure.require("dofs", "a list of at least one name", faults), faults);
  scene.dofs = dofs.names;
  scene.masses = read_parts(structure.find("masses"), &mass_type, dofs, names, faults);
  scene.springs = read_parts(structure.find("springs"), &spring_type, dofs, names, faults);
  scene.dampers = read_parts(structure.find("dampers"), &damper_type, dofs, names, faults);
  scene.elements = read_parts(root.find("elements"), nullptr, dofs, names, faults);
  if (is_sound(before_parts)) {
    check_structure(scene, faults);
  }

  const std::size_t before_excitation = faults.count();
  scene.excitation = read_excitation(root, dofs, names, faults);
  const bool excitation_sound = is_sound(before_excitation);

  const std::size_t before_ties = faults.count();
  scene.ties = read_ties(root.find("ties"), names, faults);
  const bool ties_sound = is_sound(before_ties);
  if (is_sound(before_parts)) {
    check_ties(scene, faults);
  }

  const std::size_t before_harmonics = faults.count();
  scene.harmonics = read_harmonics(root.find("harmonics"), faults);
  if (is_sound(before_harmonics)) {
    check_samples(scene, faults);
    if (excitation_sound) {
      check_excitation(scene, faults);
    }
  }

  scene.response = read_response(root.find("response"), dofs, faults);
  scene.studies = read_studies(root.find("studies"), scene.frequency_unit,
                               Parameters(scene.ties, ties_sound, names), dofs, faults);
  return scene;
}

Scene read_text_of_scene(const std::string& text, const StopRequest& stop) {
  const Node root = read_tree(text, stop);
  Faults faults;
  Scene scene = read_scene(root, faults);
  faults.raise();
  return scene;
}

}  // namespace
}  // namespace detail

Scene read(std::istream& in) {
  return detail::read_text_of_scene(detail::read_text(in), {});
}

Scene read_file(const std::string& path) {
  return read_file(path, {});
}

Scene read_file(const std::string& path, const StopRequest& stop) {
  return detail::read_text_of_scene(detail::read_text(path, stop), stop);
}

void check(const Scene& scene) {
  detail::read_text_of_scene(write(scene), {});
}

}  // namespace arcslip::scene
