#pragma once

#include <string_view>
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

}  // namespace arcslip::scene::file
