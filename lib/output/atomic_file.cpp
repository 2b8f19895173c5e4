#include <arcslip/output/atomic_file.hpp>

#include <arcslip/output/descriptor_buffer.hpp>
#include <arcslip/results/text.hpp>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <regex>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
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
      return "choose a writable folder";
    case ENOENT:
      return "create the folder first, or check its name";
    case ENOTDIR:
      return "a part of this path is a file, not a folder";
    case EISDIR:
      return "it is a folder; choose a file name";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EBADF:
      return "it is closed";
    case EPIPE:
      return "the reader closed it";
    case EINTR:
      return "nobody read it when the run was interrupted";
    case ELOOP:
      return "circular symbolic links; choose another file name";
    default:
      return "check the disk, or choose another path";
  }
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw WriteError(path, error);
}

std::string folder_of(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// The target of a link, so that renaming replaces the file and not the link; it need not exist.
std::string resolved(const std::string& link) {
  std::string path = link;
  std::error_code error;
  for (int links = 0; links < 40; ++links) {
    const std::filesystem::path target = std::filesystem::read_symlink(path, error);
    if (error) return path;
    path = target.is_absolute() ? target.string() : (folder_of(path) + "/" + target.string());
  }
  fail(link, ELOOP);
}

/// The path of an open unnamed file on Linux.
std::string unnamed_link(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

/// Calls try_name with probably unused names until the result is not EEXIST.
template <class TryName>
std::pair<std::string, int> unused_name(const std::string& folder, const TryName& try_name) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    std::string name =
        folder + "/.arcslip-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
    const int error = try_name(name);
    if (error != EEXIST) return {std::move(name), error};
  }
  return {"", EEXIST};
}

}  // namespace

WriteError::WriteError(const std::string& path, int error)
    : Error("cannot write " + results::visible(path) + ": " + std::generic_category().message(error) + " (" +
            advice(error) + ")"),
      error_(error) {}

struct AtomicFile::Target {
  std::string path;        // as the user wrote it
  std::string final_name;  // what rename replaces; empty: written directly
  std::string temporary;   // its present name; empty: it has none
  int descriptor = -1;
  bool owns_descriptor = true;
  control::Control control{};
  std::optional<detail::DescriptorBuffer> buffer;
  std::optional<std::ostream> stream;

  void open();
  void open_temporary(mode_t mode);
  void start_stream();
  void commit();
  ~Target();
};

void AtomicFile::Target::open() {
  if (path.empty()) fail("a file without a name", ENOENT);
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (!exists && errno != ENOENT) fail(path, errno);
  if (path.back() == '/' || (exists && S_ISDIR(old.st_mode))) fail(path, EISDIR);
  if (exists && !S_ISREG(old.st_mode)) {
    descriptor = detail::open_special(path, control);
    return;
  }
  if (exists && ::access(path.c_str(), W_OK) != 0) fail(path, errno);
  final_name = resolved(path);
  open_temporary(0666);
  if (exists)
    static_cast<void>(::fchmod(descriptor, old.st_mode & 07777));  // may be refused; the content matters more
}

void AtomicFile::Target::open_temporary(mode_t mode) {
  const std::string folder = folder_of(final_name);
#ifdef O_TMPFILE
  descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
  if (descriptor >= 0 && ::access(unnamed_link(descriptor).c_str(), F_OK) == 0) {
    ::flock(descriptor, LOCK_SH);  // for clear_temporaries(): it has a name for a moment in commit()
    return;
  }
  if (descriptor >= 0)  // without /proc it could never be given a name
    ::close(std::exchange(descriptor, -1));
#endif
  const auto [name, error] = unused_name(folder, [&](const std::string& candidate) {
    descriptor = ::open(candidate.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode);
    if (descriptor < 0) return errno;
    ::flock(descriptor, LOCK_SH);  // for clear_temporaries(), which may have removed it before that
    if (struct stat status{}; ::fstat(descriptor, &status) == 0 && status.st_nlink > 0) return 0;
    ::close(std::exchange(descriptor, -1));
    return EEXIST;
  });
  if (error != 0) fail(path, error);
  temporary = name;
}

