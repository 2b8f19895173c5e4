#include <arcslip/hbm/coordinates.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

namespace arcslip::hbm {
namespace {

constexpr double independent = 1e-10;  // of unit directions, after taking out those before

}  // namespace

Coordinates coordinates(const model::Model& model) {
  std::vector<Eigen::VectorXd> directions;
  for (const auto& element : model.elements) directions.push_back(element.direction);
  if (directions.empty()) directions.push_back(model.response);

  // An independent set, in the order of the scene.
  Eigen::MatrixXd B(model.dofs, 0), orthonormal(model.dofs, 0);
  for (const Eigen::VectorXd& d : directions) {
    Eigen::VectorXd rest = d.normalized();
    for (int pass = 0; pass < 2; ++pass) rest -= orthonormal * (orthonormal.transpose() * rest);
    if (rest.norm() < independent) continue;
    const Eigen::Index r = B.cols();
    B.conservativeResize(Eigen::NoChange, r + 1);
    orthonormal.conservativeResize(Eigen::NoChange, r + 1);
    B.col(r) = d;
    orthonormal.col(r) = rest.normalized();
  }

  Coordinates c;
  c.unknowns = static_cast<int>(B.cols());
  c.P.resize(model.dofs, model.dofs);
  // B^T x = unknowns: x = B (B^T B)^-1 unknowns + (null space of B^T) * linear coordinates.
  c.P.leftCols(c.unknowns) = B * (B.transpose() * B).inverse();
  if (c.linear() > 0) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(B);
    const Eigen::MatrixXd Q = qr.householderQ();
    c.P.rightCols(c.linear()) = Q.rightCols(c.linear());
  }
  return c;
}

}  // namespace arcslip::hbm
