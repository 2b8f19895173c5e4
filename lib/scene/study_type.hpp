#pragma once
// A kind of study as scene files have it: its name and its keys. What it computes stands in
// studies/study_kind.hpp. Kinds and laws of force are listed in a Catalogue, which is passed to the reader of
// a scene; reader, writer and command depend on no specific kind.

#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// A parameter that a study itself sets, and how: `which the study is "over"`.
struct ParameterUse {
  std::string parameter, how;
};

/// Takes a number of a study's settings and its JSON pointer in the study, "/from" or "/frequency/0".
using NumberVisitor = std::function<void(const std::string& pointer, double& number)>;

/// The ends of a window of frequencies, in the scene's unit.
struct WindowEnds {
  double *lower, *upper;
};

/// The keys of settings, whose type only file::KeysOf (scene/keys/study_keys.hpp) knows. Settings that are
/// empty have the defaults.
class SettingsKeys {
 public:
  virtual ~SettingsKeys() = default;

  virtual std::vector<Key> keys() const = 0;  // in the order of a file
  virtual Settings defaults() const = 0;
  virtual Settings read(const file::Reading& from) const = 0;
  /// Files named by the settings.
  virtual std::vector<NamedFile*> files(Settings& settings) const = 0;
  /// The window that the settings may have; both of its ends are 0 where the scene does not give it.
  virtual std::optional<WindowEnds> window(Settings& settings) const = 0;
  virtual void write(const Settings& settings, const Scene& scene, std::vector<file::Member>& to) const = 0;

  virtual std::vector<ParameterUse> taken(const Settings& settings) const = 0;
  /// Visits the numbers that may follow parameters.
  virtual void visit_numbers(Settings& settings, const NumberVisitor& visit) const = 0;
  /// Removes a parameter from lists of values; the continuation parameter cannot be removed.
  virtual void drop(std::string_view parameter, Settings& settings) const = 0;
};

class StudyType {
 public:
  /// name: "frf", as a scene file writes it; verb: of the command, if it is not the name; help: one line;
  /// keys: those between "kind" and "for_each".
  StudyType(std::string_view name, std::string_view verb, std::string_view help,
            std::shared_ptr<const SettingsKeys> keys)
      : name_(name), verb_(verb.empty() ? name : verb), help_(help), keys_(std::move(keys)) {}
  virtual ~StudyType() = default;

  std::string_view name() const { return name_; }
  std::string_view verb() const { return verb_; }
  std::string_view help() const { return help_; }
  std::vector<Key> keys() const { return keys_->keys(); }
  const SettingsKeys& settings() const { return *keys_; }

 private:
  std::string_view name_, verb_, help_;
  std::shared_ptr<const SettingsKeys> keys_;
};

/// The laws of force of the section "elements" and the kinds of studies known to a reader. Scenes share the
/// ownership of theirs.
struct Catalogue {
  std::vector<std::shared_ptr<const PartType>> elements;
  std::vector<std::shared_ptr<const StudyType>> studies;

  /// The law or the kind with that name, or null.
  const PartType* element(std::string_view name) const;
  const StudyType* study(std::string_view name) const;
};

/// Returns a type for a catalogue that lives as long as the program, as those of Arcslip do.
template <class Type>
std::shared_ptr<const Type> lasting(const Type& type) {
  return {std::shared_ptr<const void>(), &type};
}

}  // namespace arcslip::scene
