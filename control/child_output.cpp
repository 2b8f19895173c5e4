#include <arcslip/control/child_output.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace arcslip::control {
namespace {

constexpr int pause = 100;              // ms between questions whether to go on
constexpr int pipe_capacity = 1 << 20;  // bytes, if the system grants them

// A folder, null streams but for the output, default signal handlers, and a process group, so that a
// terminal's Ctrl-C does not reach it and all that it starts can be killed with it.
class SpawnSettings {
 public:
  SpawnSettings(const ChildOutput::Command& command, int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    if (!command.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, command.folder.c_str());
    // The output first: it may have the number of a standard stream that is closed here.
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (command.with_errors)
      posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    else
      posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
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

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

ChildOutput::ChildOutput(const Command& command, Limits limits)
    : limits_(std::move(limits)), began_(std::chrono::steady_clock::now()), asked_(began_) {
  std::vector<std::string> words{command.program}, variables;
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  if (command.environment) variables = *command.environment;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
  ::fcntl(ends[1], F_SETPIPE_SZ, pipe_capacity);
  const SpawnSettings settings(command, ends[1]);
  const int error =
      ::posix_spawnp(&child_, command.program.c_str(), settings.actions(), settings.attributes(),
                     pointers(words).data(), command.environment ? pointers(variables).data() : environ);
  ::close(ends[1]);
  pipe_ = ends[0];
  if (error == 0) return;
  ::close(pipe_);
  throw std::system_error(error, std::generic_category());
}

ChildOutput::~ChildOutput() {
  kill_all();
  ::close(pipe_);
}

bool ChildOutput::read_some(std::string& text) {
  if (first_ == last_ && !fill()) return false;
  text.append(buffer_.data() + first_, last_ - first_);
  first_ = last_;
  return true;
}

bool ChildOutput::read(void* to, std::size_t bytes) {
  auto* next = static_cast<char*>(to);
  while (bytes > 0) {
    if (first_ == last_ && !fill()) return false;
    const std::size_t count = std::min(bytes, last_ - first_);
    std::memcpy(next, buffer_.data() + first_, count);
    first_ += count;
    next += count;
    bytes -= count;
  }
  return true;
}

std::optional<std::string> ChildOutput::line(std::size_t longest) {
  std::string line;
  for (char c = 0; line.size() <= longest && read(&c, 1); line += c)
    if (c == '\n') return line;
  return {};
}

bool ChildOutput::ends_well() {
  if (first_ != last_ || fill()) return false;
  return end_ == End::by_itself && exit_code_ == 0;
}

// False at the end of the output.
bool ChildOutput::fill() {
  while (end_ == End::not_yet && keeps_going()) {
    pollfd place{pipe_, POLLIN, 0};
    if (::poll(&place, 1, pause) <= 0) {
      if (!has_exited()) continue;
      // What it started may keep the pipe open; what it wrote before its end is there.
      if (::poll(&place, 1, 0) <= 0) {
        wait_for_end();
        break;
      }
    }
    const auto count = ::read(pipe_, buffer_.data(), buffer_.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      wait_for_end();
      break;
    }
    first_ = 0;
    last_ = static_cast<std::size_t>(count);
    return true;
  }
  return false;
}

// It has closed its output.
void ChildOutput::wait_for_end() {
  while (end_ == End::not_yet && keeps_going()) {
    if (has_exited())
      take_status(kill_all());
    else
      ::poll(nullptr, 0, 1);
  }
}

// Also where the caller ignores the ends of its children, so that nothing is known: what was read decides.
bool ChildOutput::has_exited() {
  if (child_ < 0) return true;
  siginfo_t state{};
  if (::waitid(P_PID, static_cast<id_t>(child_), &state, WEXITED | WNOHANG | WNOWAIT) == 0)
    return state.si_pid == child_;
  if (errno == EINTR) return false;
  child_ = -1;
  return true;
}

bool ChildOutput::keeps_going() {
  const auto now = std::chrono::steady_clock::now();
  if (now - began_ > limits_.time) {
    take_status(kill_all());
    end_ = End::out_of_time;
  } else if (now - asked_ > std::chrono::milliseconds(pause)) {
    asked_ = now;
    if (limits_.control.keep_going()) return true;
    take_status(kill_all());
    end_ = End::stopped;
  }
  return end_ == End::not_yet;
}

void ChildOutput::take_status(int status) {
  child_ = -1;
  signal_ = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end_ = signal_ != 0 ? End::by_signal : End::by_itself;
}

// Returns the status with which it ended: what has ended before is not killed again.
int ChildOutput::kill_all() {
  int status = 0;
  if (child_ <= 0) return status;
  ::kill(-child_, SIGKILL);
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return status;
}

}  // namespace arcslip::control
