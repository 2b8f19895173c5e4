// Reductions with loads on all rows, with a stiffness that grows with the square of a speed, and with
// gyroscopic, circulatory and other unsymmetric matrices, next to the whole structures.
#include "catch.hpp"

#include "lib/structure/matrices.hpp"

#include <arcslip/structure/reduction.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

using namespace arcslip;

namespace {

using Long = std::complex<long double>;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

std::vector<int> order_of(int size, const std::vector<int>& kept) {
  std::vector<int> order = kept;
  for (int i = 0; i < size; ++i)
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) order.push_back(i);
  return order;
}

// (Z, f) condensed onto the first b coordinates, with a loss factor; in long double.
LongMatrix condensed_with_loads(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K, const Eigen::MatrixXd& C,
                                const Eigen::MatrixXd& f, double s, Eigen::Index b) {
  LongMatrix Z = K.cast<Long>() * Long(1, 0.01L) - static_cast<long double>(s) * s * M.cast<Long>();
  if (C.size() > 0) Z += Long(0, s) * C.cast<Long>();
  const Eigen::Index n = M.rows() - b;
  LongMatrix all(b, b + f.cols());
  all << Z.topLeftCorner(b, b), f.topRows(b).cast<Long>();
  if (n == 0) return all;
  LongMatrix right(n, b + f.cols());
  right << Z.bottomLeftCorner(n, b), f.bottomRows(n).cast<Long>();
  const LongMatrix inside = Z.bottomRightCorner(n, n).partialPivLu().solve(right);
  return all - Z.topRightCorner(b, n) * inside;
}

struct Difference {
  double stiffness = 0, load = 0;
};

// The largest differences at one speed up to the highest frequency: of the stiffness over the terms of its
// row and column, of a load over the same of its row and sqrt(f^T K^-1 f).
Difference difference(const scene::Matrices& of, const std::vector<int>& kept,
                      const structure::Purpose& purpose, const structure::Reduced& reduced, double speed) {
  const auto b = static_cast<Eigen::Index>(kept.size());
  const std::vector<int> order = order_of(of.size(), kept);
  const auto in_order = [&](const scene::MatrixFile& file) {
    return Eigen::MatrixXd(structures::dense(file)(order, order));
  };
  const Eigen::MatrixXd M = in_order(of.mass);
  Eigen::MatrixXd C = of.damping.matrix ? in_order(of.damping) : Eigen::MatrixXd(), C_reduced = reduced.C;
  Eigen::MatrixXd K = in_order(of.stiffness), K_reduced = reduced.K;
  if (of.stiffness_speed_squared.matrix) {
    K += speed * speed * in_order(of.stiffness_speed_squared);
    K_reduced += speed * speed * reduced.K2;
  }
  if (of.gyroscopic.matrix) {
    if (C.size() == 0) C.setZero(M.rows(), M.cols());
    if (C_reduced.size() == 0) C_reduced.setZero(reduced.M.rows(), reduced.M.cols());
    C += speed * in_order(of.gyroscopic);
    C_reduced += speed * reduced.G;
  }
  if (of.circulatory.matrix) {
    K += speed * in_order(of.circulatory);
    K_reduced += speed * reduced.N;
  }
  const Eigen::MatrixXd f = purpose.loads.size() > 0 ? Eigen::MatrixXd(purpose.loads(order, Eigen::all))
                                                     : Eigen::MatrixXd(of.size(), 0);
  const Eigen::MatrixXd f_reduced =
      purpose.loads.size() > 0 ? reduced.loads : Eigen::MatrixXd(reduced.M.rows(), 0);
  const Eigen::VectorXd load_size =
      (f.array() * K.partialPivLu().solve(f).array()).colwise().sum().sqrt().matrix().transpose();
  Difference largest;
  for (int k = 0; k <= 20; ++k) {
    const double s = purpose.highest * k / 20;
    const LongMatrix whole = condensed_with_loads(M, K, C, f, s, b),
                     less = condensed_with_loads(reduced.M, K_reduced, C_reduced, f_reduced, s, b);
    for (Eigen::Index i = 0; i < b; ++i) {
      const auto scale = [&](Eigen::Index j) {
        return std::sqrt(std::abs(K_reduced(j, j)) + s * s * reduced.M(j, j));
      };
      for (Eigen::Index j = 0; j < whole.cols(); ++j) {
        const double by = static_cast<double>(std::abs(whole(i, j) - less(i, j)));
        if (j < b)
          largest.stiffness = std::max(largest.stiffness, by / scale(i) / scale(j));
        else
          largest.load = std::max(largest.load, by / scale(i) / load_size[j - b]);
      }
    }
  }
  return largest;
}

