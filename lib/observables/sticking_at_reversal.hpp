#pragma once
// Motions that stop: where friction without a stiffness holds its element at a reversal.
//
// At a reversal of q = d . x the friction force goes from one limit to the other, and q'' jumps by 2 p/m,
// 1/m = d^T M^-1 d. The motion goes on if q'' has the same sign before and after, and else stops. The
// truncated series has the middle of both, so that it goes on if m |q''| > p. Of N harmonics q'' differs from
// that by 1/N of the jump.
//
// In a ring whose sectors share masses, 1/m is the mean of D^T M_d^-1 conj(D), D = d + t next, over the waves
// of all harmonics: that of forces on one sector, and on those that move together with it.

#include <arcslip/laws/element.hpp>
#include <arcslip/model/model.hpp>

#include <Eigen/Cholesky>

#include <complex>
#include <vector>

namespace arcslip::observables {

class Stops {
 public:
  explicit Stops(const model::Model& model) : model_(model) {}

  /// Whether the motion of an element stops, at the last place of `at`. p: as of harmonic balance.
  bool at_reversals(const elements::Element& at, std::size_t element, const continuation::Vector& p);

 private:
  // Of the masses: in a linked sector one for each wave, of twice the size.
  struct Mass {
    std::complex<double> turn;
    double share;
    Eigen::MatrixXd M;
    Eigen::LDLT<Eigen::MatrixXd> factors;
  };
  void move_to(const continuation::Vector& p);
  double inertia(const model::Direction& d, const model::Direction& next);

  const model::Model& model_;
  continuation::Vector values_;  // for which these are
  std::vector<Mass> masses_;
};

}  // namespace arcslip::observables
