#include <arcslip/output/atomic_file.hpp>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <streambuf>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace arcslip::output {
namespace {

const char* advice(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "free some space there or write to another disk";
    case EFBIG:
      return "files may not grow that large here (see ulimit -f)";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder in which you may write";
    case ENOENT:
      return "make the folder first, or check its name";
    case ENOTDIR:
      return "a part of this path is a file where a folder is needed";
    case EISDIR:
      return "it is a folder; give the name of a file";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EBADF:
      return "it is closed";
    case EPIPE:
      return "the reader has gone";
    default:
      return "check the disk, or write to another place";
  }
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw WriteError(path, error);
}

/// A buffer that puts its bytes into a file descriptor, or throws.
class DescriptorBuffer : public std::streambuf {
 public:
  DescriptorBuffer(int descriptor, std::string path) : descriptor_(descriptor), path_(std::move(path)) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }

 protected:
  int_type overflow(int_type character) override {
    sync();
    if (!traits_type::eq_int_type(character, traits_type::eof())) {
      sputc(traits_type::to_char_type(character));
    }
    return traits_type::not_eof(character);
  }

  int sync() override {
    const char* begin = pbase();
    const char* const end = pptr();
    setp(buffer_.data(), buffer_.data() + buffer_.size());  // a failed write is not tried again
    while (begin != end) {
      const auto written = ::write(descriptor_, begin, static_cast<std::size_t>(end - begin));
      if (written < 0 && errno != EINTR) {
        fail(path_, errno);
      }
      begin += written > 0 ? written : 0;
    }
    return 0;
  }

 private:
  int descriptor_;
  std::string path_;
  std::array<char, 1 << 16> buffer_;
};

std::string folder_of(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// The file that a link stands for, so that renaming replaces the file and not the link.
std::string resolved(const std::string& path) {
  struct stat link {};
  if (::lstat(path.c_str(), &link) != 0 || !S_ISLNK(link.st_mode)) {
    return path;
  }
  const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr), &std::free);
  return real ? std::string(real.get()) : path;
}

/// Where Linux shows an open file that has no name.
std::string unnamed_link(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

/// Calls try_name with names that do not exist yet in all likelihood until it answers other than EEXIST.
template <class TryName>
std::pair<std::string, int> unused_name(const std::string& folder, const TryName& try_name) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    std::string name =
        folder + "/.arcslip-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
    const int error = try_name(name);
    if (error != EEXIST) {
      return {std::move(name), error};
    }
  }
  return {"", EEXIST};
}

}  // namespace

WriteError::WriteError(const std::string& path, int error)
    : std::runtime_error("cannot write " + path + ": " + std::generic_category().message(error) + " (" +
                         advice(error) + ")"),
      error_(error) {}

struct AtomicFile::Target {
  std::string path;        // as the user wrote it
  std::string final_name;  // what rename replaces; empty: written directly
  std::string temporary;   // its present name; empty: it has none
  int descriptor = -1;
  bool owns_descriptor = true;
  std::optional<DescriptorBuffer> buffer;
  std::optional<std::ostream> stream;

  void open();
  void open_temporary(mode_t mode);
  void start_stream();
  void commit();
  ~Target();
};

void AtomicFile::Target::open() {
  if (path.empty()) {
    fail("a file without a name", ENOENT);
  }
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (!exists && errno != ENOENT) {
    fail(path, errno);
  }
  if (path.back() == '/' || (exists && S_ISDIR(old.st_mode))) {
    fail(path, EISDIR);
  }
  if (exists && !S_ISREG(old.st_mode)) {
    descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) {
      fail(path, errno);
    }
    return;
  }
  if (exists && ::access(path.c_str(), W_OK) != 0) {
    fail(path, errno);
  }
  final_name = resolved(path);
  open_temporary(0666);
  if (exists) {
    static_cast<void>(::fchmod(descriptor, old.st_mode & 07777));  // may be refused; the content matters more
  }
}

void AtomicFile::Target::open_temporary(mode_t mode) {
  const std::string folder = folder_of(final_name);
#ifdef O_TMPFILE
  descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
  if (descriptor >= 0 && ::access(unnamed_link(descriptor).c_str(), F_OK) == 0) {
    return;
  }
  if (descriptor >= 0) {  // without /proc it could never be given a name
    ::close(std::exchange(descriptor, -1));
  }
#endif
  const auto [name, error] = unused_name(folder, [&](const std::string& candidate) {
    descriptor = ::open(candidate.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode);
    return descriptor < 0 ? errno : 0;
  });
  if (error != 0) {
    fail(path, error);
  }
  temporary = name;
}

void AtomicFile::Target::start_stream() {
  buffer.emplace(descriptor, path);
  stream.emplace(&*buffer);
  stream->exceptions(std::ios::badbit | std::ios::failbit);  // WriteError passes through
}

void AtomicFile::Target::commit() {
  stream->flush();
  if (!final_name.empty()) {
    if (::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP) {
      fail(path, errno);
    }
    if (temporary.empty()) {
      const std::string unnamed = unnamed_link(descriptor);
      const auto [name, error] = unused_name(folder_of(final_name), [&](const std::string& candidate) {
        return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, candidate.c_str(), AT_SYMLINK_FOLLOW) != 0
                   ? errno
                   : 0;
      });
      if (error != 0) {
        fail(path, error);
      }
      temporary = name;
    }
  }
  if (owns_descriptor && ::close(std::exchange(descriptor, -1)) != 0) {
    fail(path, errno);
  }
  if (!final_name.empty()) {
    if (std::rename(temporary.c_str(), final_name.c_str()) != 0) {
      fail(path, errno);
    }
    temporary.clear();
  }
}

AtomicFile::Target::~Target() {
  if (stream) {
    stream->exceptions(std::ios::goodbit);
  }
  if (owns_descriptor && descriptor >= 0) {
    ::close(descriptor);
  }
  if (!temporary.empty()) {
    ::unlink(temporary.c_str());
  }
}

AtomicFile::AtomicFile(std::unique_ptr<Target> target) : target_(std::move(target)) {}
AtomicFile::AtomicFile(AtomicFile&&) noexcept = default;
AtomicFile& AtomicFile::operator=(AtomicFile&&) noexcept = default;
AtomicFile::~AtomicFile() = default;

AtomicFile::AtomicFile(const std::string& path) : target_(std::make_unique<Target>()) {
  target_->path = path;
  target_->open();
  target_->start_stream();
}

AtomicFile AtomicFile::standard_output() {
  auto target = std::make_unique<Target>();
  target->path = "standard output";
  target->descriptor = STDOUT_FILENO;
  target->owns_descriptor = false;
  target->start_stream();
  return AtomicFile(std::move(target));
}

std::ostream& AtomicFile::stream() {
  return *target_->stream;
}

void AtomicFile::commit() {
  target_->commit();
}

void write_file(const std::string& path, const std::function<void(std::ostream&)>& writer) {
  AtomicFile file(path);
  writer(file.stream());
  file.commit();
}

void check_writable(const std::string& path) {
  AtomicFile{path};
}

}  // namespace arcslip::output
