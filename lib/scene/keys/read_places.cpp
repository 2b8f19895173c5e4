#include <arcslip/scene/keys/read_places.hpp>

#include <arcslip/scene/keys/enum_words.hpp>

#include <algorithm>

namespace arcslip::scene::file {
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
                                      : "at " + faults.reported(child(place.pointer, earlier - named))) +
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
