#pragma once

#include <arcslip/output/atomic_file.hpp>

#include <functional>
#include <iosfwd>
#include <optional>

namespace arcslip::app {

/// Standard output, which may be closed, full or read by nobody: then the rest of the run goes on without it,
/// and finish() says so.
class StandardOutput {
 public:
  /// What a terminal may get as it is, such as JSON and CSV.
  void write(const std::function<void(std::ostream&)>& writer);

  /// Lines for people, with what a terminal must not get escaped (results/text.hpp).
  void write_lines(const std::function<void(std::ostream&)>& writer);

  /// Throws output::WriteError where not all was written.
  void finish() const;

 private:
  std::optional<output::WriteError> lost_;
};

}  // namespace arcslip::app
