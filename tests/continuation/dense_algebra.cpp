// Each decomposition against what defines it, on matrices that are regular, singular, large and empty.
#include "catch.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/finite.hpp>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace {

using namespace arcslip::continuation;
using Eigen::Index;

constexpr double rounding = 1e-13;

Matrix numbers(Index rows, Index columns, double phase = 0) {
  return Matrix::NullaryExpr(rows, columns, [&](Index i, Index j) {
    return std::sin(1.3 * static_cast<double>(i * i) + 2.1 * static_cast<double>(j) +
                    0.7 * static_cast<double>(i * j) + phase);
  });
}

// K of a chain of n masses between two walls: 2 - 2 cos(k pi / (n + 1)).
Matrix chain_stiffness(Index n) {
  Matrix K = 2 * Matrix::Identity(n, n);
  for (Index i = 0; i + 1 < n; ++i) K(i, i + 1) = K(i + 1, i) = -1;
  return K;
}

double chain_eigenvalue(Index n, Index k) {
  return 2 - 2 * std::cos(std::numbers::pi * static_cast<double>(k + 1) / static_cast<double>(n + 1));
}

}  // namespace

TEST_CASE("LU solves with a matrix and its transpose, and knows the determinant") {
  for (const Index n : {1, 2, 7, 40}) {
    const Matrix A = numbers(n, n) + 2 * Matrix::Identity(n, n), B = numbers(n, 3, 0.5);
    LU<double> lu(n);
    lu.factorize(A);
    const Vector b = B.col(0);
    Vector x(n), y(n);
    lu.solve(b, x);
    lu.solve_transposed(b, y);
    Matrix X;
    lu.solve_columns(B, X);
    CHECK((A * x - b).norm() < rounding * static_cast<double>(n) * A.norm() * x.norm());
    CHECK((A.transpose() * y - b).norm() < rounding * static_cast<double>(n) * A.norm() * y.norm());
    CHECK((A * X - B).norm() < rounding * static_cast<double>(n) * A.norm() * X.norm());
    CHECK((solve(A, B) - X).norm() <= rounding * X.norm());
    double product = lu.permutation_sign();
    for (Index i = 0; i < n; ++i) product *= lu.pivot(i);
    CHECK(product == Approx(lu.determinant()).epsilon(1e-12));
  }
  LU<double> swapped(2);
  swapped.factorize((Matrix(2, 2) << 0, 2, 3, 0).finished());
  CHECK(swapped.determinant() == -6);
  CHECK(swapped.permutation_sign() == -1);
}

TEST_CASE("LU of complex matrices") {
  const Eigen::MatrixXcd A = numbers(5, 5) + std::complex<double>(0, 1) * numbers(5, 5, 1);
  const Eigen::MatrixXcd B = numbers(5, 2) + std::complex<double>(0, 1) * numbers(5, 2, 2);
  LU<std::complex<double>> lu(5);
  lu.factorize(A);
  Eigen::MatrixXcd X;
  lu.solve_columns(B, X);
  CHECK((A * X - B).norm() < rounding * A.norm() * X.norm());
  CHECK((A * solve_complex(A, B) - B).norm() < rounding * A.norm() * X.norm());
}

TEST_CASE("a singular matrix is solved where a solution exists") {
  Matrix A = numbers(4, 4);
  A.col(3) = A.col(0) + A.col(1);
  const Vector b = A * Vector::Ones(4);
  CHECK((A * solve_any(A, b) - b).norm() < rounding);
}

TEST_CASE("Cholesky's factors solve, reduce, and refuse what is not positive definite") {
  const Matrix A = chain_stiffness(6), B = numbers(6, 2);
  Cholesky of;
  REQUIRE(of.factorize(A));
  CHECK((A * of.solve(B) - B).norm() < rounding * B.norm());
  CHECK((A * of.solve(B.col(0)) - B.col(0)).norm() < rounding * B.norm());
  const Matrix S = A * A;  // S v = mu A v has the eigenvalues of A
  CHECK((symmetric_eigenvalues(of.reduced(S)) - symmetric_eigenvalues(A)).norm() < rounding * S.norm());
  CHECK_FALSE(of.factorize(A - 3 * Matrix::Identity(6, 6)));
}

