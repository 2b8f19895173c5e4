#include <arcslip/scene/read_parts.hpp>
#include <arcslip/scene/words.hpp>

#include <algorithm>

namespace arcslip::scene::file {
namespace {

// Why a name may not be used, or "".
std::string objection(const std::string& name) {
  if (name.empty()) {
    return "must be a name of at least one character";
  }
  if (name == ground) {
    return "which is reserved for the fixed frame; must be another name";
  }
  if (name == "frequency") {
    return "which is reserved for the excitation frequency; must be another name";
  }
  const auto forbidden = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return c == '.' || c == '=' || code <= 0x20 || code == 0x7f;
  };
  if (std::any_of(name.begin(), name.end(), forbidden)) {
    return "must be a name without '.', '=' and white space";
  }
  return {};
}

const PartType* read_type(const Keys& keys, Faults& faults) {
  std::vector<std::string> known;
  for (const PartType* type : element_types()) {
    known.emplace_back(type->name);
  }
  const std::string wanted = "one of " + listed(known);
  const Place place = keys.require("type", wanted, faults);
  const auto text = read_string(place, wanted, faults);
  if (!text) {
    return nullptr;
  }
  for (const PartType* type : element_types()) {
    if (type->name == *text) {
      return type;
    }
  }
  faults.add(place.pointer, "found " + shown(*text) + ", must be " + wanted + hint(*text, known));
  return nullptr;
}

// The keys of a part. An element whose type is not known may have any.
std::vector<std::string> keys_of(const PartType* type, bool is_element) {
  if (type == nullptr) {
    return {};
  }
  std::vector<std::string> keys = {"name", "at", "between", "direction"};
  if (is_element) {
    keys.insert(keys.begin() + 1, "type");
  }
  if (type == &force_type) {
    keys.emplace_back("harmonic");
  }
  for (const Field& field : type->fields) {
    keys.emplace_back(field.name);
  }
  return keys;
}

Part read_part(const Place& place, const PartType* section_type, const Dofs& dofs, Names& names,
               Faults& faults) {
  Part part;
  part.type = section_type;
  if (section_type == nullptr && place.node->get<Node::Object>() != nullptr) {
    Faults duplicates;  // told below, once the type tells which keys are allowed
    part.type = read_type(Keys(place, {}, duplicates), faults);
  }
  const Keys keys(place, keys_of(part.type, section_type == nullptr), faults);
  if (!keys.is_object()) {
    names.set_incomplete();
    return part;
  }
  const Place name = keys.require("name", "a string, the name of the part", faults);
  const auto text = read_string(name, "a string, the name of the part", faults);
  if (text && names.add(*text, name.pointer, faults)) {
    part.name = *text;
    names.set_type(part.name, part.type);
  } else if (!text || !objection(*text).empty()) {
    names.set_incomplete();
  }
  if (const auto direction = read_direction(keys, dofs, faults)) {
    part.direction = *direction;
  }
  if (part.type == nullptr) {
    return part;
  }
  if (part.type == &force_type) {
    part.harmonic = read_integer(keys.find("harmonic"), 1, largest_order, faults).value_or(part.harmonic);
  }
  for (const Field& field : part.type->fields) {
    const Place value =
        field.default_value ? keys.find(field.name) : keys.require(field.name, allowed_text(field), faults);
    part.values.push_back(read_number(value, field, faults).value_or(field.default_value.value_or(0)));
  }
  return part;
}

}  // namespace

bool Names::add(const std::string& name, const std::string& pointer, Faults& faults) {
  if (const std::string reason = objection(name); !reason.empty()) {
    faults.add(pointer, "found " + shown(name) + ", " + reason);
    return false;
  }
  const auto [first, is_new] = pointers_.emplace(name, pointer);
  if (!is_new) {
    faults.add(pointer, "found the name " + shown(name) + " again, which is also at " + first->second +
                            "; parts and ties must have different names");
  }
  return is_new;
}

bool Names::may_exist(std::string_view parameter) const {
  const auto part = types_.find(parameter.substr(0, parameter.find('.')));
  return part == types_.end() ? !complete_ : part->second == nullptr;
}

const Field* Names::field(std::string_view parameter, const std::string& pointer, Faults& faults) const {
  const std::size_t dot = parameter.find('.');
  const auto part = types_.find(parameter.substr(0, dot));
  if (dot != std::string_view::npos && part != types_.end() && part->second != nullptr) {
    for (const Field& field : part->second->fields) {
      if (field.name == parameter.substr(dot + 1)) {
        return &field;
      }
    }
  }
  if (faults.full()) {
    faults.add({}, {});
  } else if (!may_exist(parameter)) {
    faults.add(pointer, "found " + shown(parameter) + ", must be one of the parameters " + listed(fields_) +
                            hint(parameter, fields_));
  }
  return nullptr;
}

void Names::set_type(const std::string& part, const PartType* type) {
  types_.emplace(part, type);
  for (std::size_t i = 0; type != nullptr && i < type->fields.size(); ++i) {
    fields_.push_back(part + '.' + std::string(type->fields[i].name));
  }
}

std::vector<Part> read_parts(const Place& place, const PartType* type, const Dofs& dofs, Names& names,
                             Faults& faults) {
  std::vector<Part> parts;
  const Node::List* list = read_list(place, "a list of objects", faults);
  if (place.node != nullptr && list == nullptr) {
    names.set_incomplete();
  }
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    parts.push_back(read_part({&(*list)[i], child(place.pointer, i)}, type, dofs, names, faults));
  }
  return parts;
}

}  // namespace arcslip::scene::file
