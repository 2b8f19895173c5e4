#pragma once
// Files that appear under their name only when complete.

#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>

#include <functional>
#include <memory>
#include <ostream>
#include <string>

namespace arcslip::output {

/// A file that cannot be written. what() names the file, the cause and a remedy.
class WriteError : public Error {
 public:
  WriteError(const std::string& path, int error);
  /// The system's error number (errno), such as ENOSPC.
  int error() const { return error_; }

 private:
  int error_;
};

/// Writes to a temporary file in the folder of `path`; commit() syncs it to disk and renames it, replacing an
/// existing file. If destroyed before that, nothing remains and an old file of this name is untouched; on
/// systems with unnamed files (Linux), this holds even if the program is killed. Links are followed, even if
/// dangling. What is not a regular file (a device, a pipe) is opened once and written to directly, and may
/// block on its reader: if `control` ends and nothing is read for a second, it fails with EINTR. Every
/// failure throws WriteError, also through stream().
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path, control::Control control = {});
  /// Standard output and standard error, with the same error handling.
  static AtomicFile standard_output(control::Control control = {});
  static AtomicFile standard_error(control::Control control = {});
  AtomicFile(AtomicFile&&) noexcept;
  AtomicFile& operator=(AtomicFile&&) noexcept;
  ~AtomicFile();

  std::ostream& stream();
  void commit();

 private:
  struct Target;
  explicit AtomicFile(std::unique_ptr<Target> target);
  static AtomicFile standard_stream(int descriptor, const char* name, control::Control control);
  std::unique_ptr<Target> target_;
};

/// Writes the output of `writer` to a file, completely or not at all. Throws WriteError.
void write_file(const std::string& path, const std::function<void(std::ostream&)>& writer,
                const control::Control& control = {});

/// Throws the WriteError that opening `path` for writing would cause (no such folder, no permission). Leaves
/// no trace, and opens nothing that has a reader.
void check_writable(const std::string& path);

/// The file that writing `path` replaces: with links resolved and its folder in canonical form. Two paths to
/// the same file give the same result, whether it exists or not.
std::string written_file(const std::string& path);

/// Removes temporary files of AtomicFile left in a folder by killed writers. Those of living ones, which hold
/// a lock, stay.
void clear_temporaries(const std::string& folder);

}  // namespace arcslip::output
