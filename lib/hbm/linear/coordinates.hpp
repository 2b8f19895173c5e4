#pragma once
// Coordinates in which only a few equations are nonlinear: x = P y, y = (unknowns, linear coordinates).
//
// The first `unknowns` entries of y are displacements along element directions d_e . x (a largest independent
// set of them), the others span what no element sees; those are condensed away harmonic by harmonic.
//
// If parts are much stiffer than others, such as nearly rigid links, the elongation of each is a separate
// coordinate, an unknown if it depends on the elements' displacements only. The small elongation then keeps
// all its digits, and the large stiffness appears in its row and column only, instead of cancelling in those
// of both ends: in k (x_a - x_b)^2 with k = 1e20, softer springs are lost in double precision.

#include <arcslip/hbm/linear/fixed_interface.hpp>

#include <memory>

namespace arcslip::hbm {

struct Coordinates {
  int unknowns = 0;                                    // r >= 1
  Eigen::MatrixXd P;                                   // dofs x dofs
  std::shared_ptr<const FixedInterfaceModes> modes{};  // not null: they are the linear coordinates

  int linear() const { return static_cast<int>(P.cols()) - unknowns; }
};

/// Without elements in the model, the response takes their place. Parts have their default stiffness.
/// frequency: typical, rad/s; 0: linear coordinates are no modes.
Coordinates coordinates(const model::Model& model, double frequency = 0);

}  // namespace arcslip::hbm
