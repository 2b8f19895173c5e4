#pragma once
// The real program, run in a temporary folder.

#include "environment.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

namespace app_test {

inline std::string arcslip_program() {
  return program_named("ARCSLIP_PROGRAM");
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A new folder to run in, with the paper's scene as scene.json. It goes away by itself.
class Workplace {
 public:
  Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  ~Workplace();

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  /// Every file and folder below, by its path from here, sorted.
  std::vector<std::string> files() const;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

struct Ended {
  int exit_code = -1;  // -1 where a signal ended it
  int signal = 0;
  std::string out, err;
  double processor_seconds = 0;  // that it took in all
  long kilobytes = 0;            // of memory, at most; no less than the test had
};

/// A running arcslip.
class Program {
 public:
  /// `environment` is put over ours; `output` is where standard output goes, a temporary file if empty. With
  /// a terminal, standard error is one.
  Program(const Workplace& place, const std::vector<std::string>& arguments,
          const std::map<std::string, std::string>& environment = {}, const std::string& output = "",
          bool terminal = false);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  void send(int signal) const;
  /// Whether it has its own answer to the signal by now.
  bool handles(int signal) const;
  bool is_running() const;
  double processor_seconds() const;
  /// Waits for its end.
  Ended wait();

 private:
  pid_t pid_ = 0;
  int terminal_ = -1;
  std::filesystem::path streams_;
  bool ended_ = false;
};

inline Ended run(const Workplace& place, const std::vector<std::string>& arguments,
                 const std::map<std::string, std::string>& environment = {}, const std::string& output = "") {
  return Program(place, arguments, environment, output).wait();
}

}  // namespace app_test
