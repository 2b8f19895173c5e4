#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace arcslip::results {
namespace {

struct Character {
  char32_t code = 0;
  std::size_t size = 1;  // bytes
  bool valid = true;     // false: a byte that is not UTF-8
};

// The character at the beginning of a text that is not empty (RFC 3629, but with surrogates).
Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead};
  const std::size_t size = lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
  if (size == 0 || size > text.size()) return {lead, 1, false};
  char32_t code = lead & (0xffu >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {lead, 1, false};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[size] || code > 0x10ffff) return {lead, 1, false};
  return {code, size};
}

bool within(char32_t code, char32_t first, char32_t last) {
  return code >= first && code <= last;
}

bool is_shown(char32_t code) {
  const bool commands = code < 0x20 || within(code, 0x7f, 0x9f) || within(code, 0x2028, 0x2029);
  const bool directs = code == 0x61c || within(code, 0x200e, 0x200f) || within(code, 0x202a, 0x202e) ||
                       within(code, 0x2066, 0x2069);
  const bool is_none = within(code, 0xd800, 0xdfff) || within(code, 0xfdd0, 0xfdef) || code == 0xfeff ||
                       (code & 0xfffe) == 0xfffe;
  return !commands && !directs && !is_none;
}

void add_escape(std::string_view prefix, char32_t code, int digits, std::string& out) {
  out += prefix;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) out += "0123456789abcdef"[code >> shift & 15];
}

// A character with known code, unchanged or escaped.
void add_visible(std::string_view character, char32_t code, std::string& out) {
  if (is_shown(code)) {
    out += character;
  } else if (code < 0x10000) {
    add_escape("\\u", code, 4, out);
  } else {
    add_escape("\\u", 0xd7c0 + (code >> 10), 4, out);
    add_escape("\\u", 0xdc00 + (code & 0x3ff), 4, out);
  }
}

std::string escaped(std::string_view text, bool keeps_lines) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character next = first_of(text);
    if (!next.valid)
      add_escape("\\x", next.code, 2, out);
    else if (keeps_lines && next.code == '\n')
      out += '\n';
    else
      add_visible(text.substr(0, next.size), next.code, out);
    text.remove_prefix(next.size);
  }
  return out;
}

}  // namespace

std::string visible(std::string_view text) {
  return escaped(text, false);
}

std::string visible_lines(std::string_view text) {
  return escaped(text, true);
}

std::string json_quoted(std::string_view text) {
  constexpr std::string_view short_escapes = "\"\\\b\f\n\r\t", names = "\"\\bfnrt";
  std::string out = "\"";
  while (!text.empty()) {
    const Character next = first_of(text);
    if (!next.valid || within(next.code, 0xd800, 0xdfff))
      out += "\xef\xbf\xbd";
    else if (const auto at =
                 next.code < 0x80 ? short_escapes.find(static_cast<char>(next.code)) : short_escapes.npos;
             at != short_escapes.npos)
      (out += '\\') += names[at];
    else
      add_visible(text.substr(0, next.size), next.code, out);
    text.remove_prefix(next.size);
  }
  return out += '"';
}

std::string to_digits(double value, int digits) {
  std::array<char, 32> text;
  const auto end = text.data() + text.size();
  return {text.data(), std::to_chars(text.data(), end, value, std::chars_format::general, digits).ptr};
}

std::string with_error(double value, double error, const char* format) {
  std::string shorter = format;
  int most = 0;
  char conversion = 0;
  if (std::isfinite(value) && value != 0 && std::isfinite(error) && error > 0 &&
      std::sscanf(format, "%%.%d%c", &most, &conversion) == 2) {
    const double last = std::ceil(std::log10(2 * error)), first = std::floor(std::log10(std::abs(value)));
    // Significant digits, less those before the first decimal.
    const double before = conversion == 'f' ? first + 1 : conversion == 'e' ? 1 : 0;
    const double digits = std::max(first - last + 1, 2.0) - before;
    shorter = "%." + std::to_string(std::lround(std::clamp(digits, 0.0, 1.0 * most))) + conversion;
  }
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), shorter.c_str(), value);
  return text.data();
}

double doubtful_error(double value, double error) {
  constexpr double three_digits = 5e-4;
  return std::max(error, three_digits * std::abs(value));
}

std::string with_unit(std::string_view quantity, std::string_view unit) {
  std::string text = visible(quantity);
  if (!unit.empty()) text.append(" (").append(unit).append(")");
  return text;
}

std::string quantity(double value, std::string_view unit) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.10g", value);  // without the last digits' rounding
  const double rounded = std::strtod(digits, nullptr);
  std::string text = shortest(std::isfinite(rounded) ? rounded : value);
  if (!unit.empty() && unit != "-") text.append(" ").append(unit);
  return text;
}

PrefixedUnit prefixed(std::string_view unit, double size) {
  constexpr std::array<std::string_view, 7> prefixes = {"n", "\u00b5", "m", "", "k", "M", "G"};
  constexpr std::size_t without = 3;
  constexpr std::array<std::string_view, 5> scaled = {"m", "N", "J", "W", "Pa"};
  const bool takes_prefix = std::any_of(scaled.begin(), scaled.end(), [&](std::string_view of) {
    return unit == of || (unit.starts_with(of) && (unit[of.size()] == ' ' || unit[of.size()] == '/'));
  });
  if (!takes_prefix || !std::isfinite(size) || size == 0) return {std::string(unit), 1};
  std::size_t prefix = without;
  double factor = 1;
  for (; std::abs(size) * factor < 0.1 && prefix > 0; --prefix) factor *= 1e3;
  for (; std::abs(size) * factor >= 100 && prefix + 1 < prefixes.size(); ++prefix) factor /= 1e3;
  return {std::string(prefixes[prefix]) + std::string(unit), factor};
}

std::string readable(double value, std::string_view unit, int digits) {
  const PrefixedUnit in = prefixed(unit, value);
  const std::string text = to_digits(value * in.factor, digits);
  return in.unit.empty() || in.unit == "-" ? text : text + " " + in.unit;
}

}  // namespace arcslip::results
