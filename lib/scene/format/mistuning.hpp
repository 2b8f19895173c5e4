#pragma once
// Unequal sectors of a full ring, "mistuning": {"kb.value": [1, 1.02, 0.97], "matrices.stiffness": [...]}.

#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/keys/json_tree.hpp>

namespace arcslip::scene::file {

/// "structure": {"matrices": {...}}, whose stiffness may differ from sector to sector.
inline constexpr const char* matrices_stiffness = "matrices.stiffness";

/// Multiplies the numbers of the sector's parts, each then {"each": [its values]} (repeat.hpp), and the
/// stiffness matrix, which gets its "stiffness_factors".
void mistune(Node& scene, int sectors, Faults& faults);

}  // namespace arcslip::scene::file
