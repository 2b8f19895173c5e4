#include <arcslip/formula/formula.hpp>

#include <arcslip/formula/tape_builder.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace arcslip::formula {
namespace {

/// One number for each node, without an allocation where there are few.
class NodeValues {
 public:
  explicit NodeValues(std::size_t nodes) : many_(nodes > few_.size() ? nodes : 0) {}
  double& operator[](int node) {
    const auto n = static_cast<std::size_t>(node);
    return many_.empty() ? few_[n] : many_[n];
  }
  double at_or_zero(int node) { return node < 0 ? 0.0 : (*this)[node]; }

 private:
  std::array<double, largest_size> few_;
  std::vector<double> many_;
};

void set_values(std::span<const Node> nodes, std::span<const double> inputs, int last, NodeValues& f) {
  for (int n = 0; n <= last; ++n) {
    const Node& node = nodes[static_cast<std::size_t>(n)];
    if (node.operation == Operation::constant)
      f[n] = node.value;
    else if (node.operation == Operation::input)
      f[n] = inputs[static_cast<std::size_t>(node.input())];
    else
      f[n] =
          rule(node.operation)
              .value(f[node.a], node.operation == Operation::whole_power ? node.value : f.at_or_zero(node.b),
                     f.at_or_zero(node.c));
  }
}

// The derivative of a node, by those of its arguments. What does not change has no part in it, whatever the
// slope by it is.
double rate_of(const Node& node, int n, NodeValues& f, NodeValues& rates) {
  if (node.operation == Operation::choose) return rates[f[node.a] != 0 ? node.b : node.c];
  const Rule& by = rule(node.operation);
  const double b = node.operation == Operation::whole_power ? node.value : f.at_or_zero(node.b);
  double rate = 0;
  if (by.by_a != nullptr && rates[node.a] != 0) rate += by.by_a(f[node.a], b, f[n]) * rates[node.a];
  if (by.by_b != nullptr && node.b >= 0 && rates[node.b] != 0)
    rate += by.by_b(f[node.a], b, f[n]) * rates[node.b];
  return rate;
}

}  // namespace

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

double Formula::value(std::span<const double> inputs) const {
  NodeValues f(nodes_.size());
  set_values(nodes_, inputs, results_.front(), f);
  return f[results_.front()];
}

double Formula::derivative(std::span<const double> inputs, int input) const {
  const int last = results_.front();
  NodeValues f(nodes_.size()), rates(nodes_.size());
  set_values(nodes_, inputs, last, f);
  for (int n = 0; n <= last; ++n) {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    if (node.operation == Operation::constant)
      rates[n] = 0;
    else if (node.operation == Operation::input)
      rates[n] = node.input() == input ? 1 : 0;
    else
      rates[n] = rate_of(node, n, f, rates);
  }
  return rates[last];
}

Formula input(int index) {
  return {{{Operation::input, -1, -1, -1, static_cast<double>(index)}}, {0}};
}

Formula composed(const Formula& formula, std::span<const Formula> inputs) {
  TapeBuilder tape;
  // Puts the nodes of a formula on the tape, and gives their places there.
  const auto put = [&tape](std::span<const Node> nodes, const std::vector<int>* of_inputs) {
    std::vector<int> at(nodes.size());
    const auto place = [&at](int node) { return node < 0 ? -1 : at[static_cast<std::size_t>(node)]; };
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Node& node = nodes[n];
      at[n] = of_inputs != nullptr && node.operation == Operation::input
                  ? (*of_inputs)[static_cast<std::size_t>(node.input())]
                  : tape.add(node.operation, place(node.a), place(node.b), place(node.c), node.value);
    }
    return at;
  };
  std::vector<int> of_inputs;
  for (const Formula& input : inputs)
    of_inputs.push_back(put(input.nodes(), nullptr)[static_cast<std::size_t>(input.results().front())]);
  const std::vector<int> at = put(formula.nodes(), &of_inputs);
  std::vector<int> results;
  for (const int result : formula.results()) results.push_back(at[static_cast<std::size_t>(result)]);
  return {tape.take(), std::move(results)};
}

}  // namespace arcslip::formula
