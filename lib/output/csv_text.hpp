#pragma once
// What the writers of CSV have in common.

#include <arcslip/output/units.hpp>
#include <arcslip/scene/visible.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::output::detail {

/// A field, in quotes where RFC 4180 asks for them.
inline std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted.append(c == '"' ? 2 : 1, c);
  }
  return quoted + '"';
}

/// A cell that holds a name or another text. A spreadsheet takes what begins with =, +, - or @ for a formula:
/// a ' goes before it. What is not to be shown is escaped (scene/visible.hpp).
inline std::string csv_text(const std::string& text) {
  const bool is_formula =
      !text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos;
  return (is_formula ? "'" : "") + scene::visible(text);
}

/// Empty where there is no value.
inline std::string csv_number(double value) {
  return std::isnan(value) ? "" : shortest(value);
}

inline void write_csv_row(std::ostream& out, const std::vector<std::string>& cells) {
  const char* separator = "";
  for (const std::string& cell : cells) {
    out << separator << csv_field(cell);
    separator = ",";
  }
  out << "\r\n";
}

/// Puts a name to others, once.
inline void add_name(const std::string& name, std::vector<std::string>& names) {
  if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
    names.push_back(name);
  }
}

/// The first row: each title as csv_text() makes it.
inline void write_csv_header(std::ostream& out, std::vector<std::string> titles) {
  for (std::string& title : titles) {
    title = csv_text(title);
  }
  write_csv_row(out, titles);
}

}  // namespace arcslip::output::detail
