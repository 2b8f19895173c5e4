#pragma once
// The map between the unknowns of a problem and those of one element.
//
//   w_b(theta) = sum over shares of block b:  weight u_coordinate(theta + phase)
//
// The phase is for travelling waves: a sector of a ring moves like its neighbour, shifted by a share of the
// period. Every share contributes to the residual and the Jacobian by the transposed map.

#include <arcslip/fourier/series.hpp>

#include <utility>
#include <vector>

namespace arcslip::hbm {

class ElementMap {
 public:
  struct Share {
    int block;       // of the element: a direction, or an auxiliary unknown
    int coordinate;  // of the problem
    double weight;
    double phase = 0;  // rad, at the fundamental
  };

  ElementMap(std::vector<Share> shares, int blocks, const elements::Harmonics& harmonics);

  const std::vector<Share>& shares() const { return shares_; }
  int size() const { return blocks_ * c_; }

  /// w = E u.
  void gather(elements::In u, elements::Out w) const;
  /// R += E^T F.
  void add(elements::In F, elements::Out R) const;
  /// J += E^T J_element E.
  void add(const Eigen::MatrixXd& J_element, Eigen::MatrixXd& J) const;
  /// The same of the cosines and sines of order n > 0 alone: rows and columns 2 i and 2 i + 1 for coordinate
  /// i.
  void add_order(int n, const Eigen::MatrixXd& J_element, Eigen::MatrixXd& J_n) const;

 private:
  // cos and sin of n phase, for each sine.
  using Turn = std::vector<std::pair<double, double>>;
  // sum += factor block, turned by an angle: sense 1 for u, -1 for its transpose.
  void add_turned(double factor, const Turn& by, double sense, elements::In block, elements::Out sum) const;

  elements::Harmonics harmonics_;
  int c_, blocks_;
  std::vector<Share> shares_;
  std::vector<Turn> turns_;  // of the shares; empty where none has a phase
  mutable Eigen::MatrixXd turned_, block_;
};

}  // namespace arcslip::hbm
