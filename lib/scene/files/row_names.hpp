#pragma once
// The CSV file with the names of rows of matrices: the header "name,row", then a name and a row from 1 on
// each line. Empty lines and those that begin with # are left out.

#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/matrices.hpp>

#include <string>
#include <vector>

namespace arcslip::scene::file {

/// Adds the rows to matrices, whose size and copies are known, and the names to dofs: where there are several
/// copies, each with the number of its copy at its end. Faults stand at the key that names the file.
void read_row_names(const Location& at, const NamedFile& file, Matrices& matrices, Dofs& dofs,
                    Faults& faults);

/// The names alone, as they stand in the file at this path; none of a file that cannot be read, without a
/// fault.
std::vector<std::string> row_names(const Location& path, const FileSource& source);

}  // namespace arcslip::scene::file
