#pragma once
// Reading degrees of freedom, and the directions in them that parts act on.

#include <arcslip/scene/keys/read_values.hpp>

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace arcslip::scene::file {

/// The degrees of freedom. If their list has faults, an unknown name may be one that could not be read, and
/// is not reported.
struct Dofs {
  std::vector<std::string> names;
  std::unordered_map<std::string, int> index;
  bool complete = true;
  bool have_next = false;  // {"next": name} is that of the next sector
};

/// Why a name is not allowed for a further degree of freedom; empty if it is.
std::string objection_of_dof(const std::string& name, const Dofs& dofs);
/// Those of the list after those already there.
void read_dofs(const Location& place, Dofs& dofs, Faults& faults);
/// The direction of an object with one of "at", "between" and "direction".
std::optional<Direction> read_direction(const Keys& keys, const Dofs& dofs, Faults& faults);

}  // namespace arcslip::scene::file
