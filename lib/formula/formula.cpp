#include <arcslip/formula/formula.hpp>

#include <algorithm>
#include <utility>

namespace arcslip::formula {
std::vector<char> needed_by(std::span<const Node> nodes, std::span<const int> results) {
  std::vector<char> needed(nodes.size());
  for (const int result : results) needed[static_cast<std::size_t>(result)] = 1;
  for (std::size_t n = nodes.size(); n-- > 0;) {
    if (!needed[n]) continue;
    for (const int argument : {nodes[n].a, nodes[n].b, nodes[n].c})
      if (argument >= 0) needed[static_cast<std::size_t>(argument)] = 1;
  }
  return needed;
}

InputOf names_of(std::span<const std::string_view> names) {
  return [all = std::vector<std::string>(names.begin(), names.end())](
             std::string_view name) -> std::optional<int> {
    const auto at = std::find(all.begin(), all.end(), name);
    if (at == all.end()) return {};
    return static_cast<int>(at - all.begin());
  };
}

bool Formula::uses(std::size_t expression, int input) const {
  const std::vector<char> needed = needed_by(nodes_, std::span(&results_[expression], 1));
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (needed[n] && nodes_[n].operation == Operation::input && nodes_[n].input() == input) return true;
  return false;
}

bool Formula::uses(int input) const {
  return std::any_of(nodes_.begin(), nodes_.end(), [input](const Node& node) {
    return node.operation == Operation::input && node.input() == input;
  });
}

}  // namespace arcslip::formula
