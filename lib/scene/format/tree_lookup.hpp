#pragma once
// What is found in a tree that is changed before it is read. Of duplicate keys the first counts, which the
// reader reports.

#include <arcslip/scene/keys/json_tree.hpp>

#include <algorithm>
#include <string_view>

namespace arcslip::scene::file {

inline Node* find(Node::Object& object, std::string_view key) {
  const auto found =
      std::find_if(object.begin(), object.end(), [&](const Member& m) { return m.key == key; });
  return found != object.end() ? &found->value : nullptr;
}

/// Null where the node is no object or has no such key.
inline Node* find(Node* object, std::string_view key) {
  auto* members = object != nullptr ? std::get_if<Node::Object>(&object->value) : nullptr;
  return members != nullptr ? find(*members, key) : nullptr;
}

inline Node::List* list_in(Node* object, std::string_view key) {
  Node* found = find(object, key);
  return found != nullptr ? std::get_if<Node::List>(&found->value) : nullptr;
}

}  // namespace arcslip::scene::file
