#include <arcslip/hbm/linear/reduced_direction.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::hbm {
namespace {

constexpr double rounding = 1e-13;  // of a direction, relative to its largest entry

}  // namespace

DirectionInY::DirectionInY(const Eigen::MatrixXd& P, const model::Direction& in_x,
                           const model::Direction& next) {
  const auto in_y = [&P](const model::Direction& of) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(P.cols());
    for (model::Direction::InnerIterator x(of); x; ++x) d += x.value() * P.row(x.index()).transpose();
    return d;
  };
  const auto fill = [](const Eigen::VectorXd& d, double least, Entries& entries) {
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (d[i] != 0 && std::abs(d[i]) >= least) entries.emplace_back(i, d[i]);
  };
  const Eigen::VectorXd d = in_y(in_x);
  double largest = d.cwiseAbs().maxCoeff();
  if (next.size() > 0) {
    const Eigen::VectorXd e = in_y(next);
    largest = std::max(largest, e.cwiseAbs().maxCoeff());
    fill(e, rounding * largest, next_);
  }
  fill(d, rounding * largest, entries_);
}

DirectionInY::DirectionInY(const Eigen::MatrixXd& P, const Eigen::VectorXd& in_x) {
  const Eigen::VectorXd d = P.transpose() * in_x;
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (d[i] != 0) entries_.emplace_back(i, d[i]);
}

}  // namespace arcslip::hbm
