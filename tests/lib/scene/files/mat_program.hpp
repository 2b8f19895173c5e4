#pragma once
// What stands for the program arcslip-mat in a test.

#include "lib/scene/folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

/// A variable of the environment, for a while. value: null for none.
class Environment {
 public:
  Environment(std::string name, const char* value) : name_(std::move(name)) {
    if (const char* before = std::getenv(name_.c_str())) before_ = before;
    set(value);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { set(before_ ? before_->c_str() : nullptr); }

 private:
  void set(const char* value) const {
    if (value != nullptr)
      ::setenv(name_.c_str(), value, 1);
    else
      ::unsetenv(name_.c_str());
  }

  std::string name_;
  std::optional<std::string> before_;
};

/// A script of the shell in place of arcslip-mat. `here` in it is its folder.
class FakeProgram {
 public:
  explicit FakeProgram(const std::string& commands) : variable_("ARCSLIP_MAT", (folder_ / "fake").c_str()) {
    folder_.write("fake", "#!/bin/sh\nhere='" + folder_.path() + "'\n" + commands + "\n");
    std::filesystem::permissions(folder_ / "fake", std::filesystem::perms::owner_all);
  }
  const Folder& folder() const { return folder_; }

 private:
  Folder folder_;
  Environment variable_;
};
