#include <arcslip/ensemble/difference.hpp>

#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/keys/json_tree.hpp>

#include <algorithm>

namespace arcslip::ensemble {
namespace {

using scene::file::Node;

std::string difference_at(const std::string& pointer, const Node& before, const Node& now) {
  const auto *list = before.get<Node::List>(), *other_list = now.get<Node::List>();
  if (list != nullptr && other_list != nullptr && list->size() == other_list->size()) {
    for (std::size_t i = 0; i < list->size(); ++i)
      if (std::string text = difference_at(scene::file::child(pointer, i), (*list)[i], (*other_list)[i]);
          !text.empty())
        return text;
    return {};
  }
  const auto *object = before.get<Node::Object>(), *other = now.get<Node::Object>();
  if (object != nullptr && other != nullptr) {
    const bool same_keys = std::equal(object->begin(), object->end(), other->begin(), other->end(),
                                      [](const auto& a, const auto& b) { return a.key == b.key; });
    for (std::size_t i = 0; same_keys && i < object->size(); ++i)
      if (std::string text = difference_at(scene::file::child(pointer, (*object)[i].key), (*object)[i].value,
                                           (*other)[i].value);
          !text.empty())
        return text;
    return same_keys ? "" : pointer + " had other keys";
  }
  const std::string was = scene::file::print_tree(before), is = scene::file::print_tree(now);
  if (was == is) return {};
  return pointer + " was " + scene::file::described(before) + ", is " + scene::file::described(now);
}

}  // namespace

std::string first_difference(const std::string& before, const std::string& now) {
  return difference_at("", scene::file::read_tree(before), scene::file::read_tree(now));
}

}  // namespace arcslip::ensemble
