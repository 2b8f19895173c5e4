#pragma once
// The mechanical energy of a periodic motion, J: kinetic energy and that of the linear springs, from the
// static displacement x_s, at the instant of the largest kinetic energy,
//
//   E = x'.M x'/2 + (x - x_s).K (x - x_s)/2
//
// Where all nonlinear springs pass their rest at that instant, as in conservative motions in unison, this is
// the total energy, which does not change. Elements hold none in it.

#include <arcslip/hbm/problem.hpp>

namespace arcslip::observables {

class MechanicalEnergy {
 public:
  explicit MechanicalEnergy(std::shared_ptr<const hbm::HbmProblem> problem);

  /// u: unknowns, where `at` is. rest: those of the static displacement.
  double of(const hbm::HbmEvaluator& at, continuation::In u, continuation::In rest);

 private:
  std::shared_ptr<const hbm::HbmProblem> problem_;
  Eigen::MatrixXd M_, K_;
  Eigen::MatrixXd basis_;  // a column for each instant
};

}  // namespace arcslip::observables
