#include <arcslip/formula/facts.hpp>

#include <arcslip/formula/operations.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace arcslip::formula {
namespace {

constexpr int largest_degree = 1 << 20;  // of what is followed at all
constexpr double largest_order = 1000;

/// Facts of the nodes up to that of an expression, each from those of its arguments.
template <class Fact>
Fact of_expression(const Formula& formula, std::size_t expression,
                   const std::function<Fact(const Node&, const Fact*, const Fact*, const Fact*)>& rule) {
  const auto nodes = formula.nodes();
  const auto last = static_cast<std::size_t>(formula.results()[expression]);
  std::vector<Fact> facts;
  facts.reserve(last + 1);
  const auto at = [&](int node) { return node < 0 ? nullptr : &facts[static_cast<std::size_t>(node)]; };
  for (std::size_t n = 0; n <= last; ++n)
    facts.push_back(rule(nodes[n], at(nodes[n].a), at(nodes[n].b), at(nodes[n].c)));
  return facts.back();
}

// Degrees, with the slope of what is a constant number times the phase, and a constant.
struct Growth {
  bool known = true;
  Degree degree;
  std::optional<double> slope = 0.0;  // by the phase; none: it depends on it otherwise, or on the motion
  std::optional<double> number{};     // of a constant of the text
};

Growth unknown_growth() {
  return {.known = false, .degree = {}, .slope = {}};
}
bool is_constant(const Growth& of) {
  return of.known && of.degree == Degree() && of.slope == 0.0;
}
// The phase itself is no polynomial, but within sin and cos.
bool is_polynomial(const Growth& of) {
  return of.known && (of.slope == 0.0 || !of.slope);
}

Growth sum(const Growth& a, const Growth& b, double sign) {
  if (!a.known || !b.known) return unknown_growth();
  Growth all;
  all.degree = {std::max(a.degree.motion, b.degree.motion), std::max(a.degree.orders, b.degree.orders)};
  all.slope = a.slope && b.slope ? std::optional(*a.slope + sign * *b.slope) : std::nullopt;
  if (!all.slope && !(is_polynomial(a) && is_polynomial(b))) return unknown_growth();
  return all;
}

Growth product(const Growth& a, const Growth& b) {
  if (!a.known || !b.known) return unknown_growth();
  if (is_constant(a) && is_constant(b)) return {};
  if (a.slope && *a.slope != 0) {  // the phase times a number
    if (!b.number) return unknown_growth();
    return {.known = true, .degree = {}, .slope = *a.slope * *b.number};
  }
  if (b.slope && *b.slope != 0) return product(b, a);
  if (a.degree.motion + b.degree.motion > largest_degree ||
      a.degree.orders + b.degree.orders > largest_degree)
    return unknown_growth();
  return {.known = true,
          .degree = {a.degree.motion + b.degree.motion, a.degree.orders + b.degree.orders},
          .slope = {}};
}

// Of a sine or cosine of n phase + constant.
Growth wave(const Growth& a) {
  if (is_constant(a)) return {};
  const bool whole = a.known && a.slope && a.degree == Degree() && *a.slope == std::round(*a.slope) &&
                     std::abs(*a.slope) <= largest_order;
  if (!whole) return unknown_growth();
  return {.known = true, .degree = {0, static_cast<int>(std::abs(*a.slope))}, .slope = {}};
}

Growth growth_of_input(Role role) {
  switch (role) {
    case Role::constant:
      return {};
    case Role::motion:
      return {.known = true, .degree = {1, 0}, .slope = {}};
    case Role::phase:
      return {.known = true, .degree = {}, .slope = 1.0};
  }
  return unknown_growth();
}

Growth negative(Growth of) {
  if (of.slope) *of.slope *= -1;
  if (of.number) *of.number *= -1;
  return of;
}

Growth quotient(const Growth& a, const Growth& b) {
  if (!is_constant(b)) return unknown_growth();
  if (a.slope && *a.slope != 0 && b.number)
    return {.known = a.known, .degree = {}, .slope = *a.slope / *b.number};
  return product(a, {});
}

Growth power_of(const Growth& base, int n) {
  if (is_constant(base)) return {};
  if (n < 0) return unknown_growth();
  Growth all = base;
  for (int k = 1; k < n; ++k) all = product(all, base);
  return all;
}

// What is one of two on each side of a kink.
Growth larger(const Growth& a, const Growth& b) {
  if (!a.known || !b.known || !is_polynomial(a) || !is_polynomial(b)) return unknown_growth();
  if (is_constant(a) && is_constant(b)) return {};
  return {.known = true,
          .degree = {std::max(a.degree.motion, b.degree.motion), std::max(a.degree.orders, b.degree.orders)},
          .slope = {}};
}

// Of a function with kinks or jumps: on each side it is one of its arguments, or a number.
Growth growth_of_pieces(const Node& node, const Growth* a, const Growth* b, const Growth* c) {
  if (rule(node.operation).switches == Switch::jump) return {};
  if (node.operation == Operation::abs) return larger(*a, *a);
  return node.operation == Operation::choose ? larger(*b, *c) : larger(*a, *b);
}

bool has_pieces(Operation operation) {
  return operation == Operation::choose || rule(operation).switches != Switch::none;
}

Growth growth(const Node& node, std::span<const Role> roles, Pieces pieces, const Growth* a, const Growth* b,
              const Growth* c) {
  if (pieces == Pieces::several && has_pieces(node.operation)) return growth_of_pieces(node, a, b, c);
  switch (node.operation) {
    case Operation::constant:
      return {.known = true, .degree = {}, .slope = 0.0, .number = node.value};
    case Operation::input:
      return growth_of_input(roles[static_cast<std::size_t>(node.input())]);
    case Operation::negate:
      return negative(*a);
    case Operation::add:
      return sum(*a, *b, 1);
    case Operation::subtract:
      return sum(*a, *b, -1);
    case Operation::multiply:
      return product(*a, *b);
    case Operation::divide:
      return quotient(*a, *b);
    case Operation::whole_power:
      return power_of(*a, static_cast<int>(node.value));
    case Operation::sin:
    case Operation::cos:
      return wave(*a);
    default:
      for (const Growth* each : {a, b, c})
        if (each != nullptr && !is_constant(*each)) return unknown_growth();
      return {};
  }
}

Parity sum(Parity a, Parity b) {
  if (a == Parity::zero) return b;
  if (b == Parity::zero) return a;
  return a == b ? a : Parity::neither;
}

Parity product(Parity a, Parity b) {
  if (a == Parity::zero || b == Parity::zero) return Parity::zero;
  if (a == Parity::neither || b == Parity::neither) return Parity::neither;
  return a == b ? Parity::even : Parity::odd;
}

bool even(const Parity* of) {
  return of == nullptr || *of == Parity::even || *of == Parity::zero;
}
bool has_sign(Parity of) {
  return of == Parity::odd || of == Parity::even || of == Parity::zero;
}

// Of an even function of even arguments, and of one argument that has a sign.
Parity of_function(const Rule& of, const Parity* a, const Parity* b, const Parity* c) {
  if (even(a) && even(b) && even(c)) return Parity::even;
  if (of.symmetry == Symmetry::odd) return *a;
  return of.symmetry == Symmetry::even && has_sign(*a) ? Parity::even : Parity::neither;
}

Parity parity(const Node& node, std::span<const Role> roles, const Parity* a, const Parity* b,
              const Parity* c) {
  switch (node.operation) {
    case Operation::constant:
      return node.value == 0 ? Parity::zero : Parity::even;
    case Operation::input:
      return roles[static_cast<std::size_t>(node.input())] == Role::motion ? Parity::odd : Parity::even;
    case Operation::negate:
      return *a;
    case Operation::add:
    case Operation::subtract:
      return sum(*a, *b);
    case Operation::multiply:
      return product(*a, *b);
    case Operation::divide:
      return product(*a, *b == Parity::zero ? Parity::even : *b);
    case Operation::whole_power:
      return *a == Parity::odd && std::fmod(node.value, 2) == 0 ? Parity::even : *a;
    case Operation::hypot:
      return has_sign(*a) && has_sign(*b) ? Parity::even : Parity::neither;
    case Operation::choose:  // of an even condition
      return even(a) ? sum(*b, *c) : Parity::neither;
    default:
      return of_function(rule(node.operation), a, b, c);
  }
}

// Whether the value of each node varies with the motion or the phase.
std::vector<char> varying(std::span<const Node> nodes, std::span<const Role> roles) {
  std::vector<char> varies(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Node& node = nodes[n];
    varies[n] =
        node.operation == Operation::input && roles[static_cast<std::size_t>(node.input())] != Role::constant;
    for (const int argument : {node.a, node.b, node.c})
      if (argument >= 0 && varies[static_cast<std::size_t>(argument)]) varies[n] = 1;
  }
  return varies;
}

using Coefficients = std::optional<std::vector<double>>;

Coefficients product_of(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() + b.size() > largest_whole_power + 2u) return {};
  std::vector<double> all(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) all[i + j] += a[i] * b[j];
  return all;
}

