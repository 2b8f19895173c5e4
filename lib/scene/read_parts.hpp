#pragma once
// Reading degrees of freedom, directions and parts.

#include <arcslip/scene/read_values.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace arcslip::scene::file {

/// The degrees of freedom. Where their list is at fault, an unknown name may be one of those that could not
/// be read and is not told.
struct Dofs {
  std::vector<std::string> names;
  std::unordered_map<std::string, int> index;
  bool complete = true;
};

/// The names of parts and ties, which share one namespace, and what is known of the parts' types. What
/// follows from a fault that is already told (a part without a type, a part without a name) is not told
/// again.
class Names {
 public:
  /// Tells a fault where the name is not allowed or taken.
  bool add(const std::string& name, const std::string& pointer, Faults& faults);
  void set_type(const std::string& part, const PartType* type);
  void set_incomplete() { complete_ = false; }

  /// The field of "part.field" or, with a hint among all such names, a fault. Nothing without a fault where
  /// the name may belong to a part that could not be read.
  const Field* field(std::string_view parameter, const std::string& pointer, Faults& faults) const;
  /// True where the parameter may belong to a part that could not be read.
  bool may_exist(std::string_view parameter) const;
  /// Every "part.field", in the order of the file.
  const std::vector<std::string>& fields() const { return fields_; }

 private:
  std::unordered_map<std::string, std::string> pointers_;      // of the first use of a name
  std::map<std::string, const PartType*, std::less<>> types_;  // null: a type that is not known
  std::vector<std::string> fields_;
  bool complete_ = true;
};

Dofs read_dofs(const Place& place, Faults& faults);
/// The direction of an object that holds one of "at", "between" and "direction".
std::optional<Direction> read_direction(const Keys& keys, const Dofs& dofs, Faults& faults);
/// A section with parts of one type, or of any element type where `type` is null.
std::vector<Part> read_parts(const Place& place, const PartType* type, const Dofs& dofs, Names& names,
                             Faults& faults);

}  // namespace arcslip::scene::file
