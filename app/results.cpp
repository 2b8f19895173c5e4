#include "results.hpp"

#include "message.hpp"
#include "options.hpp"

#include <arcslip/output/atomic_file.hpp>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <ostream>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace arcslip::app {

std::string StudyFiles::path(const std::string& extension) const {
  return (std::filesystem::path(folder) / (name + extension)).string();
}

std::vector<StudyFiles> study_files(const std::string& folder, std::span<const scene::Study> studies) {
  std::vector<StudyFiles> all;
  for (const scene::Study& study : studies) {
    const std::string base = output::file_name(study.name);
    std::string name = base;
    const auto is_taken = [&](const StudyFiles& other) { return other.name == name; };
    for (int number = 2; std::any_of(all.begin(), all.end(), is_taken); ++number) {
      name = base + "_" + std::to_string(number);
    }
    all.push_back({folder, name});
  }
  return all;
}

ResultsFolder::ResultsFolder(const std::string& folder) : descriptor_(-1) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    const std::string cause = error ? error.message() : "it is a file";
    throw UsageError("cannot make the folder " + folder + ": " + cause + " (choose another with --out)");
  }
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A file system without locks goes without.
  if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    throw UsageError("another run writes into the folder " + folder +
                     ": wait for its end, or choose another with --out");
  }
}

ResultsFolder::~ResultsFolder() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void check_writable(const std::string& file, const std::string& scene_file) {
  std::error_code ignored;
  if (std::filesystem::equivalent(file, scene_file, ignored)) {
    throw UsageError(file + " is the scene itself: give the results another place");
  }
  output::check_writable(file);
}

void check_writable(const StudyFiles& files, const std::string& scene_file) {
  for (const char* extension : {".scene.json", ".json", ".csv", ".dat", ".gp"}) {
    check_writable(files.path(extension), scene_file);
  }
}

std::vector<std::string> write_study(const StudyFiles& files, const scene::Scene& scene,
                                     scene::StudyKind kind, const StudyResult& result, bool coefficients) {
  std::vector<std::string> paths{files.path(".scene.json"), files.path(".json"), files.path(".csv")};
  output::write_file(paths[0], [&](std::ostream& out) { out << scene::write(scene); });
  output::write_file(paths[1], [&](std::ostream& out) {
    write_json(out, scene, {&result, 1}, coefficients);
  });
  output::write_file(paths[2], [&](std::ostream& out) { write_csv(out, scene, result); });
  const output::Figures figures = write_figures(scene, kind, result, files.folder, files.name);
  paths.insert(paths.end(), figures.sources.begin(), figures.sources.end());
  paths.insert(paths.end(), figures.images.begin(), figures.images.end());
  if (!figures.problem.empty()) {
    tell(figures.problem);
  }
  return paths;
}

}  // namespace arcslip::app
