#pragma once
// The rows of the CSV file of a patch.

#include <arcslip/scene/keys/read_places.hpp>
#include <arcslip/scene/patch.hpp>

#include <string>
#include <vector>

namespace arcslip::scene::file {

/// Those in the text of PatchOptions::file. Faults are at `pointer`, the key of the file, and say the line.
/// The values of the elements are checked if those of the patch are right.
std::vector<PatchRow> read_patch_rows(const Part& patch, bool has_values, const Dofs& dofs,
                                      const std::string& pointer, Faults& faults);

}  // namespace arcslip::scene::file