void AtomicFile::Target::start_stream() {
  buffer.emplace(descriptor, path, control);
  stream.emplace(&*buffer);
  stream->exceptions(std::ios::badbit | std::ios::failbit);  // WriteError passes through
}

void AtomicFile::Target::commit() {
  stream->flush();
  if (!final_name.empty()) {
    while (::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP)
      if (errno != EINTR) fail(path, errno);
    if (temporary.empty()) {
      const std::string unnamed = unnamed_link(descriptor);
      const auto [name, error] = unused_name(folder_of(final_name), [&](const std::string& candidate) {
        return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, candidate.c_str(), AT_SYMLINK_FOLLOW) != 0
                   ? errno
                   : 0;
      });
      if (error != 0) fail(path, error);
      temporary = name;
    }
  }
  const int lock =
      final_name.empty() ? -1 : ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);  // held until it has its name
  const int closed = owns_descriptor ? ::close(std::exchange(descriptor, -1)) : 0;
  const int renamed =
      closed == 0 && !final_name.empty() ? std::rename(temporary.c_str(), final_name.c_str()) : 0;
  const int error = errno;
  if (lock >= 0) ::close(lock);
  if (closed != 0 || renamed != 0) fail(path, error);
  if (!final_name.empty()) temporary.clear();
}

AtomicFile::Target::~Target() {
  if (stream) stream->exceptions(std::ios::goodbit);
  if (owns_descriptor && descriptor >= 0) ::close(descriptor);
  if (!temporary.empty()) ::unlink(temporary.c_str());
}

AtomicFile::AtomicFile(std::unique_ptr<Target> target) : target_(std::move(target)) {}
AtomicFile::AtomicFile(AtomicFile&&) noexcept = default;
AtomicFile& AtomicFile::operator=(AtomicFile&&) noexcept = default;
AtomicFile::~AtomicFile() = default;

AtomicFile::AtomicFile(const std::string& path, control::Control control)
    : target_(std::make_unique<Target>()) {
  target_->path = path;
  target_->control = std::move(control);
  target_->open();
  target_->start_stream();
}

AtomicFile AtomicFile::standard_stream(int descriptor, const char* name, control::Control control) {
  auto target = std::make_unique<Target>();
  target->control = std::move(control);
  target->path = name;
  target->descriptor = descriptor;
  target->owns_descriptor = false;
  target->start_stream();
  return AtomicFile(std::move(target));
}

AtomicFile AtomicFile::standard_output(control::Control control) {
  return standard_stream(STDOUT_FILENO, "standard output", std::move(control));
}

AtomicFile AtomicFile::standard_error(control::Control control) {
  return standard_stream(STDERR_FILENO, "standard error", std::move(control));
}

std::ostream& AtomicFile::stream() {
  return *target_->stream;
}

void AtomicFile::commit() {
  target_->commit();
}

void write_file(const std::string& path, const std::function<void(std::ostream&)>& writer,
                const control::Control& control) {
  AtomicFile file(path, control);
  writer(file.stream());
  file.commit();
}

void check_writable(const std::string& path) {
  struct stat old {};
  if (::stat(path.c_str(), &old) != 0 || S_ISREG(old.st_mode) || S_ISDIR(old.st_mode))
    AtomicFile{path};
  else if (::access(path.c_str(), W_OK) != 0)
    fail(path, errno);
}

std::string written_file(const std::string& path) {
  const std::filesystem::path target = resolved(path);
  std::error_code error;
  const auto folder = std::filesystem::canonical(folder_of(target.string()), error);
  return error ? target.string() : (folder / target.filename()).string();
}

void clear_temporaries(const std::string& folder) {
  static const std::regex left_over(R"(\.arcslip-[0-9]+-[0-9]+\.tmp)");
  std::error_code error;
  std::vector<std::filesystem::path> paths;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (std::regex_match(entry->path().filename().string(), left_over)) paths.push_back(entry->path());
  for (const auto& path : paths) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) continue;
    struct stat locked {
    }, there{};
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 &&  // its writer would hold a lock
        ::fstat(descriptor, &locked) == 0 && ::lstat(path.c_str(), &there) == 0 &&
        locked.st_ino == there.st_ino && locked.st_dev == there.st_dev)
      std::filesystem::remove(path, error);
    ::close(descriptor);
  }
}

}  // namespace arcslip::output
