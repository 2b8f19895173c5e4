#include <arcslip/hbm/element_gather.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::hbm {

using elements::In, elements::Out;

ElementMap::ElementMap(std::vector<Share> shares, int blocks, const elements::Harmonics& harmonics)
    : harmonics_(harmonics), c_(harmonics.size()), blocks_(blocks), shares_(std::move(shares)) {
  if (std::all_of(shares_.begin(), shares_.end(), [](const Share& s) { return s.phase == 0; })) return;
  turned_.resize(c_, c_);
  block_.resize(c_, c_);
  for (const Share& share : shares_) {
    Turn& turn = turns_.emplace_back();
    for (int j = 0; j < harmonics_.sines(); ++j) {
      const double angle = harmonics_.sine_order(j) * share.phase;
      turn.emplace_back(std::cos(angle), std::sin(angle));
    }
  }
}

// x(theta + angle): a_n cos n angle + b_n sin n angle, b_n cos n angle - a_n sin n angle.
void ElementMap::add_turned(double factor, const Turn& by, double sense, In block, Out sum) const {
  if (!harmonics_.odd) sum[0] += factor * block[0];
  for (int j = 0; j < harmonics_.sines(); ++j) {
    const int n = harmonics_.sine_order(j);
    const int a = harmonics_.cosine_index(n), b = harmonics_.sine_index(n);
    const auto& [cosine, sine] = by[static_cast<std::size_t>(j)];
    const double c = factor * cosine, s = factor * sense * sine;
    sum[a] += c * block[a] + s * block[b];
    sum[b] += c * block[b] - s * block[a];
  }
}

void ElementMap::gather(In u, Out w) const {
  w.setZero();
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    const Share& share = shares_[k];
    const auto from = u.segment(share.coordinate * c_, c_);
    auto to = w.segment(share.block * c_, c_);
    if (share.phase == 0)
      to += share.weight * from;
    else
      add_turned(share.weight, turns_[k], 1, from, to);
  }
}

void ElementMap::add(In F, Out R) const {
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    const Share& share = shares_[k];
    const auto from = F.segment(share.block * c_, c_);
    auto to = R.segment(share.coordinate * c_, c_);
    if (share.phase == 0)
      to += share.weight * from;
    else
      add_turned(share.weight, turns_[k], -1, from, to);
  }
}

void ElementMap::add(const Eigen::MatrixXd& J_element, Eigen::MatrixXd& J) const {
  for (std::size_t m = 0; m < shares_.size(); ++m)
    for (std::size_t l = 0; l < shares_.size(); ++l) {
      const Share &i = shares_[l], &j = shares_[m];
      auto to = J.block(i.coordinate * c_, j.coordinate * c_, c_, c_);
      const auto from = J_element.block(i.block * c_, j.block * c_, c_, c_);
      if (i.phase == 0 && j.phase == 0) {
        to += (i.weight * j.weight) * from;
        continue;
      }
      // T_i^T B T_j, columns first: the transpose of a turn is the turn back.
      turned_.setZero();
      for (int k = 0; k < c_; ++k) add_turned(i.weight, turns_[l], -1, from.col(k), turned_.col(k));
      block_ = turned_.transpose();
      turned_.setZero();
      for (int k = 0; k < c_; ++k) add_turned(j.weight, turns_[m], -1, block_.col(k), turned_.col(k));
      to += turned_.transpose();
    }
}

void ElementMap::add_order(int n, const Eigen::MatrixXd& J_element, Eigen::MatrixXd& J_n) const {
  const int a = harmonics_.cosine_index(n), b = harmonics_.sine_index(n);
  const auto turn = [n](double angle) {
    const double c = std::cos(n * angle), s = std::sin(n * angle);
    return Eigen::Matrix2d{{c, s}, {-s, c}};
  };
  for (const Share& j : shares_)
    for (const Share& i : shares_) {
      const int row = i.block * c_, column = j.block * c_;
      Eigen::Matrix2d from;
      from << J_element(row + a, column + a), J_element(row + a, column + b),  //
          J_element(row + b, column + a), J_element(row + b, column + b);
      if (i.phase != 0) from = turn(i.phase).transpose() * from;
      if (j.phase != 0) from = from * turn(j.phase);
      J_n.block<2, 2>(2 * i.coordinate, 2 * j.coordinate) += (i.weight * j.weight) * from;
    }
}

}  // namespace arcslip::hbm
