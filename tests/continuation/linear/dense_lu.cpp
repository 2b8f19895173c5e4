#include "catch.hpp"

#include "continuation/linear/bordered.hpp"

#include <arcslip/continuation/linear/group_elimination.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <Eigen/Dense>

#include <atomic>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

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

TEST_CASE("systems of 144 unknowns that sixteen threads solve at the same time have the bits of one alone") {
  const Matrix J = Matrix::Random(144, 144);
  const Vector b = Vector::Random(144);
  const auto solved = [&] {
    const auto lu = dense_lu();
    Vector x = b;
    if (lu->factorize(J, random_borders(144, 0))) lu->solve(x);
    return x;
  };
  const Vector alone = solved();
  CHECK((J * alone - b).norm() < 1e-11 * alone.norm());
  std::atomic<int> others = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 16; ++t)
    threads.emplace_back([&] {
      for (int k = 0; k < 400; ++k) others += solved() != alone;
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(others == 0);
}

namespace {

// Unknown i is of group i % groups. Of ten equations some couple groups, at random, the others do not.
Matrix coupled_in_groups(int n, int groups, int coupling_of_ten) {
  Matrix J = Matrix::Random(n, n);
  J.diagonal().array() += 4;
  for (int i = 0; i < n; ++i)
    if (i * 7 % 10 >= coupling_of_ten)
      for (int j = 0; j < n; ++j)
        if (j % groups != i % groups) J(i, j) = 0;
  return J;
}

std::vector<int> groups_of(int n, int groups) {
  std::vector<int> of(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) of[static_cast<std::size_t>(i)] = i % groups;
  return of;
}

}  // namespace

TEST_CASE("with groups, bordered and transposed solves leave residuals at rounding level as without") {
  for (int n : {12, 100, 150, 231})
    for (int m : {0, 1, 2})
      for (int groups : {1, 2, 4, 7})
        for (int coupling : {0, 1, 4, 9, 10}) {
          const Matrix J = coupled_in_groups(n, groups, coupling);
          const Borders borders = random_borders(n, m);
          const Matrix B = whole(J, borders);
          const Vector b = Vector::Random(n + m);
          const auto lu = dense_lu_by_groups(groups_of(n, groups)), plain = dense_lu();
          REQUIRE(lu->factorize(J, borders));
          REQUIRE(plain->factorize(J, borders));
          Vector x = b;
          lu->solve(x);
          CHECK((B * x - b).norm() < 1e-13 * B.norm() * x.norm());
          Vector y = b;
          REQUIRE(lu->solve_transposed(y));
          CHECK((B.transpose() * y - b).norm() < 1e-13 * B.norm() * y.norm());
          CHECK(lu->determinant_sign() == plain->determinant_sign());
        }
}

TEST_CASE("what stays within its group is eliminated from 100 unknowns on, if it is an eighth of them") {
  const auto left = [](int n, int groups, int coupling) {
    GroupElimination elimination(groups_of(n, groups));
    const bool any = elimination.eliminate(coupled_in_groups(n, groups, coupling), random_borders(n, 1));
    return any ? elimination.kept() : Eigen::Index(n);
  };
  CHECK(left(150, 3, 0) == 0);
  CHECK(left(150, 3, 4) == 60);
  CHECK(left(150, 3, 9) == 150);
  CHECK(left(150, 1, 4) == 150);
  CHECK(left(90, 3, 4) == 90);
}

TEST_CASE("one solver follows equations that begin and cease to couple groups") {
  const int n = 140, groups = 5;
  const auto lu = dense_lu_by_groups(groups_of(n, groups));
  for (int coupling : {3, 10, 0, 7, 3, 1}) {
    const Matrix J = coupled_in_groups(n, groups, coupling);
    const Borders borders = random_borders(n, 1);
    const Vector b = Vector::Random(n + 1);
    REQUIRE(lu->factorize(J, borders));
    Vector x = b;
    lu->solve(x);
    CHECK((whole(J, borders) * x - b).norm() < 1e-13 * whole(J, borders).norm() * x.norm());
  }
}

TEST_CASE("where the equations of a group are singular by themselves, the others take part") {
  const int n = 120, groups = 3;
  for (const auto& [e, apart] : {std::pair(0.0, 0.0), {1e-14, 0.0}, {0.5, 0.0}, {0.5, 1e-12}, {0.5, 1e-6}}) {
    Matrix J = coupled_in_groups(n, groups, 3);
    // Rows 9 and 12 stay within group 0, and depend on each other but for unknown 30, which couples groups.
    J.row(9).setZero();
    J.row(12).setZero();
    J(9, 9) = e;
    J(9, 12) = 1;
    J(12, 9) = e * e;
    J(12, 12) = e + apart;
    J(12, 30) = 1;
    const Borders borders = random_borders(n, 1);
    const Matrix B = whole(J, borders);
    const Vector b = Vector::Random(n + 1);
    const auto lu = dense_lu_by_groups(groups_of(n, groups));
    REQUIRE(lu->factorize(J, borders));
    Vector x = b;
    lu->solve(x);
    CHECK((B * x - b).norm() < 1e-13 * B.norm() * x.norm());
    const auto plain = dense_lu();
    REQUIRE(plain->factorize(J, borders));
    CHECK(lu->determinant_sign() == plain->determinant_sign());
  }
}

TEST_CASE("a Jacobian that has not as many unknowns as are in groups is refused") {
  const auto lu = dense_lu_by_groups(groups_of(10, 2));
  CHECK_THROWS_WITH(lu->factorize(Matrix(Matrix::Identity(9, 9)), Borders(9, 1)),
                    "the Jacobian has 9 unknowns, and 10 are in groups");
  CHECK_THROWS_WITH(dense_lu_by_groups({0, -1}), "the groups of unknowns are numbers from 0 on");
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
