#pragma once
// Numbers of a scene that are given as texts.

#include <arcslip/formula/formula.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace arcslip::scene {

/// How a number is given that is no plain one: with a unit, "0.2 mm", or by a formula, "0.12*k". A formula of
/// other parameters is followed: the number changes with them, and is no parameter of its own.
struct NumberText {
  std::string text{};                                 // as in the file; empty: a plain number
  std::shared_ptr<const formula::Formula> formula{};  // null: a number with a unit
  std::vector<std::string> parameters{};              // of the formula's inputs, in their order

  bool follows() const { return !parameters.empty(); }
  /// Whether it is another parameter itself.
  bool is_parameter() const {
    return follows() && parameters.size() == 1 &&
           formula->nodes()[static_cast<std::size_t>(formula->results().front())].operation ==
               formula::Operation::input;
  }
  friend bool operator==(const NumberText& a, const NumberText& b) { return a.text == b.text; }
};

/// A parameter "name" of the scene that belongs to no part: for formulas.
struct Constant {
  std::string name;
  double value = 0;
  std::string unit{};  // SI; "-" for a pure number, empty: not known
  double lower, upper;
  std::string help{};
  NumberText text{};
  friend bool operator==(const Constant&, const Constant&) = default;
};

}  // namespace arcslip::scene
