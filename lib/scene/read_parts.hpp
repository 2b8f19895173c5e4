#pragma once
// Reading degrees of freedom, directions and parts.

#include <arcslip/scene/read_values.hpp>

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
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

/// Why a name is not allowed, as the end of a message; empty if it is.
std::string objection(const std::string& name);

/// The names of parts and ties, which share one namespace, and the known fields of the parts. Consequences of
/// a fault that is already reported (a part without a type, a part without a name) are not reported again.
class Names {
 public:
  /// Reports a fault if the name is not allowed or taken.
  bool add(const std::string& name, const std::string& pointer, Faults& faults);
  void set_fields(const std::string& part, std::span<const Field> fields);  // copied
  void set_unknown(const std::string& part);                                // what fields it has
  void set_incomplete() { complete_ = false; }

  /// The field of "part.field", or a fault with a hint. Nothing, without a fault, if the name may belong to a
  /// part that could not be read.
  const Field* field(std::string_view parameter, const std::string& pointer, Faults& faults) const;
  /// Whether the parameter may belong to a part that could not be read.
  bool may_exist(std::string_view parameter) const;
  /// Every "part.field", in the order of the file.
  const std::vector<std::string>& fields() const { return fields_; }

 private:
  std::unordered_map<std::string, std::string> pointers_;                        // of the first use of a name
  std::map<std::string, std::optional<std::vector<Field>>, std::less<>> parts_;  // none: not known
  std::vector<std::string> fields_;
  bool complete_ = true;
};

/// The key "wear_coefficient" of an element.
inline constexpr Field wear_coefficient{.name = "wear_coefficient",
                                        .unit = "m^3/J",
                                        .lower = 0,
                                        .upper = std::numeric_limits<double>::infinity(),
                                        .default_value = 0.0,
                                        .help = "volume worn for the energy dissipated"};

/// Why a name is not allowed for a further degree of freedom; empty if it is.
std::string objection_of_dof(const std::string& name, const Dofs& dofs);
inline constexpr int largest_copies = 10'000;  // of matrices
/// The matrices of "structure", if it has any, from files or of a bar; the rows with names are the first
/// degrees of freedom.
std::optional<Matrices> read_matrices(const Keys& structure, FrequencyUnit unit, const FileSource& source,
                                      Dofs& dofs, Faults& faults);
std::optional<Matrices> read_bar(const Location& place, bool bends, FrequencyUnit unit,
                                 const FileSource& source, Dofs& dofs, Faults& faults);
/// Those of the list after those already there.
void read_dofs(const Location& place, Dofs& dofs, Faults& faults);
/// The direction of an object with one of "at", "between" and "direction".
std::optional<Direction> read_direction(const Keys& keys, const Dofs& dofs, Faults& faults);
/// The options of a part of this type.
Settings read_options(const PartType& type, const Location& place, const Dofs& dofs, const FileSource& source,
                      Faults& faults);
/// The patches of contacts, of any of these laws.
std::vector<Part> read_patches(const Location& place, std::span<const PartType* const> laws, const Dofs& dofs,
                               const FileSource& source, Names& names, Faults& faults);
/// A section with parts of one type or, if `type` is null, of any of `types`.
std::vector<Part> read_parts(const Location& place, const PartType* type,
                             std::span<const PartType* const> types, const Dofs& dofs,
                             const FileSource& source, Names& names, Faults& faults);
/// The part that an object is; none without it.
std::vector<Part> read_one(const Location& place, const PartType& type, const Dofs& dofs,
                           const FileSource& source, Names& names, Faults& faults);

}  // namespace arcslip::scene::file
