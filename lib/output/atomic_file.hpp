#pragma once
// Files that appear under their name only when they are whole.

#include <functional>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>

namespace arcslip::output {

/// A file that cannot be written. what() says which, why, and what to do.
class WriteError : public std::runtime_error {
 public:
  WriteError(const std::string& path, int error);
  /// The system's error number (errno), such as ENOSPC.
  int error() const { return error_; }

 private:
  int error_;
};

/// Writes to a temporary in the folder of `path`; commit() brings it to the disk and gives it its name, in
/// place of what had it. Destroyed before that, nothing of it remains and an old file of this name is
/// untouched; where the system has files without a name (Linux), this holds even if the program is killed.
/// What is not a regular file (a device, a pipe) is written to directly. Every failure throws WriteError,
/// those of stream() too.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  /// Standard output, with the same care for errors.
  static AtomicFile standard_output();
  AtomicFile(AtomicFile&&) noexcept;
  AtomicFile& operator=(AtomicFile&&) noexcept;
  ~AtomicFile();

  std::ostream& stream();
  void commit();

 private:
  struct Target;
  explicit AtomicFile(std::unique_ptr<Target> target);
  std::unique_ptr<Target> target_;
};

/// Writes what `writer` puts into the stream, whole or not at all. Throws WriteError.
void write_file(const std::string& path, const std::function<void(std::ostream&)>& writer);

/// Throws the WriteError that writing `path` would meet at its beginning (no such folder, no permission).
/// Leaves no trace.
void check_writable(const std::string& path);

}  // namespace arcslip::output
