#include <arcslip/scene/keys/read_parts.hpp>

#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/natural_frequency.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/study_keys.hpp>
#include <arcslip/scene/part_type.hpp>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

namespace arcslip::scene::file {
namespace {

const PartType* read_type(const Keys& keys, std::span<const PartType* const> types, Faults& faults) {
  std::vector<std::string> known;
  for (const PartType* type : types) known.emplace_back(type->name());
  const std::string wanted = "one of " + listed(known);
  const Location place = keys.require("type", wanted, faults);
  const auto text = read_string(place, wanted, faults);
  if (!text) return nullptr;
  for (const PartType* type : types)
    if (type->name() == *text) return type;
  faults.add(place.pointer, "found " + shown(*text) + ", must be " + wanted + hint(*text, known));
  return nullptr;
}

bool is_excitation(const PartType* type) {
  const auto types = excitation_types();
  return std::find(types.begin(), types.end(), type) != types.end();
}

// The keys of a part. An element whose type is not known may have any.
std::vector<std::string> keys_of(const Part& part, bool has_type, bool has_wear) {
  if (part.type == nullptr) return {};
  std::vector<std::string> keys = {"name"};
  if (has_type) keys.emplace_back("type");
  const auto slots = part.type->slots_with(part.options);
  for (const std::string_view slot : slots) keys.emplace_back(slot);
  if (part.type->has_one_direction(part.options)) keys.insert(keys.end(), {"at", "between", "direction"});
  for (const Key& option : part.type->options()) keys.push_back(option.name);
  if (is_excitation(part.type)) keys.emplace_back("harmonic");
  for (const Field& field : part.fields())
    if (field.place.empty()) keys.emplace_back(field.name);
  if (part.type == &spring_type()) keys.emplace_back(frequency_key);  // with the value that it gives
  if (part.type == &damper_type()) keys.emplace_back(damping_ratio_key);
  if (has_wear) keys.emplace_back(wear_coefficient.name);
  return keys;
}

Direction all_dofs(const Dofs& dofs) {
  Direction all;
  for (std::size_t i = 0; i < dofs.names.size(); ++i) all.push_back({static_cast<int>(i), 1.0});
  return all;
}

std::vector<Direction> read_directions(const PartType& type, const Settings& options, const Keys& keys,
                                       const Dofs& dofs, Faults& faults) {
  const auto slots = type.slots_with(options);
  if (type.has_one_direction(options)) {
    const bool has_place = keys.has("at") || keys.has("between") || keys.has("direction");
    if (!has_place && (keys.has("shape") || keys.has("imaginary_shape"))) return {Direction{}};
    if (is_base_motion(type) && !has_place) return {all_dofs(dofs)};
    const auto direction = read_direction(keys, dofs, faults);
    return std::vector<Direction>(direction ? 1 : 0, direction.value_or(Direction{}));
  }
  std::vector<Direction> directions;
  for (const std::string_view slot : slots) {
    if (const auto dof = dofs.index.find(std::string(slot));
        type.names_directions() && !keys.has(slot) && dof != dofs.index.end()) {
      directions.push_back({{dof->second, 1.0}});
      continue;
    }
    const Location place =
        keys.require(slot, "an object with one of \"at\", \"between\", \"direction\"", faults);
    if (place.node == nullptr) continue;
    const Keys within(place, {"at", "between", "direction"}, faults);
    if (const auto direction = read_direction(within, dofs, faults)) directions.push_back(*direction);
  }
  return directions;
}

// options_sound: whether the fields are known that the options bring.
void read_name(const Keys& keys, bool options_sound, Part& part, Names& names, Faults& faults) {
  const Location name = keys.require("name", "a string, the name of the part", faults);
  const auto text = read_string(name, "a string, the name of the part", faults);
  if (text && names.add(*text, name.pointer, faults)) {
    part.name = *text;
    if (part.type != nullptr && (options_sound || !part.type->options_bring_fields()))
      names.set_fields(part.name, part.fields());
    else
      names.set_unknown(part.name);
  } else if (!text || !objection(*text).empty()) {
    names.set_incomplete();
  }
}

// section_type: without a "type"; none: that key is required.
Part read_part(const Location& place, const PartType* section_type, std::span<const PartType* const> types,
               const Dofs& dofs, const FileSource& source, Names& names, Faults& faults) {
  Part part;
  part.type = section_type;
  if (!types.empty() && place.node->get<Node::Object>() != nullptr) {
    Faults duplicates;  // reported below, once the allowed keys are known from the type
    const Keys all(place, {}, duplicates);
    if (section_type == nullptr || all.has("type")) part.type = read_type(all, types, faults);
  }
  const std::size_t before = faults.count();
  if (part.type != nullptr) part.options = read_options(*part.type, place, dofs, source, faults);
  const bool options_sound = faults.count() == before;
  const Location wear = part.type != nullptr && place.node->get<Node::Object>() != nullptr
                            ? at_pointer(place, "/wear_coefficient")
                            : Location{};
  const bool has_wear = section_type == nullptr && wear.node != nullptr &&
                        (faults.count() > before || part.type->has_wear(part.options));
  const Elsewhere elsewhere = [&part](std::string_view key) {
    return key == "engine_order" && is_excitation(part.type) ? "which belongs to repeated excitations" : "";
  };
  const Keys keys(place, keys_of(part, !types.empty(), has_wear), faults, elsewhere);
  if (!keys.is_object()) {
    names.set_incomplete();
    return part;
  }
  read_name(keys, options_sound, part, names, faults);
  if (part.type == nullptr) {  // which may have no place
    if (keys.has("at") || keys.has("between") || keys.has("direction")) read_direction(keys, dofs, faults);
    return part;
  }
  part.directions = read_directions(*part.type, part.options, keys, dofs, faults);
  if (is_excitation(part.type))
    part.harmonic = read_integer(keys.find("harmonic"), 0, largest_order, faults).value_or(part.harmonic);
  for (const Field& field : part.fields()) {
    const Location value = !field.place.empty()  ? at_pointer(place, field.place)
                           : field.default_value ? keys.find(field.name)
                                                 : keys.require(field.name, allowed_text(field), faults);
    read_value(value, field, part, faults);
  }
  if (has_wear) part.wear_coefficient = read_number(wear, wear_coefficient, faults).value_or(0);
  return part;
}

// Of a formula until resolve_formulas(), and of a number with a fault.
constexpr double unknown_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void read_value(const Location& place, const Field& field, Part& part, Faults& faults) {
  GivenNumber given{field.default_value.value_or(unknown_number)};
  if (place.node != nullptr)
    given = read_given_number(place, field, faults).value_or(GivenNumber{unknown_number});
  part.values.push_back(given.follows ? unknown_number : given.value);
  if (given.text.empty()) return;
  part.texts.resize(part.fields().size());
  part.texts[part.values.size() - 1].text = given.text;
}

Settings read_options(const PartType& type, const Location& place, const Dofs& dofs, const FileSource& source,
                      Faults& faults) {
  if (type.options().empty()) return {};
  Faults others;  // reported with the keys of the part, which these options decide
  return type.read_options({Keys(place, {}, others), any_number, no_parameters(), dofs, faults, source});
}

std::vector<Part> read_parts(const Location& place, const PartType* type,
                             std::span<const PartType* const> types, const Dofs& dofs,
                             const FileSource& source, Names& names, Faults& faults) {
  std::vector<Part> parts;
  const Node::List* list = read_list(place, "a list of objects", faults);
  if (place.node != nullptr && list == nullptr) names.set_incomplete();
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    parts.push_back(
        read_part({&(*list)[i], child(place.pointer, i)}, type, types, dofs, source, names, faults));
  }
  return parts;
}

std::vector<Part> read_one(const Location& place, const PartType& type, const Dofs& dofs,
                           const FileSource& source, Names& names, Faults& faults) {
  if (place.node == nullptr) return {};
  return {read_part(place, &type, {}, dofs, source, names, faults)};
}

}  // namespace arcslip::scene::file
