#include "standard_output.hpp"

#include "../interrupt.hpp"

#include <arcslip/results/text.hpp>

#include <ostream>
#include <sstream>

namespace arcslip::app {

void StandardOutput::write(const std::function<void(std::ostream&)>& writer) {
  if (lost_) return;
  try {
    output::AtomicFile file = output::AtomicFile::standard_output(by_signal());
    writer(file.stream());
    file.commit();
  } catch (const output::WriteError& error) {
    lost_ = error;
  }
}

void StandardOutput::write_lines(const std::function<void(std::ostream&)>& writer) {
  std::ostringstream text;
  writer(text);
  write([&](std::ostream& out) { out << results::visible_lines(text.str()); });
}

void StandardOutput::finish() const {
  if (lost_) throw *lost_;
}

}  // namespace arcslip::app
