#pragma once
// The mechanical energy of a periodic motion about a static displacement x_s, J: kinetic energy and that of
// springs and elements,
//
//   E = x'.M x'/2 + d.K d/2 + sum_e V_e(x_s + d) - V_e(x_s) - f_e(x_s).d,   d = x - x_s
//
// with the elastic energy V_e and the force f_e of each element: what lies above the minimum at x_s of the
// potential of springs, elements and static loads. In conservative motions it does not change; else it is
// that at the instant of the largest kinetic energy.

#include <arcslip/hbm/problem.hpp>

namespace arcslip::observables {

class MechanicalEnergy {
 public:
  /// rest: the unknowns of the static displacement. p: parameters at which they hold.
  MechanicalEnergy(std::shared_ptr<const hbm::HbmProblem> problem, const continuation::Vector& rest,
                   const continuation::Vector& p);

  /// u: unknowns, where `at` is.
  double of(const hbm::HbmEvaluator& at, continuation::In u);
  /// At an angle (rad) of the motion there.
  double at_angle(const hbm::HbmEvaluator& at, continuation::In u, double theta);

 private:
  void move_to(const hbm::HbmEvaluator& at, continuation::In u);
  double kinetic(double theta);
  double potential(const hbm::HbmEvaluator& at, double theta);

  // An element: its fields, and its displacements, force and elastic energy at rest.
  struct Element {
    std::vector<double> fields;
    continuation::Vector q, f;
    double stored = 0;
  };

  std::shared_ptr<const hbm::HbmProblem> problem_;
  continuation::Vector rest_;
  Eigen::MatrixXd M_, K_;
  Eigen::MatrixXd basis_;  // a column for each instant
  Eigen::MatrixXd x_, velocity_, acceleration_;
  continuation::Vector phi_, now_;
  std::vector<Element> elements_;
};

}  // namespace arcslip::observables
