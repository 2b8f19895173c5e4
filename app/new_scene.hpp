#pragma once
// Scenes to begin with: arcslip new KIND.

#include "command_line/options.hpp"

#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/study_type.hpp>

#include <limits>
#include <string>
#include <vector>

namespace arcslip::app {

/// A number that a scene is made of. upper, lower_open: what is allowed. otherwise: NaN, none.
struct NewNumber {
  std::string name, help;  // "contact-stiffness-ratio"
  double otherwise = std::numeric_limits<double>::quiet_NaN();
  std::string unit{};
  bool lower_open = true;  // above 0; false: at least 0
  double upper = std::numeric_limits<double>::infinity();
};

/// A file or a name that a scene is made of.
struct NewText {
  std::string name, help, value_name;
};

/// A kind of scene, with its options.
struct NewKind {
  std::string name, help;
  std::vector<NewNumber> numbers;
  std::vector<NewText> texts{};
  std::vector<std::string> files{};  // positional arguments: "M.mtx"
};

const std::vector<NewKind>& new_kinds();

/// The text of a scene with comments, windows, bounds and studies, and further files by their paths. Throws
/// UsageError for numbers that make none, scene::SceneError, scene::FileError and control::Interrupted.
struct NewScene {
  std::string text;
  std::vector<std::pair<std::string, std::string>> files{};  // path and text
};
NewScene new_scene(const CommandOptions& options, const scene::Catalogue& catalogue,
                   const control::Control& control);

}  // namespace arcslip::app
