#pragma once
// Stability of equilibria along a branch: eigenvalues mu of J v = mu M v for M u' = F(u, p).
//
//   Options options{.lower = 0, .upper = 4};
//   options.stability.emplace();                       // u' = F
//   const Branch branch = trace(problem, start, options, hopf_monitors(*problem));
//   for (const StabilityRange& each : stability_ranges(branch)) ...   // points first to last: `unstable` of
//   them
//
// J dense or sparse of up to `dense` unknowns: all eigenvalues, by QR, or QZ with M. A larger one that is
// symmetric, without M: the number of positive ones, by the inertia of L D L^T. Any other: those next to the
// imaginary axis, by Arnoldi's method for (J - i w M)^-1 M with shifts i w, and, as a second opinion on
// request, the one that is nearest to the axis at whatever frequency, by Lyapunov inverse iteration.

#include <arcslip/continuation/problem/problem.hpp>

#include <complex>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace arcslip::continuation {

/// A part of the imaginary axis, 0 <= lower <= upper, rad per unit of time: pairs on it, and next to it, were
/// found.
struct AxisRange {
  double lower = 0, upper = 0;
};

/// Eigenvalues at a point. Those on the imaginary axis, as at an event, are counted by rounding.
struct Spectrum {
  std::vector<std::complex<double>> leading;      // by decreasing real part; of a pair that with a positive
                                                  // imaginary part comes first. Empty: only counted
  int unstable = 0;                               // with a positive real part: of those found
  bool complete = false;                          // `unstable` is their number. False: those found
  std::vector<AxisRange> found_near;              // where eigenvalues were looked for; all of it if complete
  std::optional<std::complex<double>> nearest{};  // to the imaginary axis, Im >= 0, by the second opinion,
                                                  // among those counted. None: not asked for, not found by
                                                  // shifts, or it does not converge, as where many are near
};

/// Which points have a spectrum. automatic: all, up to StabilityOptions::every_point unknowns; beyond, the
/// first point and those that follow an event.
enum class SpectrumAt { automatic, every_point, events };

/// The user's own eigensolver, in place of all of the above. M: null if there is none; before: at the last
/// point that has one, or null.
using EigenSolver = std::function<Spectrum(const Jacobian& J, const SparseMatrix* M, const Spectrum* before)>;

struct StabilityOptions {
  /// M of M u' = F, n x n, constant; it may be singular, and its infinite eigenvalues are dropped. None: 1.
  std::shared_ptr<const SparseMatrix> mass{};
  SpectrumAt at = SpectrumAt::automatic;
  int every_point = 50;  // unknowns: up to so many, all eigenvalues double the time of a trace at most
  int dense = 500;       // unknowns: up to so many, all eigenvalues are computed, in some 10 n^3 operations
  int leading = 6;       // eigenvalues that are kept; >= 1

  // Of Arnoldi's method.
  int near_shift = 8;  // eigenvalues wanted near each shift; >= 1
  int krylov = 40;     // vectors kept, >= 2 near_shift + 1: more cost memory, fewer more restarts
  int restarts = 5;    // at most: eigenvalues equally far from a shift hardly converge, and end its range
  double tolerance = 1e-8;  // of eigenvalues, relative
  int shifts = 8;           // at most, each with a factorization or two: every further one goes twice as far
  double largest_frequency = 0;  // w beyond which nothing is looked for, rad per time; 0: as far as shifts go
  std::vector<double> frequencies{};  // w of the first shifts, >= 0, besides 0

  // Lyapunov inverse iteration (K. Meerbergen, A. Spence, SIAM J. Matrix Anal. Appl. 31, 2010), of which no
  // frequency has to be known: a second opinion where eigenvalues are found by shifts. It costs some ten
  // complex factorizations more at each point that has a spectrum.
  bool second_opinion = false;
  int lyapunov_space = 80;  // vectors kept, >= 8: more cost memory, fewer more iterations

  EigenSolver solver{};
};

/// Throws std::invalid_argument, with the value and its bound, for an option that is not valid, or a mass of
/// another size than n x n.
void check(const StabilityOptions& options, int n);

}  // namespace arcslip::continuation
