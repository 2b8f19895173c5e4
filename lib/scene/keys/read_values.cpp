#include <arcslip/scene/keys/read_values.hpp>

#include <arcslip/scene/unit.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace arcslip::scene::file {

void add_wrong_type(const Location& place, std::string_view must_be, Faults& faults) {
  faults.add(place.pointer, "found " + described(*place.node) + ", must be " + std::string(must_be));
}

Keys::Keys(const Location& place, std::vector<std::string> allowed, Faults& faults,
           const Elsewhere& elsewhere)
    : object_(place.node != nullptr ? place.node->get<Node::Object>() : nullptr), pointer_(place.pointer) {
  if (object_ == nullptr) {
    if (place.node != nullptr) {
      add_wrong_type(place, allowed.empty() ? "an object" : "an object with the keys " + listed(allowed),
                     faults);
    }
    return;
  }
  std::unordered_set<std::string_view> seen;
  for (const Member& member : *object_) {
    if (!seen.insert(member.key).second) {
      faults.add(child(pointer_, member.key),
                 "found the key " + shown(member.key) + " again, must stand only once");
    } else if (!allowed.empty() && member.key == comment_key) {
      read_string({&member.value, child(pointer_, member.key)}, "a string, a comment", faults);
    } else if (!allowed.empty() && std::find(allowed.begin(), allowed.end(), member.key) == allowed.end()) {
      const std::string belongs = elsewhere ? elsewhere(member.key) : "";
      faults.add(child(pointer_, member.key),
                 belongs.empty() ? "found the unknown key " + shown(member.key) + ", must be one of " +
                                       listed(allowed) + hint(member.key, allowed)
                                 : "found the key " + shown(member.key) + ", " + belongs +
                                       ", must be one of " + listed(allowed));
    }
  }
}

Location Keys::find(std::string_view key) const {
  Location place{nullptr, child(pointer_, key)};
  if (object_ != nullptr) {
    const auto member =
        std::find_if(object_->begin(), object_->end(), [&](const Member& m) { return m.key == key; });
    place.node = member != object_->end() ? &member->value : nullptr;
  }
  return place;
}

Location Keys::require(std::string_view key, const std::string& what, Faults& faults) const {
  Location place = find(key);
  if (place.node == nullptr && is_object())
    faults.add(place.pointer, "found no key " + quoted(key) + ", which is required: must be " + what);
  return place;
}

Location at_pointer(const Location& root, std::string_view pointer) {
  Location at = root;
  at.pointer += pointer;
  while (at.node != nullptr && !pointer.empty()) {
    const std::size_t end = std::min(pointer.find('/', 1), pointer.size());
    const std::string key(pointer.substr(1, end - 1));
    pointer.remove_prefix(end);
    if (const auto* list = at.node->get<Node::List>()) {
      const std::size_t i = std::stoul(key);
      at.node = i < list->size() ? &(*list)[i] : nullptr;
    } else {
      Faults none;
      at.node = Keys({at.node, {}}, {}, none).find(key).node;
    }
  }
  return at;
}

std::vector<const Member*> members(const Location& place, Faults& faults) {
  std::vector<const Member*> all;
  if (place.node == nullptr || !Keys(place, {}, faults).is_object()) return all;
  std::unordered_set<std::string_view> seen;
  for (const Member& member : *place.node->get<Node::Object>())
    if (seen.insert(member.key).second)  // the second is reported as a duplicate key
      all.push_back(&member);
  return all;
}

namespace {

// "0.2 mm", in the unit of the field.
std::optional<double> read_quantity(const Quantity& quantity, const Unit& unit, const Location& place,
                                    const Field& field, Faults& faults) {
  const auto wanted = unit_of(field.unit);
  const auto value = wanted ? value_in(quantity.number, unit, *wanted) : std::nullopt;
  if (value) return value;
  const std::string found = "found " + described(*place.node) + ", must be ";
  if (field.unit == "-")
    faults.add(place.pointer, found + "a pure number");
  else
    faults.add(place.pointer, found + "in a unit of the same dimension as " + std::string(field.unit));
  return {};
}

}  // namespace

void check_coherent_unit(const std::string& unit, const std::string& pointer, Faults& faults) {
  if (const std::string why = objection_to_unit(unit); !why.empty()) faults.add(pointer, why);
}

