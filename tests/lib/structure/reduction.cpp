// Reduced structures beside the whole ones, and beside natural frequencies in closed form.
#include "catch.hpp"

#include "lib/structure/matrices.hpp"

#include <arcslip/structure/reduction.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

using namespace arcslip;
using Complex = std::complex<double>;

namespace {

using Long = std::complex<long double>;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

// Z condensed onto the first b coordinates, with proportional damping and a loss factor. In long double: the
// factorization of a beam loses digits with the fourth power of its elements.
Eigen::MatrixXcd condensed(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K, const Eigen::MatrixXd& C,
                           double s, Eigen::Index b) {
  const double alpha = 0.02, beta = 1e-4, loss = 0.01;
  LongMatrix Z = K.cast<Long>() * Long(1, s * beta + loss) + M.cast<Long>() * Long(-s * s, s * alpha);
  if (C.size() > 0) Z += Long(0, s) * C.cast<Long>();
  const Eigen::Index n = M.rows() - b;
  if (n == 0) return Z.cast<Complex>();
  const LongMatrix whole =
      Z.topLeftCorner(b, b) -
      Z.topRightCorner(b, n) * Z.bottomRightCorner(n, n).partialPivLu().solve(Z.bottomLeftCorner(n, b));
  return whole.cast<Complex>();
}

Eigen::MatrixXd in_order(const Eigen::MatrixXd& A, const std::vector<int>& kept) {
  std::vector<int> order = kept;
  for (int i = 0; i < A.rows(); ++i)
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) order.push_back(i);
  return A(order, order);
}

// The largest difference of the condensed stiffness up to the highest frequency, each entry over the terms of
// its row and column on the diagonal.
double difference(const scene::Matrices& of, const std::vector<int>& kept, double highest,
                  const structure::Reduced& reduced) {
  const auto b = static_cast<Eigen::Index>(kept.size());
  const Eigen::MatrixXd M = in_order(structures::dense(of.mass), kept),
                        K = in_order(structures::dense(of.stiffness), kept),
                        C = of.damping.matrix ? in_order(structures::dense(of.damping), kept)
                                              : Eigen::MatrixXd();
  double largest = 0;
  for (int k = 0; k <= 97; ++k) {
    const double s = highest * k / 97;
    const Eigen::MatrixXcd whole = condensed(M, K, C, s, b),
                           less = condensed(reduced.M, reduced.K, reduced.C, s, b);
    const Eigen::VectorXd scale = (reduced.K.diagonal().head(b).cwiseAbs() +
                                   (s * s + 0.09 * highest * highest) * reduced.M.diagonal().head(b))
                                      .cwiseSqrt();
    largest = std::max(
        largest, (scale.cwiseInverse().asDiagonal() * (whole - less) * scale.cwiseInverse().asDiagonal())
                     .cwiseAbs()
                     .maxCoeff());
  }
  return largest;
}

}  // namespace

TEST_CASE("a reduced beam has the dynamic stiffness of the whole one up to its highest frequency") {
  const bool clamped = GENERATE(true, false);
  const scene::Matrices beam = structures::beam(30, clamped);
  const int tip = beam.size() - 2;
  const std::vector<int> kept = GENERATE_COPY(std::vector{tip}, std::vector{tip, 30, 31, 10});
  const double highest = GENERATE(100.0, 1000.0);  // 3 and 10 modes
  const structure::Reduced reduced = structure::reduce(beam, kept, highest);
  CAPTURE(clamped, kept.size(), highest, reduced.M.rows(), reduced.error);
  CHECK(reduced.M.rows() < 40);
  // Rounding: the entries of a beam of n elements determine its motion to n^4 2e-16, and beside a pole with a
  // loss factor of 0.01 to 100 times that.
  const double rounding = std::pow(30, 4) * 2e-16 / 0.01;
  CHECK(reduced.error < rounding);
  CHECK(difference(beam, kept, highest, reduced) < rounding);
}

TEST_CASE("a reduced chain has the dynamic stiffness of the whole one") {
  // 80 masses, every third of them without mass, two equal branches at its end, dampers that are not
  // proportional, and a part that nothing links to it.
  const int size = 90;
  structures::Entries M, K, C;
  const auto link = [](structures::Entries& to, int i, int j, double value) {
    to.insert(to.end(), {{i, i, value}, {j, j, value}, {i, j, -value}, {j, i, -value}});
  };
  for (int i = 0; i < size; ++i)
    if (i % 3 != 1) M.push_back({i, i, 1 + 0.1 * (i % 4)});
  for (int i = 1; i < 80; ++i) link(K, i, i == 70 ? 59 : i - 1, 100 + i % 7);
  for (int i = 81; i < size; ++i) link(K, i, i - 1, 100);
  for (int i = 5; i < 80; i += 9) link(C, i, i - 1, 0.3);
  scene::Matrices chain;
  chain.mass = structures::matrix(size, M);
  chain.stiffness = structures::matrix(size, K);
  if (GENERATE(false, true)) chain.damping = structures::matrix(size, C);
  const std::vector<int> kept = {40, 3};
  const double highest = GENERATE(0.5, 3.0, 30.0);
  const structure::Reduced reduced = structure::reduce(chain, kept, highest);
  CAPTURE(highest, reduced.M.rows(), reduced.error);
  CHECK(reduced.error < 1e-10);
  CHECK(difference(chain, kept, highest, reduced) < 1e-10);
}

TEST_CASE("a structure of which all rows are kept is not changed") {
  const scene::Matrices beam = structures::beam(2, true);
  const structure::Reduced reduced = structure::reduce(beam, {2, 0, 3, 1}, 10);
  CHECK(reduced.error == 0);
  CHECK((reduced.M - in_order(structures::dense(beam.mass), {2, 0, 3, 1})).norm() < 1e-15 * reduced.M.norm());
  CHECK((reduced.K - in_order(structures::dense(beam.stiffness), {2, 0, 3, 1})).norm() <
        1e-15 * reduced.K.norm());
}

TEST_CASE("a reduction tells the row at which matrices are not positive definite, and can be stopped") {
  structures::Entries K = {{0, 0, 2}, {1, 1, 1}, {2, 2, 3}, {0, 1, -1}, {1, 0, -1}, {1, 2, -2}, {2, 1, -2}},
                      M;
  for (int i = 0; i < 3; ++i) M.push_back({i, i, 1e-3});
  scene::Matrices wrong;
  wrong.mass = structures::matrix(3, M);
  wrong.stiffness = structures::matrix(3, K);
  try {
    structure::reduce(wrong, {0}, 1);
    FAIL("reduced");
  } catch (const structure::ReductionError& error) {
    const std::string what = error.what();
    CHECK(what.find("is not positive definite") != std::string::npos);
    CHECK((what.find("at row 2") != std::string::npos || what.find("at row 3") != std::string::npos));
  }
  CHECK_THROWS_AS(structure::reduce(structures::beam(30, true), {5}, 100, [] { return true; }),
                  scene::Interrupted);
}

TEST_CASE("a reduced beam has the natural frequencies of the closed form") {
  const scene::Matrices beam = structures::beam(30, true);
  const structure::Reduced reduced = structure::reduce(beam, {58}, 100);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(reduced.K, reduced.M);
  CHECK(std::pow(modes.eigenvalues()[0], 0.25) == Approx(1.8751040687).epsilon(1e-8));
  CHECK(std::pow(modes.eigenvalues()[1], 0.25) == Approx(4.6940911330).epsilon(5e-7));
  CHECK(std::pow(modes.eigenvalues()[2], 0.25) == Approx(7.8547574382).epsilon(5e-6));
}
