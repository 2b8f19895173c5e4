// Mutated formulas: 20 000 of them, 100 000 with ARCSLIP_FULL=1. Each is a formula with a value, or has a
// fault with a column within its text.

#include "catch.hpp"

#include "lib/formula/random_formula.hpp"
#include "volume.hpp"

#include <arcslip/formula/evaluator.hpp>
#include <arcslip/formula/facts.hpp>

#include <array>

using namespace arcslip::formula;

namespace {

// A few changes of bytes and of pieces.
std::string mutated(std::string text, std::mt19937_64& bits) {
  static const std::vector<std::string> pieces = {"(",        ")",
                                                  "((((((((", "^",
                                                  "^-",       "**",
                                                  "-",        "1e999",
                                                  "1e-400",   ".",
                                                  "..",       "'",
                                                  "''",       "q",
                                                  "if(",      "max(",
                                                  ",",        "<=",
                                                  "==",       "!=",
                                                  "=",        "\0",
                                                  "\xff",     "\xc3",
                                                  "#",        "pi",
                                                  "1/0",      "0x1p3",
                                                  "nan",      "inf",
                                                  "damper.",  " ",
                                                  "\t\n",     "9999999999999999999999",
                                                  "^64",      "^65",
                                                  "abs",      "sin(",
                                                  "1e5"};
  const int changes = 1 + static_cast<int>(bits() % 3);
  for (int k = 0; k < changes; ++k) {
    const std::size_t at = bits() % (text.size() + 1);
    switch (bits() % 4) {
      case 0:
        text.insert(at, pieces[bits() % pieces.size()]);
        break;
      case 1:
        if (at < text.size()) text.erase(at, 1 + bits() % 4);
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(bits());
        break;
      default:
        text.insert(at, text.substr(bits() % (text.size() + 1), bits() % 40));
    }
  }
  return text;
}

}  // namespace

TEST_CASE("a mutated formula has a value, or a fault with a column of its text") {
  const std::uint64_t count = Volume{"ARCSLIP_MUTATED_FORMULAS", 20000, 100000}.count();
  std::array<std::string_view, random_formula::inputs> names;
  std::copy(std::begin(random_formula::names), std::end(random_formula::names), names.begin());
  constexpr std::array<Role, 3> roles = {Role::motion, Role::phase, Role::constant};
  const std::array<double, 3> x = {0.3, -1.2, 2.5};
  std::uint64_t formulas = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    std::mt19937_64 bits(seed);
    const auto tree = random_formula::grown(bits, 1 + static_cast<int>(bits() % 6));
    const std::string text = mutated(random_formula::text(*tree, bits), bits);
    try {
      const Formula formula(std::vector{text}, names_of(names));
      std::array<InputValues, 3> values{};
      std::array<double, 3> slopes{};
      std::vector<Derivative> derivatives;
      for (std::size_t i = 0; i < 3; ++i) {
        values[i] = {&x[i], i < 2};
        derivatives.push_back({0, static_cast<int>(i), &slopes[i]});
      }
      double f = 0;
      Evaluator evaluator(formula);
      evaluator.compute(values, 1, std::array{&f}, derivatives);
      static_cast<void>(degree(formula, 0, roles));
      static_cast<void>(parity(formula, 0, roles));
      static_cast<void>(polynomial(formula, 0, 0, x));
      ++formulas;
    } catch (const FormulaError& error) {
      const std::size_t column = error.fault().column;
      if (column < 1 || column > text.size() + 1) {
        CAPTURE(seed, text, error.what());
        CHECK(column == 0);
      }
    }
  }
  CHECK(formulas > count / 20);
  CHECK(formulas < count);
}