// A chain of masses with three dampers that are not proportional.
scene::Matrices chain(int size, bool damped) {
  structures::Entries M, K, C;
  const auto link = [](structures::Entries& to, int i, int j, double value) {
    to.insert(to.end(), {{i, i, value}, {j, j, value}, {i, j, -value}, {j, i, -value}});
  };
  for (int i = 0; i < size; ++i) M.push_back({i, i, 1 + 0.1 * (i % 4)});
  K.push_back({0, 0, 150});
  for (int i = 1; i < size; ++i) link(K, i, i - 1, 100 + i % 7);
  for (const int i : {7, 20, 33}) link(C, i, i - 1, 0.3);
  scene::Matrices all;
  all.mass = structures::matrix(size, M);
  all.stiffness = structures::matrix(size, K);
  if (damped) all.damping = structures::matrix(size, C);
  return all;
}

// The stiffening of the links by the tension of all that rotates beyond them, and a little softening, which
// leaves K + Omega^2 K2 definite.
scene::MatrixFile stiffening(int size) {
  structures::Entries K2;
  double tension = 0;
  for (int i = size - 1; i >= 1; --i) {
    tension += (1 + 0.1 * (i % 4)) * (0.5 + 0.02 * i);
    K2.insert(K2.end(),
              {{i, i, tension}, {i - 1, i - 1, tension}, {i, i - 1, -tension}, {i - 1, i, -tension}});
  }
  for (int i = 0; i < size; ++i) K2.push_back({i, i, -0.05 * (1 + 0.1 * (i % 4))});
  return structures::matrix(size, K2);
}

Eigen::MatrixXd pressure(int size) {
  Eigen::MatrixXd loads(size, 2);
  for (int i = 0; i < size; ++i) {
    loads(i, 0) = std::cos(0.4 * i);
    loads(i, 1) = i % 5 == 0 ? 3.0 : -0.2;
  }
  return loads;
}

}  // namespace

TEST_CASE("loads on all rows act on a reduced structure as on the whole one") {
  const bool damped = GENERATE(false, true);
  const scene::Matrices of = chain(60, damped);
  const std::vector<int> kept = GENERATE(std::vector{59}, std::vector{40, 3});
  structure::Purpose purpose{GENERATE(0.5, 3.0, 30.0), 0, pressure(60)};
  const structure::Reduced reduced = structure::reduce(of, kept, purpose);
  CAPTURE(damped, kept.size(), purpose.highest, reduced.M.rows(), reduced.error);
  CHECK(reduced.error < 1e-9);  // where estimates fall by less than 0.3, the one before the last
  const Difference found = difference(of, kept, purpose, reduced, 0);
  CHECK(found.stiffness < 1e-10);
  CHECK(found.load < 1e-10);
}

TEST_CASE("a load on rows that are kept, and on those that nothing links to them") {
  scene::Matrices of = chain(10, false);
  const std::vector<int> all{3, 0, 1, 2, 4, 5, 6, 7, 8, 9};
  structure::Purpose purpose{5, 0, pressure(10)};
  const structure::Reduced whole = structure::reduce(of, all, purpose);
  CHECK(whole.loads == Eigen::MatrixXd(purpose.loads(all, Eigen::all)));
  // A mass of its own.
  structures::Entries M{{0, 0, 1}, {1, 1, 1}, {2, 2, 1}},
      K{{0, 0, 2}, {1, 1, 1}, {0, 1, -1}, {1, 0, -1}, {2, 2, 5}};
  scene::Matrices apart;
  apart.mass = structures::matrix(3, M);
  apart.stiffness = structures::matrix(3, K);
  purpose.loads = Eigen::MatrixXd::Zero(3, 1);
  purpose.loads(2, 0) = 1;
  const structure::Reduced reduced = structure::reduce(apart, {0}, purpose);
  CHECK(reduced.error < 1e-10);
  CHECK(reduced.loads.isZero(0));
}

