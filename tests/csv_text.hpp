#pragma once
// Whether a table is whole: RFC 4180.

#include <string_view>

/// Rows end with CRLF and have as many cells as the first one; cells may be quoted.
inline bool is_whole_table(std::string_view table) {
  long cells = 1, columns = 0;
  bool quoted = false;
  for (const char c : table) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ',') ++cells;
    if (c != '\n') continue;
    if (columns == 0) columns = cells;
    if (cells != columns) return false;
    cells = 1;
  }
  return !quoted && table.ends_with("\r\n");
}
