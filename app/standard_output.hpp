#pragma once

#include <functional>
#include <iosfwd>

namespace arcslip::app {

/// Standard output, which somebody may stop reading: then the rest of the run goes on without it.
class StandardOutput {
 public:
  /// Throws output::WriteError for any other failure.
  void write(const std::function<void(std::ostream&)>& writer);

 private:
  bool is_read_ = true;
};

}  // namespace arcslip::app
