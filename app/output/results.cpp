#include "results.hpp"

#include "../command_line/options.hpp"
#include "../interrupt.hpp"
#include "message.hpp"

#include <arcslip/output/atomic_file.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <ostream>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace arcslip::app {
namespace {

constexpr std::array<const char*, 4> file_extensions = {".scene.json", ".json", ".dat", ".gp"};
constexpr std::array<const char*, 3> csv_parts = {"events", "cases", "summary"};  // next to the first table

/// "a.events.csv" next to "a.csv".
std::string nearby(const std::string& file, const std::string& part) {
  std::filesystem::path path(file);
  const std::string extension = path.extension().string();
  path.replace_extension();
  return path.string() + "." + part + extension;
}

/// Whether a file starts like a table of results.
bool is_table(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path);
  std::string first;
  return std::getline(file, first, ',') && first == "study";
}

/// Device and number of a file, by whatever name.
std::pair<dev_t, ino_t> file_of(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? std::pair(status.st_dev, status.st_ino)
                                            : std::pair<dev_t, ino_t>();
}

}  // namespace

std::string StudyFiles::path(const std::string& extension) const {
  return (std::filesystem::path(folder) / (name + extension)).string();
}

std::vector<StudyFiles> study_files(const std::string& folder, std::span<const scene::Study> studies) {
  std::vector<StudyFiles> all;
  for (const scene::Study& study : studies) {
    const std::string base = output::file_name(study.name);
    std::string name = base;
    const auto is_taken = [&](const StudyFiles& other) { return other.name == name; };
    for (int number = 2; std::any_of(all.begin(), all.end(), is_taken); ++number)
      name = base + "_" + std::to_string(number);
    all.push_back({folder, name});
  }
  return all;
}

void add_places(const StudyFiles& files, const std::string& study, std::vector<OutputPath>& places) {
  const std::string what = "the results of the study \"" + study + '"';
  for (const char* extension : file_extensions) places.push_back({what, files.path(extension)});
  add_csv_places(what, files.path(".csv"), places);
}

bool may_wait(const std::string& place) {
  std::error_code ignored;
  return place == "-" || std::filesystem::is_other(place, ignored);
}

void add_csv_places(const std::string& what, const std::string& path, std::vector<OutputPath>& places) {
  if (path != "-") places.push_back({what, path});
  for (const char* part : csv_parts)
    if (!may_wait(path)) places.push_back({what, nearby(path, part)});
}

File json_file(const std::string& path) {
  return {path, [](std::ostream& out) { return std::make_unique<results::JsonWriter>(out); }};
}

std::vector<File> csv_files(const std::string& path, std::span<const results::Schema> schemas) {
  std::vector<File> files;
  const std::vector<std::string> keys = results::table_keys(schemas);
  for (const std::string& key : keys) {
    files.push_back({files.empty() ? path : nearby(path, key),
                     [key](std::ostream& out) { return std::make_unique<results::CsvWriter>(out, key); }});
  }
  if (may_wait(path)) {
    files.resize(1);
    return files;
  }
  files.push_back({nearby(path, "summary"),
                   [](std::ostream& out) { return std::make_unique<results::CsvSummary>(out); }});
  return files;
}

std::vector<std::string> older_tables(const std::string& path, std::span<const results::Schema> schemas) {
  std::vector<std::string> older;
  const std::vector<std::string> keys = results::table_keys(schemas);
  for (const char* part : {"events", "cases"})
    if (!may_wait(path) && std::find(keys.begin(), keys.end(), part) == keys.end() &&
        is_table(nearby(path, part)))
      older.push_back(nearby(path, part));
  return older;
}

void write(const File& file, const results::Results& results, std::ostream& out) {
  results::replay(results, *file.sink(out));
}

