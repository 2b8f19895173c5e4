#pragma once
// Responses where branches pass a value of their free parameter: the frequency, or the factor of the
// excitation.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/hbm/problem.hpp>

#include <string>
#include <vector>

namespace arcslip::observables {

/// The event passage, where the free parameter passes a value.
continuation::Monitor passage_monitor(double value);

/// Collects responses at parameters p, each once. A branch that comes from a fold may pass the value twice
/// within a step: those are found from the fold.
class Passages {
 public:
  /// parameter: the free one; its value in p is the one passed.
  Passages(const hbm::HbmProblem& problem, continuation::Vector p, int parameter);

  /// Of a branch that was traced with a fold monitor and passage_monitor().
  void take(const continuation::Branch& branch);

  bool has(const continuation::Vector& u) const;
  bool add(const continuation::Vector& u);  // whether it is a further one

  std::vector<continuation::Vector> u;
  std::string doubt;  // why one is missing; empty: none is

 private:
  void add_near(const continuation::Vector& guess, bool is_located);
  void add_between(const continuation::Point& fold, const continuation::Point& nearby, double share);

  const hbm::HbmProblem& problem_;
  continuation::Vector p_;
  int parameter_;
  double value_;
};

}  // namespace arcslip::observables
