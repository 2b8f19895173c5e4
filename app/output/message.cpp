#include "message.hpp"

#include "../interrupt.hpp"

#include <arcslip/output/atomic_file.hpp>
#include <arcslip/results/text.hpp>

#include <string>

namespace arcslip::app {

void tell(std::string_view message) {
  tell_line("arcslip: " + std::string(message));
}

void tell_line(std::string_view text) {
  put(results::visible_lines(text) + '\n');
}

void put(std::string_view text) {
  try {
    output::AtomicFile file = output::AtomicFile::standard_error(by_signal());
    file.stream() << text;
    file.commit();
  } catch (const output::WriteError&) {
  }
}

}  // namespace arcslip::app
