#pragma once
// Files that a scene names: tables, matrices. They are read with the scene, and its hash covers what they
// hold.

#include <arcslip/scene/stop_request.hpp>

#include <memory>
#include <string>
#include <vector>

namespace arcslip::scene {

/// Where a scene is from: its relative paths begin here. Scenes that differ in it alone are equal.
struct Folder {
  std::string path{};  // empty: the current directory
  friend bool operator==(const Folder&, const Folder&) { return true; }
};

/// A file that a scene names. Its text is shared by all copies.
struct NamedFile {
  std::string path{};  // as the scene has it: absolute, or relative to the scene's folder
  std::shared_ptr<const std::string> text{};  // what it held when the scene was read; null: there is none
  friend bool operator==(const NamedFile& a, const NamedFile& b) {
    return a.path == b.path && (a.text == b.text || (a.text && b.text && *a.text == *b.text));
  }
};

namespace file {

/// What a reader needs for the files that it comes to.
struct FileSource {
  Folder folder{};
  StopRequest stop{};
  std::vector<NamedFile> read{};  // already
};

}  // namespace file
}  // namespace arcslip::scene
