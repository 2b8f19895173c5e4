#pragma once
// What interrupts the command in the middle of its work, and what it leaves. Also a table of
// docs/robustness.md.

#include "volume.hpp"

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

/// A run that is sent SIGINT or SIGTERM at a random moment.
struct RandomInterruption {
  std::vector<std::string> arguments;  // of arcslip
  std::string example;                 // its scene, scene.json: a file of examples
  std::vector<std::string> files;      // that it writes; each is there before, and then either that or whole
  std::string patch{};                 // of the scene, RFC 7396
};

const std::vector<RandomInterruption>& random_interruptions();
/// Of each row.
inline constexpr Volume random_moments{"ARCSLIP_MOMENTS", 4, 1000};

}  // namespace app_test
