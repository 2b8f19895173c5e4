#include "catch.hpp"

#include <arcslip/formula/evaluator.hpp>

#include <array>
#include <cmath>
#include <numbers>

using namespace arcslip::formula;

namespace {

constexpr std::array<std::string_view, 4> all_names = {"q", "v", "damper.k", "left spring.k"};
constexpr double q_at = 0.75, v_at = -2, k_at = 3, left_at = 11;

double value(const std::string& text) {
  const Formula formula(std::vector{text}, names_of(all_names));
  Evaluator evaluator(formula);
  double f = 0;
  evaluator.compute(
      std::array<InputValues, 4>{{{&q_at, true}, {&v_at, true}, {&k_at, false}, {&left_at, false}}}, 1,
      std::array{&f});
  return f;
}

// What is said of a text that is no formula.
std::string fault(const std::string& text) {
  try {
    const Formula formula(std::vector{text}, names_of(all_names));
  } catch (const FormulaError& error) {
    return error.what();
  }
  return "a formula";
}

}  // namespace

TEST_CASE("powers bind closest and from the right, then signs, products and sums, then comparisons") {
  CHECK(value("-2^2") == -4);
  CHECK(value("2^-2") == 0.25);
  CHECK(value("2^3^2") == 512);
  CHECK(value("(2^3)^2") == 64);
  CHECK(value("2^-1^2") == 0.5);
  CHECK(value("8/4/2") == 1);
  CHECK(value("8-4-2") == 2);
  CHECK(value("2+3*4^2/8-1") == 7);
  CHECK(value("- -+q") == q_at);
  CHECK(value("-q*-v") == q_at * v_at);
  CHECK(value("1+1<1*3") == 1);
  CHECK(value("q > v") == 1);
  CHECK(value("q >= v+10") == 0);
  CHECK(value("(q<1) == (v<1)") == 1);
  CHECK(value("1e-3 + 2.E+1 + .5") == 0.001 + 20 + 0.5);
  CHECK(value("\tq \n+\r v") == q_at + v_at);
}

TEST_CASE("names have points and quotes, and pi is a number") {
  CHECK(value("damper.k*q") == k_at * q_at);
  CHECK(value("'left spring'.k") == left_at);
  CHECK(value("'left spring.k'/'q'") == left_at / q_at);
  CHECK(value("2*pi") == 2 * std::numbers::pi);
  const Formula own(std::vector<std::string>{"pi"}, names_of(std::array<std::string_view, 1>{"pi"}));
  CHECK(own.uses(0));
}

TEST_CASE("each function has its value") {
  CHECK(value("sqrt(q)") == std::sqrt(q_at));
  CHECK(value("exp(q)") == std::exp(q_at));
  CHECK(value("log(q)") == std::log(q_at));
  CHECK(value("sin(q)") == std::sin(q_at));
  CHECK(value("cos(q)") == std::cos(q_at));
  CHECK(value("tan(q)") == std::tan(q_at));
  CHECK(value("asin(q)") == std::asin(q_at));
  CHECK(value("acos(q)") == std::acos(q_at));
  CHECK(value("atan(q)") == std::atan(q_at));
  CHECK(value("sinh(q)") == std::sinh(q_at));
  CHECK(value("cosh(q)") == std::cosh(q_at));
  CHECK(value("tanh(q)") == std::tanh(q_at));
  CHECK(value("asinh(q)") == std::asinh(q_at));
  CHECK(value("acosh(1+q)") == std::acosh(1 + q_at));
  CHECK(value("atanh(q)") == std::atanh(q_at));
  CHECK(value("abs(v)") == 2);
  CHECK(value("sign(v) + sign(q) + sign(0*q)") == 0);
  CHECK(value("min(q, v, 4)") == -2);
  CHECK(value("max(q, v, 4, -7)") == 4);
  CHECK(value("hypot(3, 4*sign(q))") == 5);
  CHECK(value("pow(v, 3)") == -8);
  CHECK(value("if(q < v, 1/(q-q), 5)") == 5);
}

TEST_CASE("whole powers to 64 are products, of any sign of the base") {
  for (int n = -64; n <= 64; ++n) {
    CAPTURE(n);
    const double exact = std::pow(v_at, n);
    CHECK(value("v^" + std::to_string(n)) == exact);
  }
  CHECK(value("v^65") == std::pow(v_at, 65));
  CHECK(value("(v+2)^0") == 1);
  CHECK(std::isnan(value("v^0.5")));
}

TEST_CASE("a choice has the derivative of what it takes, whatever the other one is") {
  const Formula formula(std::vector<std::string>{"if(q > 0, sqrt(q), 3*q)"}, names_of(all_names));
  const std::array<double, 3> x = {-1, 0.25, -4};
  std::array<double, 3> f{}, slope{};
  Evaluator evaluator(formula);
  evaluator.compute(
      std::array<InputValues, 4>{{{x.data(), true}, {&v_at, false}, {&k_at, false}, {&left_at, false}}}, 3,
      std::array{f.data()}, std::array{Derivative{0, 0, slope.data()}});
  CHECK(f == std::array{-3.0, 0.5, -12.0});
  CHECK(slope == std::array{3.0, 1.0, 3.0});
}

