#pragma once
// Formatting of numbers and texts.

#include <array>
#include <charconv>
#include <string>
#include <string_view>

namespace arcslip::results {

/// The shortest text that reads back as this number: "3", "0.01", "1e-12"; "nan", "inf", "-inf".
inline void append_shortest(std::string& out, double value) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  out.append(text.data(), result.ptr);
}

inline std::string shortest(double value) {
  std::string text;
  append_shortest(text, value);
  return text;
}

/// Returns the text of a number with so many significant digits at most.
std::string to_digits(double value, int digits);

/// A number in a format of printf with a precision ("%.8e", "%.8f", "%.8g"), without the digits whose unit is
/// less than twice its estimated error, but with two of them at least. All of them where the error is not
/// known (NaN) or 0.
std::string with_error(double value, double error, const char* format);

/// An estimated error that may be far too low, as one that leaves three digits at most; NaN as it is.
double doubtful_error(double value, double error);

/// "damper.normal_load (N)", the title of a column or an axis, escaped by visible().
std::string with_unit(std::string_view quantity, std::string_view unit);

/// "3 N", to ten digits; without a unit for a pure number ("" or "-").
std::string quantity(double value, std::string_view unit);

/// A unit with a prefix, and the numbers in it over those in the unit itself.
struct PrefixedUnit {
  std::string unit;  // "mm"
  double factor;     // 1000
};

/// The prefix with which a number of this size lies from 0.1 to 100. m, N, J, W, Pa and units that begin with
/// these have prefixes, others have none.
PrefixedUnit prefixed(std::string_view unit, double size);

/// quantity() to so many digits, in prefixed(): "0.69 mm", "3.2 MN/m".
std::string readable(double value, std::string_view unit, int digits = 4);

/// Escapes every character that is unsafe for a terminal or invalid: control characters (C0, DEL, C1),
/// bidirectional formatting characters, line and paragraph separators, noncharacters (U+FFFE, U+FFFF and so
/// on) and surrogates, as in JSON (\u009b); bytes that are not UTF-8, as \x9b. Idempotent.
std::string visible(std::string_view text);

/// The same, but keeps line breaks (\n).
std::string visible_lines(std::string_view text);

/// A JSON string with quotes, safe for a terminal. Bytes that are not UTF-8, and surrogates, become U+FFFD.
std::string json_quoted(std::string_view text);

}  // namespace arcslip::results
