#pragma once
// Numbers and texts as the writers write them.

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

/// "damper.normal_load (N)", as a column or an axis is headed, escaped by visible().
std::string with_unit(std::string_view quantity, std::string_view unit);

/// "3 N", to ten digits; a pure number ("" or "-") stands alone.
std::string quantity(double value, std::string_view unit);

/// The text with every character escaped that commands a terminal, changes how its neighbours look, or is
/// none: control characters (C0, DEL, C1), marks and embeddings of writing direction, separators of lines and
/// paragraphs, noncharacters (U+FFFE, U+FFFF and their like) and surrogates, as JSON escapes them (\u009b);
/// bytes that are not UTF-8, as \x9b. What it has made it leaves as it is.
std::string visible(std::string_view text);

/// The same, but line breaks (\n) stay.
std::string visible_lines(std::string_view text);

/// In quotes, as JSON writes a text; a terminal may show it. Bytes that are not UTF-8, and surrogates, become
/// U+FFFD.
std::string json_quoted(std::string_view text);

}  // namespace arcslip::results
