#include "interruptions.hpp"

#include <csignal>

namespace app_test {

const std::vector<Interruption>& interruptions() {
  static const std::string partial = "the results so far will be written";
  static const std::vector<std::string> results{"results",
                                                "results/frf.csv",
                                                "results/frf.dat",
                                                "results/frf.events.csv",
                                                "results/frf.gp",
                                                "results/frf.json",
                                                "results/frf.scene.json",
                                                "results/frf.summary.csv",
                                                "results/report.html"};
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
       {"a.csv", "a.events.csv", "a.json", "a.summary.csv"}},
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

const std::vector<RandomInterruption>& random_interruptions() {
  static const std::string paper = "al_sayed_2011/scene.json", duffing = "duffing_jenkins/scene.json";
  static const std::vector<std::string> both{"a.json", "a.csv", "a.summary.csv"},
      all{"a.json", "a.csv", "a.events.csv", "a.summary.csv"};
  static const std::vector<RandomInterruption> rows = {
      {{"frf", "scene.json", "--harmonics", "15", "--json", "a.json", "--csv", "a.csv"}, paper, all},
      {{"frf", "scene.json", "--harmonics", "15", "--json", "-"}, paper, {}},
      {{"trace", "scene.json", "--harmonics", "31", "--over", "k.value", "--from", "15000", "--to", "20000",
        "--frequency", "20", "--json", "a.json", "--csv", "a.csv"},
       paper,
       all},
      {{"peaks", "scene.json", "--harmonics", "7", "--json", "a.json", "--csv", "a.csv"}, paper, all},
      {{"folds", "scene.json", "--json", "a.json", "--csv", "a.csv"}, duffing, all},
      {{"time", "scene.json", "--frequency", "20", "--method", "newmark", "--json", "a.json", "--csv",
        "a.csv"},
       paper,
       both},
      {{"optimize", "scene.json", "--harmonics", "7", "--json", "a.json", "--csv", "a.csv"}, paper, both},
      {{"optimize", "scene.json", "--json", "a.json", "--csv", "a.csv"},
       "levels/scene.json",
       both,
       R"({"harmonics": {"order": 5, "friction": "sampled", "samples": 64}, "studies": [{"name": "o",
         "kind": "optimum", "over": ["damper.normal_load"], "bounds": [[0.5, 60]], "frequency": [15, 60],
         "evaluations": 20}]})"},
      {{"optimize", "scene.json", "--json", "a.json"}, "two_dampers/scene.json", {"a.json"}},
      {{"run", "scene.json", "--harmonics", "5", "--out", "results"},
       paper,
       {"results/frf.csv",
        "results/frf.events.csv",
        "results/frf.summary.csv",
        "results/frf.json",
        "results/frf.scene.json",
        "results/frf.dat",
        "results/frf.gp",
        "results/peaks.csv",
        "results/peaks.events.csv",
        "results/peaks.summary.csv",
        "results/peaks.json",
        "results/peaks.scene.json",
        "results/peaks.dat",
        "results/peaks.gp",
        "results/best_load.csv",
        "results/best_load.summary.csv",
        "results/best_load.json",
        "results/best_load.scene.json",
        "results/best_load.dat",
        "results/best_load.gp",
        "results/best_load_responses.dat",
        "results/best_load_responses.gp",
        "results/report.html"}},
      {{"check", "scene.json"}, paper, {}},
  };
  return rows;
}

}  // namespace app_test