TEST_CASE("a structure whose stiffness grows with the square of a speed is reduced for all speeds") {
  const int size = 40;
  scene::Matrices of = chain(size, GENERATE(false, true));
  of.stiffness_speed_squared = stiffening(size);
  const std::vector<int> kept{size - 1, 12};
  // At 2 rad/s, the first links are twice as stiff.
  structure::Purpose purpose{GENERATE(1.0, 8.0), GENERATE(0.5, 2.0), pressure(size)};
  const structure::Reduced reduced = structure::reduce(of, kept, purpose);
  CAPTURE(purpose.highest, purpose.highest_speed, reduced.M.rows(), reduced.error);
  CHECK(reduced.error < 1e-9);
  for (const double speed : {0.0, 0.37, 0.6, 0.83, 1.0}) {
    const Difference found = difference(of, kept, purpose, reduced, speed * purpose.highest_speed);
    CAPTURE(speed);
    CHECK(found.stiffness < 1e-9);
    CHECK(found.load < 1e-9);
  }
}

namespace {

// A shaft in two planes: the chain in each, with gyroscopic moments of a few disks or all along it, and with
// disks also bearings with cross-coupled coefficients and rotating damping at the joints.
scene::Matrices shaft(int size, bool disks) {
  const scene::Matrices plane = chain(size, disks);
  const auto twice = [&](const scene::MatrixFile& file) {
    structures::Entries entries;
    const Eigen::MatrixXd A = structures::dense(file);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j)
        if (A(i, j) != 0)
          for (const int k : {0, 1}) entries.push_back({2 * i + k, 2 * j + k, A(i, j)});
    return entries;
  };
  const auto couple = [](structures::Entries& to, int at, double xy, double yx) {
    to.insert(to.end(), {{2 * at, 2 * at + 1, xy}, {2 * at + 1, 2 * at, yx}});
  };
  structures::Entries K = twice(plane.stiffness), G, N;
  for (int i = 0; i < size; i += disks ? size / 3 : 1) couple(G, i, 0.9, -0.9);
  scene::Matrices all;
  all.mass = structures::matrix(2 * size, twice(plane.mass));
  if (disks) {
    structures::Entries C = twice(plane.damping);
    for (const int at : {5, size / 2}) {
      K.insert(K.end(), {{2 * at, 2 * at, 30}, {2 * at + 1, 2 * at + 1, 45}});
      couple(K, at, 20, -35);
      C.insert(C.end(), {{2 * at, 2 * at, 1}, {2 * at + 1, 2 * at + 1, 2}});
      couple(C, at, 0.4, 0.1);
    }
    couple(N, size / 4, 0.3, -0.3);
    all.damping = structures::matrix(2 * size, C);
    all.circulatory = structures::matrix(2 * size, N);
    all.unsymmetric_stiffness = all.unsymmetric_damping = true;
  }
  all.stiffness = structures::matrix(2 * size, K);
  all.gyroscopic = structures::matrix(2 * size, G);
  return all;
}

}  // namespace

TEST_CASE("a rotor with unsymmetric matrices is reduced for all speeds") {
  const int size = 36;
  const bool disks = GENERATE(true, false);
  const scene::Matrices of = shaft(size, disks);
  const std::vector<int> kept{2 * size - 1, 24};
  structure::Purpose purpose{1, disks ? 4.0 : 0.5, pressure(2 * size)};
  const structure::Reduced reduced = structure::reduce(of, kept, purpose);
  CAPTURE(disks, purpose.highest, purpose.highest_speed, reduced.M.rows(), reduced.error);
  CHECK(reduced.error < 1e-9);
  CHECK(reduced.G == -reduced.G.transpose());
  CHECK(reduced.N == -reduced.N.transpose());
  for (const double speed : {0.0, 0.37, 1.0}) {
    const Difference found = difference(of, kept, purpose, reduced, speed * purpose.highest_speed);
    CAPTURE(speed);
    CHECK(found.stiffness < 1e-9);
    CHECK(found.load < 1e-9);
  }
}

TEST_CASE("what only a skew-symmetric matrix links to the rows that are kept is part of the reduction") {
  scene::Matrices of;
  of.mass = structures::matrix(3, {{0, 0, 1}, {1, 1, 2}, {2, 2, 1}});
  of.stiffness = structures::matrix(3, {{0, 0, 4}, {1, 1, 5}, {2, 2, 6}});
  of.damping = structures::matrix(3, {{0, 0, 0.1}});
  of.gyroscopic = structures::matrix(3, {{0, 1, 0.7}, {1, 0, -0.7}});
  of.circulatory = structures::matrix(3, {{1, 2, 0.2}, {2, 1, -0.2}});
  const structure::Purpose purpose{5, 3, {}};
  const structure::Reduced reduced = structure::reduce(of, {0}, purpose);
  CHECK(reduced.M.rows() == 3);
  for (const double speed : {0.0, 1.3, 3.0})
    CHECK(difference(of, {0}, purpose, reduced, speed).stiffness < 1e-12);
}
