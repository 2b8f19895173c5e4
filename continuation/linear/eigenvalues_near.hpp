#pragma once
// Eigenvalues of large sparse matrices near a point of the imaginary axis, by Spectra. Not installed.
//
// Arnoldi's method with implicit restarts for Re((J - i w M)^-1 M), whose eigenvalues are
//
//   nu = (1 / (mu - i w) + 1 / (mu + i w)) / 2 = mu / (mu^2 + w^2),
//
// so that the largest |nu| belong to the mu next to +- i w; infinite mu, of a singular M, have nu = 0. They
// converge first: where the smallest one found is nu_k, none is expected to be missed for which |nu| > nu_k,
// as on the axis between
//
//   (-+ 1 / nu_k + sqrt(1 / nu_k^2 + 4 w^2)) / 2.

#include <arcslip/continuation/problem/stability.hpp>

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace arcslip::continuation {

struct NearEigenvalues {
  std::vector<std::complex<double>> values;
  Eigen::VectorXd start;  // of a space that has them, to begin with at a neighbouring point
  AxisRange range;        // upper = lower: none
};

/// J, M: n x n; M null: 1. start: n, or empty. Values whose residual exceeds the root of the tolerance are
/// left out. Nothing found where J - i w M is singular.
NearEigenvalues eigenvalues_near(const SparseMatrix& J, const SparseMatrix* M, double w,
                                 const StabilityOptions& options, const Eigen::VectorXd& start);

}  // namespace arcslip::continuation
