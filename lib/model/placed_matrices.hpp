#pragma once
// The matrices of a scene in the degrees of freedom of its model: its rows with names, of a reduced structure
// those that the scene uses; then what describes the others, rows or coordinates; then the degrees of freedom
// next to the matrices. Of several copies the rows of all stand first, then the coordinates of all.

#include <arcslip/control/run_control.hpp>
#include <arcslip/model/model.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::model {

enum class MatrixForm { symmetric, skew, general };

/// A shape of an excitation, its real or its imaginary part.
struct PlacedShape {
  std::size_t excitation;
  bool imaginary;
  Eigen::VectorXd load;    // a force, or M r
  Eigen::VectorXd ground;  // r of what the model sees; empty of a force
};

struct PlacedMatrices {
  std::vector<std::string> dof_names;
  int unnamed_from = 0, unnamed_to = 0;
  std::vector<int> dof_of;            // of the degrees of freedom of the scene; -1: not in the model
  std::vector<MatrixPart> parts;      // without parameters yet
  std::vector<std::size_t> by_speed;  // those of them that follow the speed
  std::vector<PlacedShape> shapes;
  std::optional<Reduction> reduction;  // none: the matrices are whole
};

/// One copy is reduced for the rows that the scene uses of any, once for each factor of the stiffness. Throws
/// structure::ReductionError, also where the copies together are too many, and control::Interrupted.
PlacedMatrices place_matrices(const scene::Scene& scene, const control::Control& control);

}  // namespace arcslip::model
