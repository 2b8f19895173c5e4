#pragma once
// Writing to a file descriptor that may block on a reader.

#include <arcslip/control/run_control.hpp>

#include <array>
#include <chrono>
#include <streambuf>
#include <string>

namespace arcslip::output::detail {

/// Waits for the reader: without limit, but at most a second without progress once a stop is requested.
class Patience {
 public:
  explicit Patience(control::Control control);
  bool is_at_end();
  void progress() { asked_ = false; }

 private:
  control::Control control_;
  bool asked_ = false;
  std::chrono::steady_clock::time_point since_{};
};

/// Opens an existing special file, once; a pipe waits for its reader. Throws WriteError.
int open_special(const std::string& path, const control::Control& control);

/// A stream buffer that writes to a file descriptor, or throws WriteError with this path.
class DescriptorBuffer : public std::streambuf {
 public:
  /// stop: called while the descriptor blocks.
  DescriptorBuffer(int descriptor, std::string path, control::Control control);

 protected:
  int_type overflow(int_type character) override;
  int sync() override;

 private:
  void wait();

  int descriptor_;
  bool waits_;
  std::string path_;
  Patience patience_;
  std::array<char, 1 << 16> buffer_;
};

}  // namespace arcslip::output::detail
