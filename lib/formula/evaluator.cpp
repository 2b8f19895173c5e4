#include <arcslip/formula/evaluator.hpp>

#include <arcslip/formula/operations.hpp>

#include <algorithm>
#include <cstdlib>

namespace arcslip::formula {
namespace {

constexpr std::size_t largest_block = 64;  // samples at once

// A factor 0 stands for what a choice does not take: its derivative may be anything.
double chained(double adjoint, double derivative) {
  return adjoint == 0 ? 0.0 : adjoint * derivative;
}

// f = x^n, in the order of whole_power().
void set_powers(const double* x, int n, std::size_t count, double* __restrict f) {
  if (n == 2 || n == 3) {  // most of all
    for (std::size_t s = 0; s < count; ++s) f[s] = x[s] * x[s];
    for (std::size_t s = 0; n == 3 && s < count; ++s) f[s] *= x[s];
    return;
  }
  double base[largest_block];
  std::copy_n(x, count, base);
  std::fill_n(f, count, 1.0);
  for (int left = std::abs(n); left > 0; left /= 2) {
    if (left % 2 == 1)
      for (std::size_t s = 0; s < count; ++s) f[s] *= base[s];
    if (left > 1)
      for (std::size_t s = 0; s < count; ++s) base[s] *= base[s];
  }
  for (std::size_t s = 0; n < 0 && s < count; ++s) f[s] = 1 / f[s];
}

template <class Function>
void for_each(std::size_t count, Function function) {
  for (std::size_t s = 0; s < count; ++s) function(s);
}

}  // namespace

Evaluator::Evaluator(const Formula& formula)
    : formula_(formula),
      varies_(formula.nodes().size()),
      active_(formula.nodes().size()),
      at_(formula.nodes().size()),
      reached_(formula.nodes().size()) {}

bool Evaluator::has_marks(std::span<const InputValues> inputs,
                          std::span<const Derivative> derivatives) const {
  return std::equal(inputs.begin(), inputs.end(), marked_inputs_.begin(), marked_inputs_.end(),
                    [](const InputValues& input, char varies) { return input.varies == (varies != 0); }) &&
         std::equal(derivatives.begin(), derivatives.end(), marked_derivatives_.begin(),
                    marked_derivatives_.end(),
                    [](const Derivative& derivative, int input) { return derivative.input == input; });
}

void Evaluator::set_marks(std::span<const InputValues> inputs, std::span<const Derivative> derivatives) {
  if (has_marks(inputs, derivatives)) return;
  marked_inputs_.clear();
  for (const InputValues& input : inputs) marked_inputs_.push_back(input.varies);
  marked_derivatives_.clear();
  for (const Derivative& derivative : derivatives) marked_derivatives_.push_back(derivative.input);
  const auto nodes = formula_.nodes();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Node& node = nodes[n];
    bool varies = false, active = false;
    if (node.operation == Operation::input) {
      varies = inputs[static_cast<std::size_t>(node.input())].varies;
      for (const Derivative& derivative : derivatives) active = active || derivative.input == node.input();
    } else {
      for (const int argument : {node.a, node.b, node.c}) {
        if (argument < 0) continue;
        varies = varies || varies_[static_cast<std::size_t>(argument)];
        active = active || active_[static_cast<std::size_t>(argument)];
      }
    }
    varies_[n] = varies;
    active_[n] = active;
  }
}

void Evaluator::compute(std::span<const InputValues> inputs, std::size_t samples,
                        std::span<double* const> values, std::span<const Derivative> derivatives) {
  const auto results = formula_.results();
  set_marks(inputs, derivatives);
  const std::size_t wanted = std::min(samples, largest_block);
  if (stride_ < wanted) {
    stride_ = wanted;
    values_.assign(formula_.nodes().size() * stride_, 0);
    adjoints_.assign(values_.size(), 0);
  }
  for (std::size_t from = 0; from < samples; from += largest_block) {
    const std::size_t count = std::min(largest_block, samples - from);
    compute_values(inputs, from, count);
    for (std::size_t k = 0; k < results.size(); ++k) {
      if (k < values.size() && values[k] != nullptr)
        std::copy_n(values_of(results[k]), count, values[k] + from);
      bool differentiated = false;
      for (const Derivative& derivative : derivatives) {
        if (derivative.expression != k) continue;
        if (!differentiated) go_back(k, count);
        differentiated = true;
        std::fill_n(derivative.to + from, count, 0.0);
      }
      if (!differentiated) continue;
      for (int n = 0; n <= results[k]; ++n) {
        const Node& node = formula_.nodes()[static_cast<std::size_t>(n)];
        if (node.operation != Operation::input || !active_[static_cast<std::size_t>(n)] ||
            !reached_[static_cast<std::size_t>(n)])
          continue;
        for (const Derivative& derivative : derivatives)
          if (derivative.expression == k && derivative.input == node.input())
            std::copy_n(adjoints_of(n), count, derivative.to + from);
      }
    }
  }
}