TEST_CASE("several expressions share their parts, and have derivatives each") {
  const Formula formula(std::vector<std::string>{"damper.k*(q-v)^3", "-damper.k*(q-v)^3 + v"},
                        names_of(all_names));
  CHECK(formula.nodes().size() ==
        9);  // q_at, v_at, k_at, q_at - v_at, its power, k_at times it, -k_at, -k_at times it, + v_at
  CHECK(formula.uses(1, 1));
  CHECK_FALSE(formula.uses(3));
  double f[2], slopes[4];
  Evaluator evaluator(formula);
  evaluator.compute(
      std::array<InputValues, 4>{{{&q_at, true}, {&v_at, true}, {&k_at, false}, {&left_at, false}}}, 1,
      std::array{&f[0], &f[1]},
      std::array{Derivative{0, 0, &slopes[0]}, Derivative{1, 0, &slopes[1]}, Derivative{1, 1, &slopes[2]},
                 Derivative{0, 2, &slopes[3]}});
  const double s = q_at - v_at;
  CHECK(f[0] == k_at * s * s * s);
  CHECK(f[1] == -k_at * s * s * s + v_at);
  CHECK(slopes[0] == 3 * k_at * s * s);
  CHECK(slopes[1] == -3 * k_at * s * s);
  CHECK(slopes[2] == 3 * k_at * s * s + 1);
  CHECK(slopes[3] == s * s * s);
}

TEST_CASE("what is no formula has a fault with its column") {
  CHECK(fault("") == "column 1: ends, must be a number, a name, a function or \"(\"");
  CHECK(fault("2*") == "column 3: ends, must be a number, a name, a function or \"(\"");
  CHECK(fault("2*)") == "column 3: found \")\", must be a number, a name, a function or \"(\"");
  CHECK(fault("(q+1") == "column 5: ends, must be \")\" or an operator");
  CHECK(fault("(q 1)") == "column 4: found \"1\", must be \")\" or an operator");
  CHECK(fault("q v") == "column 3: found \"v\", must be an operator or the end");
  CHECK(fault("2q") == "column 1: found a number with letters behind it, must have an operator between them");
  CHECK(fault("q**2") == "column 2: found \"**\", must be \"^\" for a power");
  CHECK(fault("q = 2") == "column 3: found \"=\", must be \"==\" for a comparison");
  CHECK(fault("0 < q < 1") == "column 7: found a second comparison, must be in parentheses");
  CHECK(fault("x+1") == "column 1: found the unknown name \"x\"");
  CHECK(fault("1+sinn(q)") == "column 3: found the unknown function \"sinn\"");
  CHECK(fault("sin(q, v)") == "column 1: found sin with 2 arguments, must have 1");
  CHECK(fault("max(q)") == "column 1: found max with 1 argument, must have 2 or more");
  CHECK(fault("if(q,1)") == "column 1: found if with 2 arguments, must have 3");
  CHECK(fault("max(q,") == "column 7: ends, must be a number, a name, a function or \"(\"");
  CHECK(fault("max(q;v)") == "column 6: found \";\", must be \",\", \")\" or an operator");
  CHECK(fault("sin q") == "column 1: found the unknown name \"sin\"");
  CHECK(fault("'q") == "column 1: found a quote that does not end");
  CHECK(fault("''") == "column 1: found an empty name in quotes");
  CHECK(fault("q + 1e999") == "column 5: found a number beyond the range of doubles");
  CHECK(fault("q + 1/(2-2)") == "column 6: found a value that is not a finite number");
  CHECK(fault("q + log(-1)") == "column 5: found a value that is not a finite number");
  CHECK(fault("1e300*1e300") == "column 6: found a value that is not a finite number");
  CHECK(fault("\xc3\xa9 + )") == "column 1: found the unknown name \"\xc3\xa9\"");
  CHECK(fault("'\xc3\xa9' + )").substr(0, 10) == "column 1: ");
  CHECK(fault(".").substr(0, 9) == "column 1:");
  CHECK(fault(std::string("q\0+1", 4)).substr(0, 9) == "column 2:");
  CHECK(fault("0x10") ==
        "column 1: found a number with letters behind it, must have an operator between them");
}

TEST_CASE("a formula has at most 64 levels, 1000 operations and 20000 characters") {
  const auto nested = [](std::size_t levels) {
    return std::string(levels, '(') + "q" + std::string(levels, ')');
  };
  CHECK(fault(nested(63)) == "a formula");
  CHECK(fault(nested(64)) == "column 65: is nested deeper than 64 levels");
  CHECK(fault(std::string(63, '-') + "q") == "a formula");
  CHECK(fault(std::string(100000, '(')) != "a formula");
  CHECK(fault(std::string(10000, '-')) == "column 65: is nested deeper than 64 levels");
  std::string tower = "q", sum = "q";
  for (int i = 0; i < 100; ++i) tower += "^v";
  CHECK(fault(tower) != "a formula");
  for (int i = 0; i < 600; ++i) sum += "+q*" + std::to_string(i + 2);
  CHECK(fault(sum).find("has more than 1000 operations") != std::string::npos);
  sum = "q";
  for (int i = 0; i < 400; ++i) sum += "+q*3";  // equal parts are one
  CHECK(fault(sum) == "a formula");
  CHECK(fault(std::string(30000, ' ') + "q") == "column 20001: is longer than 20000 characters");
}
