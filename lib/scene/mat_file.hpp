#pragma once
// Matrices in MATLAB's .mat files, of version 5 (which MATLAB 5 to 7 write, compressed or not) and 7.3, read
// by matio. A variable must be a real matrix of double precision, sparse or full.
//
// matio reads the file by its path once more, and does not hear a request to stop meanwhile. It and HDF5, by
// which it reads version 7.3, are not made for threads: files are read one after another. Messages of HDF5 on
// standard error are switched off meanwhile, for the whole process. A damaged file of version 7.3 may leave
// HDF5 with one more when the program ends.

#include <arcslip/scene/sparse_matrix.hpp>
#include <arcslip/scene/stop_request.hpp>

#include <string>
#include <string_view>

namespace arcslip::scene {

/// Whether a file is taken as a .mat file: by the ending of its name or by its first bytes.
bool is_mat_file(std::string_view path, std::string_view text);

/// path: of the file, text: its content. variable: its name; empty: the only one in the file. file: the name
/// in messages. Throws Interrupted, and MatrixError (matrix_market.hpp), which names the variable, for
/// whatever is no such matrix: of other types, damaged or too large, with entries that are given twice,
/// outside of the matrix or not finite.
SparseMatrix read_mat_file(const std::string& path, std::string_view text, const std::string& variable,
                           const std::string& file, const StopRequest& stop = {});

}  // namespace arcslip::scene
