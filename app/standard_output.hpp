#pragma once

#include <arcslip/output/atomic_file.hpp>

#include <functional>
#include <iosfwd>
#include <optional>

namespace arcslip::app {

/// Standard output, which somebody may stop reading: then the rest of the run goes on without it, so that all
/// files are written, and finish() says so.
class StandardOutput {
 public:
  /// Throws output::WriteError for any other failure.
  void write(const std::function<void(std::ostream&)>& writer);

  /// Throws output::WriteError where not all that was written was read.
  void finish() const;

 private:
  std::optional<output::WriteError> lost_;
};

}  // namespace arcslip::app
