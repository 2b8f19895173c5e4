// Sectors with rows on both faces: in a wave, next to the closed ring of their copies.
#include "catch.hpp"

#include "lib/structure/matrices.hpp"

#include <arcslip/structure/wave.hpp>

#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace arcslip;
using structures::Entries;

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd, Eigen::MatrixXd;

// A part of a disc, deflections at radius i and angle j of the sector, from one face to the other; unequal
// along the angle, so that the wave the other way round is another one. On the outer side, a blade.
struct Disc {
  static constexpr int radii = 5, angles = 6;
  static int row(int i, int j) { return angles * i + j; }

  Entries M, K, C, K2, G, N;
  int size = radii * angles;
  std::vector<scene::FacePair> faces;

  Disc() {
    const auto link = [](Entries& A, int a, int b, double k) {
      for (const auto& [i, j, sign] : {std::tuple(a, a, 1.0), {b, b, 1.0}, {a, b, -1.0}, {b, a, -1.0}})
        A.push_back({i, j, sign * k});
    };
    const auto cross = [](Entries& A, int a, int b, double value) {
      A.push_back({a, b, value});
      A.push_back({b, a, -value});
    };
    for (int i = 0; i < radii; ++i)
      for (int j = 0; j < angles; ++j) {
        const int at = row(i, j);
        const double varied = 1 + 0.3 * std::sin(1.0 + 2 * i + 5 * j);
        const bool face = j == 0 || j + 1 == angles;
        M.push_back({at, at, (face ? 0.5 : 1) * varied});
        K.push_back({at, at, 0.05 * varied});
        if (i > 0) link(K, at, row(i - 1, j), 2 * varied);
        if (i > 0) link(K2, at, row(i - 1, j), 0.3 * varied);
        if (j > 0) link(K, at, row(i, j - 1), 3 * varied);
        if (j > 0) link(M, at, row(i, j - 1), -0.05 * varied);
        if (i > 0 && j > 0) link(K, at, row(i - 1, j - 1), 0.7);
        if (i > 0 && j > 0) cross(G, at, row(i, j - 1), 0.2 * varied);
        if (j == 2) cross(N, at, row(i, angles - 1), 0.01 * varied);
      }
    const int tip = size++, root = row(radii - 1, 2);
    M.push_back({tip, tip, 0.8});
    link(K, tip, root, 0.9);
    link(C, tip, root, 0.05);
    link(C, row(1, 4), row(1, 5), 0.08);
    C.push_back({row(0, 0), row(0, 1), 0.02});  // unsymmetric
    for (int i = 0; i < radii; ++i) faces.push_back({row(i, 0), row(i, angles - 1)});
  }

  scene::Matrices sector(bool of_rotor) const {
    scene::Matrices all;
    all.mass = structures::matrix(size, M);
    all.stiffness = structures::matrix(size, K);
    Entries symmetric = C;
    if (!of_rotor) symmetric.push_back({row(0, 1), row(0, 0), 0.02});
    if (!of_rotor) symmetric.push_back({row(0, 0), row(0, 0), 0.03});
    if (!of_rotor) symmetric.push_back({row(0, 1), row(0, 1), 0.03});
    all.damping = structures::matrix(size, symmetric);
    all.unsymmetric_damping = of_rotor;
    if (of_rotor) {
      all.stiffness_speed_squared = structures::matrix(size, K2);
      all.gyroscopic = structures::matrix(size, G);
      all.circulatory = structures::matrix(size, N);
    }
    all.faces = faces;
    return all;
  }

  // All rows but those of the second face, those that are kept first.
  std::vector<int> order(std::vector<int> kept) const {
    std::vector<bool> taken(static_cast<std::size_t>(size), false);
    for (const int row : kept) taken[static_cast<std::size_t>(row)] = true;
    for (const scene::FacePair& pair : faces) taken[static_cast<std::size_t>(pair.beyond)] = true;
    for (int row = 0; row < size; ++row)
      if (!taken[static_cast<std::size_t>(row)]) kept.push_back(row);
    return kept;
  }
};

