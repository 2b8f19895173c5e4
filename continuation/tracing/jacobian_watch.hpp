#pragma once
// Diagnostics of a trace: wrong Jacobians. Not installed.

#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <string>

namespace arcslip::continuation {

class JacobianWatch {
 public:
  /// All outlive this.
  JacobianWatch(const Problem& problem, const Options& options, State& state)
      : problem_(problem), options_(options), s_(state) {}

  /// Compares J and dF/dp with finite differences at v, n + 1, unless a wrong entry is already known: the
  /// first one found becomes a warning of the branch. Of a problem made of another one, those of the other
  /// one are looked at, and its own unless they are differences.
  void look_at(const Vector& v);

  /// The same at the last point, if it is the 1st, 8th, 64th ... of the branch.
  void check_some();

  /// A correction to v did not converge quadratically: checks there and at the last point, at the 1st, 8th,
  /// 64th ... occasion. Not at v where it has diverged.
  void suspect(const Vector& v);

  /// Appended to the message that Newton's method failed at v, from a guess: "; " and what is wrong, or
  /// nothing.
  std::string doubt(const Vector& v, const Vector& guess);

  /// False where the Jacobian is wrong and steps get short, or many are rejected.
  bool can_continue() const;

 private:
  bool is_near(const Vector& v, const Vector& from) const;

  const Problem& problem_;
  const Options& options_;
  State& s_;
};

}  // namespace arcslip::continuation
