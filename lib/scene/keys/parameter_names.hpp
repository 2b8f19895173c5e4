#pragma once
// The names of parts and constants, and the parameters "part.field" that they give.

#include <arcslip/scene/keys/read_values.hpp>

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace arcslip::scene::file {

/// Why a name is not allowed, as the end of a message; empty if it is.
std::string objection(const std::string& name);

/// The names of parts and constants, which share one namespace, and the known fields of the parts.
/// Consequences of a fault that is already reported (a part without a type, a part without a name) are not
/// reported again.
class Names {
 public:
  /// Reports a fault if the name is not allowed or taken.
  bool add(const std::string& name, const std::string& pointer, Faults& faults);
  /// Of a constant, which may also be called as the field of a part is, "part.field", where there is no such
  /// part.
  bool add_constant(const std::string& name, const std::string& pointer, Faults& faults);
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
  bool add_new(const std::string& name, const std::string& pointer, Faults& faults);

  std::unordered_map<std::string, std::string> pointers_;                        // of the first use of a name
  std::map<std::string, std::optional<std::vector<Field>>, std::less<>> parts_;  // none: not known
  std::vector<std::string> fields_;
  bool complete_ = true;
};

}  // namespace arcslip::scene::file
