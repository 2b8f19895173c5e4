#pragma once
// The rows of the CSV file of a patch, and the displacements in their cells.

#include <arcslip/scene/keys/read_places.hpp>
#include <arcslip/scene/patch.hpp>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::scene::file {

/// Those in the text of PatchOptions::file. Faults are at `pointer`, the key of the file, and say the line.
/// The values of the elements are checked if those of the patch are right.
std::vector<PatchRow> read_patch_rows(const Part& patch, bool has_values, const Dofs& dofs,
                                      const std::string& pointer, Faults& faults);

/// The cells of a contact that is given by its nodes and axes; empty: the default.
struct NodeCells {
  std::string_view nodes, against, normal, tangent;
};

/// Takes what is wrong with a cell.
using Report = std::function<void(const std::string&)>;

/// That of a sum, "a", "-a", "a - b", "0.6*a.x + 0.8*a.z": terms between signs that stand alone.
Direction displacement(std::string_view sum, const Dofs& dofs, const Report& report);

/// Those of a law, by their names, along the axes of the contact: of the mean of its nodes less that of those
/// against them. Empty where a cell is wrong.
std::vector<Direction> displacements(const NodeCells& cells, std::span<const std::string> names,
                                     const Dofs& dofs, const Report& report);

}  // namespace arcslip::scene::file
