#pragma once
// The criterion and the limits as a problem of NLopt. Not installed.
//
//   smooth     objective ln V/V_0 (load_cases.hpp), with the gradient of a highest peak
//   epigraph   levels t_g for groups g of cases, constraints ln w_c A_ck/V_0 <= t_g for the peaks k
//
// In both forms with a constraint for each limit on an observable at each peak of each case, and
// linear limits.

#include <arcslip/optimize/evaluation/design_space.hpp>
#include <arcslip/optimize/evaluation/load_cases.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace arcslip::optimize {

// Assignment of peaks to constraints. Not installed.
//
// A constraint keeps its peak while peaks are tracked. In a new response it takes the nearest peak, if one is
// near; remaining peaks go to constraints without one.

class ConstraintPeaks {
 public:
  explicit ConstraintPeaks(std::size_t count = 0) : all_(count) {}

  std::size_t size() const { return all_.size(); }

  /// The peak of constraint k. responses: number traced so far. nullopt: none.
  std::optional<std::size_t> peak(std::size_t k, const PeakState& state, int responses);

 private:
  struct Constrained {
    double omega = 0;
    std::optional<std::size_t> peak{};
  };

  void assign(const PeakState& state);

  std::vector<Constrained> all_;
  int responses_ = -1;  // at the last assignment
};

class Formulation {
 public:
  /// Throws OptionsError for an unknown observable and reversed limits. Refers to its arguments.
  Formulation(const OptimumProblem& problem, const DesignSpace& space, LoadCases& cases);

  /// The problem for a run from the current design of the cases, all finite. reference: V_0. move: moves the
  /// cases to the design of y. y: the start; levels are added to it. Refers to this object.
  NonlinearProgram problem(std::vector<double>& y, const Algorithm& algorithm, double reference,
                           std::function<void(std::span<const double> y)> move);

  /// Whether the epigraph form applies at the current design of the cases, and whether the last problem
  /// used it.
  bool wants_epigraph(const Algorithm& algorithm) const;
  bool epigraph() const { return epigraph_; }

  /// The largest relative value of the limits on observables and of the linear limits at the current design;
  /// -infinity without limits.
  double margin();
  /// The largest violation of the limits there; 0 if all hold.
  double excess();
  /// The active limits there, without those at a kink.
  std::vector<ActiveLimit> active();

 private:
  struct Limited {
    PeakAmplitude::Observable observable;
    observables::Observed read;  // by it
    std::string name;
    double sign, bound;  // sign * (observable - bound)/scale <= 0
  };

  double level(std::size_t c, std::size_t peak, std::span<double> gradient) const;
  bool is_limited(std::size_t c, std::size_t peak) const;
  double height(std::size_t c, std::size_t peak) const;
  double limit(const Limited& each, std::size_t c, std::size_t peak, std::span<double> gradient);
  std::optional<std::size_t> peak(std::size_t c, std::size_t constraint);
  void add_epigraph(NonlinearProgram& problem, std::vector<double>& y);
  void add_limits(NonlinearProgram& problem, std::size_t n);

  const DesignSpace& space_;
  LoadCases& cases_;
  std::vector<Limited> limits_;
  std::vector<ConstraintPeaks> constraints_;  // of each case
  std::function<void(std::span<const double>)> move_;
  double reference_ = 1;
  bool epigraph_ = false;
};

}  // namespace arcslip::optimize
