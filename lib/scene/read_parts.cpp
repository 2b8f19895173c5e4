#include <arcslip/scene/read_parts.hpp>

#include <arcslip/scene/natural.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/read_studies.hpp>
#include <arcslip/scene/study_keys.hpp>
#include <arcslip/scene/words.hpp>

#include <algorithm>
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
std::vector<std::string> keys_of(const Part& part, bool has_type, bool wears) {
  if (part.type == nullptr) return {};
  std::vector<std::string> keys = {"name"};
  if (has_type) keys.emplace_back("type");
  const auto slots = part.type->slots_with(part.options);
  for (const std::string_view slot : slots) keys.emplace_back(slot);
  if (slots.empty() && !part.type->names_directions())
    keys.insert(keys.end(), {"at", "between", "direction"});
  for (const Key& option : part.type->options()) keys.push_back(option.name);
  if (is_excitation(part.type)) keys.emplace_back("harmonic");
  for (const Field& field : part.fields())
    if (field.place.empty()) keys.emplace_back(field.name);
  if (part.type == &spring_type()) keys.emplace_back(frequency_key);  // with the value that it gives
  if (part.type == &damper_type()) keys.emplace_back(damping_ratio_key);
  if (wears) keys.emplace_back(wear_coefficient.name);
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
  if (slots.empty() && !type.names_directions()) {
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
  const Location wear = part.type != nullptr && place.node->get<Node::Object>() != nullptr
                            ? at_pointer(place, "/wear_coefficient")
                            : Location{};
  const bool wears = section_type == nullptr && wear.node != nullptr &&
                     (faults.count() > before || part.type->wears(part.options));
  const Elsewhere elsewhere = [&part](std::string_view key) {
    return key == "engine_order" && is_excitation(part.type) ? "which belongs to repeated excitations" : "";
  };
  const Keys keys(place, keys_of(part, !types.empty(), wears), faults, elsewhere);
  if (!keys.is_object()) {
    names.set_incomplete();
    return part;
  }
  const Location name = keys.require("name", "a string, the name of the part", faults);
  const auto text = read_string(name, "a string, the name of the part", faults);
  if (text && names.add(*text, name.pointer, faults)) {
    part.name = *text;
    if (part.type != nullptr)
      names.set_fields(part.name, part.fields());
    else
      names.set_unknown(part.name);
  } else if (!text || !objection(*text).empty()) {
    names.set_incomplete();
  }
  if (part.type == nullptr) {
    read_direction(keys, dofs, faults);
    return part;
  }
  part.directions = read_directions(*part.type, part.options, keys, dofs, faults);
  if (is_excitation(part.type))
    part.harmonic = read_integer(keys.find("harmonic"), 0, largest_order, faults).value_or(part.harmonic);
  for (const Field& field : part.fields()) {
    const Location value = !field.place.empty()  ? at_pointer(place, field.place)
                           : field.default_value ? keys.find(field.name)
                                                 : keys.require(field.name, allowed_text(field), faults);
    part.values.push_back(read_number(value, field, faults).value_or(field.default_value.value_or(0)));
  }
  if (wears) part.wear_coefficient = read_number(wear, wear_coefficient, faults).value_or(0);
  return part;
}

}  // namespace

Settings read_options(const PartType& type, const Location& place, const Dofs& dofs, const FileSource& source,
                      Faults& faults) {
  if (type.options().empty()) return {};
  Faults others;  // reported with the keys of the part, which these options decide
  const Names none;
  return type.read_options(
      {Keys(place, {}, others), any_number, Parameters({}, true, none), dofs, faults, source});
}

std::string objection(const std::string& name) {
  if (name.empty()) return "must be a name of at least one character";
  if (name == ground) return "which is reserved for the fixed frame; must be another name";
  if (name == "frequency") return "which is reserved for the excitation frequency; must be another name";
  const auto forbidden = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return c == '.' || c == '=' || code <= 0x20 || code == 0x7f;
  };
  if (std::any_of(name.begin(), name.end(), forbidden))
    return "must be a name without '.', '=' and white space";
  return {};
}

