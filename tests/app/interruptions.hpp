#pragma once
// What interrupts the command in the middle of its work, and what it leaves. Also a table of
// docs/robustness.md.

#include <string>
#include <vector>

namespace app_test {

struct Interruption {
  std::string name;                    // what interrupts, for people
  std::vector<std::string> arguments;  // of arcslip, run in a folder with a study of minutes as long.json
  std::vector<int> signals;            // sent one after the other
  int exit_code = 3;                   // -1: the last signal ends the program
  std::string message;                 // part of what stands on standard error
  std::vector<std::string> files;      // left in the folder, sorted; each is whole
};

const std::vector<Interruption>& interruptions();

}  // namespace app_test
