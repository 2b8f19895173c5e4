#pragma once
// Matrices in MATLAB's .mat files, of version 5 (which MATLAB 5 to 7 write, compressed or not) and 7.3. A
// variable must be a real matrix of double precision, sparse or full.
//
// The program arcslip-mat (mat/) reads them. The variable ARCSLIP_MAT of the environment gives its path; else
// it is looked for next to the running program, in ../libexec/arcslip and ../bin from there, in the same
// places from the shared library, and in PATH. What it sends is checked, and where it dies nothing else does.

#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/sparse_matrix.hpp>

#include <string>
#include <string_view>

namespace arcslip::scene {

/// Whether a file is taken as a .mat file: by the ending of its name or by its first bytes.
bool is_mat_file(std::string_view path, std::string_view text);

/// path: of the file, text: its content. variable: its name; empty: the only one in the file. file: the name
/// in messages. Throws control::Interrupted, and MatrixError (matrix_market.hpp), which names the variable,
/// for whatever is no such matrix: of other types, damaged, too large or with data in other files, with
/// entries that are given twice, outside of the matrix or not finite; and where arcslip-mat is not there or
/// cannot be started.
SparseMatrix read_mat_file(const std::string& path, std::string_view text, const std::string& variable,
                           const std::string& file, const control::Control& control = {});

}  // namespace arcslip::scene
