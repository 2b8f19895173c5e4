#pragma once
// What an evaluation of a design gives.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/results/response.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

/// An evaluated design.
struct Evaluation {
  std::vector<double> design;
  double amplitude = 0;  // m, criterion over the cases at that time; infinity if one is unbounded
};

/// A case at the optimum; with scatter, a case with values of the uncertain parameters.
struct LoadCaseResult {
  std::size_t of = 0;                                   // index in OptimumProblem::cases; 0 without cases
  std::vector<std::pair<std::string, double>> set;      // parameters set by that case
  std::vector<std::pair<std::string, double>> scatter;  // values of the uncertain parameters
  double weight = 1;
  double amplitude = 0;              // A_c, m, without the weight
  observables::ResponsePoint point;  // at its highest peak
  bool active = false;    // worst: w_c A_c is the highest, within 1e-6, relative; mean: every case is
  double multiplier = 0;  // Lagrange multiplier at the optimum; all add up to 1
};

/// A limit c(p) <= 0 on a design p that is active, within 1e-6: c = (observable - bound)/|bound| or its
/// negative, or the same for a linear limit; without |bound| if that is 0. y: the scaled variables
/// (scaled_parameter.hpp).
struct ActiveLimit {
  std::string limit;                // the observable, or "a linear limit"
  std::size_t in_case = 0;          // of Optimum::cases; a linear limit holds in all
  continuation::Vector gradient{};  // dc / dy
  double slack = 0;                 // -c
  double multiplier = 0;            // relaxing the limit by x of its bound lowers ln V by about x times this
  bool by_height = false;  // it is exceeded at a peak that is just low enough not to be watched; where that
                           // peak might be higher by x, relative, ln V would fall by x times the multiplier
};

struct OptimumProgress {
  int evaluations = 0;
  std::span<const double> design;  // of the last one
  double omega = 0;                // of the highest peak of the highest case, rad/s; 0 if there is none
  double amplitude = 0, best = 0;  // m, criterion at the last design, and its lowest feasible value so far
  const char* phase = "";          // "the search", "the certificate"
};

}  // namespace arcslip::optimize