// sum_j A_0j t^j of the blocks of a ring: what the wave makes of it.
MatrixXcd of_ring(const scene::MatrixFile& file, const std::vector<int>& order,
                  const structure::SharedRows& rows, const structure::Wave& wave) {
  const MatrixXd A = structures::dense(file);
  MatrixXcd sum = MatrixXcd::Zero(rows.count, rows.count);
  for (int sector = 0; sector < wave.count; ++sector) {
    const Complex turn =
        std::polar(1.0, -2 * std::numbers::pi * (wave.diameter * sector % wave.count) / wave.count);
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = 0; j < order.size(); ++j)
        sum(static_cast<int>(i), static_cast<int>(j)) +=
            turn * A(rows.place[static_cast<std::size_t>(order[i])],
                     sector * rows.count + rows.place[static_cast<std::size_t>(order[j])]);
  }
  return sum;
}

double off(const MatrixXcd& a, const MatrixXcd& b) {
  REQUIRE(a.rows() == b.rows());
  REQUIRE(a.cols() == b.cols());
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

MatrixXd loads_of(int size) {
  MatrixXd loads(size, 2);
  for (int row = 0; row < size; ++row) loads.row(row) << std::cos(0.7 * row), std::sin(1.3 * row * row);
  return loads;
}

// (Z, f) condensed onto the first b coordinates.
MatrixXcd condensed_in_wave(const structure::WaveStructure& of, double s, double speed, Eigen::Index b) {
  MatrixXcd Z = of.K * Complex(1, 0.01) - s * s * of.M;
  if (of.C.size() > 0) Z += Complex(0, s) * of.C;
  if (of.K2.size() > 0) Z += speed * speed * of.K2;
  if (of.G.size() > 0) Z += Complex(0, s * speed) * of.G;
  if (of.N.size() > 0) Z += speed * of.N;
  const Eigen::Index n = Z.rows() - b;
  MatrixXcd right(n, b + of.loads.cols()), all(b, b + of.loads.cols());
  right << Z.bottomLeftCorner(n, b), of.loads.bottomRows(n);
  all << Z.topLeftCorner(b, b), of.loads.topRows(b);
  return all - Z.topRightCorner(b, n) * Z.bottomRightCorner(n, n).partialPivLu().solve(right);
}

}  // namespace

TEST_CASE("a sector in a wave is what the wave makes of the closed ring") {
  const Disc disc;
  for (const bool of_rotor : {false, true})
    for (const int count : {2, 3, 7, 8}) {
      scene::Matrices sector = disc.sector(of_rotor);
      const structure::SharedRows rows = structure::shared_rows(sector);
      const std::vector<int> order = disc.order({disc.size - 1, 8});
      sector.copies = count;
      const scene::Matrices ring = structure::closed_ring(sector);
      REQUIRE(ring.size() == count * (disc.size - Disc::radii));
      for (int diameter = 0; diameter <= count / 2; ++diameter) {
        CAPTURE(of_rotor, count, diameter);
        const structure::Wave wave{diameter, count};
        const MatrixXd f = loads_of(disc.size);
        const structure::WaveStructure in_wave = structure::whole_wave(sector, wave, order, f);
        CHECK(off(in_wave.M, of_ring(ring.mass, order, rows, wave)) < 1e-15);
        CHECK(off(in_wave.K, of_ring(ring.stiffness, order, rows, wave)) < 1e-15);
        CHECK(off(in_wave.C, of_ring(ring.damping, order, rows, wave)) < 1e-15);
        if (of_rotor) {
          CHECK(off(in_wave.K2, of_ring(ring.stiffness_speed_squared, order, rows, wave)) < 1e-15);
          CHECK(off(in_wave.G, of_ring(ring.gyroscopic, order, rows, wave)) < 2e-15);
          CHECK(off(in_wave.N, of_ring(ring.circulatory, order, rows, wave)) < 2e-15);
        }
        // Forces of all copies, each later than the one before.
        MatrixXcd all = MatrixXcd::Zero(ring.size(), f.cols());
        for (int copy = 0; copy < count; ++copy)
          for (Eigen::Index k = 0; k < f.cols(); ++k)
            all.col(k) += std::polar(1.0, -2 * std::numbers::pi * diameter * copy / count) *
                          structure::forces_on_ring(sector, copy, f.col(k));
        MatrixXcd own(rows.count, f.cols());
        for (int i = 0; i < rows.count; ++i)
          own.row(i) = all.row(rows.place[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])]);
        CHECK(off(in_wave.loads, own) < 1e-14);
      }
    }
}

