// Sparse LU against dense LU and against closed forms.
#include "catch.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/sparse_algebra.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace {

using namespace arcslip::continuation;
using Complex = std::complex<double>;
using Sparse = ComplexSparseLU::Matrix;

constexpr double least = 1e-14;

/// A row of n masses, each linked to its neighbours, beyond resonances, with damping.
Sparse damped_chain(int n, Complex diagonal) {
  std::vector<Eigen::Triplet<Complex>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, diagonal);
    if (i + 1 < n) {
      entries.emplace_back(i, i + 1, -1.0);
      entries.emplace_back(i + 1, i, -1.0);
    }
  }
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace

TEST_CASE("sparse complex LU solves as dense LU does, also where the diagonal is zero or small") {
  for (const int n : {1, 2, 40, 300})
    for (const Complex diagonal : {Complex(2, 0.1), Complex(1e-9, 1e-9), Complex(-1.3, 0.01)}) {
      Sparse A = damped_chain(n, diagonal);
      for (int i = 3; i + 20 < n; i += 7) A.coeffRef(i, i + 20) = Complex(0.3, 0.01 * i);
      A.makeCompressed();
      CAPTURE(n, diagonal);
      ComplexSparseLU lu(A);
      for (const double factor : {1.0, 0.25}) {  // other values in the same pattern
        const Sparse other = A * factor;
        const Eigen::MatrixXcd dense(other), B = Eigen::MatrixXcd::Random(n, 3);
        REQUIRE(lu.factorize(other, least));
        Eigen::MatrixXcd X = B;
        lu.solve_in_place(X);
        CHECK((dense * X - B).norm() < 1e-13 * dense.norm() * X.norm());
        const Eigen::MatrixXcd expected = solve_complex(dense, B);
        if (diagonal.real() == 2) CHECK((X - expected).norm() < 1e-10 * expected.norm());
        Eigen::MatrixXcd transposed = B;
        lu.solve_transposed_in_place(transposed);
        CHECK((dense.transpose() * transposed - B).norm() < 1e-13 * dense.norm() * transposed.norm());
      }
    }
}

TEST_CASE("sparse complex LU reports a singular matrix, to the pivot that is asked for") {
  Sparse A = damped_chain(50, 2);
  A.coeffRef(20, 20) = 0;
  A.coeffRef(20, 19) = A.coeffRef(20, 21) = 0;  // a row of zeros, in the pattern
  ComplexSparseLU lu(A);
  CHECK_FALSE(lu.factorize(A, least));
  A.coeffRef(20, 20) = 1e-12;
  CHECK(lu.factorize(A, least));
  CHECK_FALSE(lu.factorize(A, 1e-10));
  A.coeffRef(20, 20) = std::nan("");
  CHECK_FALSE(lu.factorize(A, least));
}

TEST_CASE(
    "sparse complex LU reports a singular matrix whatever the order of its rows, in units of all kinds") {
  std::mt19937 random(1);
  for (const int n : {10, 80, 81, 500, 2000})
    for (const int mode : {1, 2, 3, n / 3, n / 2, n - 1})
      for (const double decades : {0.0, 1.0}) {
        CAPTURE(n, mode, decades);
        std::vector<int> place(static_cast<std::size_t>(n));
        std::iota(place.begin(), place.end(), 0);
        std::shuffle(place.begin(), place.end(), random);
        Eigen::VectorXd unit(n);  // powers of 2: no rounding
        for (int i = 0; i < n; ++i) unit[i] = std::exp2(std::round(decades * std::sin(i) / std::log10(2)));
        const auto matrix = [&](double diagonal) {
          const Sparse A = damped_chain(n, diagonal);
          std::vector<Eigen::Triplet<Complex>> entries;
          for (int j = 0; j < n; ++j)
            for (Sparse::InnerIterator entry(A, j); entry; ++entry)
              entries.emplace_back(place[static_cast<std::size_t>(entry.row())],
                                   place[static_cast<std::size_t>(j)],
                                   unit[entry.row()] * unit[j] * entry.value());
          Sparse B(n, n);
          B.setFromTriplets(entries.begin(), entries.end());
          return B;
        };
        const double zero = 2 * std::cos(std::numbers::pi * mode / (n + 1));  // an eigenvalue of the chain
        ComplexSparseLU lu(matrix(2));
        CHECK_FALSE(lu.factorize(matrix(zero), least));
        CHECK(lu.factorize(matrix(zero + 1e-9), least));
        CHECK(lu.factorize(matrix(zero - 1e-9), least));
      }
}

TEST_CASE("a chain of n masses takes some n multiplications, not n^3") {
  CHECK(ComplexSparseLU(damped_chain(2000, 2)).multiplications() < 20 * 2000.0);
  const int n = 60;
  const Sparse full = Eigen::MatrixXcd::Ones(n, n).sparseView();
  CHECK(ComplexSparseLU(full).multiplications() == Approx(n * n * n / 3.0).epsilon(0.1));
}
