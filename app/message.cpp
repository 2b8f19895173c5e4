#include "message.hpp"

#include <cstdio>

namespace arcslip::app {

void tell(std::string_view message) noexcept {
  std::fputs("arcslip: ", stderr);
  tell_plainly(message);
  std::fputc('\n', stderr);
  std::fflush(stderr);
}

void tell_plainly(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace arcslip::app