void add_formula_fault(const formula::FormulaError& error, const std::string& pointer,
                       std::vector<std::string> names, Faults& faults) {
  const formula::FormulaFault& fault = error.fault();
  using Kind = formula::FormulaFault::Kind;
  if (fault.kind == Kind::text) return faults.add(pointer, error.what());
  if (fault.kind == Kind::unknown_function) {
    names.clear();
    for (const formula::Function& function : formula::functions()) names.emplace_back(function.name);
  }
  faults.add(pointer,
             std::string(error.what()) + ", must be one of " + listed(names) + hint(fault.name, names));
}

std::optional<GivenNumber> read_given_number(const Location& place, const Field& bounds, Faults& faults) {
  if (place.node == nullptr) return {};
  GivenNumber given;
  if (const auto* number = place.node->get<double>()) {
    given.value = *number;
  } else if (const auto* text = place.node->get<std::string>()) {
    given.text = *text;
    const auto quantity = split_quantity(*text);
    const auto unit = quantity ? unit_of(quantity->unit) : std::nullopt;
    if (unit) {
      const auto value = read_quantity(*quantity, *unit, place, bounds, faults);
      if (!value) return {};
      given.value = *value;
    } else {
      try {
        const formula::Formula formula(std::span(text, 1), [&](std::string_view) {
          given.follows = true;
          return std::optional(0);
        });
        if (given.follows) return given;
        given.value = formula.value({});
      } catch (const formula::FormulaError& error) {
        if (const std::string objection = objection_to_number(*text); !objection.empty())
          faults.add(place.pointer, objection);
        else
          add_formula_fault(error, place.pointer, {}, faults);
        return {};
      }
    }
  } else if (place.node->get<Oversized>() != nullptr) {
    add_wrong_type(place, "a finite number of at most 1.797e308 in size", faults);
    return {};
  } else {
    const std::string allowed = allowed_text(bounds);
    add_wrong_type(place, allowed.starts_with("a finite") ? allowed : "a number, " + allowed, faults);
    return {};
  }
  if (within(bounds, given.value)) return given;
  faults.add(place.pointer, bound_fault(bounds, given.value));
  return {};
}

std::optional<double> read_number(const Location& place, const Field& bounds, Faults& faults) {
  const auto given = read_given_number(place, bounds, faults);
  if (!given) return {};
  if (!given->follows) return given->value;
  faults.add(place.pointer, "found " + shown(given->text) +
                                ", a formula of parameters, must be a number; it would not follow them");
  return {};
}

std::optional<int> read_integer(const Location& place, int lower, int upper, Faults& faults,
                                std::string_view why) {
  if (place.node == nullptr) return {};
  const auto* number = place.node->get<double>();
  if (number != nullptr && *number == std::floor(*number) && *number >= lower && *number <= upper)
    return static_cast<int>(*number);
  const std::string found = number != nullptr ? number_text(*number) : described(*place.node);
  faults.add(place.pointer, "found " + found + ", must be an integer from " + std::to_string(lower) + " to " +
                                std::to_string(upper) + std::string(why));
  return {};
}

std::optional<std::string> read_string(const Location& place, std::string_view what, Faults& faults) {
  if (place.node == nullptr) return {};
  if (const auto* text = place.node->get<std::string>()) return *text;
  add_wrong_type(place, what, faults);
  return {};
}

const Node::List* read_list(const Location& place, std::string_view what, Faults& faults) {
  if (place.node == nullptr) return nullptr;
  const auto* list = place.node->get<Node::List>();
  if (list == nullptr) add_wrong_type(place, what, faults);
  return list;
}

std::optional<std::vector<double>> read_factors(const Location& place, int count, const Field& bounds,
                                                const std::string& what, Faults& faults) {
  const std::string wanted = "a list of " + std::to_string(count) + " numbers, " + what;
  const std::size_t before = faults.count();
  const Node::List* list = read_list(place, wanted, faults);
  if (list == nullptr) return {};
  if (list->size() != static_cast<std::size_t>(count)) {
    faults.add(place.pointer, "found a list of " + std::to_string(list->size()) + ", must be " + wanted);
    return {};
  }
  std::vector<double> factors;
  for (std::size_t i = 0; i < list->size(); ++i)
    factors.push_back(read_number({&(*list)[i], child(place.pointer, i)}, bounds, faults).value_or(1));
  return faults.count() == before ? std::optional(factors) : std::nullopt;
}

}  // namespace arcslip::scene::file
