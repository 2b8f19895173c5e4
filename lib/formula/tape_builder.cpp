#include <arcslip/formula/tape_builder.hpp>

#include <bit>

namespace arcslip::formula {
namespace {

double known_value(Operation operation, double value, double a, double b, double c) {
  if (operation == Operation::constant) return value;
  return rule(operation).value(a, operation == Operation::whole_power ? value : b, c);
}

}  // namespace

std::size_t TapeBuilder::Hash::operator()(const Node& node) const {
  std::size_t hash = static_cast<std::size_t>(node.operation);
  for (const std::size_t part : {static_cast<std::size_t>(node.a), static_cast<std::size_t>(node.b),
                                 static_cast<std::size_t>(node.c), std::bit_cast<std::size_t>(node.value)})
    hash = (hash ^ part) * 0x9e3779b97f4a7c15ull + (hash >> 29);
  return hash;
}

int TapeBuilder::add(Operation operation, int a, int b, int c, double value) {
  Node node{operation, a, b, c, value};
  const auto value_of = [this](int at) { return at < 0 ? 0.0 : this->at(at).value; };
  const bool known = operation != Operation::input && (a < 0 || is_constant(a)) &&
                     (b < 0 || is_constant(b)) && (c < 0 || is_constant(c));
  if (known)
    node = {Operation::constant, -1, -1, -1,
            known_value(operation, value, value_of(a), value_of(b), value_of(c))};
  const auto [place, is_new] = known_.emplace(node, static_cast<int>(nodes_.size()));
  if (is_new) nodes_.push_back(node);
  return place->second;
}

}  // namespace arcslip::formula
