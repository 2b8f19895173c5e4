#pragma once
// A JSON document of results, whichever their kinds.

#include <arcslip/scene/scene.hpp>

#include <functional>
#include <iosfwd>
#include <span>
#include <string>

namespace arcslip::output {

/// All results of one kind.
struct JsonSection {
  std::string format;                          // of a document that holds nothing else: "arcslip-branches-1"
  std::string key;                             // "branches"
  std::function<void(std::ostream&)> write{};  // writes the value of that key
};

/// Writes one object, {"format", "program", "scene_hash", "title", "frequency_unit"} and the sections by
/// their keys. Its format is that of the only section, or "arcslip-results-1" where there is not exactly one.
void write_document(std::ostream& out, const scene::Scene& scene, std::span<const JsonSection> sections);

}  // namespace arcslip::output
