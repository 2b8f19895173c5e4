#pragma once
// Points of codimension 2 on curves of folds and of Hopf points of u' = F(u, p), with their normal forms.
//
// Where the critical eigenvalues of the curve are left out, the real parts of the others, sorted, are
// continuous along it (events/hopf.hpp), and one that crosses zero adds a real eigenvalue or a pair to the
// critical ones:
//
//   curve of folds        a pair: zero-Hopf; a real one: Bogdanov-Takens, of bogdanov_takens_monitor()
//   curve of Hopf points  a real one: zero-Hopf; a pair: double Hopf
//
// A generalized Hopf point is a zero of l1. Beyond a Bogdanov-Takens point, where frequency^2 < 0, the points
// of the curve are neutral saddles: there, l1 keeps its last sign, and there are no events.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <memory>
#include <vector>

namespace arcslip::continuation {

/// Monitors of a curve of Hopf points (hopf_points()): "bogdanov_takens", "generalized_hopf", "zero_hopf" and
/// "double_hopf", with the data of the structs of these names. Zero-Hopf and double Hopf points are reported,
/// no branch is switched there. l1 is computed at each point, from some 160 evaluations of J, or 300 of F.
/// Throws std::invalid_argument, at the first point, on other branches.
std::vector<Monitor> hopf_curve_monitors(const Problem& curve);

/// Monitors of a curve of folds (folds()) of up to largest_spectrum unknowns: "cusp", "bogdanov_takens" and
/// "zero_hopf". Throws as the above, and std::invalid_argument for more unknowns.
std::vector<Monitor> fold_curve_monitors(const Problem& curve);

/// The curve of Hopf points that leaves a Bogdanov-Takens point, and where it begins:
///
///   trace(origin.curve, {.u = origin.u, .p = origin.p, .free = origin.free, .tangent = origin.tangent}, ...)
struct HopfCurveOrigin {
  std::shared_ptr<const Problem> curve;  // hopf_points() with a typical frequency of the curve's own
  Vector u, p;                           // (u, p_along, 0); all parameters
  int free = 0;
  Vector tangent;  // towards positive squares of the frequency
};

/// bogdanov_takens: an event of a curve of folds in p_along, over p_free; p: all parameters of that curve.
/// Throws std::invalid_argument for other events, and where the curve of Hopf points has no tangent there.
HopfCurveOrigin hopf_curve_at(const std::shared_ptr<const Problem>& problem, int along,
                              const Event& bogdanov_takens, const Vector& p, int free);

}  // namespace arcslip::continuation
