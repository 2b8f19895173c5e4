#pragma once
// Matrices of a structure in the coordinates y, x = P y (coordinates.hpp).

#include <arcslip/hbm/linear/reduced_direction.hpp>
#include <arcslip/model/model.hpp>

#include <vector>

namespace arcslip::hbm {

/// P^T A P without zeros: one matrix; of a sector whose matrices reach into the next one, a matrix for the
/// wave of each of these nodal diameters, with entries in the same places.
std::vector<ComplexSparse> in_waves(const model::MatrixPart& part, const Eigen::MatrixXd& P,
                                    const std::vector<int>& diameters);

}  // namespace arcslip::hbm
