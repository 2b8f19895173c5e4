// Patches of contacts.
#include <arcslip/scene/format/patch_rows.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/study_keys.hpp>
#include <arcslip/scene/patch.hpp>

#include <algorithm>
#include <utility>

namespace arcslip::scene::file {
namespace {

const PartType* read_law(const Keys& keys, std::span<const PartType* const> laws, Faults& faults) {
  std::vector<std::string> known;
  for (const PartType* law : laws)
    if (!patch_fields(*law, {}).empty()) known.emplace_back(law->name());
  const std::string wanted = "one of " + listed(known);
  const Location place = keys.require("law", wanted, faults);
  const auto text = read_string(place, wanted, faults);
  if (!text) return nullptr;
  for (const PartType* law : laws)
    if (law->name() == *text && std::find(known.begin(), known.end(), *text) != known.end()) return law;
  faults.add(place.pointer, "found " + shown(*text) + ", must be " + wanted + hint(*text, known));
  return nullptr;
}

void read_patch_values(const Keys& keys, Part& patch, Faults& faults) {
  for (const Field& field : patch.fields()) {
    const Location value =
        field.default_value ? keys.find(field.name) : keys.require(field.name, allowed_text(field), faults);
    read_value(value, field, patch, faults);
  }
  patch.wear_coefficient =
      read_number(keys.find(wear_coefficient.name), wear_coefficient, faults).value_or(0);
}

Part read_patch(const Location& place, std::span<const PartType* const> laws, const Dofs& dofs,
                const FileSource& source, Names& names, Faults& faults) {
  Part patch;
  patch.type = &patch_type();
  PatchOptions options;
  if (place.node->get<Node::Object>() != nullptr) {
    Faults others;  // reported below, with the keys that the law has
    options.law = read_law(Keys(place, {}, others), laws, faults);
  }
  std::vector<std::string> known;  // none: every key
  if (options.law != nullptr) {
    options.law_options = read_options(*options.law, place, dofs, source, faults);
    options.fields = patch_fields(*options.law, options.law_options);
    known = {"name", "law", "file", "details", std::string(wear_coefficient.name)};
    for (const Key& option : options.law->options()) known.push_back(option.name);
    for (const Field& field : options.fields) known.emplace_back(field.name);
  }
  const Keys keys(place, known, faults);
  const Location name = keys.require("name", "a string, the name of the patch", faults);
  const auto text = read_string(name, "a string, the name of the patch", faults);
  const bool named = text && names.add(*text, name.pointer, faults);
  if (named) patch.name = *text;
  if (options.law == nullptr || !keys.is_object()) {
    if (named) names.set_unknown(patch.name);
    if (!named) names.set_incomplete();
    return patch;
  }
  const Reading reading{keys, any_number, no_parameters(), dofs, faults, source};
  constexpr const char* wanted = "a string, the path of a CSV file of contacts";
  const Location file = keys.require("file", wanted, faults);
  options.file = read_file_of(file, wanted, reading).value_or(NamedFile{});
  if (const Location details = keys.find("details"); details.node != nullptr) {
    if (const bool* is = details.node->get<bool>())
      options.details = *is;
    else
      add_wrong_type(details, "true or false", faults);
  }
  patch.options = Settings::of(options);
  if (named) names.set_fields(patch.name, patch.options.as<PatchOptions>().fields);
  const std::size_t before = faults.count();
  read_patch_values(keys, patch, faults);
  if (!options.file.text) return patch;
  patch.options.as<PatchOptions>().rows =
      read_patch_rows(patch, faults.count() == before, dofs, file.pointer, faults);
  return patch;
}

}  // namespace

std::vector<Part> read_patches(const Location& place, std::span<const PartType* const> laws, const Dofs& dofs,
                               const FileSource& source, Names& names, Faults& faults) {
  std::vector<Part> patches;
  const Node::List* list = read_list(place, "a list of objects", faults);
  if (place.node != nullptr && list == nullptr) names.set_incomplete();
  if (list != nullptr) patches.reserve(list->size());
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
    patches.push_back(read_patch({&(*list)[i], child(place.pointer, i)}, laws, dofs, source, names, faults));
  return patches;
}

}  // namespace arcslip::scene::file
