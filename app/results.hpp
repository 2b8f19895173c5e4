#pragma once
// Where the results of a run go, and that they can go there, known before anything is computed.

#include "exit_code.hpp"

#include <arcslip/results/figure.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {

/// The files of one study in a folder: NAME.scene.json, NAME.json, NAME.csv with those beside it, and the
/// figures.
struct StudyFiles {
  std::string folder, name;

  std::string path(const std::string& extension) const;
};

/// A name for the files of each study, different for each.
std::vector<StudyFiles> study_files(const std::string& folder, std::span<const scene::Study> studies);

/// A folder that one run at a time writes into: made with those above it, and held as long as this lives,
/// even if the program is killed. What a killed run has left half-written is removed. Throws UsageError where
/// it cannot be made or another run holds it.
class ResultsFolder {
 public:
  explicit ResultsFolder(const std::string& folder);
  ResultsFolder(ResultsFolder&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  ResultsFolder& operator=(ResultsFolder&&) = delete;
  ~ResultsFolder();

 private:
  int descriptor_;
};

/// Where something is to be written, and what, for people.
struct Place {
  std::string what, path;
};

/// A file and the sink that writes it. No sink: there is to be none; what an earlier run has left is removed.
struct File {
  std::string path;
  std::function<std::unique_ptr<results::Sink>(std::ostream&)> sink;
};

File json_file(const std::string& path);

/// Results as CSV: the first of their tables in `path`; the others and the summary beside it, with the key of
/// the table or "summary" before the ending of the name, but not where that is standard output ("-"), a pipe
/// or a device.
std::vector<File> csv_files(const std::string& path, std::span<const results::Schema> schemas);

/// Writes results that are there.
void write(const File& file, const results::Results& results, std::ostream& out);

/// Where CSV of any results may go.
void add_csv_places(const std::string& what, const std::string& path, std::vector<Place>& places);

/// Whether a place may have to wait for a reader: standard output ("-"), a pipe, a device.
bool may_wait(const std::string& place);

/// All of a study that has files of its own.
void add_places(const StudyFiles& files, const std::string& study, std::vector<Place>& places);

/// Throws UsageError where two of them are one file, by whatever name, or one is the scene file or that below
/// standard output; output::WriteError where one cannot be written.
void check_places(const std::vector<Place>& places, const std::string& scene_file);

/// Writes one thing after the other: what cannot be written is told on standard error and costs nothing else.
class Writing {
 public:
  /// Whether it is written: whatever may throw output::WriteError; `what` it writes, for people.
  bool attempt(const std::string& what, const std::function<void()>& write);
  /// The file of an earlier run.
  static void remove(const std::string& path);
  /// `what` is not there for a reason that is told.
  void misses(std::string what) { missing_.push_back(std::move(what)); }
  /// What is not there: part of a sentence.
  std::string missing() const;
  /// How the program is to end, which would end in another way if all were written.
  ExitCode code(ExitCode otherwise) const;

 private:
  bool failed_ = false, stopped_ = false;
  std::vector<std::string> missing_;
};

/// The scene as it is computed, beside the results of its study. Returns its path where it is written.
std::vector<std::string> write_scene(const StudyFiles& files, const scene::Scene& scene, Writing& writing);

/// Draws the figures of a study; those that an earlier run has left are removed. Returns the paths of what is
/// there; tells on standard error what is missing, and why.
std::vector<std::string> write_figures(const StudyFiles& files,
                                       const std::vector<results::FigureData>& figures, Writing& writing);

}  // namespace arcslip::app
