#pragma once

#include <arcslip/output/atomic_file.hpp>

#include <functional>
#include <iosfwd>
#include <optional>

namespace arcslip::app {

/// Standard output, which may be closed, full or without a reader: the run then continues without it, and
/// finish() reports the error.
class StandardOutput {
 public:
  /// Output that is safe for a terminal as it is, such as JSON and CSV.
  void write(const std::function<void(std::ostream&)>& writer);

  /// Human-readable lines, with characters unsafe for a terminal escaped (results/text.hpp).
  void write_lines(const std::function<void(std::ostream&)>& writer);

  /// Throws output::WriteError if not everything was written.
  void finish() const;

 private:
  std::optional<output::WriteError> lost_;
};

}  // namespace arcslip::app
