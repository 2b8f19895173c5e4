#pragma once
// Curves of Hopf points of u' = F(u, p) in two parameters.
//
// Let V, W (n x 2) span the right and left invariant subspaces of J = dF/du to one pair of its eigenvalues,
//
//   J V = V R,   W^T J = R W^T,   W^T V = I,        R (2 x 2) with that pair.
//
// sigma = tr R and pi = det R, the sum and the product of the pair, are smooth wherever it is apart from the
// other eigenvalues, whether it is complex, real or double. A Hopf point with omega^2 = kappa is a solution
// of
//
//   F(u, p) = 0,   sigma(u, p) = 0,   pi(u, p) - kappa = 0,
//
// n + 2 equations in u, a parameter p_a, kappa and one more free parameter: a problem like any other, which
// trace() follows. kappa is an unknown so that (u, p, kappa) itself says which pair is meant: the nearest to
// +- i sqrt(kappa). At kappa = 0, a Bogdanov-Takens point, the pair is a double zero and the curve goes on
// regularly; beyond it, with kappa < 0, are neutral saddles, which are no Hopf points.
//
// Gradients: differentiate J V = V R and multiply by W^T; with S = W^T dV,
//
//   dR = W^T dJ V + R S - S R,   d sigma = tr(W^T dJ V),   d pi = tr(adj(R) W^T dJ V),   adj(R) = sigma I -
//   R,
//
// as the commutator vanishes from both traces. dJ v . w is Evaluator::second_derivative, or a difference of
// J^T w and F_p . w along v, by the symmetry of second derivatives.
//
// V and W are the kernels of Q = J^2 - sigma J + pi I and its transpose, whose rank is n - 2 at a double zero
// too, where the eigenvectors are one. (Bindel, Demmel and Friedman, SIAM J. Sci. Comput. 30, 2008, on
// invariant subspaces; Govaerts 2000, chapter 4, on other ways to the same curve.)

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <memory>

namespace arcslip::continuation {

/// The Hopf points of branches in the parameter `along`, as a problem in the unknowns (u, p_along, kappa) and
/// the same parameters; p[along] is not looked at. frequency: a typical omega > 0, whose square is the scale
/// of kappa. All eigenvalues are computed at each evaluation: a dense or sparse Jacobian and at most
/// largest_spectrum unknowns (hopf.hpp). Throws std::invalid_argument where these or the frequency do not
/// fit, std::out_of_range for an index without parameter.
std::shared_ptr<const Problem> hopf_points(std::shared_ptr<const Problem> problem, int along,
                                           double frequency);

/// The unknowns (u, p_along, omega^2) of a Hopf point of a branch in p_along, to start a curve from. Throws
/// std::invalid_argument for an event of another kind.
Vector with_frequency(const Event& hopf);

/// On a curve of Hopf points, zero at Bogdanov-Takens points: kappa. Its events are called "bogdanov_takens".
Monitor zero_frequency_monitor();

}  // namespace arcslip::continuation
