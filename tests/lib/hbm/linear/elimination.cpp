#include "catch.hpp"

#include <arcslip/continuation/linear/cpu_dispatch.hpp>
#include <arcslip/hbm/linear/elimination.hpp>

#include <Eigen/LU>

using namespace arcslip;
using hbm::Complex;
using hbm::ComplexMatrix;
using hbm::ComplexVector;

namespace {

// Symmetric, without a diagonal: no elimination without row pivots.
Eigen::MatrixXd without_diagonal(int n) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n);
  Eigen::MatrixXd sum = A + A.transpose();
  sum.diagonal().setZero();
  return sum;
}

}  // namespace

TEST_CASE("elimination of the linear coordinates is that of a factorization, with pivots, for any size") {
  std::srand(1);
  for (const int r : {0, 1, 3, 20})
    for (const int l : {1, 2, 5, 9, 17, 64, 131})
      for (const int more : {0, 1, 2}) {
        CAPTURE(r, l, more);
        const int n = r + l;
        hbm::StructuralMatrices of{without_diagonal(n), without_diagonal(n), without_diagonal(n)};
        if (l == 1) of.M(r, r) = 1;
        const hbm::Factors g{Complex(-4, 0.3), Complex(0, 2), Complex(1, 0.1)};
        const ComplexVector f = ComplexVector::Random(n);
        const Eigen::MatrixXd c = Eigen::MatrixXd::Random(l, more);
        ComplexMatrix full(n, n);
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) full(i, j) = of.at(g, i, j);
        ComplexMatrix right(l, r + 1 + more);
        right << full.bottomLeftCorner(l, r), f.tail(l), c.cast<Complex>();
        const ComplexMatrix expected = full.bottomRightCorner(l, l).fullPivLu().solve(right);
        hbm::Elimination elimination(r, l, more);
        ComplexMatrix Z;
        ComplexVector condensed;
        hbm::SplitMatrix split;
        for (int again = 0; again < 2; ++again) {
          elimination.set(of, g, f, c);
          REQUIRE(elimination.run(1e-14));
          elimination.condensed(Z, condensed, split);
          const ComplexMatrix W = split.re + Complex(0, 1) * split.im;
          REQUIRE(W.cols() == expected.cols());
          CHECK((W - expected).norm() < 1e-11 * expected.norm());
          const ComplexMatrix left = full.topRightCorner(r, l);
          if (r == 0) continue;
          const ComplexMatrix of_q = full.topLeftCorner(r, r) - left * expected.leftCols(r);
          CHECK((Z - of_q).norm() < 1e-11 * of_q.norm());
          CHECK((Z - Z.transpose()).norm() == 0);
          CHECK((condensed - (f.head(r) - left * expected.col(r))).norm() < 1e-11 * condensed.norm());
        }
      }
}

TEST_CASE("elimination finds a singular block of the linear coordinates") {
  std::srand(1);
  for (const int l : {1, 2, 9, 40}) {
    CAPTURE(l);
    const int r = 3, n = r + l;
    hbm::StructuralMatrices of{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n),
                               without_diagonal(n) + 5 * Eigen::MatrixXd::Identity(n, n)};
    of.K.row(n - 1).tail(l) = of.K.row(r).tail(l);
    if (l == 1) of.K(r, r) = 0;
    hbm::Elimination elimination(r, l, 1);
    elimination.set(of, {-1, Complex(0, 1), 1}, ComplexVector::Ones(n), Eigen::MatrixXd::Ones(l, 1));
    CHECK_FALSE(elimination.run(1e-14));
    of.K.bottomRightCorner(l, l).diagonal().array() += 100;
    elimination.set(of, {-1, Complex(0, 1), 1}, ComplexVector::Ones(n), Eigen::MatrixXd::Ones(l, 1));
    CHECK(elimination.run(1e-14));
  }
}

TEST_CASE("loops have the same digits whichever instructions they are compiled for") {
  std::srand(1);
  const Eigen::Index n = 1003;
  const Eigen::VectorXd a = Eigen::VectorXd::Random(n), b = Eigen::VectorXd::Random(n);
  Eigen::VectorXd wide = a, plain = a;
  const auto loops = [&](double* x) __attribute__((always_inline)) {
    for (Eigen::Index i = 0; i < n; ++i) x[i] = x[i] / b[i] - 0.3 * b[i] + 0.7 * x[i] * b[i];
  };
  continuation::widest([&]() __attribute__((always_inline)) { loops(wide.data()); });
  loops(plain.data());
  CHECK(wide == plain);
}
