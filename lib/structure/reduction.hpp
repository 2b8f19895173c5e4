#pragma once
// Reduction of a large structure M x'' + C x' + K x to some of its rows, b, and to a few coordinates z of all
// others, i. With a shift sigma > 0 below the square of the highest angular frequency of interest,
//
//   x_i = Psi x_b + V z,   A = K + sigma M,   Psi = -A_ii^-1 A_ib
//
// V spans the block Krylov space A_ii^-1 R, A_ii^-1 M_ii A_ii^-1 R, ... of R = M_ii Psi + M_ib. It holds just
// what b can excite, and each of its blocks makes two more terms of the power series, about s^2 = -sigma, of
// the dynamic stiffness condensed onto b exact:
//
//   Z(s) = A_c - p M_c - p^2 sum_j mu_j mu_j^T/(1 - p theta_j),   p = s^2 + sigma
//
// theta_j: the eigenvalues of V^T M_ii V for V^T A_ii V = 1; mu = V^T R. M, C and K are projected onto (x_b,
// z), so that proportional damping stays proportional and rigid-body motions, massless rows and floating
// parts need no case of their own. With a matrix C the space also has A_ii^-1 C_ii times each of its vectors,
// which adds nothing where C is proportional. A row that no entry of the matrices links to b takes no part.
//
// Loads f on all rows become f_b + Psi^T f_i and V^T f_i. Their f_i stand next to R in the space: what b sees
// of them, p R^T (A_ii - p M_ii)^-1 f_i, then has the moments that Z has.
//
// A stiffness K + Omega^2 K2 is expanded about the speed whose square is half that of the highest: K is the
// stiffness there, R2 = K2_ii Psi + K2_ib stands next to R, and A_ii^-1 K2_ii times each vector of the space
// is in it as well, which makes the mixed moments in s^2 and Omega^2 exact. Psi and V are those of all
// speeds.
//
// Of unsymmetric C and K the symmetric parts take the places of C and K; the skew-symmetric ones, and
// gyroscopic and circulatory matrices S, with the speed as a factor or not, are projected onto the same
// coordinates, where they are skew-symmetric again. The space has A_ii^-1 (S_ii Psi + S_ib) and A_ii^-1 S_ii
// times each of its vectors; as S^T = -S, it is that of the transposed structure as well.
//
// Moments: E. J. Grimme, Krylov projection methods for model reduction, PhD thesis, Univ. of Illinois (1997).
//
// With modes in place of that space, sigma is 0, so that statics are exact whatever the modes:
//
//   fixed-interface modes of b held, K_ii V = M_ii V diag(omega^2):
//     R. R. Craig and M. C. C. Bampton, Coupling of substructures for dynamic analyses,
//     AIAA J. 6 (1968) 1313
//   free-interface modes Phi with their residual flexibility:
//     S. Rubin, Improved component-mode representation for structural dynamic analysis,
//     AIAA J. 13 (1975) 995
//
// Rubin's vectors, Phi and what the statics of forces on b, balanced by inertia where the structure floats,
// have next to them, span (I, Psi) x_b and (0, Phi_i - Psi Phi_b): the latter, of K_ii (Phi_i - Psi Phi_b) =
// omega^2 (M Phi)_i, and those of inertia, are V = K_ii^-1 (M Phi)_i, rigid-body motions among them. The
// natural frequencies of Phi are then those of the whole structure. With b held no part may float.

#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/matrices.hpp>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace arcslip::structure {

/// In (x_b, z): dense, symmetric, M and K diagonal in z. Without damping C is empty. C and K are unsymmetric
/// where those of the structure are, and K is then diagonal in z but for its skew-symmetric part.
struct Reduced {
  Eigen::MatrixXd M, C, K;
  Eigen::MatrixXd G, N;   // gyroscopic and circulatory, with the speed as a factor; empty: none
  Eigen::MatrixXd K2;     // empty: none
  Eigen::MatrixXd loads;  // a column each
  /// The largest error of an entry of Z, for s from 0 to the highest frequency and a loss factor of 1 %,
  /// relative to the terms of its row and column on the diagonal, and of the loads at b, relative to
  /// sqrt(f^T A^-1 f) in place of a row, at speeds from 0 to the highest: by residuals (projected.hpp);
  /// and what the last digits of the entries of M and K change of the square of the lowest natural frequency.
  double error = 0;
  /// Natural frequencies below this, rad/s, are not distinguished from 0: rigid-body motions. 0: there are
  /// none.
  double free_below = 0;
};

/// Matrices that cannot be reduced: what() says why, with the row at fault.
class ReductionError : public Error {
  using Error::Error;
};

/// What the structure is reduced for, next to the rows that are kept.
struct Purpose {
  double highest = 0;        // frequency, rad/s, above 0
  double highest_speed = 0;  // Omega, rad/s; 0: G and N as they stand, and no K2
  Eigen::MatrixXd loads{};   // on all rows, a column each
  double accuracy = 1e-11;   // of Reduced::error: V grows until then, or as far as rounding allows
  scene::ReductionMethod method = scene::ReductionMethod::krylov;
  int modes = -1;     // of the other methods, as many as there are; -1: those up to the cutoff
  double cutoff = 0;  // rad/s
};

/// kept: rows of the matrices, from 0. most: vectors of V by Krylov spaces. Throws ReductionError, where
/// K + sigma M is not positive definite, a part floats with b held by another method, numbers overflow, or
/// the error of Krylov spaces stays above 1e-3, and control::Interrupted. The error of modes is as it is.
Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, const Purpose& purpose,
               const control::Control& control = {}, int most = 1500);
Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, double highest,
               const control::Control& control = {}, int most = 1500);

}  // namespace arcslip::structure
