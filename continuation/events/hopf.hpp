#pragma once
// Hopf points of u' = F(u, p): where a pair of eigenvalues of J = dF/du crosses the imaginary axis, and a
// branch of periodic solutions begins.
//
// With the eigenvalues of J in the order of their real parts, s_1 >= s_2 >= ... >= s_n, each s_k is
// continuous along a branch, and crosses zero where the number of unstable eigenvalues passes from below k to
// k or more, or back. So there is one monitor to each s_k:
//   - a pair that turns real, or real eigenvalues that become a pair, leave all s_k continuous: no event;
//   - at a neutral saddle, real eigenvalues of opposite sign and equal size, no s_k is zero: no event;
//   - where a real eigenvalue crosses, a fold or a branch point, the zero of s_k is found and is no event;
//   - several pairs that cross within one step are zeros of different s_k, and all are found;
//   - a pair and a real eigenvalue within one step leave at least one s_k that the pair alone has changed.
// What cancels is a pair that crosses and another one that crosses back within one step.
// A pair is a zero of two neighbours, s_k = s_(k+1), which is one event, that of the eigenvalue with a
// positive imaginary part. Pairs that cross at one place are as many events, by rising frequencies.
//
// The sign convention is that of u' = F: negative real parts are stable. -F has the same Hopf points.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>

#include <vector>

namespace arcslip::continuation {

/// All eigenvalues are computed at each point, by QR of a dense J, about 10 n^3 operations: n is at most
/// this.
constexpr int largest_spectrum = 500;

/// The monitors of s_1 to s_n, each called "hopf"; to be used together. Copies serve several traces at a
/// time. Their events carry Hopf, with omega > 0, and a + ib normalised by |a|^2 + |b|^2 = 1, a . b = 0, |a|
/// >= |b| in the scales of the problem, and the component of a that is largest in scales positive. Throws
/// std::invalid_argument for more than largest_spectrum unknowns. A Jacobian that is an operator, or a QR
/// that does not converge, ends the branch (StopReason::monitor_failed).
std::vector<Monitor> hopf_monitors(const Problem& problem);

/// J, dense or sparse, as a dense matrix. Throws std::invalid_argument for an operator.
void to_dense(const Jacobian& J, Matrix& dense);

}  // namespace arcslip::continuation
