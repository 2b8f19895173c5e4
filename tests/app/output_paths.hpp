#pragma once
// Where results cannot go, or go slowly, and what is left whole. Also a table of docs/robustness.md.

#include <string>
#include <vector>

namespace app_test {

struct OutputPath {
  std::string name;                // what is wrong with the path, for people
  std::string script;              // of sh, with "arcslip VERB" for every verb that computes
  int exit_code = 1;               // of arcslip
  std::string message;             // part of what stands on standard error, or in the file "err"
  std::vector<std::string> whole;  // files that are there and complete: as from a run without trouble
  bool needs_mount = false;        // of a file system, which not every machine allows
  bool needs_much = false;         // to be written: more than a pipe holds
};

const std::vector<OutputPath>& output_paths();

}  // namespace app_test
