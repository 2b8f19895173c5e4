// Scenes as values, and their studies with other keys.

#include "bindings.hpp"
#include "supervised.hpp"

#include <arcslip/scene/format/scene_file.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nb = nanobind;

namespace arcslip::python {
namespace {

using scene::Scene;
using scene::file::Member;
using scene::file::Node;

/// Calls read(control), which Ctrl-C ends.
template <class Read>
Scene read_supervised(const Read& read) {
  std::optional<Scene> scene;
  if (auto ended_by = supervised(nb::none(), [&](const control::Control& control) { scene = read(control); }))
    throw nb::python_error(std::move(*ended_by));
  return *std::move(scene);
}

Scene read_file(const std::string& path) {
  return read_supervised([&](const auto& control) { return scene::read_file(path, catalogue(), control); });
}

Scene read(const std::string& text, const std::string& folder, const nb::dict& files) {
  std::vector<scene::NamedFile> known;
  for (const auto& [path, content] : files) {
    const auto bytes = nb::cast<nb::bytes>(content);
    known.push_back(
        {nb::cast<std::string>(path), std::make_shared<const std::string>(bytes.c_str(), bytes.size())});
  }
  return read_supervised(
      [&](const auto& control) { return scene::read(text, catalogue(), folder, std::move(known), control); });
}

/// The content of the files that it names, by their paths.
nb::dict files(Scene scene) {
  nb::dict all;
  for (const scene::NamedFile* file : scene::files(scene))
    if (file->text) all[file->path.c_str()] = nb::bytes(file->text->data(), file->text->size());
  return all;
}

/// The text of the scene as a file in another folder. kept: paths that are relative to it already.
std::string write_in(const Scene& scene, const std::string& folder, const std::vector<std::string>& kept) {
  Scene there = scene::from_folder(scene, folder);
  Scene here = scene;
  const auto before = scene::files(here), after = scene::files(there);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (std::find(kept.begin(), kept.end(), before[i]->path) != kept.end()) after[i]->path = before[i]->path;
  return scene::write(there);
}

nb::list parameters(const Scene& scene) {
  nb::list all;
  for (const std::string& name : scene::parameter_names(scene)) {
    const scene::Field field = scene::parameter_field(scene, name);
    nb::dict each;
    each["name"] = name;
    each["value"] = scene::value(scene, name);
    each["unit"] = studies::parameter_unit(scene, name);
    each["lower"] = field.lower;
    each["upper"] = field.upper;
    each["lower_open"] = field.lower_open;
    each["help"] = std::string(field.help);
    const scene::NumberText* formula = scene::parameter_formula(scene, name);
    each["formula"] = formula != nullptr ? nb::cast(formula->text) : nb::none();
    all.append(each);
  }
  return all;
}

using Value = std::variant<double, std::string>;

Scene replace(const Scene& scene, const std::vector<std::pair<std::string, Value>>& values,
              std::optional<int> order, std::optional<double> accuracy) {
  Scene other = scene;
  for (const auto& [name, value] : values) {
    if (const auto* text = std::get_if<std::string>(&value))
      scene::set_text(other, name, *text);
    else
      scene::set(other, name, std::get<double>(value));
  }
  if (order || accuracy) {
    other.harmonics.accuracy = accuracy.value_or(0);
    other.harmonics.order = order.value_or(scene::largest_chosen_order);
  }
  scene::check(other);
  return other;
}

/// (name, kind) of each study.
std::vector<std::pair<std::string, std::string>> studies(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const scene::Study& study : scene.studies)
    all.emplace_back(study.name, std::string(study.type->name()));
  return all;
}

/// The parameters that keys name, which lists of values then do not set.
std::vector<std::string> named_parameters(const scene::StudyType& type, const std::vector<Member>& keys) {
  std::vector<std::string> names;
  const std::vector<scene::Key> known = type.keys();
  for (const Member& member : keys) {
    const auto key =
        std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.name == member.key; });
    if (key == known.end()) continue;
    using enum scene::KeyType;
    if (key->type != parameter && key->type != parameters && key->type != followed) continue;
    if (const auto* name = member.value.get<std::string>()) names.push_back(*name);
    if (const auto* list = member.value.get<Node::List>())
      for (const Node& each : *list)
        if (const auto* one = each.get<std::string>()) names.push_back(*one);
  }
  return names;
}

/// Adds a study of this type with its defaults, and its required keys as missing, where the keys do not have
/// them.
void add_study(const scene::StudyType& type, Scene& scene, std::vector<Member>& keys) {
  std::string name(type.verb());
  while (
      std::any_of(scene.studies.begin(), scene.studies.end(), [&](const auto& s) { return s.name == name; }))
    name += "_2";
  scene.studies.push_back({name, &type, type.settings().defaults(), {}});
  const auto is_given = [&](const std::string& key) {
    return std::any_of(keys.begin(), keys.end(), [&](const Member& member) { return member.key == key; });
  };
  for (const scene::Key& key : type.keys())
    if (key.required && !is_given(key.name)) keys.push_back({key.name, {nullptr}});
}

/// The scene with these keys, a JSON object, in the study with an index, or in a new one of a kind; and the
/// index.
std::pair<Scene, std::size_t> with_study(const Scene& scene, const std::string& kind,
                                         std::optional<std::size_t> index, const std::string& json) {
  const scene::StudyType* type = catalogue().study(kind);
  if (type == nullptr) throw nb::value_error(("unknown kind of study: " + kind).c_str());
  Node tree = scene::file::read_tree(json);
  auto* object = std::get_if<Node::Object>(&tree.value);
  if (object == nullptr) throw nb::value_error("keys must be a JSON object");
  std::vector<Member> keys = std::move(*object);
  if (index && *index >= scene.studies.size()) throw nb::index_error("no such study");
  Scene other = scene;
  if (!index) {
    index = other.studies.size();
    add_study(*type, other, keys);
  }
  for (const std::string& name : named_parameters(*type, keys)) scene::drop(other.studies.at(*index), name);
  return {keys.empty() ? std::move(other) : scene::with_keys(other, *index, keys), *index};
}

}  // namespace

void bind_scene(nb::module_& core) {
  nb::class_<Scene>(core, "Scene")
      .def_static("read_file", read_file, nb::arg("path"))
      .def_static("read", read, nb::arg("text"), nb::arg("folder"), nb::arg("files"))
      .def("write", [](const Scene& scene) { return scene::write(scene); })
      .def("write_in", write_in, nb::arg("folder"), nb::arg("kept"))
      .def("hash", [](const Scene& scene) { return scene::hash(scene); })
      .def("files", files)
      .def("parameters", parameters)
      .def("replace", replace, nb::arg("values"), nb::arg("order").none(), nb::arg("accuracy").none())
      .def("studies", studies)
      .def("with_study", with_study, nb::arg("kind"), nb::arg("index").none(), nb::arg("json"))
      .def_prop_ro("labels",
                   [](const Scene& scene) {
                     nb::dict all;
                     for (const auto& [axis, text] : scene.labels) all[axis.c_str()] = text;
                     return all;
                   })
      .def_prop_ro("title", [](const Scene& scene) { return scene.title; })
      .def_prop_ro("folder", [](const Scene& scene) { return scene.folder.path; })
      .def_prop_ro("dofs", [](const Scene& scene) { return scene.dofs; })
      .def_prop_ro("frequency_unit",
                   [](const Scene& scene) { return std::string(scene::unit_name(scene.frequency_unit)); });
}

}  // namespace arcslip::python
