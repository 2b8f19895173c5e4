// Work of a continuation for each problem of the test suite, at default settings:
//
//   problem, n, accepted points, rejected steps; per accepted point: factorizations with the fold monitor and
//   without, residuals with it and without, iterations of the corrector; folds found; why the branch ended.
//
// Usage: arcslip_continuation_counts [part of a problem's name]

#include "continuation/suite/cases.hpp"

#include <algorithm>
#include <cstdio>

int main(int argc, char** argv) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  std::printf("%-24s %4s %6s %5s %7s %7s %6s %7s %6s %5s  %s\n", "problem", "n", "points", "rej", "fact/pt",
              "no mon", "res/pt", "no mon", "it/pt", "folds", "end");
  for (const suite::Case& c : suite::cases()) {
    if (c.name.find(wanted) == std::string::npos) continue;
    suite::Options options = suite::window(c.lower, c.upper);
    options.points = 5000;
    const suite::Branch with = suite::trace(c, options);
    const suite::Branch without = arcslip::continuation::trace(c.problem, c.start, options);
    long iterations = 0;
    for (const auto& point : with.points) iterations += point.iterations;
    const auto per_point = [](long count, const suite::Branch& b) {
      return static_cast<double>(count) / static_cast<double>(std::max(1L, b.counts.points));
    };
    std::printf("%-24s %4d %6ld %5ld %7.2f %7.2f %6.2f %7.2f %6.2f %5zu  %s\n", c.name.c_str(),
                c.problem->size(), with.counts.points, with.counts.rejected_steps,
                per_point(with.counts.factorizations, with),
                per_point(without.counts.factorizations, without), per_point(with.counts.residuals, with),
                per_point(without.counts.residuals, without), per_point(iterations, with), with.events.size(),
                name(with.stop.reason));
  }
}
