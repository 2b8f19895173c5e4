#pragma once
// A sector of a ring in a wave (faces.hpp). With x -> T x, which is t times the row `own` in a row beyond, a
// matrix A of the sector becomes T^H A T = A_R + i A_I, and forces f become T^H f. Where A is symmetric that
// is Hermitian, and the matrix of twice the size
//
//   D = [A_R  -A_I]          D U = U (A_R + i A_I),   U = (1, -i)^T/sqrt 2,   U^H U = 1
//       [A_I   A_R]
//
// is symmetric: it is reduced as any other (reduction.hpp) onto the rows that are kept, twice, and real
// coordinates z. Among these, x = U q leads to complex matrices in (q, z), half of whose coordinates a wave
// does not see: the others are of the wave the other way round.
//
// D. L. Thomas, Dynamics of rotationally periodic structures, Int. J. Numer. Meth. Eng. 14 (1979) 81.

#include <arcslip/control/run_control.hpp>
#include <arcslip/structure/faces.hpp>
#include <arcslip/structure/reduction.hpp>

namespace arcslip::structure {

/// In the rows that are kept, then z: Hermitian, G and N skew-Hermitian, C and K general where the scene says
/// so. Empty: none.
struct WaveStructure {
  Eigen::MatrixXcd M, C, K, G, N, K2;
  Eigen::MatrixXcd loads;            // T^H f, a column each
  double error = 0, free_below = 0;  // as of Reduced

  Eigen::Index size() const { return M.rows(); }
};

/// kept: rows of the matrices from 0, none beyond. Throws as reduce() does.
WaveStructure reduce_wave(const scene::Matrices& sector, const Wave& wave, const std::vector<int>& kept,
                          const Purpose& purpose, const control::Control& control = {});
/// All rows but those beyond, in this order. loads: on all rows, a column each.
WaveStructure whole_wave(const scene::Matrices& sector, const Wave& wave, const std::vector<int>& rows,
                         const Eigen::MatrixXd& loads);

}  // namespace arcslip::structure
