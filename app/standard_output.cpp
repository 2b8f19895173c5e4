#include "standard_output.hpp"

#include <cerrno>

namespace arcslip::app {

void StandardOutput::write(const std::function<void(std::ostream&)>& writer) {
  if (lost_) {
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
    lost_ = error;
  }
}

void StandardOutput::finish() const {
  if (lost_) {
    throw *lost_;
  }
}

}  // namespace arcslip::app
