#pragma once
// Coordinates in which only few equations are nonlinear: x = P y, y = (unknowns, linear coordinates).
//
// The first `unknowns` entries of y are displacements along element directions d_e . x (a largest independent
// set of them), the others span what no element sees; those are condensed away harmonic by harmonic.
//
// Where parts are much stiffer than others, as links that are to be rigid, the elongation of each is a
// coordinate of its own, an unknown if it depends on the elements' displacements alone. The small elongation
// then keeps all its digits, and the large stiffness stands in its row and column only, instead of cancelling
// in those of both ends: of k (x_a - x_b)^2 with k = 1e20, nothing of softer springs is left in double
// precision.

#include <arcslip/model/model.hpp>

namespace arcslip::hbm {

struct Coordinates {
  int unknowns = 0;   // r >= 1
  Eigen::MatrixXd P;  // dofs x dofs

  int linear() const { return static_cast<int>(P.cols()) - unknowns; }
};

/// Where the model has no element, the response takes the place of one. The stiffness of parts is their
/// default.
Coordinates coordinates(const model::Model& model);

}  // namespace arcslip::hbm
