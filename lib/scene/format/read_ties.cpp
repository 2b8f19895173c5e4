#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/read_studies.hpp>

#include <unordered_map>

namespace arcslip::scene::file {
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
                                   faults.reported(first->second) + "; a field must be tied only once");
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

}  // namespace arcslip::scene::file
