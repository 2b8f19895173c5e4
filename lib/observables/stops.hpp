#pragma once
// Motions that stop: where friction without a stiffness holds its element at a reversal.
//
// At a reversal of q = d . x the friction force goes from one limit to the other, and q'' jumps by 2 p/m,
// 1/m = d^T M^-1 d. The motion goes on if q'' has the same sign before and after, and else stops. The
// truncated series has the middle of both, so that it goes on if m |q''| > p. Of N harmonics q'' differs from
// that by 1/N of the jump.

#include <arcslip/elements/element.hpp>
#include <arcslip/model/model.hpp>

#include <Eigen/Cholesky>

namespace arcslip::observables {

class Stops {
 public:
  explicit Stops(const model::Model& model) : model_(model) {}

  /// Whether the motion of an element stops, at the last place of `at`. p: as of harmonic balance.
  bool at_reversals(const elements::Element& at, std::size_t element, const continuation::Vector& p);

 private:
  double inertia(const model::Direction& d, const continuation::Vector& p);

  const model::Model& model_;
  continuation::Vector masses_;  // of the matrix
  Eigen::MatrixXd M_;
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

}  // namespace arcslip::observables
