#pragma once
// What is to be least, and the limits, as a problem of NLopt. Not installed.
//
//   smooth     objective ln V/V_0 (cases.hpp), with the gradient of a highest peak
//   epigraph   levels t_g for groups g of cases, constraints ln w_c A_ck/V_0 <= t_g for the peaks k
//
// and for both a constraint for each limit on an observable at each peak of each case, and linear limits.

#include <arcslip/optimize/peaks/peak_amplitude.hpp>
#include <arcslip/optimize/search/cases.hpp>
#include <arcslip/optimize/search/design_space.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace arcslip::optimize {

// Which peak each of several constraints is about. Not installed.
//
// A constraint keeps its peak while peaks are followed. Of a new response it takes the nearest one, if one is
// near; peaks that are left over go to constraints that have none.

class ConstraintPeaks {
 public:
  explicit ConstraintPeaks(std::size_t count = 0) : all_(count) {}

  std::size_t size() const { return all_.size(); }

  /// Of constraint k. responses: how many were traced so far. nullopt: there is none for it.
  std::optional<std::size_t> peak(std::size_t k, const PeakState& state, int responses);

 private:
  struct Constrained {
    double omega = 0;
    std::optional<std::size_t> peak{};
  };

  void assign(const PeakState& state);

  std::vector<Constrained> all_;
  int responses_ = -1;  // when they were given their peaks
};

class Formulation {
 public:
  /// Throws OptionsError for an unknown observable and reversed limits. Refers to its arguments.
  Formulation(const OptimumProblem& problem, const DesignSpace& space, Cases& cases);

  /// For a run from where the cases stand, all finite. reference: V_0. move: takes the cases to y's design.
  /// y: the start; levels are added to it. Refers to this object.
  Problem problem(std::vector<double>& y, const Algorithm& algorithm, double reference,
                  std::function<void(std::span<const double> y)> move);

  /// Whether it would be an epigraph where the cases stand, and whether the last one was.
  bool wants_epigraph(const Algorithm& algorithm) const;
  bool epigraph() const { return epigraph_; }

  /// The largest value of the limits on observables and of the linear ones where the cases stand, relative;
  /// -infinity where there are none.
  double margin();
  /// By how much the worst of the limits is exceeded there; 0 where all hold.
  double excess();
  /// Those that are active there, without those at a kink.
  std::vector<ActiveLimit> active();

 private:
  struct Limited {
    PeakAmplitude::Observable observable;
    std::string name;
    double sign, bound;  // sign * (observable - bound)/scale <= 0
  };

  double level(std::size_t c, std::size_t peak, std::span<double> gradient) const;
  bool is_limited(std::size_t c, std::size_t peak) const;
  double height(std::size_t c, std::size_t peak) const;
  double limit(const Limited& each, std::size_t c, std::size_t peak, std::span<double> gradient);
  std::optional<std::size_t> peak(std::size_t c, std::size_t constraint);
  void add_epigraph(Problem& problem, std::vector<double>& y);
  void add_limits(Problem& problem, std::size_t n);

  const DesignSpace& space_;
  Cases& cases_;
  std::vector<Limited> limits_;
  std::vector<ConstraintPeaks> constraints_;  // of each case
  std::function<void(std::span<const double>)> move_;
  double reference_ = 1;
  bool epigraph_ = false;
};

}  // namespace arcslip::optimize