bool Names::add(const std::string& name, const std::string& pointer, Faults& faults) {
  if (const std::string reason = objection(name); !reason.empty()) {
    faults.add(pointer, "found " + shown(name) + ", " + reason);
    return false;
  }
  const auto [first, is_new] = pointers_.emplace(name, pointer);
  if (!is_new) {
    faults.add(pointer, "found the name " + shown(name) + " again, which is also at " +
                            faults.told(first->second) + "; parts and ties must have different names");
  }
  return is_new;
}

bool Names::may_exist(std::string_view parameter) const {
  const auto part = parts_.find(parameter.substr(0, parameter.find('.')));
  return part == parts_.end() ? !complete_ : !part->second;
}

const Field* Names::field(std::string_view parameter, const std::string& pointer, Faults& faults) const {
  const std::size_t dot = parameter.find('.');
  const auto part = parts_.find(parameter.substr(0, dot));
  if (dot != std::string_view::npos && part != parts_.end() && part->second) {
    for (const Field& field : *part->second)
      if (field.name == parameter.substr(dot + 1)) return &field;
  }
  if (faults.full()) {
    faults.add({}, {});
  } else if (!may_exist(parameter)) {
    faults.add(pointer, "found " + shown(parameter) + ", must be one of the parameters " + listed(fields_) +
                            hint(parameter, fields_));
  }
  return nullptr;
}

void Names::set_fields(const std::string& part, std::span<const Field> fields) {
  parts_.emplace(part, std::vector<Field>(fields.begin(), fields.end()));
  for (const Field& field : fields) fields_.push_back(part + '.' + std::string(field.name));
}

void Names::set_unknown(const std::string& part) {
  parts_.emplace(part, std::nullopt);
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

namespace {

constexpr std::string_view members_wanted = "a list of at least one parameter \"part.field\"";

// The members of one tie. used: the fields already tied, and where.
std::vector<std::string> read_members(const Location& place, const Names& names,
                                      std::unordered_map<std::string, std::string>& used, Faults& faults) {
  std::vector<std::string> members;
  const Node::List* list = read_list(place, members_wanted, faults);
  if (list != nullptr && list->empty())
    faults.add(place.pointer, "found an empty list, must be " + std::string(members_wanted));
  std::string_view unit;
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const Location item{&(*list)[i], child(place.pointer, i)};
    const auto member = read_string(item, "a string, a parameter \"part.field\"", faults);
    const Field* field = member ? names.field(*member, item.pointer, faults) : nullptr;
    if (field == nullptr) continue;
    const auto [first, is_new] = used.emplace(*member, item.pointer);
    if (!is_new) {
      faults.add(item.pointer, "found " + shown(*member) + " again, which is also at " +
                                   faults.told(first->second) + "; a field must be tied only once");
    } else if (!members.empty() && field->unit != unit) {
      faults.add(item.pointer, "found " + shown(*member) + " (" + std::string(field->unit) + ") tied to " +
                                   shown(members.front()) + " (" + std::string(unit) +
                                   "), must have the same unit");
    } else {
      unit = field->unit;
      members.push_back(*member);
    }
  }
  return members;
}

}  // namespace

namespace {

// Whether a tie is that of a field in all sectors of a ring, as ring.hpp makes them: "part.field" of
// "part1.field", "part2.field" ...
bool is_of_ring(const Member& tie) {
  const std::size_t dot = tie.key.find('.');
  const auto* members = tie.value.get<Node::List>();
  if (dot == std::string::npos || members == nullptr || members->empty()) return false;
  for (std::size_t i = 0; i < members->size(); ++i) {
    const auto* member = (*members)[i].get<std::string>();
    if (member == nullptr || *member != tie.key.substr(0, dot) + std::to_string(i + 1) + tie.key.substr(dot))
      return false;
  }
  return true;
}

}  // namespace