// factor b + a
std::vector<double> sum_of(std::vector<double> a, double factor, const std::vector<double>& b) {
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t k = 0; k < b.size(); ++k) a[k] += factor * b[k];
  return a;
}

Coefficients power_of(const std::vector<double>& base, int n) {
  if (n < 0) return {};
  Coefficients all = base;
  for (int k = 1; k < n && all; ++k) all = product_of(*all, base);
  return all;
}

// Of arguments that are polynomials, not all of them numbers.
Coefficients combined(const Node& node, const std::vector<double>& a, const std::vector<double>& b) {
  switch (node.operation) {
    case Operation::negate:
      return sum_of({}, -1, a);
    case Operation::add:
      return sum_of(a, 1, b);
    case Operation::subtract:
      return sum_of(a, -1, b);
    case Operation::multiply:
      return product_of(a, b);
    case Operation::divide: {
      if (b.size() > 1) return {};
      std::vector<double> all = a;
      for (double& each : all) each /= b[0];
      return all;
    }
    case Operation::whole_power:
      return power_of(a, static_cast<int>(node.value));
    default:
      return {};
  }
}

// Of arguments that are numbers.
double number_of(const Node& node, const Coefficients* a, const Coefficients* b, const Coefficients* c) {
  const auto front = [](const Coefficients* of) { return of == nullptr ? 0.0 : (**of)[0]; };
  const double second = node.operation == Operation::whole_power ? node.value : front(b);
  return rule(node.operation).value(front(a), second, front(c));
}

}  // namespace

