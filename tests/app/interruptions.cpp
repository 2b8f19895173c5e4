#include "interruptions.hpp"

#include <csignal>

namespace app_test {

const std::vector<Interruption>& interruptions() {
  static const std::string partial = "what is computed so far will be written";
  static const std::vector<std::string> results{"results",          "results/frf.csv",
                                                "results/frf.dat",  "results/frf.gp",
                                                "results/frf.json", "results/frf.scene.json"};
  static const std::vector<Interruption> rows = {
      {"Ctrl-C (SIGINT) in the middle of run",
       {"run", "long.json", "--out", "results"},
       {SIGINT},
       3,
       partial,
       results},
      {"SIGTERM in the middle of run",
       {"run", "long.json", "--out", "results"},
       {SIGTERM},
       3,
       partial,
       results},
      {"Ctrl-C with both files asked for",
       {"frf", "long.json", "--json", "a.json", "--csv", "a.csv"},
       {SIGINT},
       3,
       partial,
       {"a.csv", "a.json"}},
      {"Ctrl-C with JSON on standard output", {"frf", "long.json", "--json", "-"}, {SIGINT}, 3, partial, {}},
      {"Ctrl-C in the middle of peaks",
       {"peaks", "long.json", "--json", "a.json"},
       {SIGINT},
       3,
       partial,
       {"a.json"}},
      {"Ctrl-C in the middle of a motion in time",
       {"time", "long.json", "--method", "newmark", "--frequency", "20.9", "--set", "damper.normal_load=500",
        "--tolerance", "0", "--periods", "10000000", "--steps", "10", "--json", "a.json"},
       {SIGINT},
       3,
       partial,
       {"a.json"}},
      {"Ctrl-C twice, the second before the first is heard",
       {"frf", "long.json", "--harmonics", "2000", "--json", "a.json"},
       {SIGINT, SIGINT},
       -1,
       "",
       {}},
      {"killed (SIGKILL)", {"frf", "long.json", "--json", "a.json", "--csv", "a.csv"}, {SIGKILL}, -1, "", {}},
  };
  return rows;
}

}  // namespace app_test
