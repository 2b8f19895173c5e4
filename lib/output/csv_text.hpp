#pragma once
// What the writers of CSV have in common.

#include <arcslip/output/units.hpp>

#include <cmath>
#include <ostream>
#include <string>
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

}  // namespace arcslip::output::detail