std::vector<Tie> read_ties(const Location& place, Names& names, Faults& faults) {
  std::vector<Tie> ties;
  if (place.node == nullptr || !Keys(place, {}, faults).is_object()) return ties;
  std::unordered_map<std::string, std::string> used;
  std::unordered_map<std::string, int> seen;
  for (const Member& member : *place.node->get<Node::Object>()) {
    if (seen[member.key]++ > 0) continue;  // reported as a duplicate key
    const Location item{&member.value, child(place.pointer, member.key)};
    if (!is_of_ring(member)) names.add(member.key, item.pointer, faults);
    ties.push_back({member.key, read_members(item, names, used, faults)});
  }
  return ties;
}

namespace {

constexpr std::size_t largest_dofs = 1000;  // matrices are dense
constexpr std::string_view dofs_wanted = "a list of at least one name";

// Adds weight * x_name; ground adds nothing. False where the name is not known.
bool add_term(const std::string& name, double weight, bool next, const std::string& pointer, const Dofs& dofs,
              Direction& direction, Faults& faults) {
  if (name == ground) return true;
  const auto found = dofs.index.find(name);
  if (found == dofs.index.end()) {
    if (faults.full()) {
      faults.add({}, {});
    } else if (dofs.complete) {
      faults.add(pointer, "found " + shown(name) + ", must be one of the degrees of freedom " +
                              listed(dofs.names) + " or \"ground\"" + hint(name, dofs.names));
    }
    return false;
  }
  const auto same = [&](const Term& term) { return term.dof == found->second && term.next == next; };
  const auto term = std::find_if(direction.begin(), direction.end(), same);
  if (term == direction.end())
    direction.push_back({found->second, weight, next});
  else
    term->weight += weight;
  return true;
}

// Whether there is a next sector; else a fault.
bool have_next(const Location& place, const Dofs& dofs, Faults& faults) {
  if (dofs.have_next) return true;
  faults.add(place.pointer,
             "found a place of the next sector, must be a degree of freedom by its name: \"next\" belongs to "
             "masses, springs, dampers, elements and patches of a structure with \"cyclic\"");
  return false;
}

// What `place` has under "next", if it is an object with that key.
Location next_of(const Location& place) {
  const auto* object = place.node != nullptr ? place.node->get<Node::Object>() : nullptr;
  for (std::size_t i = 0; object != nullptr && i < object->size(); ++i)
    if ((*object)[i].key == next_key) return {&(*object)[i].value, child(place.pointer, next_key)};
  return {};
}

// Adds weight * x of a name, or of {"next": name} in the next sector.
bool read_term(const Location& place, double weight, const Dofs& dofs, Direction& direction, Faults& faults) {
  constexpr std::string_view wanted = "a string, the name of a degree of freedom";
  const Location next = next_of(place);
  if (next.node == nullptr) {
    const auto name = read_string(place, wanted, faults);
    return name && add_term(*name, weight, false, place.pointer, dofs, direction, faults);
  }
  if (!have_next(place, dofs, faults)) return false;
  const std::size_t before = faults.count();
  const Keys keys(place, {std::string(next_key)}, faults);
  const auto name = read_string(next, wanted, faults);
  return name && add_term(*name, weight, true, next.pointer, dofs, direction, faults) &&
         faults.count() == before;
}

bool read_between(const Location& place, const Dofs& dofs, Direction& direction, Faults& faults) {
  constexpr std::string_view wanted = "a list of two names of degrees of freedom";
  const Node::List* list = read_list(place, wanted, faults);
  if (list == nullptr) return false;
  if (list->size() != 2) {
    faults.add(place.pointer,
               "found a list of " + std::to_string(list->size()) + ", must be " + std::string(wanted));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const Location item{&(*list)[i], child(place.pointer, i)};
    good = read_term(item, i == 0 ? 1 : -1, dofs, direction, faults) && good;
  }
  return good;
}

bool read_weights(const Location& place, bool next, const Dofs& dofs, Direction& direction, Faults& faults) {
  const std::size_t before = faults.count();
  const Keys keys(place, {}, faults);
  if (!keys.is_object() || faults.count() > before) return false;
  bool good = true;
  for (const Member& member : *place.node->get<Node::Object>()) {
    const Location item{&member.value, child(place.pointer, member.key)};
    if (!next && member.key == next_key && member.value.get<Node::Object>() != nullptr) {
      good = have_next(item, dofs, faults) && read_weights(item, true, dofs, direction, faults) && good;
      continue;
    }
    const auto weight = read_number(item, any_number, faults);
    good = add_term(member.key, weight.value_or(0), next, item.pointer, dofs, direction, faults) && weight &&
           good;
  }
  return good;
}

}  // namespace

