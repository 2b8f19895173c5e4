#pragma once
// Curves of Hopf points of u' = F(u, p) in two parameters.
//
// Let V, W (n x 2) span the right and left invariant subspaces of J = dF/du for one pair of eigenvalues,
//
//   J V = V R,   W^T J = R W^T,   W^T V = I,        R (2 x 2) with that pair.
//
// sigma = tr R and pi = det R, the sum and the product of the pair, are smooth as long as the pair is
// separate from the other eigenvalues, be it complex, real or double. A Hopf point with omega^2 = kappa is a
// solution of
//
//   F(u, p) = 0,   sigma(u, p) = 0,   pi(u, p) - kappa = 0,
//
// n + 2 equations in u, a parameter p_a, kappa and one more free parameter, which trace() continues like any
// other problem. kappa is an unknown, so that (u, p, kappa) identifies the pair: the one nearest to
// +- i sqrt(kappa). At kappa = 0, a Bogdanov-Takens point, the pair is a double zero and the curve is
// regular; beyond it, with kappa < 0, the points are neutral saddles, which are no Hopf points.
//
// Gradients: differentiate J V = V R and multiply by W^T; with S = W^T dV,
//
//   dR = W^T dJ V + R S - S R,   d sigma = tr(W^T dJ V),
//   d pi = tr(adj(R) W^T dJ V),   adj(R) = sigma I - R,
//
// as the commutator drops out of both traces. dJ v . w is Evaluator::second_derivative, or a difference of
// J^T w and F_p . w along v, by the symmetry of second derivatives.
//
// V and W are the kernels of Q = J^2 - sigma J + pi I and its transpose, whose rank is n - 2 also at a double
// zero, where there is a single eigenvector. (Bindel, Demmel and Friedman, SIAM J. Sci. Comput. 30, 2008, on
// invariant subspaces; Govaerts 2000, chapter 4, on other formulations of the same curve.)
//
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

/// The Hopf points of branches in the parameter `along`, as a problem in the unknowns (u, p_along, kappa)
/// with the same parameters; p[along] is ignored. frequency: a typical omega > 0, whose square is the scale
/// of kappa. All eigenvalues are computed at each evaluation, which requires a dense or sparse Jacobian and
/// at most largest_spectrum unknowns (hopf.hpp). Throws std::invalid_argument if these or the frequency are
/// invalid, std::out_of_range for an invalid index.
std::shared_ptr<const Problem> hopf_points(std::shared_ptr<const Problem> problem, int along,
                                           double frequency);

/// The unknowns (u, p_along, omega^2) of a Hopf point of a branch in p_along, the start of a curve. Throws
/// std::invalid_argument for other events.
Vector with_frequency(const Event& hopf);

/// kappa on a curve of Hopf points, zero at Bogdanov-Takens points. Its events are named "bogdanov_takens".
Monitor zero_frequency_monitor();

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
