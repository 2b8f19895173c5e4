#pragma once
// Files that appear under their name only when they are whole.

#include <arcslip/scene/stop_request.hpp>

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
/// A link is followed, also one to what is not there yet. What is not a regular file (a device, a pipe) is
/// opened once and written to directly, and waits for its reader: where `stop` is asked for and nothing is
/// read for a second, it fails with EINTR. Every failure throws WriteError, those of stream() too.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path, scene::StopRequest stop = {});
  /// Standard output and standard error, with the same care for errors.
  static AtomicFile standard_output(scene::StopRequest stop = {});
  static AtomicFile standard_error(scene::StopRequest stop = {});
  AtomicFile(AtomicFile&&) noexcept;
  AtomicFile& operator=(AtomicFile&&) noexcept;
  ~AtomicFile();

  std::ostream& stream();
  void commit();

 private:
  struct Target;
  explicit AtomicFile(std::unique_ptr<Target> target);
  static AtomicFile standard_stream(int descriptor, const char* name, scene::StopRequest stop);
  std::unique_ptr<Target> target_;
};

/// Writes what `writer` puts into the stream, whole or not at all. Throws WriteError.
void write_file(const std::string& path, const std::function<void(std::ostream&)>& writer,
                const scene::StopRequest& stop = {});

/// Throws the WriteError that writing `path` would meet at its beginning (no such folder, no permission).
/// Leaves no trace, and opens nothing that has a reader.
void check_writable(const std::string& path);

/// The file that writing `path` replaces: at the end of its links, with the folder that it is in as the
/// system names it. Two paths to one file give the same, whether it is there or not.
std::string written_file(const std::string& path);

/// Removes what writers that were killed have left in a folder: temporaries of AtomicFile and of images. Only
/// for one who knows that nobody else writes into it now.
void clear_temporaries(const std::string& folder);

}  // namespace arcslip::output
