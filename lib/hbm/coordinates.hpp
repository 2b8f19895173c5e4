#pragma once
// Coordinates in which only few equations are nonlinear: x = P y, y = (unknowns, linear coordinates).
//
// The first `unknowns` entries of y are displacements along element directions d_e . x (a largest independent
// set of them), the others span what no element sees; those are condensed away harmonic by harmonic.

#include <arcslip/model/model.hpp>

namespace arcslip::hbm {

struct Coordinates {
  int unknowns = 0;   // r >= 1
  Eigen::MatrixXd P;  // dofs x dofs

  int linear() const { return static_cast<int>(P.cols()) - unknowns; }
};

/// Where the model has no element, the response takes the place of one.
Coordinates coordinates(const model::Model& model);

}  // namespace arcslip::hbm
