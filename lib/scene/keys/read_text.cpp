#include <arcslip/results/text.hpp>
#include <arcslip/scene/keys/read_text.hpp>
#include <arcslip/scene/scene.hpp>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <istream>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace arcslip::scene::file {
namespace {

constexpr std::size_t chunk = 1 << 16;
constexpr int poll_milliseconds = 50;

std::string largest_text(const std::string& noun, std::size_t largest) {
  return "a " + noun + " must be at most " + std::to_string(largest >> 20) + " MB";
}

void check_size(const std::string& text, const std::string& noun, std::size_t largest) {
  if (text.size() > largest) {
    throw SceneError(
        {{"", "found more than " + std::to_string(largest) + " bytes, " + largest_text(noun, largest)}});
  }
}

class OpenFile {
 public:
  explicit OpenFile(const std::string& path) {
    do {
      descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    } while (descriptor_ < 0 && errno == EINTR);
    if (descriptor_ < 0) {
      throw FileError("cannot open " + results::visible(path) + ": " +
                      std::generic_category().message(errno));
    }
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { ::close(descriptor_); }

  // Appends what is there. False at the end of the file, or after an error, which errno reports.
  bool read_some(std::string& text) const {
    pollfd place{descriptor_, POLLIN, 0};
    if (::poll(&place, 1, poll_milliseconds) <= 0)  // a pipe may have no writer yet
      return true;
    const std::size_t before = text.size();
    text.resize(before + chunk);
    errno = 0;
    const auto count = ::read(descriptor_, text.data() + before, chunk);
    text.resize(before + static_cast<std::size_t>(count > 0 ? count : 0));
    return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
  }

 private:
  int descriptor_;
};

}  // namespace

std::string read_text(std::istream& in) {
  std::string text;
  while (in.good()) {
    const std::size_t before = text.size();
    text.resize(before + chunk);
    in.read(text.data() + before, static_cast<std::streamsize>(chunk));
    text.resize(before + static_cast<std::size_t>(in.gcount()));
    check_size(text, "scene", largest_size);
  }
  if (in.bad() || !in.eof())
    throw FileError("reading the scene failed after " + std::to_string(text.size()) + " bytes");
  return text;
}

std::string read_text(const std::string& path, const control::Control& control, const std::string& noun,
                      std::size_t largest) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    throw FileError(results::visible(path) + " is a directory, must be a " +
                    (noun == "scene" ? "scene file" : noun));
  }
  if (fs::is_regular_file(status)) {
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error && size > largest)
      throw SceneError(
          {{"", "found a file of " + std::to_string(size) + " bytes, " + largest_text(noun, largest)}});
  }
  const OpenFile file(path);
  std::string text;
  while (file.read_some(text)) {
    check_size(text, noun, largest);
    if (!control.keep_going())
      throw control::Interrupted("interrupted while " + results::visible(path) + " was read");
  }
  if (errno != 0) {
    throw FileError(results::visible(path) + ": reading the " + noun + " failed after " +
                    std::to_string(text.size()) + " bytes: " + std::generic_category().message(errno));
  }
  return text;
}

}  // namespace arcslip::scene::file
