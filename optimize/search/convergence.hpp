#pragma once
// When a run of an algorithm within a search is ended: by tests of a minimum that NLopt does not have, or for
// lack of progress. Not installed.

#include <arcslip/optimize/certificate/multipliers.hpp>
#include <arcslip/optimize/evaluation/design_evaluations.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>

#include <cstddef>
#include <vector>

namespace arcslip::optimize {

inline constexpr double gain = 1e-7;            // relative: a value lower by less is no progress
inline constexpr double gain_outside = 0.5;     // the same of the excess of a limit
inline constexpr double small_gradient = 1e-8;  // of d ln V / dy: smaller ones are rounding

/// The balance of gradients where the cases stand.
Balance balance_here(DesignEvaluations& designs);

class Convergence {
 public:
  /// no: the run continues. vanishes: the gradient vanishes. settles: the first-order conditions of a minimum
  /// hold at a candidate. idles: the algorithm calls for known designs again and again, or, with limits, for
  /// many without a gain.
  enum class Ends { no, vanishes, settles, idles };

  struct Settings {
    bool smooth;      // one peak, without constraints, by gradients
    bool limited;     // the problem has limits
    bool refinement;  // the run refines a design at which another algorithm ended
    bool global;
    std::size_t parameters;
  };

  /// Of a run from where the designs stand, which outlive this.
  Convergence(DesignEvaluations& designs, const Settings& settings);

  /// After each call of the algorithm.
  Ends test();

  /// After the run: counts the candidate as the best design if it is stationary and as good but for what the
  /// tolerance of a limit gains.
  void take_candidate();

  /// The residual gradient of the candidate.
  double stationarity() const { return candidate_.left.stationarity; }

 private:
  bool gradient_vanishes();
  bool is_settled();
  std::size_t count() const { return designs_.evaluations().size(); }

  DesignEvaluations& designs_;
  Settings settings_;
  struct Candidate {
    std::vector<double> design;
    Balance left;
  } candidate_;  // the design nearest to a minimum by its conditions, among those as good as the best
  std::size_t known_ = 0;   // evaluations at the last call
  int idle_ = 0;            // calls since there was another
  std::size_t gained_ = 0;  // evaluations at the last gain, and the best design then
  double gained_value_ = 0, gained_excess_ = 0;
};

}  // namespace arcslip::optimize
