#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace arcslip::scene::file {

/// Without white space at its ends.
inline std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

/// The parts between separators, at least one.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> all;
  for (std::size_t at = text.find(separator); at != std::string_view::npos; at = text.find(separator)) {
    all.push_back(text.substr(0, at));
    text.remove_prefix(at + 1);
  }
  all.push_back(text);
  return all;
}

/// Calls line(number, cells, whole) for each line that is not empty and does not begin with #, until it
/// returns false.
template <class Line>
void for_each_line(std::string_view text, const Line& line) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
  std::size_t number = 0;
  for (const std::string_view whole : split(text, '\n')) {
    ++number;
    if (trimmed(whole).empty() || trimmed(whole).front() == '#') continue;
    if (!line(number, split(whole, ','), trimmed(whole))) return;
  }
}

/// An integer from 1 to size, or nothing.
inline std::optional<int> row_in(std::string_view digits, int size) {
  int row = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), row);
  const bool is_row =
      error == std::errc() && rest == digits.data() + digits.size() && row >= 1 && row <= size;
  return is_row ? std::optional(row) : std::nullopt;
}

/// A finite number, or nothing.
inline std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return {};
  return value;
}

}  // namespace arcslip::scene::file
