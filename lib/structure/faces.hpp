#pragma once
// A sector of a ring with rows on both of its faces: a row of the one face, `beyond`, moves as a row of the
// other face, `own`, does in the next sector (scene::Matrices::faces). Rows beyond are none of the ring, nor
// of the sector in a wave; the others keep their order.

#include <arcslip/scene/matrices.hpp>

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace arcslip::structure {

/// Where the rows of the matrices are in the ring.
struct SharedRows {
  std::vector<int> place;    // of each row: that of `own` for one beyond
  std::vector<bool> beyond;  // then it is in the next sector
  int count = 0;             // rows of a sector in the ring
};

SharedRows shared_rows(const scene::Matrices& sector);

/// All copies of a sector as one structure without faces, sector by sector, each with its factor of the
/// stiffness. Its rows with names are in the order of scene::Scene::dofs.
scene::Matrices closed_ring(const scene::Matrices& sector);

/// Forces on the rows of one copy, from 0, as forces on the closed ring, and displacements of these rows, of
/// which those beyond are the next copy's.
Eigen::VectorXd forces_on_ring(const scene::Matrices& sector, int copy, const Eigen::VectorXd& on_rows);
Eigen::VectorXd displacements_on_ring(const scene::Matrices& sector, int copy,
                                      const Eigen::VectorXd& on_rows);

/// A wave around a ring: the next sector moves as this one times turn() = exp(-2 pi i diameter/count).
struct Wave {
  int diameter, count;

  std::complex<double> turn() const;
};

}  // namespace arcslip::structure
