// Reductions to many rows: the error that they report next to that of the whole structure, in long double.
#include "catch.hpp"

#include "lib/structure/matrices.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/structure/reduction.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

using namespace arcslip;
using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

namespace {

using Long = std::complex<long double>;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

// Two membranes of rows x columns points that face each other, one on springs along an edge, both linked at
// a few points. Masses differ a little, unless the membranes are alike: modes then move them alike and
// against each other.
scene::Matrices membranes(int rows, int columns, bool alike, bool damped) {
  const int plane = rows * columns;
  structures::Entries M, K, C;
  const auto link = [](structures::Entries& to, int i, int j, double k) {
    to.insert(to.end(), {{i, i, k}, {j, j, k}, {i, j, -k}, {j, i, -k}});
  };
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const int at = side * plane + i * columns + j;
        M.push_back({at, at, 1 + (alike ? 0 : 0.1 * ((3 * i + 5 * j + side) % 4))});
        if (j == 0 && (alike || side == 0)) K.push_back({at, at, 50});
        if (i > 0) link(K, at, at - columns, 80);
        if (j > 0) link(K, at, at - 1, 100 + (alike ? 0 : (i + j) % 3));
        if (side == 1 && (i + 2 * j) % 7 == 0) link(K, at, at - plane, 5);
        if (damped && (i * j) % 5 == 1) link(C, at, at - 1, 0.2);
      }
  scene::Matrices all;
  all.mass = structures::matrix(2 * plane, M);
  all.stiffness = structures::matrix(2 * plane, K);
  if (damped) all.damping = structures::matrix(2 * plane, C);
  return all;
}

// (Z, f) condensed onto the first b coordinates, with a loss factor.
LongMatrix condensed_rows(const MatrixXd& M, const MatrixXd& K, const MatrixXd& C, const MatrixXd& f,
                          double s, Index b) {
  LongMatrix Z = K.cast<Long>() * Long(1, 0.01L) - static_cast<long double>(s) * s * M.cast<Long>();
  if (C.size() > 0) Z += Long(0, s) * C.cast<Long>();
  const Index n = M.rows() - b;
  LongMatrix all(b, b + f.cols()), right(n, b + f.cols());
  all << Z.topLeftCorner(b, b), f.topRows(b).cast<Long>();
  right << Z.bottomLeftCorner(n, b), f.bottomRows(n).cast<Long>();
  return all - Z.topRightCorner(b, n) * Z.bottomRightCorner(n, n).partialPivLu().solve(right);
}

struct Structure {
  MatrixXd M, K, C, loads;
};

// The largest error over frequencies and the poles of the interior, each entry over the terms of its row and
// column on the diagonal, loads over the same of their row and their size.
double true_error(const Structure& whole, const structure::Reduced& less, double highest, Index b) {
  const Index n = whole.M.rows() - b, loads = whole.loads.cols();
  const double sigma = 0.09 * highest * highest;
  std::vector<double> frequencies;
  for (int k = 0; k <= 11; ++k) frequencies.push_back(highest * k / 11);
  for (const double square :
       continuation::symmetric_eigenvalues(whole.K.bottomRightCorner(n, n), whole.M.bottomRightCorner(n, n)))
    if (square < highest * highest) frequencies.push_back(std::sqrt(square));
  const MatrixXd A = whole.K + sigma * whole.M;
  const MatrixXd Psi = continuation::solve(A.bottomRightCorner(n, n), -A.bottomLeftCorner(n, b));
  const MatrixXd M_psi = whole.M.bottomRightCorner(n, n) * Psi + whole.M.bottomLeftCorner(n, b);
  const VectorXd A_c = (A.topLeftCorner(b, b) + A.topRightCorner(b, n) * Psi).diagonal(),
                 M_c = (whole.M.topLeftCorner(b, b) + Psi.transpose() * M_psi +
                        whole.M.topRightCorner(b, n) * Psi)
                           .diagonal();
  VectorXd size(b + loads);
  if (loads > 0)
    size.tail(loads) = (whole.loads.transpose() * continuation::solve(A, whole.loads)).diagonal().cwiseSqrt();
  double largest = 0;
  for (const double s : frequencies) {
    size.head(b) = (A_c + (s * s + sigma) * M_c).cwiseSqrt();
    const LongMatrix off = condensed_rows(whole.M, whole.K, whole.C, whole.loads, s, b) -
                           condensed_rows(less.M, less.K, less.C, less.loads, s, b);
    for (Index j = 0; j < b + loads; ++j)
      for (Index i = 0; i < b; ++i)
        largest = std::max(largest, static_cast<double>(std::abs(off(i, j))) / (size[i] * size[j]));
  }
  return largest;
}

