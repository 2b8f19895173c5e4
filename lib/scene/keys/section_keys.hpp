#pragma once
// Sections of a scene by the key tables that studies have (study_keys.hpp): an object with keys of its own,
// and keys without a default.

#include <arcslip/scene/keys/study_keys.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// The keys of "harmonics", and of "matrices", "beam" or "rod", and "cyclic" in "structure".
const SettingsKeys& harmonics_keys();
const SettingsKeys& matrices_keys();
const SettingsKeys& bar_keys(bool bends);
const SettingsKeys& cyclic_keys();

namespace file {

/// What an object gives that has the keys of a table; the defaults where there is none.
Settings read_section(const Location& place, const SettingsKeys& table, const Field& frequency,
                      const FileSource& source, const Dofs& dofs, Faults& faults);

/// "beam" or "rod" of a structure that is one.
void write_bar(const Matrices& matrices, const Scene& scene, Node::Object& structure);

/// A key whose value is described by a JSON Schema.
Key key_of(std::string name, std::string unit, std::string allowed, std::string help, std::string schema,
           bool required = false);

/// A frequency above 0 that may be left out, and is 0 then.
KeyGroup<double> optional_frequency(const std::string& name, std::string help);

/// The group with keys that have no default: written where the value is another one than without them.
template <class S, class T>
KeyGroup<S> optional(T S::*value, KeyGroup<S> group) {
  for (Key& key : group.keys) key.otherwise.clear();
  group.write = [value, write = std::move(group.write)](const S& s, const Scene& scene, Node::Object& to) {
    if (s.*value != S{}.*value) write(s, scene, to);
  };
  return group;
}

/// The group with a first key that must be there.
template <class S>
KeyGroup<S> required(KeyGroup<S> group) {
  Key& key = group.keys.front();
  key.required = true;
  key.otherwise.clear();
  group.read = [name = key.name, allowed = key.allowed, read = std::move(group.read)](const Reading& reading,
                                                                                      S& s) {
    reading.keys.require(name, allowed, reading.faults);
    read(reading, s);
  };
  return group;
}

}  // namespace file
}  // namespace arcslip::scene