void read_dofs(const Location& place, Dofs& dofs, Faults& faults) {
  const std::size_t before = faults.count(), named = dofs.names.size();
  const Node::List* list = read_list(place, dofs_wanted, faults);
  if (list != nullptr && list->empty())
    faults.add(place.pointer, "found an empty list, must be " + std::string(dofs_wanted));
  if (list != nullptr && list->size() > largest_dofs) {
    faults.add(place.pointer, "found " + std::to_string(list->size()) +
                                  " degrees of freedom, must be at most " + std::to_string(largest_dofs) +
                                  ": the matrices of the linear part are dense, and with more a single "
                                  "evaluation would take many seconds and gigabytes; reduce the model first");
  }
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const Location item{&(*list)[i], child(place.pointer, i)};
    const auto name = read_string(item, "a string, the name of a degree of freedom", faults);
    if (!name) continue;
    const auto first = dofs.index.find(*name);
    if (name->empty()) {
      faults.add(item.pointer, "found \"\", must be a name of at least one character");
    } else if (*name == ground) {
      faults.add(item.pointer,
                 "found \"ground\", which is reserved for the fixed frame; must be another name");
    } else if (first != dofs.index.end()) {
      const auto earlier = static_cast<std::size_t>(first->second);
      faults.add(item.pointer,
                 "found " + shown(*name) + " again, which is also " +
                     (earlier < named ? "a row of the matrices"
                                      : "at " + faults.told(child(place.pointer, earlier - named))) +
                     "; each degree of freedom must stand only once");
    } else {
      dofs.index.emplace(*name, static_cast<int>(dofs.names.size()));
      dofs.names.push_back(*name);
    }
  }
  dofs.complete = dofs.complete && list != nullptr && faults.count() == before;
}

std::optional<Direction> read_direction(const Keys& keys, const Dofs& dofs, Faults& faults) {
  std::vector<std::string> given;
  for (const std::string_view key : {"at", "between", "direction"})
    if (keys.has(key)) given.emplace_back(key);
  if (given.size() != 1) {
    if (keys.is_object()) {
      faults.add(keys.pointer(), "found " + (given.empty() ? "no place" : listed(given) + " together") +
                                     ", must have exactly one of \"at\", \"between\", \"direction\"");
    }
    return {};
  }
  Direction direction;
  const Location place = keys.find(given.front());
  const bool good = given.front() == "at"        ? read_term(place, 1, dofs, direction, faults)
                    : given.front() == "between" ? read_between(place, dofs, direction, faults)
                                                 : read_weights(place, false, dofs, direction, faults);
  if (!good) return {};
  std::erase_if(direction, [](const Term& term) { return term.weight == 0; });
  if (direction.empty()) {
    faults.add(
        place.pointer,
        "found a direction that is zero, must act on at least one degree of freedom other than \"ground\"");
    return {};
  }
  return direction;
}

}  // namespace arcslip::scene::file
