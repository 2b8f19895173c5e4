#pragma once
// Hopf points of u' = F(u, p): a pair of eigenvalues of J = dF/du crosses the imaginary axis, and a branch of
// periodic solutions emerges.
//
// With the real parts of the eigenvalues of J sorted, s_1 >= s_2 >= ... >= s_n, each s_k is continuous along
// a branch, and crosses zero where the number of unstable eigenvalues changes from below k to k or more, or
// back. So there is one monitor for each s_k:
//   - a pair that turns real, or real eigenvalues that become a pair, leave all s_k continuous: no event;
//   - at a neutral saddle, real eigenvalues of opposite sign and equal size, no s_k is zero: no event;
//   - where a real eigenvalue crosses, at a fold or a branch point, the zero of s_k is found and is no event;
//   - several pairs that cross within one step are zeros of different s_k, and all are found;
//   - if a pair and a real eigenvalue cross within one step, at least one s_k changes by the pair alone.
// A pair that crosses and another one that crosses back within one step cancel, and are missed.
// A pair is a common zero of two neighbours, s_k = s_(k+1), and is one event, that of the eigenvalue with
// positive imaginary part. Pairs that cross at the same point are one event each, by increasing frequency.
//
// A pair that crosses apart from others is then located by equations of its own (hopf_refinement.hpp), to
// 1e-12 of p and of the frequency with an exact J, to 1e-8 with default differences.
//
// The sign convention is that of u' = F: negative real parts are stable. -F has the same Hopf points.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/stability.hpp>

#include <vector>

namespace arcslip::continuation {

/// The largest n of which all eigenvalues are computed at each point, by QR of a dense J, about 10 n^3
/// operations.
constexpr int largest_spectrum = 500;

struct HopfOptions {
  /// First Lyapunov coefficient, speed of the pair and first approximation of the cycles at each event, from
  /// some 160 evaluations of J if it is exact, else 300 of F. Default: they decide between
  /// stable and unstable cycles, and cost less than the eigenvalues of a few points.
  bool normal_form = true;

  /// Beyond largest_spectrum unknowns, of a sparse J: how eigenvalues next to the imaginary axis are found,
  /// with shifts along it (problem/stability.hpp), and how many pairs are watched, those of the largest real
  /// parts. What shifts do not reach is not found.
  StabilityOptions spectrum{};
  int pairs = 4;
};

/// The monitors of s_1 to s_n, each named "hopf", to be used together. Copies may serve several traces at the
/// same time. The data of an event is Hopf, with omega > 0 and a + ib normalized by |a|^2 + |b|^2 = 1,
/// a . b = 0, |a| >= |b| in the scales of the problem, and the component of a largest in scales positive. For
/// more than largest_spectrum unknowns there is a monitor for each of HopfOptions::pairs found next to the
/// imaginary axis. Throws std::invalid_argument for options that are not valid, and for more than
/// largest_spectrum unknowns without a sparse Jacobian. A Jacobian that is an operator, or a QR that does not
/// converge, ends the branch (StopReason::monitor_failed).
std::vector<Monitor> hopf_monitors(const Problem& problem, const HopfOptions& options = {});

/// A cycle near a Hopf point, by its normal form: a periodic solution of u' = F up to terms of the third
/// power of the amplitude, the start of a computation of cycles.
struct NearbyCycle {
  double parameter = 0, frequency = 0;  // p and angular frequency of the cycle
  Vector mean;                          // n
  Matrix harmonics;                     // n x 4: of cos theta, sin theta, cos 2 theta, sin 2 theta

  /// u at the phase theta = frequency * time.
  Vector at(double theta) const;
};

/// The cycle of amplitude e, z = e exp(i theta) in the normal form (Hopf in problem/branch.hpp): its first
/// harmonic is 2 e Re(q exp(i theta)), |q| = 1. Throws std::invalid_argument for an event without data of a
/// Hopf point, one whose normal form is not known, and amplitudes that are not positive.
NearbyCycle cycle_near(const Event& hopf, double amplitude);

/// J, dense or sparse, as a dense matrix. Throws std::invalid_argument for an operator.
void to_dense(const Jacobian& J, Matrix& dense);

}  // namespace arcslip::continuation
