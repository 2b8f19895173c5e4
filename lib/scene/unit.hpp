#pragma once
// Units of numbers, and numbers with a unit.

#include <optional>
#include <string>
#include <string_view>

namespace arcslip::scene {

/// A unit as a product of powers of kg, m, s and rad, with a factor: kN/m is 10^3 kg/s^2, Hz 2 pi rad/s.
struct Unit {
  int mass = 0, length = 0, time = 0, angle = 0;
  int turns = 0;  // of the angle, the power in turns, as of Hz and rpm
  int ten = 0;    // the factor is other * 10^ten
  double other = 1;

  bool same_dimension(const Unit& unit) const {
    return mass == unit.mass && length == unit.length && time == unit.time;
  }
};

/// Of "N s/m", "kN/mm", "m^3/J", "rad/s", "%"; "-" and "1" for pure numbers. None if it is no unit. A product
/// after a division stands in parentheses: "J/(m^2 s)".
std::optional<Unit> unit_of(std::string_view text);
/// The text of a unit without its factor; "Hz" for turns over a time.
std::string coherent_text(const Unit& unit);

/// Why a text is no unit in which formulas may take a value: one without a factor, but Hz. Empty: it is one.
std::string objection_to_unit(std::string_view text);

/// "0.2 mm": a number in digits, then a unit.
struct Quantity {
  std::string_view number, unit;
};
/// None if a text does not begin with a number that something follows which may be a unit: not an operator.
std::optional<Quantity> split_quantity(std::string_view text);
/// Why a text that is no formula is no number with a unit, either: a decimal comma, or an unknown unit and
/// the one that may be meant; "" where it is neither.
std::string objection_to_number(std::string_view text);
/// Its value in a unit of the same dimension, with all digits where the factor is a power of ten; none if
/// `number` is no finite number or the dimensions differ.
std::optional<double> value_in(std::string_view number, const Unit& unit, const Unit& wanted);

}  // namespace arcslip::scene
