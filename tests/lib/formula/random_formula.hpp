#pragma once
// Random formulas as trees that know their value without the tape: of real and complex numbers, whose small
// imaginary parts carry derivatives (complex steps, Squire & Trapp 1998).

#include <arcslip/formula/operations.hpp>

#include <cmath>
#include <complex>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace random_formula {

using arcslip::formula::Operation;

struct Tree {
  Operation operation = Operation::constant;
  double number = 0;  // of a constant; an exponent; the index of an input
  std::vector<std::unique_ptr<Tree>> arguments{};
};

constexpr int inputs = 3;
const std::string names[inputs] = {"q", "v2", "damper.k_1"};

/// At most `depth` levels.
inline std::unique_ptr<Tree> grown(std::mt19937_64& bits, int depth) {
  const auto pick = [&](std::uint64_t count) { return static_cast<int>(bits() % count); };
  auto tree = std::make_unique<Tree>();
  if (depth == 0 || pick(8) == 0) {
    tree->operation = pick(3) == 0 ? Operation::constant : Operation::input;
    tree->number = tree->operation == Operation::input ? pick(inputs) : 0.25 * (1 + pick(20));
    return tree;
  }
  constexpr Operation all[] = {
      Operation::add,       Operation::add,    Operation::subtract,      Operation::multiply,
      Operation::multiply,  Operation::divide, Operation::negate,        Operation::whole_power,
      Operation::power,     Operation::sqrt,   Operation::exp,           Operation::log,
      Operation::sin,       Operation::cos,    Operation::tan,           Operation::asin,
      Operation::acos,      Operation::atan,   Operation::sinh,          Operation::cosh,
      Operation::tanh,      Operation::asinh,  Operation::acosh,         Operation::atanh,
      Operation::abs,       Operation::sign,   Operation::min,           Operation::max,
      Operation::hypot,     Operation::less,   Operation::less_or_equal, Operation::equal,
      Operation::not_equal, Operation::choose};
  tree->operation = all[static_cast<std::size_t>(pick(std::size(all)))];
  if (tree->operation == Operation::whole_power) tree->number = 2 + pick(5) - (pick(4) == 0 ? 8 : 0);
  if (tree->operation == Operation::whole_power && tree->number >= -1 && tree->number <= 1) tree->number = -2;
  for (int k = 0; k < arcslip::formula::rule(tree->operation).arguments; ++k)
    tree->arguments.push_back(grown(bits, depth - 1));
  return tree;
}

template <class T>
double real_part(const T& x) {
  return static_cast<double>(std::real(x));
}

template <class T>
T value(const Tree& tree, const T* at) {
  std::vector<T> x;
  for (const auto& argument : tree.arguments) x.push_back(value(*argument, at));
  switch (tree.operation) {
    case Operation::constant:
      return T(tree.number);
    case Operation::input:
      return at[static_cast<int>(tree.number)];
    case Operation::negate:
      return -x[0];
    case Operation::add:
      return x[0] + x[1];
    case Operation::subtract:
      return x[0] - x[1];
    case Operation::multiply:
      return x[0] * x[1];
    case Operation::divide:
      return x[0] / x[1];
    case Operation::whole_power: {
      T all = T(1);
      for (int k = 0; k < std::abs(static_cast<int>(tree.number)); ++k) all = all * x[0];
      return tree.number < 0 ? T(1) / all : all;
    }
    case Operation::power:
      return x[1] == T(0) ? T(1) : std::pow(x[0], x[1]);  // of complex 0: no number
    case Operation::sqrt:
      return std::sqrt(x[0]);
    case Operation::exp:
      return std::exp(x[0]);
    case Operation::log:
      return std::log(x[0]);
    case Operation::sin:
      return std::sin(x[0]);
    case Operation::cos:
      return std::cos(x[0]);
    case Operation::tan:
      return std::sin(x[0]) / std::cos(x[0]);
    case Operation::asin:
      return std::asin(x[0]);
    case Operation::acos:
      return std::acos(x[0]);
    case Operation::atan:
      return std::atan(x[0]);
    case Operation::sinh:
      return std::sinh(x[0]);
    case Operation::cosh:
      return std::cosh(x[0]);
    case Operation::tanh:
      return std::tanh(x[0]);
    case Operation::asinh:
      return std::asinh(x[0]);
    case Operation::acosh:
      return std::acosh(x[0]);
    case Operation::atanh:
      return std::atanh(x[0]);
    case Operation::abs:
      return real_part(x[0]) < 0 ? -x[0] : x[0];
    case Operation::sign:
      return T(real_part(x[0]) > 0 ? 1 : real_part(x[0]) < 0 ? -1 : 0);
    case Operation::min:
      return real_part(x[1]) < real_part(x[0]) ? x[1] : x[0];
    case Operation::max:
      return real_part(x[1]) > real_part(x[0]) ? x[1] : x[0];
    case Operation::hypot:
      return std::sqrt(x[0] * x[0] + x[1] * x[1]);
    case Operation::less:
      return T(real_part(x[0]) < real_part(x[1]));
    case Operation::less_or_equal:
      return T(real_part(x[0]) <= real_part(x[1]));
    case Operation::equal:
      return T(real_part(x[0]) == real_part(x[1]));
    case Operation::not_equal:
      return T(real_part(x[0]) != real_part(x[1]));
    case Operation::choose:
      return real_part(x[0]) != 0 ? x[1] : x[2];
  }
  return T(0);
}

