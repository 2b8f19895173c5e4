#pragma once
// Files named by a scene: tables, matrices. They are read with the scene, and its hash covers their content.

#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/sparse_matrix.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// The folder of a scene, to which its paths are relative. Scenes that differ only in it are equal.
struct Folder {
  std::string path{};  // empty: the current directory
  friend bool operator==(const Folder&, const Folder&) { return true; }
};

/// A file named by a scene. Its text is shared by all copies.
struct NamedFile {
  std::string path{};                         // as in the scene: absolute, or relative to the scene's folder
  std::shared_ptr<const std::string> text{};  // content when the scene was read; null: none
  friend bool operator==(const NamedFile& a, const NamedFile& b) {
    return a.path == b.path && (a.text == b.text || (a.text && b.text && *a.text == *b.text));
  }
};

class Derived;  // matrices.hpp

namespace file {

/// Context for reading named files. A file that a scene names several times is read once.
struct FileSource {
  Folder folder{};
  control::Control control{};
  mutable std::vector<NamedFile> read{};  // already
  // The matrices in texts that have been read, with the names of their variables.
  struct Known {
    std::shared_ptr<const std::string> text;
    std::string variable;
    std::shared_ptr<const SparseMatrix> matrix;
  };
  mutable std::vector<Known> matrices{};
  std::shared_ptr<Derived> derived{};  // of them
};

}  // namespace file
}  // namespace arcslip::scene
