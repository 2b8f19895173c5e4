#pragma once
// Hopf points to rounding.
//
// The zero of the real part of an eigenvalue along a branch is as accurate as that eigenvalue: rounding of QR
// counts relative to the norm of J, and errors of a J that consists of differences count in full. The pair
// near i omega is better known from its right and left vectors, J v = mu v, w^H J = mu w^H, as
//
//   mu = w^H (J v) / (w^H v),
//
// in which errors of v and w are of second order, and J v, a derivative of F in one complex direction, may
// come from extrapolated differences. v and w are those of the bordered system
//
//   [ J - i omega  b ] (v, g) = e_{n+1},   and of its conjugate transpose,
//   [ c^H          0 ]
//
// of the balanced J. Newton's method for Re mu = 0 moves along the tangent t of the branch, with d mu / ds =
// w^H J'(t) v / (w^H v), and returns to F = 0 by the factors there; omega = Im mu.

#include <arcslip/continuation/events/monitor.hpp>

#include <complex>
#include <optional>

namespace arcslip::continuation {

struct RefinedHopf {
  Vector x;            // (u, p), n + 1
  double frequency;    // > 0
  Eigen::VectorXcd z;  // J z = i frequency z
};

/// From a place near the Hopf point of a pair that is separate from the others, with its frequency and
/// eigenvector. free: index of the free parameter. Nothing if the iteration does not converge, or leads
/// elsewhere. The evaluator is moved. Not installed.
std::optional<RefinedHopf> refine_hopf(const Accepted& now, double frequency, const Eigen::VectorXcd& z,
                                       const Vector& scales);

}  // namespace arcslip::continuation
