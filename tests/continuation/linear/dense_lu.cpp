#include "catch.hpp"

#include "continuation/linear/bordered.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <Eigen/Dense>

#include <cmath>

using namespace bordered;

TEST_CASE("bordered solves and transposed solves leave residuals at rounding level") {
  for (int n : {1, 2, 3, 4, 5, 6, 7, 40, 94, 96, 97, 98, 99, 100, 150})
    for (int m : {0, 1, 2, 3}) {
      const Matrix J = Matrix::Random(n, n);
      const Borders borders = random_borders(n, m);
      const Matrix B = whole(J, borders);
      const Vector b = Vector::Random(n + m);
      const auto lu = dense_lu();
      REQUIRE(lu->factorize(J, borders));
      Vector x = b;
      lu->solve(x);
      CHECK((B * x - b).norm() < 1e-13 * n * B.norm() * x.norm());
      Vector y = b;
      REQUIRE(lu->solve_transposed(y));
      CHECK((B.transpose() * y - b).norm() < 1e-13 * n * B.norm() * y.norm());
      CHECK(lu->determinant_sign() == (B.determinant() > 0 ? 1 : -1));
    }
}

TEST_CASE("a matrix of rows that follow each other in a circle is solved without a rounding error") {
  for (int n : {1, 2, 3, 4, 5, 9, 50, 96, 97, 120}) {
    Matrix J = Matrix::Zero(n, n);
    for (int i = 0; i < n; ++i) J(i, (i + 1) % n) = 2;
    const auto lu = dense_lu();
    REQUIRE(lu->factorize(J, Borders(n, 0)));
    const Vector b = Vector::Random(n);
    Vector x = b, y = b;
    lu->solve(x);
    REQUIRE(lu->solve_transposed(y));
    for (int i = 0; i < n; ++i) {
      CHECK(x[(i + 1) % n] == b[i] / 2);
      CHECK(y[i] == b[(i + 1) % n] / 2);
    }
    CHECK(lu->determinant_sign() == (n % 2 == 1 ? 1 : -1));
  }
}

TEST_CASE("the bordered system of a singular J is solved to rounding, whatever the scale of its rows") {
  const int n = 12;
  Matrix J = Matrix::Random(n, n);
  J.row(3) = J.row(5) + 1e-16 * J.row(7);  // singular to rounding, as at a fold
  const Borders unscaled = random_borders(n, 1);
  const Vector b = Vector::Random(n + 1);
  for (double scale : {1e-12, 1.0, 1e12}) {
    Borders borders = unscaled;
    borders.columns *= scale;
    const auto lu = dense_lu();
    REQUIRE(lu->factorize(Matrix(scale * J), borders));
    Vector x = b;
    x.head(n) *= scale;
    const Vector right = x;
    lu->solve(x);
    const Matrix B = whole(scale * J, borders);
    CHECK((B * x - right).head(n).norm() < 1e-13 * scale * x.norm() * J.norm());
    CHECK(std::abs((B * x - right)[n]) < 1e-13 * x.norm() * borders.rows.norm());
  }
}

TEST_CASE("a singular or non-finite bordered matrix is refused") {
  const auto lu = dense_lu();
  Borders borders(2, 1);
  borders.columns.setZero();
  borders.rows << 1, 0;
  borders.corner.setZero();
  CHECK_FALSE(lu->factorize(Matrix(Matrix::Zero(2, 2)), borders));
  Matrix J = Matrix::Identity(2, 2);
  J(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(lu->factorize(J, borders));
}

TEST_CASE("a single entry of J that vanishes next to its columns leaves the bordered system accurate") {
  for (double tiny : {1e-8, 1e-20, -1e-61}) {
    Borders borders(1, 2);
    borders.columns << 2e-31, 1;
    borders.rows << -0.38992585549959879, 0.92084625601286241;
    borders.corner << 0.92084625601286241, 0, 0.38992585549959885, 0;
    const auto lu = dense_lu();
    REQUIRE(lu->factorize(Matrix(Matrix::Constant(1, 1, tiny)), borders));
    Vector x = Vector{{0.0, 1.0, 0.0}};
    lu->solve(x);
    // The border's rows are orthonormal: x is the first of them, and the last entry makes the sum zero.
    CHECK(std::abs(x[0] - borders.rows(0, 0)) < 1e-15);
    CHECK(std::abs(x[1] - borders.corner(0, 0)) < 1e-15);
    CHECK(std::abs(x[2] + tiny * x[0] + 2e-31 * x[1]) < 1e-15 * std::abs(x[2]));
  }
}

TEST_CASE(
    "a parameter that moves nothing leaves the unknowns at rest, however small their part of the border") {
  const int n = 12;
  const Matrix J = 4 * Matrix::Identity(n, n) + Matrix::Random(n, n);
  for (double part : {0.0, 1e-17, 1e-8, 1.0}) {
    Borders borders(n, 1);
    borders.columns.setZero();
    borders.rows = part * Matrix::Random(n, 1);
    borders.corner << 5.0;
    const auto lu = dense_lu();
    REQUIRE(lu->factorize(J, borders));
    Vector x = Vector::Unit(n + 1, n);
    lu->solve(x);
    CHECK(x.head(n).norm() < 1e-14 * x[n]);
    CHECK(std::abs(x[n] - 0.2) < 1e-16);
  }
}
