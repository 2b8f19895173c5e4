#pragma once
// What the parts of a scene are: masses, springs, dampers, forces, and laws of force.

#include <arcslip/scene/field.hpp>
#include <arcslip/scene/json_tree.hpp>
#include <arcslip/scene/key.hpp>
#include <arcslip/scene/named_file.hpp>
#include <arcslip/scene/settings.hpp>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace arcslip::scene {

struct Scene;

namespace file {
struct Reading;
}

/// What a section of the scene may hold. Those of "elements" are laws of force; they stand in a Catalogue.
class PartType {
 public:
  virtual ~PartType() = default;
  virtual std::string_view name() const = 0;            // as a scene file writes it
  virtual std::string_view help() const { return {}; }  // one line

  /// Names of its directions, each an object with "at", "between" or "direction" in a scene file. Empty: it
  /// has one, which stands in the part itself.
  virtual std::span<const std::string_view> slots() const { return {}; }
  std::size_t direction_count() const { return slots().empty() ? 1 : slots().size(); }

  /// What is settled with the part and is no parameter: choices, tables in files. It may decide which fields
  /// there are. file::KeyedPart (study_keys.hpp) has all four of these.
  virtual std::vector<Key> options() const { return {}; }
  virtual Settings read_options(const file::Reading&) const { return {}; }
  /// Files that these options name.
  virtual std::vector<NamedFile*> files(Settings&) const { return {}; }
  virtual void write_options(const Settings&, const Scene&, file::Node::Object&) const {}

  /// The scalar fields with these options, in the order of Part::values. They live as long as the options.
  virtual std::span<const Field> fields(const Settings& options) const = 0;
};

}  // namespace arcslip::scene
