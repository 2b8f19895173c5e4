#include "standard_output.hpp"

#include <arcslip/output/atomic_file.hpp>

#include <cerrno>

namespace arcslip::app {

void StandardOutput::write(const std::function<void(std::ostream&)>& writer) {
  if (!is_read_) {
    return;
  }
  try {
    output::AtomicFile file = output::AtomicFile::standard_output();
    writer(file.stream());
    file.commit();
  } catch (const output::WriteError& error) {
    if (error.error() != EPIPE) {
      throw;
    }
    is_read_ = false;
  }
}

}  // namespace arcslip::app
