#pragma once
// An attempted step, until it is accepted or rejected. Not installed.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/correction/curve_point.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::continuation {

/// A tracer has one, so that its vectors are allocated once.
struct TrialStep {
  CurvePoint end;
  Correction correction;
  double usual_contraction = 1;  // of the corrections at the point before
  double error = 0;              // of the end, relative, where it was looked at
  bool is_looked_at = false;     // the evaluator has F at the end
  double length = 0;             // arclength of the step, by way of its corners
  double turn = 0;               // rad, of the tangent
  bool kink = false;  // the tangent jumps in it: at one of its corners, or at a kink that was not located
  std::vector<PassedKink> corners;        // on the way, in order
  std::optional<LocatedEvent> crossing;   // the branch point on the way
  double curve_error = 0;                 // of the cubics along it, relative to the tolerance: the largest
  double worst_begin = 0, worst_end = 0;  // arclength of the ends of its section
  bool worst_has_kinks = false;           // which it passes by its curve alone
  bool other_piece_between = false;       // unnoticed by its sections
  bool passes_kinks = false;              // which are not looked for
  Vector basis;                           // TransverseSpace at its end, where the sign of the
  bool has_basis = false;                 // determinant is not known
  double chord_error = 0;                 // of the monitored quantities, relative to the tolerance
  double refused_error = 0;               // curve_error of the rejection before, from the same point; 0: none
  double refused_length = 0;              // its length
  Rejection rejection;                    // why it was rejected
  std::size_t unresolved = 0;             // the monitor of the unresolved quantity
  bool evaluated = true;                  // false: the reason is that the problem could not be evaluated
  std::string failure;                    // in its words

  void begin() {
    length = turn = curve_error = chord_error = 0;
    is_looked_at = kink = other_piece_between = passes_kinks = worst_has_kinks = has_basis = false;
    corners.clear();
    crossing.reset();
  }

  void forget_refusal() { refused_error = refused_length = 0; }
  void keep_refusal() {
    refused_error = curve_error;
    refused_length = length;
  }

  /// Where the last of its smooth sections begins.
  const CurvePoint& last_section(const CurvePoint& here) const {
    return corners.empty() ? here : corners.back().beyond;
  }

  /// f(from, to) for each smooth section of the step from `here`, in order, while it returns true. Whether it
  /// always did.
  template <class F>
  bool all_sections(const CurvePoint& here, F&& f) const {
    const CurvePoint* from = &here;
    for (const PassedKink& corner : corners) {
      if (!f(*from, corner.before)) return false;
      from = &corner.beyond;
    }
    return f(*from, end);
  }
};

}  // namespace arcslip::continuation