TEST_CASE("the sectors of a closed ring have stiffnesses of their own") {
  const Disc disc;
  scene::Matrices sector = disc.sector(false);
  sector.copies = 3;
  sector.stiffness_factors = {1, 2, 4};
  sector.rows = {disc.size - 1, 0};
  const scene::Matrices ring = structure::closed_ring(sector);
  const structure::SharedRows rows = structure::shared_rows(sector);
  CHECK(ring.rows == std::vector<int>{25, 51, 77, 0, 26, 52});
  CHECK(ring.copies == 1);
  CHECK(ring.faces.empty());
  const MatrixXd K = structures::dense(ring.stiffness), own = structures::dense(sector.stiffness);
  const int first = Disc::row(1, 0), last = Disc::row(1, 5);
  // The first face of a sector is also the second one of that before.
  for (int copy = 0; copy < 3; ++copy) {
    const double factor = std::pow(2, copy), before = std::pow(2, (copy + 2) % 3);
    const int at = copy * rows.count + rows.place[static_cast<std::size_t>(first)];
    CHECK(K(at, at) == Approx(factor * own(first, first) + before * own(last, last)).epsilon(1e-15));
    CHECK(K(at, at + 1) == factor * own(first, first + 1));
  }
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(disc.size);
  CHECK(structure::displacements_on_ring(sector, 1, ones).sum() == rows.count);
  CHECK(structure::forces_on_ring(sector, 2, ones)[0] == 1);  // on the second face
  CHECK(structure::forces_on_ring(sector, 2, ones).sum() == disc.size);
}

TEST_CASE("a sector that is reduced in a wave has the dynamic stiffness and the loads of the whole one") {
  const Disc disc;
  using scene::ReductionMethod;
  const auto method =
      GENERATE(ReductionMethod::krylov, ReductionMethod::craig_bampton, ReductionMethod::rubin);
  for (const bool of_rotor : {false, true})
    for (const std::vector<int>& kept : {std::vector<int>{disc.size - 1}, {disc.size - 1, 0, 14, 12}})
      for (const auto& [diameter, count] : {std::pair(0, 8), {1, 8}, {2, 8}, {4, 8}, {3, 7}}) {
        CAPTURE(method, of_rotor, kept.size(), diameter, count);
        if (method != ReductionMethod::krylov && (of_rotor || diameter != 1)) continue;
        const scene::Matrices sector = disc.sector(of_rotor);
        const structure::Wave wave{diameter, count};
        const MatrixXd f = loads_of(disc.size);
        const double speed = of_rotor ? 0.8 : 0;
        structure::Purpose purpose{1.5, speed, f};
        purpose.method = method;
        purpose.modes = disc.size;  // all of them
        const structure::WaveStructure whole = structure::whole_wave(sector, wave, disc.order(kept), f),
                                       reduced = structure::reduce_wave(sector, wave, kept, purpose);
        const auto b = static_cast<Eigen::Index>(kept.size());
        CHECK(reduced.error < 1e-9);
        for (const double s : {0.0, 0.3, 0.77, 1.2, 1.5})
          for (const double at : {0.0, speed})
            CHECK(off(condensed_in_wave(reduced, s, at, b), condensed_in_wave(whole, s, at, b)) < 1e-9);
      }
}