/// The largest value of the tree or a part of it; infinite where one of them has none.
inline double largest_part(const Tree& tree, const double* at) {
  const double own = std::abs(value(tree, at));
  double most = std::isfinite(own) ? own : HUGE_VAL;
  for (const auto& argument : tree.arguments) most = std::max(most, largest_part(*argument, at));
  return most;
}

inline int binding(Operation operation) {
  switch (operation) {
    case Operation::less:
    case Operation::less_or_equal:
    case Operation::equal:
    case Operation::not_equal:
      return 0;
    case Operation::add:
    case Operation::subtract:
      return 1;
    case Operation::multiply:
    case Operation::divide:
      return 2;
    case Operation::negate:
      return 3;
    case Operation::whole_power:
    case Operation::power:
      return 4;
    default:
      return 5;
  }
}

/// Its text, with no parentheses but those that it needs, and some others.
inline std::string text(const Tree& tree, std::mt19937_64& bits) {
  const auto one_in = [&](std::uint64_t count) { return bits() % count == 0; };
  const auto argument = [&](std::size_t k, int least) {
    const Tree& of = *tree.arguments[k];
    std::string inside = text(of, bits);
    if (binding(of.operation) < least || one_in(10)) inside = "(" + inside + ")";
    return (one_in(10) ? " " : "") + inside;
  };
  const auto between = [&](const std::string& sign, int left, int right) {
    return argument(0, left) + (one_in(5) ? " " : "") + sign + argument(1, right);
  };
  switch (tree.operation) {
    case Operation::constant: {
      std::string number = std::to_string(tree.number);
      while (number.back() == '0' && one_in(2)) number.pop_back();
      return number;
    }
    case Operation::input:
      return names[static_cast<int>(tree.number)];
    case Operation::negate:
      return "-" + argument(0, 3);
    case Operation::add:
      return between("+", 1, 2);
    case Operation::subtract:
      return between("-", 1, 2);
    case Operation::multiply:
      return between("*", 2, 3);
    case Operation::divide:
      return between("/", 2, 3);
    case Operation::whole_power:
      return argument(0, 5) + "^" + std::to_string(static_cast<int>(tree.number));
    case Operation::power:
      return one_in(2) ? between("^", 5, 3) : "pow(" + argument(0, 0) + "," + argument(1, 0) + ")";
    case Operation::less:
      return one_in(2) ? between("<", 1, 1) : argument(1, 1) + ">" + argument(0, 1);
    case Operation::less_or_equal:
      return one_in(2) ? between("<=", 1, 1) : argument(1, 1) + ">=" + argument(0, 1);
    case Operation::equal:
      return between("==", 1, 1);
    case Operation::not_equal:
      return between("!=", 1, 1);
    default:
      break;
  }
  std::string all;
  for (const auto& function : arcslip::formula::functions())
    if (function.operation == tree.operation) all = std::string(function.name) + "(";
  for (std::size_t k = 0; k < tree.arguments.size(); ++k) all += (k > 0 ? "," : "") + argument(k, 0);
  return all + ")";
}

}  // namespace random_formula
