#pragma once
// What the command is given that it cannot use, and what it answers. Also a table of docs/robustness.md.

#include <functional>
#include <string>
#include <vector>

namespace app_test {

struct BadInput {
  std::string name;                    // what is bad, for people
  std::vector<std::string> arguments;  // of arcslip, run in a folder with the paper's scene as scene.json
  int exit_code = 1;
  std::string message;  // part of what stands on standard error
  std::string file;     // a file of the folder, besides scene.json, and what is in it
  std::function<std::string()> content;
  std::string output = {};  // where standard output goes, a file of the test if empty
};

const std::vector<BadInput>& bad_inputs();

}  // namespace app_test
