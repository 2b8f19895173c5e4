#pragma once
// Extremes of the paper's oscillator, each with its expected outcome. docs/robustness.md prints the table.

#include <arcslip/results/reason.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <string>
#include <vector>

namespace extremes {

struct Extreme {
  std::string name;  // what is extreme
  std::function<void(arcslip::scene::Scene&)> change;
  std::vector<arcslip::results::Reason> reasons;  // of the stops of its branches, in order
  int peaks;                                      // finite ones
  double amplitude;                               // of the highest finite peak, m; 0: not tested
  double tolerance;                               // relative
  bool flagged;              // truncation is flagged at the highest peak (or the first point)
  std::string outcome;       // for people
  std::string message = {};  // part of the last stop's
  bool takes_long = false;   // seconds: among the long tests
};

const std::vector<Extreme>& all();

}  // namespace extremes
