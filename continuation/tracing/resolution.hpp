#pragma once
// Whether a step tells what lies along it: the curve, its kinks, and the extremes of monitored quantities.
// Sections 8.4 and 8.5 of the theory. Not installed.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/corrector.hpp>
#include <arcslip/continuation/tracing/state.hpp>
#include <arcslip/continuation/tracing/trial.hpp>

#include <vector>

namespace arcslip::continuation {

class Resolution {
 public:
  /// All outlive this.
  Resolution(const Options& options, const std::vector<Monitor>& monitors, bool looks_for_kinks, State& state,
             Corrector& corrector)
      : options_(options),
        monitors_(monitors),
        looks_for_kinks_(looks_for_kinks),
        s_(state),
        main_(corrector) {}

  /// Fills curve_error and other_piece_between: of the cubics along the smooth pieces, over that allowed, the
  /// largest; and whether there is more between than these.
  void measure_curve(Trial& trial);

  /// Whether kinks lie in the step that were not found, two between ends on one piece or one that is hard to
  /// come to: then it is shortened, though not without end, as the cubic may touch another piece where the
  /// branch does not.
  bool hides_a_piece(const Trial& trial);

  /// Whether each monitored quantity has no more extremes in the step than its slopes at the ends of its
  /// sections tell. Beside a kink a slope may bend however short the step: in one stretch the step is
  /// shortened no further than to a part of the first one. Fills chord_error and unresolved.
  bool tells_quantities(Trial& trial);

  /// Whether steps have been shortened enough in the stretch of the branch where they do not tell what is
  /// asked for.
  bool stretch_is_short(double share) const;
  void begin_stretch(double length);

 private:
  double curve_error(const Place& from, Trial& trial, const Place& to);
  bool tells(const Place& from, const Place& to, Trial& trial) const;
  double chord_departure(const Place& from, const Place& to, std::size_t m, double length) const;

  const Options& options_;
  const std::vector<Monitor>& monitors_;
  bool looks_for_kinks_;
  State& s_;
  Corrector& main_;
  Vector middle_;
};

}  // namespace arcslip::continuation
