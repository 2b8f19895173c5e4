#pragma once
// Output files of a run, and the checks before anything is computed that they can be written.

#include "../exit_code.hpp"

#include <arcslip/output/figures.hpp>
#include <arcslip/results/figure_data.hpp>
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

/// The files of one study in a folder: NAME.scene.json, NAME.json, NAME.csv with its companions, and the
/// figures.
struct StudyFiles {
  std::string folder, name;

  std::string path(const std::string& extension) const;
};

/// Unique file names for each study.
std::vector<StudyFiles> study_files(const std::string& folder, std::span<const scene::Study> studies);

/// An output path, and a description of what goes there.
struct OutputPath {
  std::string what, path;
};

/// A file and the sink that writes it.
struct File {
  std::string path;
  std::function<std::unique_ptr<results::Sink>(std::ostream&)> sink;
};

File json_file(const std::string& path);

/// Results as CSV: the first table in `path`; the others and the summary next to it, with the key of the
/// table or "summary" inserted before the extension, unless `path` is standard output ("-"), a pipe or a
/// device.
std::vector<File> csv_files(const std::string& path, std::span<const results::Schema> schemas);

/// Returns tables next to `path` from earlier results, which these have no counterpart of.
std::vector<std::string> older_tables(const std::string& path, std::span<const results::Schema> schemas);

/// Writes collected results.
void write(const File& file, const results::Results& results, std::ostream& out);

/// Adds every path that CSV results may be written to.
void add_csv_places(const std::string& what, const std::string& path, std::vector<OutputPath>& places);

/// Whether writing may block on a reader: standard output ("-"), a pipe, a device.
bool may_wait(const std::string& place);

/// Adds the paths of a study with files of its own.
void add_places(const StudyFiles& files, const std::string& study, std::vector<OutputPath>& places);

/// Throws UsageError if two of the paths are the same file, under whatever name, or one is a file that is
/// read (the scene's, and those that it names) or the file behind standard output; output::WriteError if one
/// cannot be written.
void check_places(const std::vector<OutputPath>& places, const std::vector<std::string>& sources);

/// Writes several outputs in turn: a failure is reported on standard error and does not affect the others.
class Writing {
 public:
  /// Calls write(), which may throw output::WriteError. what: the output, for messages. Returns success.
  bool attempt(const std::string& what, const std::function<void()>& write);
  /// Records that `what` is missing, for a reason reported elsewhere.
  void misses(std::string what) { missing_.push_back(std::move(what)); }
  /// The outputs that could not be written so far.
  std::size_t failures() const { return failures_; }
  /// The missing outputs, as part of a sentence.
  std::string missing() const;
  /// The exit code; `otherwise` if everything was written.
  ExitCode code(ExitCode otherwise) const;

 private:
  bool failed_ = false, stopped_ = false;
  std::size_t failures_ = 0;
  std::vector<std::string> missing_;
};

/// Writes the resolved scene next to the results of its study. Returns its path, if written.
std::vector<std::string> write_scene(const StudyFiles& files, const scene::Scene& scene, Writing& writing);

/// Returns the names of all files that figures may have.
std::vector<std::string> figure_names(const StudyFiles& files,
                                      const std::vector<results::FigureData>& figures,
                                      const output::FigureOptions& options);

/// Figures that were drawn, and why others were not, in a sentence for the user.
struct DrawnFigures {
  std::vector<std::string> paths{};
  std::string problem{};
};

/// The figures of a study, drawn while the next one is computed.
class FiguresOfStudy {
 public:
  /// Writes their data and starts to draw them.
  FiguresOfStudy(const StudyFiles& files, const std::vector<results::FigureData>& figures,
                 const output::FigureOptions& options, Writing& writing);

  /// Waits for them.
  DrawnFigures finish(Writing& writing);

 private:
  std::string what_;
  std::unique_ptr<output::DrawingFigures> drawing_{};  // null: nothing is drawn
  DrawnFigures drawn_{};
};

}  // namespace arcslip::app