TEST_CASE("least squares: the residual is orthogonal to the columns, the shortest solution to the kernel") {
  Matrix A = numbers(6, 3);
  const Matrix B = numbers(6, 2, 0.7);
  const auto full = least_squares(A, B);
  CHECK(full.rank == 3);
  CHECK((A.transpose() * (A * full.X - B)).norm() < rounding * A.squaredNorm() * full.X.norm());
  A.col(2) = A.col(0) - 2 * A.col(1);
  const auto shortest = shortest_least_squares(A, B);
  CHECK(shortest.rank == 2);
  CHECK((A.transpose() * (A * shortest.X - B)).norm() < rounding * A.squaredNorm() * shortest.X.norm());
  CHECK((kernel(A).transpose() * shortest.X).norm() < rounding * shortest.X.norm());
  A(0, 2) += 1e-6;
  CHECK(least_squares(A, B).rank == 3);
  CHECK(least_squares(A, B, 1e-5).rank == 2);
  CHECK(shortest_least_squares(A, B, 1e-5).rank == 2);
}

TEST_CASE("bases of columns, of their complement and of null spaces") {
  const Matrix A = numbers(6, 2);
  const Matrix Q = orthonormal_columns(A), N = orthogonal_complement(A);
  Matrix all(6, 6);
  all << Q, N;
  CHECK((all.transpose() * all - Matrix::Identity(6, 6)).norm() < rounding);
  CHECK((A - Q * (Q.transpose() * A)).norm() < rounding * A.norm());
  Matrix dependent(6, 3);
  dependent << A, A.col(0) + A.col(1);
  CHECK(orthogonal_complement(dependent, 1e-9).cols() == 4);
  CHECK((orthogonal_complement(dependent, 1e-9).transpose() * A).norm() < rounding * A.norm());
  CHECK(kernel(numbers(3, 3)).cols() == 0);

  for (const Index n : {2, 3, 9})
    for (const Index k : {Index(1), Index(2)}) {
      const Matrix S = numbers(n, n - k, 0.2) * numbers(n - k, n, 0.9);
      NullSpaces of;
      of.compute(S, k);
      CHECK((S * of.right()).norm() < rounding * (1 + S.norm()) * of.right().norm());
      CHECK((S.transpose() * of.left()).norm() < rounding * (1 + S.norm()) * of.left().norm());
      CHECK(least_squares(of.right(), of.right()).rank == k);
      CHECK(least_squares(of.left(), of.left()).rank == k);
    }
}

TEST_CASE("eigenvalues and singular values of chains, rotations and one with another") {
  const Index n = 12;
  const Matrix K = chain_stiffness(n);
  const SymmetricModes of_K = symmetric_modes(K);
  const SingularValues svd = singular_values(K);
  for (Index k = 0; k < n; ++k) {
    CHECK(of_K.values[k] == Approx(chain_eigenvalue(n, k)).epsilon(1e-12));
    CHECK(svd.values[n - 1 - k] == Approx(chain_eigenvalue(n, k)).epsilon(1e-12));
  }
  CHECK((K * of_K.V - of_K.V * of_K.values.asDiagonal()).norm() < rounding * n);
  CHECK(((K * svd.V).colwise().norm().transpose() - svd.values).norm() < rounding * n);
  CHECK((symmetric_eigenvalues(K) - of_K.values).norm() < rounding * n);
  CHECK((symmetric_eigenvalues(K, 4 * Matrix::Identity(n, n)) - of_K.values / 4).norm() < rounding * n);

  const Matrix turn = (Matrix(2, 2) << 0.6, -0.8, 0.8, 0.6).finished();
  const Modes of_turn = modes(turn);
  for (Index i = 0; i < 2; ++i) {
    CHECK(of_turn.values[i].real() == Approx(0.6));
    CHECK(std::abs(of_turn.values[i].imag()) == Approx(0.8));
  }
  CHECK((turn * of_turn.V - of_turn.V * of_turn.values.asDiagonal()).norm() < rounding);
  CHECK((eigenvalues(turn) - of_turn.values).norm() < rounding);
}

TEST_CASE("what does not converge is empty") {
  const Matrix nothing = Matrix::Constant(3, 3, std::nan(""));
  CHECK(eigenvalues(nothing).size() == 0);
  CHECK(modes(nothing).values.size() == 0);
}

TEST_CASE("a value that is not finite is found at each place of vectors of each size") {
  constexpr double largest = std::numeric_limits<double>::max(),
                   infinity = std::numeric_limits<double>::infinity();
  for (int n = 0; n <= 19; ++n) {
    CAPTURE(n);
    Eigen::VectorXd x = Eigen::VectorXd::Constant(n, largest);
    CHECK(all_finite(x));
    CHECK(all_finite(-x));
    for (int i = 0; i < n; ++i)
      for (const double value : {infinity, -infinity, std::nan("")}) {
        CAPTURE(i, value);
        x[i] = value;
        CHECK_FALSE(all_finite(x));
        CHECK(all_finite(x.head(i)));
        CHECK(all_finite(x.tail(n - 1 - i)));
        x[i] = largest;
      }
  }
}