void Evaluator::compute_values(std::span<const InputValues> inputs, std::size_t from, std::size_t count) {
  const auto nodes = formula_.nodes();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Node& node = nodes[n];
    double* const __restrict f = values_.data() + n * stride_;
    at_[n] = f;
    if (node.operation == Operation::input) {
      const InputValues& input = inputs[static_cast<std::size_t>(node.input())];
      if (input.varies)
        at_[n] = input.at + from;
      else
        std::fill_n(f, count, *input.at);
      continue;
    }
    const double* const a = node.a < 0 ? f : values_of(node.a);
    const double* const b = node.b < 0 ? f : values_of(node.b);
    const double* const c = node.c < 0 ? f : values_of(node.c);
    const double second = node.operation == Operation::whole_power ? node.value : *b;
    if (!varies_[n])
      std::fill_n(
          f, count,
          node.operation == Operation::constant ? node.value : rule(node.operation).value(*a, second, *c));
    else
      set_values(node, count, f, a, b, c);
  }
}

void Evaluator::set_values(const Node& node, std::size_t count, double* __restrict f, const double* a,
                           const double* b, const double* c) {
  const auto value = rule(node.operation).value;
  switch (node.operation) {
    case Operation::negate:
      for_each(count, [&](std::size_t s) { f[s] = -a[s]; });
      break;
    case Operation::add:
      for_each(count, [&](std::size_t s) { f[s] = a[s] + b[s]; });
      break;
    case Operation::subtract:
      for_each(count, [&](std::size_t s) { f[s] = a[s] - b[s]; });
      break;
    case Operation::multiply:
      for_each(count, [&](std::size_t s) { f[s] = a[s] * b[s]; });
      break;
    case Operation::divide:
      for_each(count, [&](std::size_t s) { f[s] = a[s] / b[s]; });
      break;
    case Operation::whole_power:
      set_powers(a, static_cast<int>(node.value), count, f);
      break;
    default:
      for_each(count, [&](std::size_t s) { f[s] = value(a[s], b[s], c[s]); });
  }
}

// The derivatives of an expression by each node: 1 by itself, and those by the arguments of a node from that
// by the node, by the chain rule.
void Evaluator::go_back(std::size_t expression, std::size_t count) {
  const auto nodes = formula_.nodes();
  const int last = formula_.results()[expression];
  std::fill_n(reached_.begin(), last + 1, char(0));
  std::fill_n(adjoints_of(last), count, 1.0);
  reached_[static_cast<std::size_t>(last)] = 1;
  for (int n = last; n >= 0; --n) {
    const auto at = static_cast<std::size_t>(n);
    if (active_[at] && reached_[at] && nodes[at].operation != Operation::input) pass_on(nodes[at], n, count);
  }
}

void Evaluator::pass_on(const Node& node, int n, std::size_t count) {
  const double* const __restrict g = adjoints_of(n);
  const double *const f = values_of(n), *const a = values_of(node.a);
  const double* const b = node.b < 0 ? a : values_of(node.b);
  // Adds the derivative, a function of the sample, to that by an argument.
  const auto add = [&](int argument, auto derivative) {
    if (argument < 0 || !active_[static_cast<std::size_t>(argument)]) return;
    double* const to = adjoints_of(argument);
    char& reached = reached_[static_cast<std::size_t>(argument)];
    if (reached)
      for (std::size_t s = 0; s < count; ++s) to[s] += derivative(s);
    else
      for (std::size_t s = 0; s < count; ++s) to[s] = derivative(s);
    reached = 1;
  };
  const Rule& by = rule(node.operation);
  switch (node.operation) {
    case Operation::add:
      add(node.a, [&](std::size_t s) { return g[s]; });
      add(node.b, [&](std::size_t s) { return g[s]; });
      break;
    case Operation::subtract:
      add(node.a, [&](std::size_t s) { return g[s]; });
      add(node.b, [&](std::size_t s) { return -g[s]; });
      break;
    case Operation::multiply:
      add(node.a, [&](std::size_t s) { return chained(g[s], b[s]); });
      add(node.b, [&](std::size_t s) { return chained(g[s], a[s]); });
      break;
    case Operation::whole_power: {
      double lower[largest_block];
      set_powers(a, static_cast<int>(node.value) - 1, count, lower);
      add(node.a, [&](std::size_t s) { return chained(node.value * g[s], lower[s]); });
      break;
    }
    case Operation::choose:
      add(node.b, [&](std::size_t s) { return a[s] != 0 ? g[s] : 0.0; });
      add(node.c, [&](std::size_t s) { return a[s] != 0 ? 0.0 : g[s]; });
      break;
    default:
      if (by.by_a != nullptr)
        add(node.a, [&](std::size_t s) { return chained(g[s], by.by_a(a[s], b[s], f[s])); });
      if (by.by_b != nullptr)
        add(node.b, [&](std::size_t s) { return chained(g[s], by.by_b(a[s], b[s], f[s])); });
  }
}

}  // namespace arcslip::formula
