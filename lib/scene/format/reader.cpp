// A scene file, section by section, in the order of the format.
#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/consistency.hpp>
#include <arcslip/scene/files/manifest.hpp>
#include <arcslip/scene/format/constants.hpp>
#include <arcslip/scene/format/repeat.hpp>
#include <arcslip/scene/format/ring.hpp>
#include <arcslip/scene/format/scene_file.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/keys/natural_frequency.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/read_text.hpp>
#include <arcslip/scene/keys/section_keys.hpp>
#include <arcslip/scene/patch.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/shape.hpp>
#include <arcslip/scene/study_type.hpp>

#include <algorithm>
#include <filesystem>

namespace arcslip::scene {
namespace file {
namespace {

void read_format(const Keys& keys, Faults& faults) {
  const std::string wanted = quoted(format_name);
  const Location place = keys.require("format", wanted, faults);
  const auto text = read_string(place, wanted, faults);
  if (!text || *text == first_format_name) return;
  if (*text != format_name)
    faults.add(place.pointer,
               "found " + shown(*text) + ", must be " + wanted + " or " + quoted(first_format_name));
  if (const Location ties = keys.find("ties"); ties.node != nullptr)
    faults.add(ties.pointer,
               "found \"ties\", which belongs to format " + quoted(first_format_name) +
                   "; must be a constant, {\"constants\": {\"load\": 3}}, that takes the place of "
                   "the number in each field: \"normal_load\": \"load\"");
}

constexpr std::string_view wanted_response =
    "an object with one of \"at\", \"between\", \"direction\", or a list of such objects with names";

// The keys of a response next to its name.
void read_places(const Keys& keys, const Dofs& dofs, Response& response, Faults& faults) {
  response.frame = read_choice(keys.find("frame"), frames, response.frame, faults);
  const Location places = keys.find("max_of");
  if (places.node == nullptr) {
    response.direction = read_direction(keys, dofs, faults).value_or(Direction{});
    return;
  }
  for (const std::string_view key : {"at", "between", "direction"})
    if (keys.has(key))
      faults.add(keys.pointer(), "found \"max_of\" and " + shown(key) + " together, must have one of them");
  const auto* list = places.node->get<Node::List>();
  if (list == nullptr || list->empty()) {
    constexpr const char* wanted =
        "a list of at least one place, such as [{\"at\": \"a\"}, {\"between\": [\"a\", \"b\"]}]";
    if (list == nullptr)
      add_wrong_type(places, wanted, faults);
    else
      faults.add(places.pointer, std::string("found an empty list, must be ") + wanted);
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Keys place({&(*list)[i], child(places.pointer, i)}, {"at", "between", "direction"}, faults);
    const Direction direction = read_direction(place, dofs, faults).value_or(Direction{});
    if (i == 0)
      response.direction = direction;
    else
      response.others.push_back(direction);
  }
}

Response read_named_response(const Location& place, const Dofs& dofs, const std::vector<Response>& before,
                             Faults& faults) {
  constexpr const char* wanted = "a string, the name of the response";
  const Keys keys(place, {"name", "at", "between", "direction", "max_of", "frame"}, faults);
  Response response;
  if (!keys.is_object()) return response;
  const Location name = keys.require("name", wanted, faults);
  if (const auto text = read_string(name, wanted, faults)) {
    response.name = *text;
    if (const std::string reason = objection(*text); !reason.empty()) {
      faults.add(name.pointer, "found " + shown(*text) + ", " + reason);
    } else if (std::any_of(before.begin(), before.end(),
                           [&](const Response& other) { return other.name == *text; })) {
      faults.add(name.pointer,
                 "found the name " + shown(*text) + " again; responses must have different names");
    }
  }
  read_places(keys, dofs, response, faults);
  return response;
}

std::vector<Response> read_responses(const Location& place, const Dofs& dofs, Faults& faults) {
  if (place.node == nullptr) {
    if (dofs.complete && dofs.names.size() != 1) {
      faults.add(place.pointer,
                 "found no key \"response\", which is required where there are several degrees of freedom: "
                 "must be " +
                     std::string(wanted_response));
    }
    return {{.direction = {{0, 1.0}}}};
  }
  if (place.node->get<Node::List>() == nullptr && place.node->get<Node::Object>() == nullptr) {
    add_wrong_type(place, wanted_response, faults);
    return std::vector<Response>(1);
  }
  if (place.node->get<Node::List>() == nullptr) {
    const Keys keys(place, {"at", "between", "direction", "max_of", "frame"}, faults);
    std::vector<Response> one(1);
    read_places(keys, dofs, one.front(), faults);
    return one;
  }
  std::vector<Response> responses;
  const Node::List& list = *place.node->get<Node::List>();
  for (std::size_t i = 0; i < list.size(); ++i)
    responses.push_back(read_named_response({&list[i], child(place.pointer, i)}, dofs, responses, faults));
  if (responses.empty()) {
    faults.add(place.pointer, "found an empty list, must be " + std::string(wanted_response));
    responses.emplace_back();
  }
  return responses;
}

std::vector<Part> read_excitation(const Keys& root, const Dofs& dofs, const FileSource& source, Names& names,
                                  Faults& faults) {
  constexpr const char* wanted = "a list of at least one force or motion of the ground";
  const Location place = root.require("excitation", wanted, faults);
  std::vector<Part> excitation =
      read_parts(place, &force_type(), excitation_types(), dofs, source, names, faults);
  if (place.node != nullptr && place.node->get<Node::List>() != nullptr && excitation.empty())
    faults.add(place.pointer, std::string("found an empty list, must be ") + wanted);
  return excitation;
}

// The same place with another value, if it has one.
Location in_place(Location place, const Node& value) {
  if (place.node != nullptr) place.node = &value;
  return place;
}

// All numbers are known from here on.
void resolve_numbers(Scene& scene, const Names& names, bool parts_sound, Faults& faults) {
  const std::size_t before = faults.count();
  resolve_formulas(scene, names, &faults);
  if (parts_sound && faults.count() == before) check_structure(scene, faults);
}

// Springs and dampers that are given by natural frequencies and damping ratios have the values of these.
void read_springs_and_dampers(const Keys& structure, const Dofs& dofs, const FileSource& source, bool sound,
                              Scene& scene, Names& names, Faults& faults) {
  const auto rows = static_cast<int>(scene.matrices ? scene.matrices->named() : 0);
  const Location springs = structure.find("springs"), dampers = structure.find("dampers");
  const std::size_t before = faults.count();
  const auto is_sound = [&] { return sound && faults.count() == before; };
  resolve_formulas(scene, names, nullptr);
  const Node with_values = with_stiffnesses(springs, {dofs, rows, scene.masses, scene.springs, is_sound()},
                                            scene.frequency_unit, faults);
  scene.springs = read_parts(in_place(springs, with_values), &spring_type(), {}, dofs, source, names, faults);
  resolve_formulas(scene, names, nullptr);
  const Node with_damping =
      with_dampings(dampers, {dofs, rows, scene.masses, scene.springs, is_sound()}, faults);
  scene.dampers =
      read_parts(in_place(dampers, with_damping), &damper_type(), {}, dofs, source, names, faults);
}

Scene read_scene(const Node& node, const Ring& ring, const Catalogue& catalogue, const FileSource& source,
                 Faults& faults) {
  Scene scene;
  const Keys root({&node, ""},
                  {"format", "title", "frequency_unit", "structure", "elements", "patches", "excitation",
                   "constants", "ties", "labels", "harmonics", "response", "studies", "$schema"},
                  faults);
  if (!root.is_object()) return scene;
  // Faults up to a section: a check that needs sound sections waits until they are.
  const auto is_sound = [&faults](std::size_t before) { return faults.count() == before; };

  read_format(root, faults);
  scene.title = read_string(root.find("title"), "a string", faults).value_or(scene.title);
  scene.frequency_unit =
      read_choice(root.find("frequency_unit"), frequency_units, scene.frequency_unit, faults);

  const std::size_t before_parts = faults.count();
  Names names;
  scene.constants = read_constants(root.find("constants"), names, faults);
  const bool constants_read = is_sound(before_parts);
  const Location structure_place = root.require("structure", "an object with the degrees of freedom", faults);
  const Keys structure(structure_place,
                       {"dofs", "masses", "springs", "dampers", "damping", "rotation", "matrices", "names",
                        "beam", "rod", "cyclic"},
                       faults);
  if (!structure.is_object()) names.set_incomplete();
  Dofs dofs;
  scene.cyclic = read_cyclic(structure.find("cyclic"), faults);
  dofs.have_next = structure.has("cyclic");
  scene.matrices = read_matrices(structure, scene.frequency_unit, source, dofs, faults);
  if (!structure.has("matrices") && !structure.has("beam") && !structure.has("rod"))
    read_dofs(structure.require("dofs", "a list of at least one name", faults), dofs, faults);
  else if (structure.has("dofs"))
    read_dofs(structure.find("dofs"), dofs, faults);
  scene.dofs = dofs.names;
  scene.masses = read_parts(structure.find("masses"), &mass_type(), {}, dofs, source, names, faults);
  read_springs_and_dampers(structure, dofs, source, is_sound(before_parts), scene, names, faults);
  scene.damping =
      read_parts(structure.find("damping"), nullptr, damping_types(), dofs, source, names, faults);
  scene.rotation = read_one(structure.find("rotation"), rotation_type(), dofs, source, names, faults);
  std::vector<const PartType*> laws;
  for (const auto& law : catalogue.elements) laws.push_back(law.get());
  scene.elements = read_parts(root.find("elements"), nullptr, laws, dofs, source, names, faults);
  scene.patches = read_patches(root.find("patches"), laws, dofs, source, names, faults);
  const bool parts_sound = is_sound(before_parts);

  dofs.have_next = false;
  const std::size_t before_excitation = faults.count();
  scene.excitation = read_excitation(root, dofs, source, names, faults);
  const bool excitation_sound = is_sound(before_excitation);

  const std::size_t before_ties = faults.count();
  read_ties(root.find("ties"), names, scene, faults);
  const bool constants_sound = constants_read && is_sound(before_ties);
  if (is_sound(before_parts)) tie_sectors(ring, scene);
  resolve_numbers(scene, names, parts_sound, faults);

  const std::size_t before_harmonics = faults.count();
  scene.harmonics = read_section(root.find("harmonics"), harmonics_keys(), any_number, source, dofs, faults)
                        .as<Harmonics>();
  if (is_sound(before_harmonics)) {
    check_samples(scene, faults);
    if (scene.cyclic) check_cyclic(scene, faults);
    if (excitation_sound) check_excitation(scene, faults);
  }

  scene.responses = read_responses(root.find("response"), dofs, faults);
  if (excitation_sound) check_frames(scene, faults);
  const Parameters parameters{scene, constants_sound, names};
  scene.labels = read_labels(root.find("labels"), parameters, faults);
  scene.studies =
      read_studies(root.find("studies"), scene.frequency_unit, parameters, dofs, source, catalogue, faults);
  return scene;
}

Scene read_scene(Node root, const Catalogue& catalogue, const FileSource& source) {
  Faults faults;
  Origins origins = repeat(root, faults);
  faults.raise();  // names of what was not repeated would be missing everywhere
  faults.set_origins(origins);
  const Ring ring = write_out_ring(root, source, origins, faults);
  faults.raise();
  faults.set_origins(std::move(origins));
  Scene scene = read_scene(root, ring, catalogue, source, faults);
  scene.folder = source.folder;
  faults.raise();
  return scene;
}

// What has been read of a scene before.
FileSource source_of(Scene scene) {
  FileSource source{scene.folder};
  for (const NamedFile* file : files(scene)) source.read.push_back(*file);
  const auto know = [&](const MatrixFile& of) {
    if (of.file.text) source.matrices.push_back({of.file.text, of.variable, of.matrix});
  };
  for (const Part& part : scene.excitation)
    if (const Shape* shape = shape_of(part)) {
      know(shape->real.from);
      know(shape->imaginary.from);
    }
  if (!scene.matrices) return source;
  source.derived = scene.matrices->derived;
  const Matrices& own = *scene.matrices;
  for (const MatrixFile* of : {&own.stiffness, &own.mass, &own.damping, &own.stiffness_speed_squared,
                               &own.gyroscopic, &own.circulatory})
    know(*of);
  return source;
}

// What the scene itself has, for reading it again: it keeps the types alive meanwhile.
Catalogue catalogue_of(const Scene& scene) {
  Catalogue catalogue;
  const auto add_law = [&](const PartType* law) {
    if (catalogue.element(law->name()) == nullptr) catalogue.elements.push_back(lasting(*law));
  };
  for (const Part& part : scene.elements) add_law(part.type);
  for (const Part& patch : scene.patches) add_law(patch.options.as<PatchOptions>().law);
  for (const Study& study : scene.studies)
    if (catalogue.study(study.type->name()) == nullptr) catalogue.studies.push_back(lasting(*study.type));
  return catalogue;
}

}  // namespace
}  // namespace file

Scene read(std::istream& in, const Catalogue& catalogue, const std::string& folder) {
  Scene scene = file::read_scene(file::read_tree(file::read_text(in)), catalogue, {{folder}, {}});
  scene.catalogue.all = std::make_shared<const Catalogue>(catalogue);
  return scene;
}

Scene read(std::string_view text, const Catalogue& catalogue, const std::string& folder,
           std::vector<NamedFile> known, const control::Control& control) {
  Scene scene =
      file::read_scene(file::read_tree(text, control), catalogue, {{folder}, control, std::move(known)});
  scene.catalogue.all = std::make_shared<const Catalogue>(catalogue);
  return scene;
}

Scene read_file(const std::string& path, const Catalogue& catalogue) {
  return read_file(path, catalogue, {});
}

Scene read_file(const std::string& path, const Catalogue& catalogue, const control::Control& control) {
  Scene scene = file::read_scene(file::read_tree(file::read_text(path, control), control), catalogue,
                                 {{std::filesystem::path(path).parent_path().string()}, control});
  scene.catalogue.all = std::make_shared<const Catalogue>(catalogue);
  const ManifestDoubts doubts = manifest_doubts(scene, path);
  if (!doubts.interrupted.empty()) throw SceneError({{"", doubts.interrupted.front()}});
  return scene;
}

void check(const Scene& scene) {
  file::Faults faults;
  for (std::size_t i = 0; i < scene.elements.size(); ++i) {
    const Part& part = scene.elements[i];
    if (part.type == nullptr) {
      faults.add(file::child("/elements", i), "found no type, must be a law of force");
    } else if (part.directions.size() != part.type->direction_count(part.options)) {
      faults.add(file::child("/elements", i), "found " + std::to_string(part.directions.size()) +
                                                  " directions, must be " +
                                                  std::to_string(part.type->direction_count(part.options)) +
                                                  " for the type " + file::shown(part.type->name()));
    } else if (part.values.size() != part.fields().size()) {
      faults.add(file::child("/elements", i), "found " + std::to_string(part.values.size()) +
                                                  " values, must be " + std::to_string(part.fields().size()) +
                                                  " for the type " + file::shown(part.type->name()));
    }
  }
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    const Part& patch = scene.patches[i];
    if (patch.type != &patch_type() || patch.options.empty() ||
        patch.options.as<PatchOptions>().law == nullptr)
      faults.add(file::child("/patches", i), "found no law, must be a patch of contacts with one");
    else if (patch.values.size() != patch.fields().size())
      faults.add(file::child("/patches", i), "found " + std::to_string(patch.values.size()) +
                                                 " values, must be " + std::to_string(patch.fields().size()));
  }
  for (std::size_t i = 0; i < scene.studies.size(); ++i)
    if (scene.studies[i].type == nullptr)
      faults.add(file::child("/studies", i), "found no kind, must be a study of some kind");
  faults.raise();
  file::read_scene(file::tree(scene), file::catalogue_of(scene), file::source_of(scene));
}

Scene with_keys(const Scene& scene, std::size_t study, const std::vector<file::Member>& keys) {
  file::Node root = file::tree(scene);
  for (file::Member& section : std::get<file::Node::Object>(root.value)) {
    if (section.key != "studies") continue;
    auto& studies = std::get<file::Node::List>(section.value.value);
    auto& object = std::get<file::Node::Object>(studies[study].value);
    for (const file::Member& key : keys) {
      const auto own = std::find_if(object.begin(), object.end(),
                                    [&](const file::Member& member) { return member.key == key.key; });
      if (key.value.get<std::nullptr_t>() != nullptr)
        object.erase(own, own == object.end() ? own : own + 1);
      else if (own != object.end())
        own->value = key.value;
      else
        object.push_back(key);
    }
  }
  Scene changed = file::read_scene(std::move(root), file::catalogue_of(scene), file::source_of(scene));
  changed.catalogue = scene.catalogue;
  return changed;
}

}  // namespace arcslip::scene
