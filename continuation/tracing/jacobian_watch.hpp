#pragma once
// What a trace finds out on the way about the Jacobian of its problem. Not installed.

#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <string>

namespace arcslip::continuation {

class JacobianWatch {
 public:
  /// All outlive this.
  JacobianWatch(const Problem& problem, const Options& options, State& state)
      : problem_(problem), options_(options), s_(state) {}

  /// Compares J and dF/dp with differences at v, n + 1, unless an entry is known to be wrong already: the
  /// first one found becomes a warning of the branch.
  void look_at(const Vector& v);

  /// The same at some of the branch's points: the 1st, 8th, 64th ...
  void look_at_some();

  /// A correction that came to v did not converge as Newton's method does: looks there and at the last point,
  /// the 1st, 8th, 64th ... time.
  void suspect(const Vector& v);

  /// To go on a message where Newton's method failed at v: "; " and what is wrong, or nothing.
  std::string doubt(const Vector& v);

  /// False where the Jacobian is wrong and steps get short, or many are rejected.
  bool gets_on() const;

 private:
  const Problem& problem_;
  const Options& options_;
  State& s_;
};

}  // namespace arcslip::continuation
