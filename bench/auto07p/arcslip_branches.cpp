// Traces one branch and says what it took, for `compare`.
//
//   arcslip_branches NAME points N      as nearly N points as can be had; timed over many repetitions
//   arcslip_branches NAME refinement R  once, with all steps R times as long, to be timed from outside
//
// Prints one line of "key value" pairs: refinement, points, seconds (the least processor time of one whole
// branch, from the start to its end, folds located), factorizations, residuals, solves, rejected, folds
// (values).

#include "branches.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string>

namespace {

using namespace arcslip;

constexpr double timed_for = 0.5;     // s, at least, and
constexpr int repetitions = 5;        // at least
constexpr double near_enough = 0.02;  // of the wanted number of points
constexpr int adjustments = 20;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

continuation::Branch traced(const bench::Case& c, double refinement) {
  continuation::Options options = c.options;
  options.points = 10'000'000;
  options.step.largest_parameter = 0.01 * refinement * (options.upper - options.lower);
  options.step.relative_state *= refinement;
  options.step.angle *= refinement;
  continuation::Branch branch =
      continuation::trace(c.problem, c.start, options, {continuation::fold_monitor()});
  if (branch.stop.reason != continuation::StopReason::boundary || branch.events.size() != c.folds)
    throw std::runtime_error("not the whole branch: " + std::to_string(branch.events.size()) + " folds, " +
                             branch.stop.message);
  return branch;
}

double refinement_for(const bench::Case& c, double points) {
  double refinement = 1, nearest = 1, miss = 1e300;
  for (int k = 0; k < adjustments && miss > near_enough; ++k) {
    const double now = static_cast<double>(traced(c, refinement).points.size());
    if (std::abs(now / points - 1) < miss) {
      miss = std::abs(now / points - 1);
      nearest = refinement;
    }
    refinement *= now / points;
  }
  return nearest;
}

void print(double refinement, double seconds, const continuation::Branch& branch) {
  const auto& counts = branch.counts;
  std::printf(
      "refinement %.17g points %zu seconds %.9g factorizations %ld residuals %ld solves %ld rejected %ld "
      "folds",
      refinement, branch.points.size(), seconds, counts.factorizations, counts.residuals, counts.solves,
      counts.rejected_steps);
  for (const auto& event : branch.events) std::printf(" %.12f", event.point.parameter);
  std::printf("\n");
}

int run(const std::string& name, const std::string& what, double value) {
  const bench::Case c = bench::branch_case(name);
  const double refinement = what == "points" ? refinement_for(c, value) : value;
  const int at_least = what == "points" ? repetitions : 1;
  double least = 1e300, total = 0;
  continuation::Branch branch;
  for (int k = 0; k < at_least || (at_least > 1 && total < timed_for); ++k) {
    const double begin = processor_seconds();
    branch = traced(c, refinement);
    const double seconds = processor_seconds() - begin;
    least = std::min(least, seconds);
    total += seconds;
  }
  print(refinement, least, branch);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 4 && (std::string(argv[2]) == "points" || std::string(argv[2]) == "refinement"))
      return run(argv[1], argv[2], std::stod(argv[3]));
    std::fprintf(stderr, "usage: arcslip_branches NAME points N | arcslip_branches NAME refinement R\n");
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "arcslip_branches: %s\n", error.what());
    return 1;
  }
}
