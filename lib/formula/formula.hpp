#pragma once
// Formulas: texts such as "k*sin(q) + c*v^3", read once into a flat tape that is evaluated at many samples.
//
//   const std::vector<std::string_view> names = {"q", "k"};
//   const Formula formula({"k*q^3"}, names_of(names));
//
// What a formula may have: numbers; names; + - * / ^, of which ^ binds closest and from the right, then a
// sign in front, so that -q^2 is -(q^2); parentheses; the functions of operations.hpp; comparisons < <= > >=
// == !=, which are 1 where they hold, else 0; if(condition, value, otherwise); pi, unless a name says
// otherwise. Names begin with a letter and go on with letters, digits and _; several are joined by points,
// and a part in single quotes may have any characters: 'left spring'.stiffness.

#include <arcslip/control/error.hpp>
#include <arcslip/formula/operations.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::formula {

inline constexpr int largest_depth = 64, largest_size = 1000, largest_whole_power = 64;
inline constexpr std::size_t longest_text = 20000;

/// Why a text is no formula.
struct FormulaFault {
  enum class Kind { text, unknown_name, unknown_function } kind = Kind::text;
  std::size_t expression = 0;  // among those given, from 0
  std::size_t column = 1;      // of a character of it, from 1
  std::string name{};          // that is unknown
};

/// What stands where, and what must: "column 7: found \")\", must be an operator or the end".
class FormulaError : public Error {
 public:
  FormulaError(FormulaFault fault, const std::string& message) : Error(message), fault_(std::move(fault)) {}
  const FormulaFault& fault() const { return fault_; }

 private:
  FormulaFault fault_;
};

/// One operation of a tape, on the results of earlier ones.
struct Node {
  Operation operation = Operation::constant;
  int a = -1, b = -1, c = -1;
  double value = 0;  // of a constant; the exponent of a whole power; the index of an input

  int input() const { return static_cast<int>(value); }
  friend bool operator==(const Node&, const Node&) = default;
};

/// Marks the nodes that some depend on, themselves included.
std::vector<char> needed_by(std::span<const Node> nodes, std::span<const int> results);

/// The index of the input that a name stands for; none: it is unknown.
using InputOf = std::function<std::optional<int>(std::string_view name)>;
/// The position of a name in a list.
InputOf names_of(std::span<const std::string_view> names);

/// One or several expressions of the same inputs. Equal parts of them are computed once. Immutable.
class Formula {
 public:
  /// Of no expression.
  Formula() = default;
  /// Throws FormulaError. Those that a program writes may be of any size.
  enum class Author { user, program };
  Formula(std::span<const std::string> expressions, const InputOf& input_of, Author author = Author::user);
  /// From nodes, each after its arguments, and those of the expressions.
  Formula(std::vector<Node> nodes, std::vector<int> results)
      : nodes_(std::move(nodes)), results_(std::move(results)) {}

  /// Each after its arguments.
  std::span<const Node> nodes() const { return nodes_; }
  /// The node of each expression.
  std::span<const int> results() const { return results_; }
  /// Whether the value of an expression depends on an input.
  bool uses(std::size_t expression, int input) const;
  bool uses(int input) const;

  /// The value of the first expression at one place. Allocates nothing in formulas of up to largest_size
  /// operations. For many places: Evaluator.
  double value(std::span<const double> inputs) const;
  /// Its derivative by one input there.
  double derivative(std::span<const double> inputs, int input) const;

 private:
  std::vector<Node> nodes_;
  std::vector<int> results_;
};

/// The formula that is one of the inputs.
Formula input(int index);

/// The formula with the first expression of another one in the place of each input. These have inputs in
/// common, which are those of the result.
Formula composed(const Formula& formula, std::span<const Formula> inputs);

}  // namespace arcslip::formula
