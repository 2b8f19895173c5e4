#pragma once

#include <arcslip/scene/files/manifest.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {

/// Returns the files that a scene reads: its own, and those that it names.
std::vector<std::string> sources_of(const scene::Scene& scene, const std::string& scene_file);

/// A folder of results with its manifest (scene/files/manifest.hpp), locked for one run at a time: created
/// with its parents and locked for the lifetime of this object; the lock does not outlive a killed program.
/// Removes temporary files left by killed runs.
class ResultsFolder {
 public:
  /// sources: files that are neither replaced nor removed. Throws UsageError if the folder cannot be created,
  /// another run holds the lock, or what has the name of the manifest is none.
  ResultsFolder(const std::string& folder, std::vector<std::string> sources);
  ResultsFolder(ResultsFolder&& other) noexcept
      : folder_(std::move(other.folder_)),
        sources_(std::move(other.sources_)),
        manifest_(std::move(other.manifest_)),
        descriptor_(std::exchange(other.descriptor_, -1)) {}
  ResultsFolder& operator=(ResultsFolder&&) = delete;
  ~ResultsFolder();

  std::string manifest_path() const;
  /// Whether a file in the folder, by its name, is a source.
  bool is_source(const std::string& name) const;
  /// Records that files of a set are about to be written: from here to end_set() the set is not complete.
  /// Throws output::WriteError.
  void begin_set(scene::FileSet set);
  /// Records the set, and, if it is complete, removes files that an earlier run wrote to it and that are not
  /// among `written` (paths). Returns the names of those removed. Throws output::WriteError.
  std::vector<std::string> end_set(const std::string& set, std::span<const std::string> written,
                                   bool complete);

 private:
  const scene::FileSet::File* known(const std::string& name) const;
  bool remove(const scene::FileSet::File& file) const;
  void write() const;

  std::string folder_;
  std::vector<std::string> sources_;
  scene::Manifest manifest_;
  int descriptor_ = -1;
};

}  // namespace arcslip::app
