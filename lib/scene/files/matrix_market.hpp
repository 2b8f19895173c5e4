#pragma once
// Matrices in the Matrix Market exchange format: https://math.nist.gov/MatrixMarket/formats.html
//
//   %%MatrixMarket matrix coordinate real symmetric
//   % comments
//   3 3 4             rows, columns, entries
//   1 1 2.0           row, column, value, counted from 1
//   2 1 -1.0
//   ...
//
// "coordinate" or "array" (all values, column by column), "real" or "integer", "general", "symmetric" or
// "skew-symmetric". Of a symmetric matrix one triangle is given, the lower one in an array.

#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/sparse_matrix.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace arcslip::scene {

inline constexpr std::size_t largest_matrix_size = 100'000'000;  // rows or columns in a file
/// Rows or columns of a matrix whose file is too short for an entry in each, as of the damping by few
/// dampers.
inline constexpr std::size_t largest_empty_matrix = 10'000'000;

/// A file that does not hold the matrix that it should: what() names file, line and cause.
class MatrixError : public Error {
  using Error::Error;
};

/// text: content of the file; file: its name in messages. Throws control::Interrupted, and MatrixError for
/// whatever is not of the format, numbers that are not finite, entries outside of the matrix or given twice,
/// and too few or too many of them.
SparseMatrix read_matrix_market(std::string_view text, const std::string& file,
                                const control::Control& control = {});

}  // namespace arcslip::scene
