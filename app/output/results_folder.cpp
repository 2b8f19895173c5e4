#include "results_folder.hpp"

#include "../command_line/options.hpp"

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

namespace fs = std::filesystem;
using scene::FileSet;

std::vector<std::string> sources_of(const scene::Scene& scene, const std::string& scene_file) {
  std::vector<std::string> sources = {scene_file};
  scene::Scene copy = scene;
  for (const scene::NamedFile* file : scene::files(copy))
    if (!file->path.empty()) sources.push_back((fs::path(scene.folder.path) / file->path).string());
  return sources;
}

namespace {

// Of a file that was there before and that no manifest names: it may be replaced, and is not removed.
constexpr const char* of_others = "not written by Arcslip";

template <class Files>
auto file_named(Files& files, const std::string& name) {
  return std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; });
}

}  // namespace

ResultsFolder::ResultsFolder(const std::string& folder, std::vector<std::string> sources)
    : folder_(folder), sources_(std::move(sources)) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    const std::string cause = error ? error.message() : "it is a file";
    throw UsageError("cannot create the folder " + folder + ": " + cause + " (choose another with --out)");
  }
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const auto refuse = [&](const std::string& why) {
    ::close(descriptor_);
    throw UsageError(why + ", or choose another folder with --out");
  };
  // File systems without locks are accepted.
  if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    refuse("another run is writing to the folder " + folder + ": wait until it ends");
  try {
    manifest_ = scene::read_manifest(folder);
  } catch (const scene::FileError& damaged) {
    refuse(damaged.what());
  }
  output::clear_temporaries(folder);
}

ResultsFolder::~ResultsFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string ResultsFolder::manifest_path() const {
  return (fs::path(folder_) / scene::manifest_name).string();
}

bool ResultsFolder::is_source(const std::string& name) const {
  const fs::path path = fs::path(folder_) / name;
  return std::any_of(sources_.begin(), sources_.end(), [&](const std::string& source) {
    std::error_code not_there;
    return fs::equivalent(path, source, not_there);
  });
}

void ResultsFolder::write() const {
  output::write_file(manifest_path(), [&](std::ostream& out) { out << manifest_.text(); });
}

const FileSet::File* ResultsFolder::known(const std::string& name) const {
  for (const FileSet& set : manifest_.sets)
    if (const auto file = file_named(set.files, name); file != set.files.end()) return &*file;
  return nullptr;
}

void ResultsFolder::begin_set(FileSet set) {
  set.complete = false;
  std::error_code error;
  for (FileSet::File& file : set.files) {
    const fs::path path = fs::path(folder_) / file.name;
    if (!fs::exists(fs::symlink_status(path, error))) continue;
    const FileSet::File* before = known(file.name);
    const bool is_ours =
        before != nullptr && !before->hash.empty() && before->hash == scene::file_hash(path.string());
    file.hash = is_ours ? before->hash : of_others;
  }
  if (const FileSet* before = manifest_.find(set.name))
    for (FileSet::File file : before->files) {
      if (file_named(set.files, file.name) != set.files.end()) continue;
      // Of a killed run, which need not have written it: an image that was being drawn is nobody else's.
      if (file.hash.empty() && !file.name.ends_with(".tmp")) file.hash = of_others;
      set.files.push_back(std::move(file));
    }
  std::erase_if(manifest_.sets, [&](const FileSet& other) { return other.name == set.name; });
  for (FileSet& other : manifest_.sets)
    std::erase_if(other.files, [&](const FileSet::File& file) {
      return file_named(set.files, file.name) != set.files.end();
    });
  manifest_.sets.push_back(std::move(set));
  write();
  ::fsync(descriptor_);  // before any of the files is replaced
}

bool ResultsFolder::remove(const FileSet::File& file) const {
  const std::string path = (fs::path(folder_) / file.name).string();
  std::error_code error;
  const bool is_ours = fs::is_regular_file(fs::symlink_status(path, error)) && !is_source(file.name) &&
                       (file.hash.empty() || file.hash == scene::file_hash(path));
  return is_ours && fs::remove(path, error);
}

std::vector<std::string> ResultsFolder::end_set(const std::string& name, std::span<const std::string> written,
                                                bool complete) {
  FileSet& set = *manifest_.find(name);
  std::vector<FileSet::File> files;
  for (const std::string& path : written)
    if (const std::string hash = scene::file_hash(path); !hash.empty())  // no pipes and devices
      files.push_back({fs::path(path).filename().string(), hash});
  std::vector<std::string> removed;
  for (const FileSet::File& file : set.files) {
    if (file_named(files, file.name) != files.end()) continue;
    if (!complete)
      files.push_back(file);
    else if (remove(file))
      removed.push_back(file.name);
  }
  set.files = std::move(files);
  set.complete = complete;
  ::fsync(descriptor_);  // all files have their names
  write();
  return removed;
}

}  // namespace arcslip::app
