#include <arcslip/formula/evaluator.hpp>

#include <arcslip/formula/operations.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace arcslip::formula {
namespace {

constexpr std::size_t largest_block = 64;  // samples at once
constexpr std::size_t no_program = static_cast<std::size_t>(-1);

// A factor 0 stands for what a choice does not take: its derivative may be anything.
double chained(double adjoint, double derivative) {
  return adjoint == 0 ? 0.0 : adjoint * derivative;
}

// f = x^n, in the order of whole_power().
void set_powers(const double* x, int n, std::size_t count, double* __restrict f) {
  if (n == 2) {  // these most of all
    for (std::size_t s = 0; s < count; ++s) f[s] = x[s] * x[s];
    return;
  }
  if (n == 3) {
    for (std::size_t s = 0; s < count; ++s) f[s] = x[s] * x[s] * x[s];
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

// Whether a derivative goes from a node to its argument a, b or c.
std::array<bool, 3> passes(Operation operation) {
  switch (operation) {  // those that pass_on() knows itself
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::whole_power:
      return {true, true, false};
    case Operation::choose:
      return {false, true, true};
    default:
      return {rule(operation).by_a != nullptr, rule(operation).by_b != nullptr, false};
  }
}

template <class Function>
void for_each(std::size_t count, Function function) {
  for (std::size_t s = 0; s < count; ++s) function(s);
}

}  // namespace

Evaluator::Evaluator(const Formula& formula)
    : formula_(formula),
      constants_of_(no_program),
      at_(formula.nodes().size()),
      results_at_(formula.nodes().size()),
      adjoints_at_(formula.nodes().size()) {}

std::size_t Evaluator::prepare(std::span<const InputValues> inputs, std::span<const Derivative> derivatives) {
  const auto fits = [&](const Program& program) {
    return std::equal(inputs.begin(), inputs.end(), program.varying_inputs.begin(),
                      program.varying_inputs.end(),
                      [](const InputValues& input, char varies) { return input.varies == (varies != 0); }) &&
           std::equal(derivatives.begin(), derivatives.end(), program.derivatives.begin(),
                      program.derivatives.end(), [](const Derivative& derivative, const auto& own) {
                        return derivative.expression == own.first && derivative.input == own.second;
                      });
  };
  const auto number =
      static_cast<std::size_t>(std::find_if(programs_.begin(), programs_.end(), fits) - programs_.begin());
  if (number == programs_.size()) programs_.push_back(make_program(inputs, derivatives));
  return number;
}

Evaluator::Program Evaluator::make_program(std::span<const InputValues> inputs,
                                           std::span<const Derivative> derivatives) const {
  Program program;
  for (const InputValues& input : inputs) program.varying_inputs.push_back(input.varies);
  for (const Derivative& derivative : derivatives)
    program.derivatives.emplace_back(derivative.expression, derivative.input);
  const auto nodes = formula_.nodes();
  std::vector<char> varies(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Node& node = nodes[n];
    const int at = static_cast<int>(n);
    if (node.operation == Operation::input)
      varies[n] = inputs[static_cast<std::size_t>(node.input())].varies;
    else
      for (const int argument : {node.a, node.b, node.c})
        if (argument >= 0 && varies[static_cast<std::size_t>(argument)] != 0) varies[n] = 1;
    if (varies[n] == 0)
      program.constants.push_back(at);
    else if (node.operation == Operation::input)
      program.given.emplace_back(at, node.input());
    else
      program.steps.push_back(at);
  }
  std::vector<char> taken(nodes.size());
  for (std::size_t k = 0; k < formula_.results().size(); ++k) {
    const int node = formula_.results()[k];
    const bool is_step = varies[static_cast<std::size_t>(node)] != 0 &&
                         nodes[static_cast<std::size_t>(node)].operation != Operation::input;
    const bool is_first = std::exchange(taken[static_cast<std::size_t>(node)], char(1)) == 0;
    (is_step && is_first ? program.results : program.copies).emplace_back(node, k);
  }
  for (std::size_t k = 0; k < formula_.results().size(); ++k)
    if (std::any_of(derivatives.begin(), derivatives.end(),
                    [&](const Derivative& derivative) { return derivative.expression == k; }))
      program.sweeps.push_back(make_sweep(k, derivatives));
  return program;
}

Evaluator::Program::Sweep Evaluator::make_sweep(std::size_t expression,
                                                std::span<const Derivative> derivatives) const {
  using Pass = Program::Pass;
  const int last = formula_.results()[expression];
  const std::vector<char> active = active_nodes(expression, derivatives);
  std::vector<char> reached(active.size());
  reached.back() = 1;
  Program::Sweep sweep{expression, {}, {}, {}};
  const auto is_active = [&](int n) { return n >= 0 && active[static_cast<std::size_t>(n)] != 0; };
  for (int n = last; n >= 0; --n) {
    const Node& node = formula_.nodes()[static_cast<std::size_t>(n)];
    if (!is_active(n) || reached[static_cast<std::size_t>(n)] == 0) continue;
    if (node.operation == Operation::input) {
      for (std::size_t d = 0; d < derivatives.size(); ++d)
        if (derivatives[d].expression == expression && derivatives[d].input == node.input())
          sweep.ends.emplace_back(n, d);
      continue;
    }
    const auto to = passes(node.operation);
    const auto pass = [&](int argument, bool depends) {
      if (!depends || !is_active(argument)) return Pass::none;
      const bool first = std::exchange(reached[static_cast<std::size_t>(argument)], char(1)) == 0;
      return first ? Pass::set : Pass::add;
    };
    const Pass a = pass(node.a, to[0]), b = pass(node.b, to[1]), c = pass(node.c, to[2]);
    sweep.steps.push_back({n, a, b, c});
  }
  for (std::size_t d = 0; d < derivatives.size(); ++d)
    if (derivatives[d].expression == expression &&
        std::none_of(sweep.ends.begin(), sweep.ends.end(), [d](const auto& end) { return end.second == d; }))
      sweep.zeros.push_back(d);
  return sweep;
}

// Those of an expression through which its derivatives go.
std::vector<char> Evaluator::active_nodes(std::size_t expression,
                                          std::span<const Derivative> derivatives) const {
  const auto nodes = formula_.nodes();
  std::vector<char> active(static_cast<std::size_t>(formula_.results()[expression]) + 1);
  for (std::size_t n = 0; n < active.size(); ++n) {
    const Node& node = nodes[n];
    if (node.operation == Operation::input)
      active[n] = std::any_of(derivatives.begin(), derivatives.end(), [&](const Derivative& derivative) {
        return derivative.expression == expression && derivative.input == node.input();
      });
    else
      for (const int argument : {node.a, node.b, node.c})
        if (argument >= 0 && active[static_cast<std::size_t>(argument)] != 0) active[n] = 1;
  }
  return active;
}

void Evaluator::reserve(std::size_t samples) {
  const std::size_t wanted = std::min(samples, largest_block);
  if (stride_ >= wanted) return;
  stride_ = wanted;
  values_.assign(formula_.nodes().size() * stride_, 0);
  adjoints_.assign(values_.size(), 0);
  for (std::size_t n = 0; n < at_.size(); ++n) {
    at_[n] = results_at_[n] = own_values(static_cast<int>(n));
    adjoints_at_[n] = own_adjoints(static_cast<int>(n));
  }
  constants_of_ = no_program;
}

void Evaluator::compute(std::size_t number, std::span<const InputValues> inputs, std::size_t samples,
                        std::span<double* const> values, std::span<const Derivative> derivatives) {
  if (samples == 0) return;
  const Program& program = programs_[number];
  reserve(samples);
  set_constants(number, inputs);
  const auto wanted = [&](std::size_t k) { return k < values.size() && values[k] != nullptr; };
  for (std::size_t from = 0; from < samples; from += largest_block) {
    const std::size_t count = std::min(largest_block, samples - from);
    for (const auto& [node, input] : program.given)
      at_[static_cast<std::size_t>(node)] = inputs[static_cast<std::size_t>(input)].at + from;
    for (const auto& [node, k] : program.results)
      results_at_[static_cast<std::size_t>(node)] = wanted(k) ? values[k] + from : own_values(node);
    for (const int node : program.steps) set_values(node, count);
    for (const auto& [node, k] : program.copies)
      if (wanted(k)) std::copy_n(values_of(node), count, values[k] + from);
    for (const Program::Sweep& sweep : program.sweeps) {
      for (const auto& [node, derivative] : sweep.ends)
        adjoints_at_[static_cast<std::size_t>(node)] = derivatives[derivative].to + from;
      go_back(sweep, count);
      for (const auto& [node, derivative] : sweep.ends)
        if (double* const to = derivatives[derivative].to + from; to != adjoints_of(node))
          std::copy_n(adjoints_of(node), count, to);
      for (const auto& [node, derivative] : sweep.ends)
        adjoints_at_[static_cast<std::size_t>(node)] = own_adjoints(node);
      for (const std::size_t derivative : sweep.zeros)
        std::fill_n(derivatives[derivative].to + from, count, 0.0);
    }
  }
}

// Those of the last call serve where no input has changed.
void Evaluator::set_constants(std::size_t number, std::span<const InputValues> inputs) {
  bool changed = constants_of_ != number;
  constants_of_ = number;
  for (const int n : programs_[number].constants) {
    const Node& node = formula_.nodes()[static_cast<std::size_t>(n)];
    double* const f = own_values(n);
    double value = node.value;
    if (node.operation == Operation::input) {
      value = *inputs[static_cast<std::size_t>(node.input())].at;
      changed = changed || value != *f || std::signbit(value) != std::signbit(*f);
    }
    if (!changed) continue;
    at_[static_cast<std::size_t>(n)] = f;
    const double *const a = node.a < 0 ? f : values_of(node.a), *const b = node.b < 0 ? f : values_of(node.b),
                        *const c = node.c < 0 ? f : values_of(node.c);
    if (node.operation != Operation::input && node.operation != Operation::constant)
      value = rule(node.operation).value(*a, node.operation == Operation::whole_power ? node.value : *b, *c);
    std::fill_n(f, stride_, value);
  }
}

void Evaluator::set_values(int n, std::size_t count) {
  const Node& node = formula_.nodes()[static_cast<std::size_t>(n)];
  double* const __restrict f = results_at_[static_cast<std::size_t>(n)];
  at_[static_cast<std::size_t>(n)] = f;
  const double* const a = values_of(node.a);
  const double* const b = node.b < 0 ? a : values_of(node.b);
  const double* const c = node.c < 0 ? a : values_of(node.c);
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
    default: {
      const auto value = rule(node.operation).value;
      for_each(count, [&](std::size_t s) { f[s] = value(a[s], b[s], c[s]); });
    }
  }
}

// The derivatives of an expression by each node: 1 by itself, and those by the arguments of a node from that
// by the node, by the chain rule.
void Evaluator::go_back(const Program::Sweep& sweep, std::size_t count) {
  const int last = formula_.results()[sweep.expression];
  if (sweep.steps.empty() ||
      formula_.nodes()[static_cast<std::size_t>(last)].operation != Operation::multiply)
    std::fill_n(adjoints_of(last), count, 1.0);
  for (const Program::Back& step : sweep.steps) pass_on(step, step.node == last, count);
}

void Evaluator::pass_on(const Program::Back& step, bool is_last, std::size_t count) {
  using Pass = Program::Pass;
  const Node& node = formula_.nodes()[static_cast<std::size_t>(step.node)];
  const double* const __restrict g = adjoints_of(step.node);
  const double *const f = values_of(step.node), *const a = values_of(node.a);
  const double* const b = node.b < 0 ? a : values_of(node.b);
  // Brings the derivative, a function of the sample, to that by an argument.
  const auto pass = [&](Pass how, int argument, auto derivative) {
    if (how == Pass::none) return;
    double* const to = adjoints_of(argument);
    if (how == Pass::add)
      for (std::size_t s = 0; s < count; ++s) to[s] += derivative(s);
    else
      for (std::size_t s = 0; s < count; ++s) to[s] = derivative(s);
  };
  const Rule& by = rule(node.operation);
  switch (node.operation) {
    case Operation::add:
      pass(step.a, node.a, [&](std::size_t s) { return g[s]; });
      pass(step.b, node.b, [&](std::size_t s) { return g[s]; });
      break;
    case Operation::subtract:
      pass(step.a, node.a, [&](std::size_t s) { return g[s]; });
      pass(step.b, node.b, [&](std::size_t s) { return -g[s]; });
      break;
    case Operation::multiply:
      if (is_last) {  // g = 1
        pass(step.a, node.a, [&](std::size_t s) { return b[s]; });
        pass(step.b, node.b, [&](std::size_t s) { return a[s]; });
        break;
      }
      pass(step.a, node.a, [&](std::size_t s) { return chained(g[s], b[s]); });
      pass(step.b, node.b, [&](std::size_t s) { return chained(g[s], a[s]); });
      break;
    case Operation::whole_power: {
      if (node.value == 3) {
        pass(step.a, node.a, [&](std::size_t s) { return chained(3 * g[s], a[s] * a[s]); });
        break;
      }
      double lower[largest_block];
      set_powers(a, static_cast<int>(node.value) - 1, count, lower);
      pass(step.a, node.a, [&](std::size_t s) { return chained(node.value * g[s], lower[s]); });
      break;
    }
    case Operation::choose:
      pass(step.b, node.b, [&](std::size_t s) { return a[s] != 0 ? g[s] : 0.0; });
      pass(step.c, node.c, [&](std::size_t s) { return a[s] != 0 ? 0.0 : g[s]; });
      break;
    default:
      pass(step.a, node.a, [&](std::size_t s) { return chained(g[s], by.by_a(a[s], b[s], f[s])); });
      pass(step.b, node.b, [&](std::size_t s) { return chained(g[s], by.by_b(a[s], b[s], f[s])); });
  }
}

}  // namespace arcslip::formula
