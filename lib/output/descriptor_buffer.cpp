#include <arcslip/output/descriptor_buffer.hpp>

#include <arcslip/output/atomic_file.hpp>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace arcslip::output::detail {
namespace {

constexpr int poll_milliseconds = 50;
constexpr std::chrono::milliseconds longest_wait{800};  // once a stop is requested

/// Whether writes to an open file may block.
bool may_wait(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && !S_ISREG(status.st_mode);
}

}  // namespace

Patience::Patience(control::Control control) : control_(std::move(control)) {}

bool Patience::is_at_end() {
  const auto now = std::chrono::steady_clock::now();
  if (control_.keep_going()) return false;
  if (!std::exchange(asked_, true)) since_ = now;
  return now - since_ > longest_wait;
}

int open_special(const std::string& path, const control::Control& control) {
  Patience patience(control);
  while (true) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (descriptor >= 0) return descriptor;
    struct stat status {};
    const int error = errno;
    const bool is_pipe = ::stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
    if (error != EINTR && !(error == ENXIO && is_pipe)) throw WriteError(path, error);
    if (patience.is_at_end()) throw WriteError(path, EINTR);
    ::poll(nullptr, 0, poll_milliseconds);
  }
}

DescriptorBuffer::DescriptorBuffer(int descriptor, std::string path, control::Control control)
    : descriptor_(descriptor),
      waits_(may_wait(descriptor)),
      path_(std::move(path)),
      patience_(std::move(control)) {
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type character) {
  sync();
  if (!traits_type::eq_int_type(character, traits_type::eof())) sputc(traits_type::to_char_type(character));
  return traits_type::not_eof(character);
}

int DescriptorBuffer::sync() {
  const char* begin = pbase();
  const char* const end = pptr();
  setp(buffer_.data(), buffer_.data() + buffer_.size());  // a failed write is not tried again
  while (begin != end) {
    auto count = static_cast<std::size_t>(end - begin);
    if (waits_) {
      wait();
      count =
          std::min<std::size_t>(count, PIPE_BUF);  // larger writes could block without checking for a stop
    }
    const auto written = ::write(descriptor_, begin, count);
    if (written < 0 && errno != EINTR && errno != EAGAIN) throw WriteError(path_, errno);
    if (written > 0) {
      begin += written;
      patience_.progress();
    }
  }
  return 0;
}

void DescriptorBuffer::wait() {
  pollfd place{descriptor_, POLLOUT, 0};
  while (::poll(&place, 1, poll_milliseconds) <= 0)
    if (patience_.is_at_end()) throw WriteError(path_, EINTR);
}

}  // namespace arcslip::output::detail