Structure kept_first(const scene::Matrices& of, const std::vector<int>& kept, const MatrixXd& loads) {
  std::vector<int> order = kept;
  for (int i = 0; i < of.size(); ++i)
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) order.push_back(i);
  const auto in_order = [&](const scene::MatrixFile& file) {
    return file.matrix ? MatrixXd(structures::dense(file)(order, order)) : MatrixXd();
  };
  return {in_order(of.mass), in_order(of.stiffness), in_order(of.damping), loads(order, Eigen::all)};
}

}  // namespace

TEST_CASE("a reduction to many rows is at least as accurate as it reports") {
  const bool alike = GENERATE(false, true), damped = GENERATE(false, true);
  const int rows = 6, columns = 9, plane = rows * columns;
  const scene::Matrices of = membranes(rows, columns, alike, damped);
  std::vector<int> kept;
  for (int i = 0; i < rows; ++i)
    for (int j = 3; j < 9; ++j)
      for (int side = 0; side < 2; ++side) kept.push_back(side * plane + i * columns + j);
  MatrixXd loads(of.size(), 2);
  for (int i = 0; i < of.size(); ++i) loads.row(i) << std::cos(1.7 * i * i), std::sin(0.9 * i);
  if (GENERATE(false, true)) loads.resize(of.size(), 0);
  const Structure whole = kept_first(of, kept, loads);
  const double highest = GENERATE(1.0, 5.0);
  for (const double accuracy : {1e-4, 1e-8}) {
    structure::Purpose purpose{highest, 0, loads};
    purpose.accuracy = accuracy;
    const structure::Reduced reduced = structure::reduce(of, kept, purpose);
    const double truth = true_error(whole, reduced, highest, static_cast<Index>(kept.size()));
    CAPTURE(alike, damped, loads.cols(), highest, accuracy, reduced.M.rows(), reduced.error, truth);
    CHECK(truth < reduced.error);
    CHECK(reduced.error < 1.1 * accuracy + 1e-12);
  }
}

TEST_CASE("the error of a reduction by modes is at least the true one, and not far above it") {
  const bool alike = GENERATE(false, true), damped = GENERATE(false, true);
  const auto method = GENERATE(scene::ReductionMethod::craig_bampton, scene::ReductionMethod::rubin);
  const int rows = 6, columns = 9, plane = rows * columns;
  const scene::Matrices of = membranes(rows, columns, alike, damped);
  std::vector<int> kept;
  for (int i = 0; i < rows; ++i)
    for (int side = 0; side < 2; ++side)
      for (int j = 5; j < 9; ++j) kept.push_back(side * plane + i * columns + j);
  MatrixXd loads(of.size(), 2);
  for (int i = 0; i < of.size(); ++i) loads.row(i) << std::cos(1.7 * i * i), std::sin(0.9 * i);
  if (GENERATE(false, true)) loads.resize(of.size(), 0);
  const Structure whole = kept_first(of, kept, loads);
  for (const int modes : {0, 6, 20}) {
    structure::Purpose purpose{5, 0, loads};
    purpose.method = method;
    purpose.modes = modes;
    const structure::Reduced reduced = structure::reduce(of, kept, purpose);
    const double truth = true_error(whole, reduced, purpose.highest, static_cast<Index>(kept.size()));
    CAPTURE(alike, damped, loads.cols(), modes, reduced.M.rows(), reduced.error, truth);
    CHECK(truth < reduced.error);
    CHECK(reduced.error < (damped ? 1000 : 100) * truth);
  }
}
