#pragma once
// The manifest of a folder: which files a command wrote there, and which of them belong together. It is
// written before the first file of a set is replaced and after the last one, so that a set that is old in
// part is known as such.

#include <arcslip/scene/scene.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// FNV-1a of 64 bits (Fowler, Noll, Vo), as 16 hexadecimal digits.
class ContentHash {
 public:
  void add(std::string_view text) {
    for (const char c : text) state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  std::string text() const;

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// The files that one study or `reduce` wrote.
struct FileSet {
  struct File {
    std::string name;    // in the folder
    std::string hash{};  // of the content that was written; "" where it is not known
  };
  std::string name, program, scene_hash;
  bool complete = false;  // all files are there, and of one run
  std::vector<File> files{};
};

constexpr const char* manifest_name = "arcslip-manifest.json";

struct Manifest {
  std::vector<FileSet> sets{};

  FileSet* find(std::string_view set);
  std::string text() const;
};

/// Reads the manifest of a folder; without sets where there is none. Throws FileError if it is damaged or
/// cannot be read.
Manifest read_manifest(const std::string& folder);

/// Returns the hash of a file's content; "" if it cannot be read, or is a pipe or a device.
std::string file_hash(const std::string& path);

/// Files that a scene reads and that differ from what the manifest next to them says, in sentences for the
/// user: of a set that was interrupted, and changed since they were written. file: the path of the scene.
struct ManifestDoubts {
  std::vector<std::string> interrupted, changed;
};
ManifestDoubts manifest_doubts(const Scene& scene, const std::string& file);

}  // namespace arcslip::scene
