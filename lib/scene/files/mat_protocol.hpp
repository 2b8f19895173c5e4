#pragma once
// What the program arcslip-mat (mat/) writes on standard output, and how much. First a line, one of
//
//   arcslip-mat 1 matrix NAME ROWS COLUMNS ENTRIES
//   arcslip-mat 1 variables COUNT BYTES
//   arcslip-mat 1 fault NAME CAUSE
//
// NAME, CAUSE: bytes of these texts. Then, without anything between them,
//   matrix:     the name of the variable; where each column starts and where the last one ends (COLUMNS + 1
//               numbers); the rows, from 0, and the values of the entries, column by column. int32 and
//               double, in the byte order of the machine
//   variables:  the names of all variables, where none was asked for and there are several, or the one that
//               was asked for is not there; a zero behind each
//   fault:      the name of the variable, if it is one of a variable, and what was found

#include <arcslip/scene/files/matrix_market.hpp>

#include <algorithm>
#include <cstddef>

namespace arcslip::scene::mat_protocol {

inline constexpr const char* greeting = "arcslip-mat 1";

inline constexpr std::size_t most_variables = 10'000;
inline constexpr std::size_t longest_name = 200;    // bytes of a name that are sent
inline constexpr std::size_t longest_cause = 1000;  // bytes
inline constexpr std::size_t most_compressed =
    1100;  // bytes of data in one of the file: zlib's limit is 1032

/// Whether a file of so many bytes may hold so many numbers of four bytes.
inline bool may_hold(std::size_t file, std::size_t numbers) {
  return numbers / most_compressed <= file / 4;
}
/// Whether a matrix in a file of so many bytes may have so many rows and columns, with or without entries.
inline bool has_size(std::size_t file, std::size_t rows, std::size_t columns) {
  const std::size_t longest = std::max(rows, columns);
  return longest <= largest_matrix_size && (longest <= largest_empty_matrix || may_hold(file, longest));
}
/// Whether it may have so many entries. Of a full matrix, which are those that are not zero.
inline bool has_entries(std::size_t file, std::size_t entries) {
  return entries <= 0x7fffffff && may_hold(file, entries);
}

}  // namespace arcslip::scene::mat_protocol
