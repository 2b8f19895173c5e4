#include "catch.hpp"

#include <arcslip/continuation/bordered_lu.hpp>

#include <Eigen/Dense>

using namespace arcslip::continuation;

namespace {

Eigen::MatrixXd bordered(const Eigen::MatrixXd& J, const Vector& F_p, const Vector& row) {
  const Eigen::Index n = J.rows();
  Eigen::MatrixXd B(n + 1, n + 1);
  B.topLeftCorner(n, n) = J;
  B.col(n).head(n) = F_p;
  B.row(n) = row.transpose();
  return B;
}

}  // namespace

TEST_CASE("bordered solves and transposed solves leave residuals at rounding level") {
  for (int n : {1, 2, 7, 40, 150}) {
    const Eigen::MatrixXd J = Eigen::MatrixXd::Random(n, n);
    const Vector F_p = Vector::Random(n), row = Vector::Random(n + 1), b = Vector::Random(n + 1);
    const Eigen::MatrixXd B = bordered(J, F_p, row);
    BorderedLU lu(n);
    REQUIRE(lu.factorize(J, F_p, row));
    Vector x = b;
    lu.solve(x);
    CHECK((B * x - b).norm() < 1e-13 * n * B.norm() * x.norm());
    Vector y = b;
    lu.solve_transposed(y);
    CHECK((B.transpose() * y - b).norm() < 1e-13 * n * B.norm() * y.norm());
    CHECK(lu.determinant_sign() == (B.determinant() > 0 ? 1 : -1));
  }
}

TEST_CASE("the bordered system of a singular J is solved to rounding, whatever the scale of its rows") {
  const int n = 12;
  Eigen::MatrixXd J = Eigen::MatrixXd::Random(n, n);
  J.row(3) = J.row(5) + 1e-16 * J.row(7);  // singular to rounding, as at a fold
  const Vector F_p = Vector::Random(n), row = Vector::Random(n + 1), b = Vector::Random(n + 1);
  for (double scale : {1e-12, 1.0, 1e12}) {
    BorderedLU lu(n);
    REQUIRE(lu.factorize(scale * J, scale * F_p, row));
    Vector x = b;
    x.head(n) *= scale;
    const Vector right = x;
    lu.solve(x);
    const Eigen::MatrixXd B = bordered(scale * J, scale * F_p, row);
    CHECK((B * x - right).head(n).norm() < 1e-13 * scale * x.norm() * J.norm());
    CHECK(std::abs((B * x - right)[n]) < 1e-13 * x.norm() * row.norm());
  }
}

TEST_CASE("a singular or non-finite bordered matrix is refused") {
  BorderedLU lu(2);
  const Vector F_p = Vector::Zero(2);
  Vector row(3);
  row << 1, 0, 0;
  CHECK_FALSE(lu.factorize(Eigen::MatrixXd::Zero(2, 2), F_p, row));
  Eigen::MatrixXd J = Eigen::MatrixXd::Identity(2, 2);
  J(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(lu.factorize(J, F_p, row));
}
