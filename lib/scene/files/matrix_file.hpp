#pragma once
// Matrices in files, as a scene names them: by a path, or by an object with "file", for .mat files with
// "variable", and where a column of the matrix is meant with "column", counted from 1.

#include <arcslip/scene/keys/read_values.hpp>
#include <arcslip/scene/matrices.hpp>

namespace arcslip::scene::file {

struct Reading;

/// column: of the matrix, if the object may have it. Null where there is a fault, or no value.
MatrixFile read_matrix_file(const Location& place, const std::string& wanted, const Reading& reading,
                            int* column = nullptr);
Node matrix_file_node(const MatrixFile& file, int column = 0);
/// The JSON Schema of such a value.
std::string matrix_file_schema(bool with_column);

}  // namespace arcslip::scene::file