void check_places(const std::vector<OutputPath>& places, const std::vector<std::string>& sources) {
  std::map<std::string, std::string> by_path;              // what goes there
  std::map<std::pair<dev_t, ino_t>, std::string> by_file;  // the same, of what is there, by whatever name
  struct stat status {};
  for (const std::string& source : sources)
    if (::stat(source.c_str(), &status) == 0) by_file.emplace(std::pair(status.st_dev, status.st_ino), "");
  if (::fstat(STDOUT_FILENO, &status) == 0 && S_ISREG(status.st_mode))
    by_file.emplace(std::pair(status.st_dev, status.st_ino), "standard output");
  for (const OutputPath& place : places) {
    const bool is_there = ::stat(place.path.c_str(), &status) == 0;
    if (is_there && S_ISCHR(status.st_mode)) {
      output::check_writable(place.path);
      continue;  // a terminal or /dev/null takes all
    }
    const auto other = by_path.emplace(output::written_file(place.path), place.what);
    const auto file = std::pair(status.st_dev, status.st_ino);
    const auto same = is_there ? by_file.emplace(file, place.what) : std::pair(by_file.end(), true);
    if (!same.second && same.first->second.empty()) {
      throw UsageError(results::visible(place.path) +
                       (file == file_of(sources.front())
                            ? " is the scene file itself: choose another path for the results"
                            : " is a file that the scene reads: choose another path for the results"));
    }
    if (!other.second || !same.second) {
      throw UsageError((other.second ? same.first->second : other.first->second) + " and " + place.what +
                       " both go to " + results::visible(place.path) +
                       ": choose another path for one of them");
    }
    output::check_writable(place.path);
  }
}

bool Writing::attempt(const std::string& what, const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const output::WriteError& error) {
    tell(error.what());
    (error.error() == EINTR ? stopped_ : failed_) = true;
    ++failures_;
    misses(what);
    return false;
  }
}

std::string Writing::missing() const {
  std::string list;
  for (const std::string& what : missing_) list += (list.empty() ? "" : ", ") + what;
  return list.empty() ? "all results were written" : "not written: " + list;
}

ExitCode Writing::code(ExitCode otherwise) const {
  return failed_ ? ExitCode::usage_or_file : stopped_ ? ExitCode::stopped_early : otherwise;
}

std::vector<std::string> write_scene(const StudyFiles& files, const scene::Scene& scene, Writing& writing) {
  const std::string path = files.path(".scene.json");
  const bool is_written = writing.attempt(results::visible(path), [&] {
    output::write_file(
        path,
        [&](std::ostream& out) {
          out << scene::write(scene::from_folder(scene, std::filesystem::path(path).parent_path().string()));
        },
        by_signal());
  });
  return is_written ? std::vector{path} : std::vector<std::string>();
}

namespace {

std::string figure_name(const StudyFiles& files, const results::FigureData& data) {
  return files.name + (data.name.empty() ? "" : "_" + data.name);
}

}  // namespace

std::vector<std::string> figure_names(const StudyFiles& files,
                                      const std::vector<results::FigureData>& figures,
                                      const output::FigureOptions& options) {
  std::vector<std::string> names;
  for (const results::FigureData& data : figures)
    for (std::string& name : output::figure_files(data, figure_name(files, data), options))
      names.push_back(std::move(name));
  return names;
}

FiguresOfStudy::FiguresOfStudy(const StudyFiles& files, const std::vector<results::FigureData>& figures,
                               const output::FigureOptions& options, Writing& writing)
    : what_("the figures of " + results::visible(files.path(""))) {
  if (figures.empty()) return;
  std::vector<output::NamedFigures> all;
  for (const results::FigureData& data : figures) all.push_back({figure_name(files, data), data});
  writing.attempt(what_, [&] {
    try {
      drawing_ = std::make_unique<output::DrawingFigures>(all, files.folder, options, by_signal());
    } catch (const std::bad_alloc&) {
      drawn_.problem = "no figure was drawn: out of memory";
    }
  });
}

DrawnFigures FiguresOfStudy::finish(Writing& writing) {
  if (drawing_) {
    const output::Figures done = drawing_->finish();
    drawn_.paths = done.sources;
    drawn_.paths.insert(drawn_.paths.end(), done.images.begin(), done.images.end());
    drawn_.problem = done.problem;
  }
  if (!drawn_.problem.empty()) writing.misses(what_);
  return std::move(drawn_);
}

}  // namespace arcslip::app
