#include <arcslip/scene/keys/read_values.hpp>

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

std::optional<double> read_number(const Location& place, const Field& bounds, Faults& faults) {
  if (place.node == nullptr) return {};
  if (const auto* number = place.node->get<double>()) {
    if (within(bounds, *number)) return *number;
    faults.add(place.pointer, bound_fault(bounds, *number));
  } else if (place.node->get<Oversized>() != nullptr) {
    add_wrong_type(place, "a finite number of at most 1.797e308 in size", faults);
  } else {
    const std::string allowed = allowed_text(bounds);
    add_wrong_type(place, allowed.starts_with("a finite") ? allowed : "a number, " + allowed, faults);
  }
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
