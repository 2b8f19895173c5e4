// Reduced structures next to the whole ones, and next to natural frequencies in closed form.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/structure/matrices.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/structure/reduction.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
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

// Masses of 1 kg between springs: the first of them holds the first mass, the others link neighbours.
scene::Matrices spring_chain(const std::vector<double>& springs) {
  const auto size = static_cast<int>(springs.size());
  structures::Entries M, K;
  for (int i = 0; i < size; ++i) {
    const double k = springs[static_cast<std::size_t>(i)];
    M.push_back({i, i, 1});
    K.push_back({i, i, k});
    if (i > 0) K.insert(K.end(), {{i - 1, i - 1, k}, {i, i - 1, -k}, {i - 1, i, -k}});
  }
  scene::Matrices all;
  all.mass = structures::matrix(size, M);
  all.stiffness = structures::matrix(size, K);
  return all;
}

std::string refusal(const scene::Matrices& of, const std::vector<int>& kept, double highest,
                    int most = 1500) {
  try {
    structure::reduce(of, kept, highest, {}, most);
  } catch (const structure::ReductionError& error) {
    return error.what();
  }
  return "none";
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
  // Rounding: the entries of a beam of n elements determine its motion to n^4 2e-16, and next to a pole with
  // a loss factor of 0.01 to 100 times that.
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
  CHECK(reduced.error < 1e-12);  // rounding
  CHECK((reduced.M - in_order(structures::dense(beam.mass), {2, 0, 3, 1})).norm() < 1e-15 * reduced.M.norm());
  CHECK((reduced.K - in_order(structures::dense(beam.stiffness), {2, 0, 3, 1})).norm() <
        1e-15 * reduced.K.norm());
}

TEST_CASE("a reduction reports the row at which matrices are not positive definite, and can be stopped") {
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
  CHECK_THROWS_AS(structure::reduce(structures::beam(30, true), {5}, 100, controls::stopped()),
                  control::Interrupted);
}

TEST_CASE("a reduced beam has the natural frequencies of the closed form") {
  const scene::Matrices beam = structures::beam(30, true);
  const structure::Reduced reduced = structure::reduce(beam, {58}, 100);
  const auto modes = continuation::symmetric_modes(reduced.K, reduced.M);
  CHECK(std::pow(modes.values[0], 0.25) == Approx(1.8751040687).epsilon(1e-8));
  CHECK(std::pow(modes.values[1], 0.25) == Approx(4.6940911330).epsilon(5e-7));
  CHECK(std::pow(modes.values[2], 0.25) == Approx(7.8547574382).epsilon(5e-6));
}

TEST_CASE("the error of a reduction has what the last digits of the entries change") {
  // Two masses that a spring of 1 N/m holds, and one of k links: x = (1, 1), x^T K x = 1 of entries of k.
  const double eps = std::numeric_limits<double>::epsilon(), sigma = 0.09;
  const auto kept = GENERATE(std::vector{0}, std::vector{1}, std::vector{1, 0});
  for (const double k : {1e3, 1e6, 1e9}) {
    const structure::Reduced reduced = structure::reduce(spring_chain({1, k}), kept, 1);
    CHECK(reduced.error == Approx(4 * eps * (4 * k + 1 + 2 * sigma)).epsilon(0.01));
    CHECK(reduced.free_below == 0);
  }
  const std::string found = refusal(spring_chain({1, 1e12}), kept, 1);
  CAPTURE(found);
  CHECK(found.find("the last digits of their entries change the square of the lowest natural frequency by "
                   "0.00355 of it, must be at most 0.001; replace very stiff links by rigid ones") !=
        std::string::npos);
  CHECK(refusal(spring_chain({1, 1e15}), kept, 1) != "none");
}

TEST_CASE("a reduction reports up to where natural frequencies of 0 cannot be distinguished from others") {
  const double eps = std::numeric_limits<double>::epsilon(), sigma = 0.09, k = 1e9;
  const structure::Reduced reduced = structure::reduce(spring_chain({0, k}), {0}, 1);
  CHECK(reduced.free_below == Approx(std::sqrt(2 * eps * k + 1e-9 * sigma)).epsilon(1e-6));
  CHECK(reduced.error == Approx(8 * eps * k / sigma).epsilon(1e-4));
  CHECK(refusal(spring_chain({0, 1e12}), {0}, 1) != "none");
  CHECK(refusal(spring_chain({0, 1e12}), {0}, 1000) == "none");  // far below the frequencies of interest
}

TEST_CASE("coordinates that the rows kept do not excite are found to add nothing, and are left out") {
  // Two equal branches of three masses at the mass that is kept: they move alike.
  structures::Entries M, K = {{0, 0, 1}};
  const auto link = [&](int i, int j) {
    K.insert(K.end(), {{i, i, 100}, {j, j, 100}, {i, j, -100}, {j, i, -100}});
  };
  for (int i = 0; i < 7; ++i) M.push_back({i, i, 1});
  for (int i = 1; i < 7; ++i) link(i, i == 4 ? 0 : i - 1);
  scene::Matrices branches;
  branches.mass = structures::matrix(7, M);
  branches.stiffness = structures::matrix(7, K);
  const structure::Reduced reduced = structure::reduce(branches, {0}, 30);
  CHECK(reduced.M.rows() == 4);
  CHECK(reduced.error < 1e-11);
  CHECK(difference(branches, {0}, 30, reduced) < 1e-11);
}

TEST_CASE("a reduction whose error does not fall is refused") {
  const std::string found = refusal(spring_chain(std::vector<double>(300, 100.0)), {150}, 30, 40);
  CAPTURE(found);
  CHECK(found.find("the matrices cannot be reduced: the error of the dynamic stiffness is ") == 0);
  CHECK(found.find("with 40 coordinates and does not fall any further, must be at most 0.001; lower "
                   "\"highest_frequency\"") != std::string::npos);
  CHECK(refusal(spring_chain(std::vector<double>(300, 100.0)), {150}, 30) == "none");
}

TEST_CASE("numbers that overflow or are none are refused") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](int row, int column, double mass) {
    scene::Matrices all = spring_chain({100, 100, 100, 100});
    structures::Entries M = {{row, column, mass}};
    if (row != column) M.push_back({column, row, mass});
    for (int i = 0; i < 4; ++i) M.push_back({i, i, 1});
    all.mass = structures::matrix(4, M);
    return all;
  };
  const std::string too_large = "their entries are too large, too small or too far apart";
  CHECK(refusal(with(0, 0, 1), {0}, 100) == "none");
  CHECK(refusal(with(0, 0, 1e308), {0}, 100).find(too_large) != std::string::npos);
  CHECK(refusal(with(0, 0, none), {0}, 100).find(too_large) != std::string::npos);
  CHECK(refusal(with(0, 1, none), {0}, 100).find(too_large) != std::string::npos);
  CHECK(refusal(with(2, 2, none), {0}, 100).find(too_large) != std::string::npos);
  CHECK(refusal(with(2, 2, 1e308), {0}, 100).find(too_large) != std::string::npos);
  CHECK(refusal(with(0, 0, 1), {0}, 1e200).find(too_large) != std::string::npos);
  CHECK(refusal(spring_chain({-500, 100, 100}), {0}, 1)
            .find("is not positive definite, as it is where mass and stiffness are positive semidefinite and "
                  "no part without mass floats; it is not in the rows that the scene uses") !=
        std::string::npos);
}