std::optional<Degree> degree(const Formula& formula, std::size_t expression, std::span<const Role> roles,
                             Pieces pieces) {
  const Growth all = of_expression<Growth>(
      formula, expression, [&](const Node& node, const Growth* a, const Growth* b, const Growth* c) {
        return growth(node, roles, pieces, a, b, c);
      });
  if (!all.known || !is_polynomial(all)) return {};
  return all.degree;
}

Parity parity(const Formula& formula, std::size_t expression, std::span<const Role> roles) {
  return of_expression<Parity>(formula, expression,
                               [&](const Node& node, const Parity* a, const Parity* b, const Parity* c) {
                                 return parity(node, roles, a, b, c);
                               });
}

Formula switches(const Formula& formula, std::span<const Role> roles) {
  const auto given = formula.nodes();
  const std::vector<char> varies = varying(given, roles);
  std::vector<Node> nodes(given.begin(), given.end());
  std::vector<int> results;
  for (std::size_t n = 0; n < given.size(); ++n) {
    const Node& node = given[n];
    // An if() changes where its condition does, which is a comparison, or seldom 0.
    if (!varies[n] || rule(node.operation).switches == Switch::none) continue;
    int at = node.a;
    if (node.b >= 0) {
      const Node difference{Operation::subtract, node.a, node.b};
      const auto known = std::find(nodes.begin(), nodes.end(), difference);
      at = static_cast<int>(known - nodes.begin());
      if (known == nodes.end()) nodes.push_back(difference);
    }
    if (std::find(results.begin(), results.end(), at) == results.end()) results.push_back(at);
  }
  return {std::move(nodes), std::move(results)};
}

bool may_jump(const Formula& formula, std::span<const Role> roles) {
  const auto nodes = formula.nodes();
  const std::vector<char> varies = varying(nodes, roles);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (varies[n] && rule(nodes[n].operation).switches == Switch::jump) return true;
  return false;
}

std::optional<std::vector<double>> polynomial(const Formula& formula, std::size_t expression, int input,
                                              std::span<const double> values) {
  const auto coefficients = [&](const Node& node, const Coefficients* a, const Coefficients* b,
                                const Coefficients* c) -> Coefficients {
    if (node.operation == Operation::constant) return std::vector{node.value};
    if (node.operation == Operation::input)
      return node.input() == input ? std::vector{0.0, 1.0}
                                   : std::vector{values[static_cast<std::size_t>(node.input())]};
    bool numbers = true;
    for (const Coefficients* each : {a, b, c}) {
      if (each != nullptr && !*each) return {};
      numbers = numbers && (each == nullptr || (*each)->size() == 1);
    }
    if (numbers) return std::vector{number_of(node, a, b, c)};
    return c != nullptr ? Coefficients() : combined(node, **a, b == nullptr ? **a : **b);
  };
  return of_expression<Coefficients>(formula, expression, coefficients);
}

}  // namespace arcslip::formula
