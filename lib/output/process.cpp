#include <arcslip/output/process.hpp>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace arcslip::output {
namespace {

constexpr int moment = 20;                   // ms between questions whether to go on
constexpr std::size_t most_text = 1u << 20;  // bytes of it that are kept

/// The setup of a child process: its folder, its streams, default signal handlers, and a process group.
class SpawnSettings {
 public:
  SpawnSettings(const std::string& folder, int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDERR_FILENO);
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE);
    sigaddset(&signals, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot create a pipe");
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    ::close(ends_[0]);
    close_writing();
  }
  int writing() const { return ends_[1]; }
  void close_writing() {
    if (ends_[1] >= 0) {
      ::close(ends_[1]);
      ends_[1] = -1;
    }
  }
  bool has_text() const {
    pollfd place{ends_[0], POLLIN, 0};
    return ::poll(&place, 1, 0) > 0 && (place.revents & POLLIN) != 0;
  }
  /// Waits a moment for text. False at the end of it.
  bool read_some(std::string& text) const {
    pollfd place{ends_[0], POLLIN, 0};
    if (::poll(&place, 1, moment) <= 0) return true;
    std::array<char, 4096> buffer;
    const auto count = ::read(ends_[0], buffer.data(), buffer.size());
    if (count > 0 && text.size() < most_text) text.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
  }

 private:
  std::array<int, 2> ends_{};
};

}  // namespace

namespace {

ProcessResult run(const std::string& program, const std::vector<std::string>& arguments,
                  const std::string& folder, const ProcessLimits& limits) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  Pipe pipe;
  const SpawnSettings settings(folder, pipe.writing());
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, program.c_str(), settings.actions(), settings.attributes(),
                                   argv.data(), environ);
  ProcessResult result;
  if (error == ENOENT || error == EACCES || error == ENOTDIR) {
    result.end = ProcessEnd::not_found;
    return result;
  }
  if (error != 0) throw std::system_error(error, std::generic_category());
  pipe.close_writing();
  const auto began = std::chrono::steady_clock::now();
  bool writes = true;
  int status = 0;
  while (true) {
    if (writes)
      writes = pipe.read_some(result.text);
    else
      ::poll(nullptr, 0, moment);
    // At the end of its output it is about to exit; its children may keep the pipe open longer.
    if (::waitpid(child, &status, WNOHANG) == child) break;
    const bool stopped = scene::is_asked(limits.stop);
    if (stopped || std::chrono::steady_clock::now() - began > limits.time) {
      result.end = stopped ? ProcessEnd::stopped : ProcessEnd::out_of_time;
      ::kill(-child, SIGKILL);
      while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      break;
    }
  }
  while (writes && pipe.has_text()) writes = pipe.read_some(result.text);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return result;
}

}  // namespace

ProcessResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const std::string& folder, const ProcessLimits& limits) {
  try {
    return run(program, arguments, folder, limits);
  } catch (const std::system_error& error) {  // no pipe, no process, no program in this file
    return {ProcessEnd::not_started, -1, 0, error.what()};
  }
}

}  // namespace arcslip::output
