// The kinds of studies with their keys, and the format of scenes.

#include "bindings.hpp"

#include <arcslip/optimize/studies.hpp>
#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/scene/key.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <string>

namespace nb = nanobind;

namespace arcslip::python {
namespace {

/// The name of a type, as the key tables have it.
std::string name_of(scene::KeyType type) {
  switch (type) {
    case scene::KeyType::number:
      return "number";
    case scene::KeyType::whole:
      return "whole";
    case scene::KeyType::text:
      return "text";
    case scene::KeyType::word:
      return "word";
    case scene::KeyType::frequency:
      return "frequency";
    case scene::KeyType::window:
      return "window";
    case scene::KeyType::parameter:
      return "parameter";
    case scene::KeyType::value:
      return "value";
    case scene::KeyType::parameters:
      return "parameters";
    case scene::KeyType::followed:
      return "followed";
    case scene::KeyType::other:
      return "other";
  }
  return "other";
}

nb::dict as_dict(const scene::Key& key) {
  nb::dict all;
  all["name"] = key.name;
  all["type"] = name_of(key.type);
  all["unit"] = key.unit;
  all["allowed"] = key.allowed;
  all["default"] = key.otherwise;
  all["required"] = key.required;
  all["help"] = key.help;
  all["words"] = key.words;
  all["next_to"] = scene::keys_next_to(key.type);
  return all;
}

nb::list kinds() {
  nb::list all;
  for (const auto& type : catalogue().studies) {
    nb::list keys;
    for (const scene::Key& key : type->keys()) keys.append(as_dict(key));
    nb::dict kind;
    kind["name"] = type->name();
    kind["verb"] = type->verb();
    kind["help"] = type->help();
    kind["keys"] = keys;
    kind["takes_coefficients"] = studies::kind_of(*type).takes_coefficients();
    all.append(kind);
  }
  return all;
}

}  // namespace

const scene::Catalogue& catalogue() {
  static const scene::Catalogue all = [] {
    scene::Catalogue made = studies::catalogue();
    optimize::add_studies(made);
    return made;
  }();
  return all;
}

void bind_studies(nb::module_& core) {
  core.def("kinds", kinds, "The kinds of studies, each with its keys.");
  core.def(
      "schema", [] { return scene::json_schema(catalogue()); },
      "The format of scenes as the text of a JSON Schema.");
}

}  // namespace arcslip::python
