#pragma once
// Where the results of a run go, and that they can go there, known before anything is computed.

#include "study_result.hpp"

#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {

/// The files of one study in a folder: NAME.scene.json, NAME.json, NAME.csv and the figures.
struct StudyFiles {
  std::string folder, name;

  std::string path(const std::string& extension) const;
};

/// A name for the files of each study, different for each.
std::vector<StudyFiles> study_files(const std::string& folder, std::span<const scene::Study> studies);

/// A folder that one run at a time writes into: made with those above it, and held as long as this lives,
/// even if the program is killed. Throws UsageError where it cannot be made or another run holds it.
class ResultsFolder {
 public:
  explicit ResultsFolder(const std::string& folder);
  ResultsFolder(ResultsFolder&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  ResultsFolder& operator=(ResultsFolder&&) = delete;
  ~ResultsFolder();

 private:
  int descriptor_;
};

/// Throws if one of the files cannot be written, or is the scene file itself.
void check_writable(const StudyFiles& files, const std::string& scene_file);
void check_writable(const std::string& file, const std::string& scene_file);

/// Writes the files and figures of a study of this kind. Returns their paths; tells on standard error why
/// figures are missing.
std::vector<std::string> write_study(const StudyFiles& files, const scene::Scene& scene,
                                     scene::StudyKind kind, const StudyResult& result, bool coefficients);

}  // namespace arcslip::app
