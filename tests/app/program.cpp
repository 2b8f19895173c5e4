#include "program.hpp"
#include "environment.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

namespace app_test {
namespace {

namespace fs = std::filesystem;

fs::path temporary_folder() {
  std::string name = (fs::temp_directory_path() / "arcslip_app_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  return name;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// In the child: from here on only what is safe after a fork, then the program.
[[noreturn]] void become(const char* folder, const std::array<int, 3>& streams, char* const* argv,
                         const std::vector<std::pair<const char*, const char*>>& environment) {
  for (int i = 0; i < 3; ++i) ::dup2(streams[static_cast<std::size_t>(i)], i);
  for (const auto& [name, value] : environment) ::setenv(name, value, 1);
  std::signal(SIGINT, SIG_DFL);  // a test runner in the background may ignore it
  if (::chdir(folder) == 0) ::execv(argv[0], argv);
  ::_exit(127);
}

}  // namespace

Workplace::Workplace() : path_(temporary_folder()) {
  fs::copy_file(source_folder() + "/examples/al_sayed_2011/scene.json", path_ / "scene.json");
}

Workplace::~Workplace() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void Workplace::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

std::string Workplace::read(const std::string& name) const {
  return content(path_ / name);
}

std::vector<std::string> Workplace::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(path_))
    names.push_back(fs::relative(entry.path(), path_).string());
  std::sort(names.begin(), names.end());
  return names;
}

Program::Program(const Workplace& place, const std::vector<std::string>& arguments,
                 const std::map<std::string, std::string>& environment, const std::string& output,
                 bool terminal)
    : streams_(temporary_folder()) {
  std::vector<std::string> words{arcslip_program()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::vector<std::pair<const char*, const char*>> variables;
  for (const auto& [name, value] : environment) variables.emplace_back(name.c_str(), value.c_str());
  constexpr int make = O_WRONLY | O_CREAT | O_CLOEXEC;
  const std::string out = output.empty() ? (streams_ / "out").string() : output;
  std::array<int, 3> streams{::open("/dev/null", O_RDONLY | O_CLOEXEC), ::open(out.c_str(), make, 0600),
                             ::open((streams_ / "err").c_str(), make, 0600)};
  if (terminal) {
    terminal_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    ::grantpt(terminal_);
    ::unlockpt(terminal_);
    const winsize wide{.ws_row = 50, .ws_col = 200, .ws_xpixel = 0, .ws_ypixel = 0};  // no line is cut off
    ::ioctl(terminal_, TIOCSWINSZ, &wide);
    ::close(streams[2]);
    streams[2] = ::open(::ptsname(terminal_), O_RDWR | O_NOCTTY | O_CLOEXEC);
  }
  const std::string folder = place.path();
  pid_ = ::fork();
  if (pid_ == 0) become(folder.c_str(), streams, argv.data(), variables);
  for (const int stream : streams) ::close(stream);
}

Program::~Program() {
  if (!ended_ && pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  if (terminal_ >= 0) ::close(terminal_);
  std::error_code ignored;
  fs::remove_all(streams_, ignored);
}

void Program::send(int signal) const {
  ::kill(pid_, signal);
}

bool Program::handles(int signal) const {
  const std::string self = "/proc/" + std::to_string(::getpid()) + "/comm";
  if (content("/proc/" + std::to_string(pid_) + "/comm") == content(self))
    return false;  // still ours, with our own answers
  std::istringstream status(content("/proc/" + std::to_string(pid_) + "/status"));
  for (std::string word; status >> word;)
    if (word == "SigCgt:" && status >> word)
      return ((std::stoull(word, nullptr, 16) >> (signal - 1)) & 1) != 0;
  return false;
}

bool Program::is_running() const {
  siginfo_t state{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &state, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         state.si_pid == 0;
}

double Program::processor_seconds() const {
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Ended Program::wait() {
  Ended result;
  if (terminal_ >= 0) {  // until its other end is closed
    std::array<char, 4096> buffer;
    for (auto count = ::read(terminal_, buffer.data(), buffer.size()); count > 0;
         count = ::read(terminal_, buffer.data(), buffer.size()))
      result.err.append(buffer.data(), static_cast<std::size_t>(count));
  }
  int status = 0;
  rusage used{};
  ::wait4(pid_, &status, 0, &used);
  ended_ = true;
  result.kilobytes = used.ru_maxrss;
  for (const timeval& time : {used.ru_utime, used.ru_stime})
    result.processor_seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.out = content(streams_ / "out");
  if (terminal_ < 0) result.err = content(streams_ / "err");
  return result;
}

}  // namespace app_test
