#pragma once
// Types of the parts of a scene: masses, springs, dampers, forces, and laws of force.

#include <arcslip/scene/field.hpp>
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
struct Member;  // keys/json_tree.hpp
struct Reading;
}  // namespace file

/// The type of a part of a section. Those of "elements" are laws of force, listed in a Catalogue.
class PartType {
 public:
  virtual ~PartType() = default;
  virtual std::string_view name() const = 0;            // in a scene file
  virtual std::string_view help() const { return {}; }  // one line

  /// Names of its directions, each an object with "at", "between" or "direction" in a scene file. Empty: a
  /// single direction, given in the part itself.
  virtual std::span<const std::string_view> slots() const { return {}; }
  std::size_t direction_count() const { return slots().empty() ? 1 : slots().size(); }
  /// Whether its options may name the directions instead: slots_with(). A name without a place in the part is
  /// that of a degree of freedom.
  virtual bool names_directions() const { return false; }
  /// Whether it has a single direction, given in the part itself.
  virtual bool has_one_direction(const Settings& options) const {
    static_cast<void>(options);
    return slots().empty() && !names_directions();
  }
  virtual std::span<const std::string_view> slots_with(const Settings& options) const {
    static_cast<void>(options);
    return slots();
  }
  std::size_t direction_count(const Settings& options) const {
    return has_one_direction(options) ? 1
           : names_directions()       ? slots_with(options).size()
                                      : direction_count();
  }

  /// Fixed options of the part, which are not parameters: choices, tables in files. They may decide which
  /// fields it has. file::KeyedPart (scene/keys/study_keys.hpp) implements these four functions.
  virtual std::vector<Key> options() const { return {}; }
  virtual Settings read_options(const file::Reading&) const { return {}; }
  /// Files named by these options.
  virtual std::vector<NamedFile*> files(Settings&) const { return {}; }
  virtual void write_options(const Settings&, const Scene&, std::vector<file::Member>&) const {}
  /// Whether they decide which fields it has; for the JSON Schema.
  virtual bool options_bring_fields() const { return !options().empty(); }

  /// The formulas of its forces, where its options have them: one for each direction.
  virtual std::vector<std::string> formulas(const Settings&) const { return {}; }

  /// Whether the part acts by the phase of the excitation, which is another one in each sector of a ring.
  virtual bool depends_on_phase(const Settings&) const { return false; }
  /// Whether a wear coefficient stands next to them: of elements that dissipate.
  virtual bool has_wear(const Settings&) const { return false; }

  /// The scalar fields with these options, in the order of Part::values. Valid as long as the options.
  virtual std::span<const Field> fields(const Settings& options) const = 0;
};

}  // namespace arcslip::scene
