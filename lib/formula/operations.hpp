#pragma once
// The operations of formulas, a line of a table each: name, value, derivatives, and what else is known of
// them.

#include <cstdint>
#include <span>
#include <string_view>

namespace arcslip::formula {

enum class Operation : std::uint8_t {
  constant,
  input,
  negate,
  add,
  subtract,
  multiply,
  divide,
  whole_power,  // by multiplication; the exponent is the second argument, of size 2 to 64
  power,
  sqrt,
  exp,
  log,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  asinh,
  acosh,
  atanh,
  abs,
  sign,  // -1, 0 or 1
  min,
  max,
  hypot,
  less,  // comparisons are 1 where they hold, else 0
  less_or_equal,
  equal,
  not_equal,
  choose  // b where a is not 0, else c
};

/// How a function of one argument changes with the sign of that.
enum class Symmetry { none, odd, even };

/// Where its value or slope changes at once: there is a kink, or it may jump.
enum class Switch { none, kink, jump };

struct Rule {
  Operation operation;
  int arguments;
  double (*value)(double a, double b, double c);
  double (*by_a)(double a, double b, double f);  // f: the value; null: 0
  double (*by_b)(double a, double b, double f);
  Symmetry symmetry = Symmetry::none;
  Switch switches = Switch::none;
};
const Rule& rule(Operation operation);

/// A function that a formula may call.
struct Function {
  std::string_view name;
  Operation operation;
  int least, most;  // arguments
};
std::span<const Function> functions();

/// x^n by repeated multiplication.
double whole_power(double x, int n);

}  // namespace arcslip::formula
