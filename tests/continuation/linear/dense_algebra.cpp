// Each decomposition against what defines it, on matrices that are regular, singular, large and empty.
#include "catch.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/finite.hpp>

#include <Eigen/LU>

#include <algorithm>
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

Matrix regular(Index n) {
  Matrix A = numbers(n, n);
  for (Index i = 0; i < n; ++i) A(i, (7 * i + 3) % n) += 30;
  return A;
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

TEST_CASE("LU of 99 unknowns is Eigen's to the bit, and from 100 on sign and condition are Eigen's") {
  for (Index n : {99, 100, 137, 240})
    for (double decades : {0.0, 12.0}) {  // of the factors of rows and columns
      Matrix A = regular(n);
      for (Index i = 0; i < n; ++i) {
        A.row(i) *= std::pow(10, decades * std::sin(3.1 * static_cast<double>(i)));
        A.col(i) *= std::pow(10, decades * std::cos(1.7 * static_cast<double>(i)));
      }
      const Eigen::PartialPivLU<Matrix> eigen(A);
      LU<double> lu(n);
      lu.factorize(A);
      if (n == 99) CHECK(lu.factors() == eigen.matrixLU());
      const Matrix L = lu.factors().triangularView<Eigen::UnitLower>();
      const Matrix U = lu.factors().triangularView<Eigen::Upper>();
      const double n_eps = static_cast<double>(n) * 2.3e-16;
      const Matrix bound = n_eps * L.cwiseAbs() * U.cwiseAbs(), product = L * U;
      double excess = -1;
      for (Index i = 0; i < n; ++i)
        excess = std::max(
            excess, ((product.row(lu.row_places()[i]) - A.row(i)).cwiseAbs() - bound.row(lu.row_places()[i]))
                        .maxCoeff());
      CHECK(excess <= 0);
      CHECK(L.cwiseAbs().maxCoeff() <= 1);

      int negative = 0, of_eigen = 0;
      for (Index i = 0; i < n; ++i) {
        negative += lu.pivot(i) < 0;
        of_eigen += eigen.matrixLU()(i, i) < 0;
      }
      CHECK(lu.permutation_sign() * (negative % 2 ? -1 : 1) ==
            static_cast<double>(eigen.permutationP().determinant()) * (of_eigen % 2 ? -1 : 1));
      const double condition = lu.reciprocal_condition(), wanted = eigen.rcond();
      CHECK(std::abs(condition - wanted) <= (decades > 0 ? 0.5 : 1e-9) * wanted);

      // Backward errors, by rows of |A| |x| (Higham, Accuracy and Stability, theorem 9.4).
      const Vector b = A * numbers(n, 1);
      Vector x(n), y(n);
      lu.solve(b, x);
      lu.solve_transposed(b, y);
      Matrix X;
      lu.solve_columns(A * numbers(n, 3), X);
      Vector by_rows(n);
      for (Index i = 0; i < n; ++i) by_rows[lu.row_places()[i]] = (A.row(i) * x - b.row(i)).cwiseAbs()[0];
      CHECK((by_rows - 3 * bound * x.cwiseAbs()).maxCoeff() <= 0);
      Vector y_in_order(n);
      for (Index i = 0; i < n; ++i) y_in_order[lu.row_places()[i]] = std::abs(y[i]);
      const Vector allowed = 3 * bound.transpose() * y_in_order;
      CHECK(((A.transpose() * y - b).cwiseAbs() - allowed).maxCoeff() <= 0);
      if (decades == 0) CHECK((X - numbers(n, 3)).norm() < 1e-9);
    }
}

TEST_CASE("LU of 100 unknowns and more knows singular and non-finite matrices by their pivots") {
  const Index n = 128;
  LU<double> lu(n);
  Matrix A = numbers(n, n);
  A.col(77).setZero();
  lu.factorize(A);
  CHECK(lu.pivot(77) == 0);
  CHECK_FALSE(lu.reciprocal_condition() > 0);
  A = numbers(n, n);
  A(0, n - 1) = std::numeric_limits<double>::quiet_NaN();
  lu.factorize(A);
  CHECK(std::isnan(lu.pivot(n - 1)));
  // Below the smallest normal number, too: 1 / pivot is not finite.
  A = Matrix::Zero(n, n);
  for (Index i = 0; i < n; ++i) A(i, (i + 1) % n) = 1e-310;
  A(5, 9) = 5e-311;
  lu.factorize(A);
  CHECK(lu.factors().cwiseAbs().maxCoeff() <= 1);
  CHECK(lu.pivot(n - 1) != 0);
  CHECK(lu.permutation_sign() == -1);
}

TEST_CASE("LU of 100 complex unknowns and more solves with the matrix and its transpose, not its adjoint") {
  const Index n = 110;
  Eigen::MatrixXcd A(n, n);
  A.real() = regular(n);
  A.imag() = numbers(n, n, 1);
  Eigen::VectorXcd b = A.col(3) * std::complex(0.5, 2.0), x(n), y(n);
  LU<std::complex<double>> lu(n);
  lu.factorize(A);
  lu.solve(b, x);
  lu.solve_transposed(b, y);
  CHECK((A * x - b).norm() < rounding * A.norm() * x.norm());
  CHECK((A.transpose() * y - b).norm() < rounding * A.norm() * y.norm());
  Eigen::MatrixXcd X;
  lu.solve_columns(A, X);
  CHECK((X - Eigen::MatrixXcd::Identity(n, n)).norm() < 1e-9);
  const double wanted = Eigen::PartialPivLU<Eigen::MatrixXcd>(A).rcond();
  CHECK(std::abs(lu.reciprocal_condition() - wanted) <= 1e-9 * wanted);
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

TEST_CASE("the solution of a Lyapunov equation is that of its Kronecker system") {
  std::srand(3);
  for (const int n : {1, 2, 5, 12}) {
    const Matrix T = Matrix::Random(n, n) - 1.5 * std::sqrt(n) * Matrix::Identity(n, n),
                 C = Matrix::Random(n, 2);
    const Matrix Y = lyapunov_solution(T, C);
    // (1 x T + T x 1) vec Y = -vec C C^T
    Matrix K = Matrix::Zero(n * n, n * n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        K.block(i * n, j * n, n, n) += T(i, j) * Matrix::Identity(n, n);
        if (i == j) K.block(i * n, i * n, n, n) += T;
      }
    const Matrix CC = C * C.transpose();
    const Matrix y = solve(K, -CC.reshaped());
    CHECK((Y.reshaped() - y.col(0)).norm() < 1e-12 * y.norm());
    CHECK((T * Y + Y * T.transpose() + CC).norm() < 1e-12 * CC.norm());
  }
}
