#pragma once
// The nodes of a tape while it grows.

#include <arcslip/formula/formula.hpp>

#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

namespace arcslip::formula {

/// Equal nodes are one node, and what has constants alone is a constant.
class TapeBuilder {
 public:
  /// The index of such a node.
  int add(Operation operation, int a, int b = -1, int c = -1, double value = 0);
  int add_constant(double value) { return add(Operation::constant, -1, -1, -1, value); }
  const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  bool is_constant(int node) const { return at(node).operation == Operation::constant; }
  std::size_t size() const { return nodes_.size(); }
  std::vector<Node> take() { return std::move(nodes_); }

 private:
  struct Hash {
    std::size_t operator()(const Node& node) const;
  };
  std::vector<Node> nodes_;
  std::unordered_map<Node, int, Hash> known_;
};

}  // namespace arcslip::formula
