#pragma once
// What the harmonics above N would add to the amplitude, to first order.
//
// At the solution u of order N the element forces have coefficients f_n for n > N as well. They drive
//   X_n = -Z_n^-1 f_n,  N < n <= 2 N + 9,
// and X_n acts back on the harmonics kept through the elements, at fixed frequency:
//   J du = -(dF/dX_n) X_n - R,
// where R is the residual at u with exact friction: zero but for rounding, or, where the scene samples its
// friction, the error of sampling. The estimate is |dA/dx . (du, X_n)|, the change of the amplitude, not a
// bound: it has been within a factor of two of the error wherever that is known (docs/performance.md), but
// both change sign along a branch. It is flagged where N omega lies below the highest natural frequency of
// the structure with its sliders stuck: a resonance is left out there, and the first order may be far off.

#include <arcslip/continuation/monitor.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/amplitude.hpp>

namespace arcslip::observables {

struct TruncationEstimate {
  double amplitude = 0;  // m
  bool flagged = false;
};

class Truncation {
 public:
  /// p: where the natural frequencies are taken.
  Truncation(const hbm::HbmProblem& problem, const continuation::Vector& p);

  /// At an accepted point of a branch in frequency (of a problem with the same harmonics); extreme: of its
  /// response.
  TruncationEstimate estimate(const continuation::Accepted& now, const Extreme& extreme);

 private:
  void embed(continuation::In u, continuation::Vector& wide) const;
  void restrict_to_kept(continuation::Vector& wide, continuation::Out kept) const;

  const hbm::HbmProblem& problem_;
  elements::Harmonics kept_, wide_;
  hbm::HbmProblem wide_problem_;
  std::unique_ptr<hbm::HbmEvaluator> evaluator_;
  double highest_;
  continuation::Vector u_, tail_, effect_, change_, residual_, response_;
};

/// Highest natural frequency (rad/s) of M x'' + (K + sum of element stiffnesses) x = 0 at p; massless motions
/// have none. 0 where there is none at all.
double highest_natural_frequency(const model::Model& model, const continuation::Vector& p);

}  // namespace arcslip::observables
