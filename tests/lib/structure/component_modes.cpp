// The methods of Craig and Bampton and of Rubin next to closed forms and to dense eigenvalues of the whole.
#include "catch.hpp"

#include "lib/structure/matrices.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/structure/reduction.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace arcslip;
using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using scene::ReductionMethod;

namespace {

structure::Purpose by(ReductionMethod method, int modes, double highest, double cutoff = 0) {
  structure::Purpose purpose{highest, 0, {}};
  purpose.method = method;
  purpose.modes = modes;
  purpose.cutoff = cutoff;
  return purpose;
}

// A rod of unit length, stiffness and mass, held at its left end: masses in the nodes.
scene::Matrices rod(int elements) {
  const double h = 1.0 / elements;
  structures::Entries M, K;
  for (int i = 0; i < elements; ++i) {
    const bool is_end = i == elements - 1;
    M.push_back({i, i, is_end ? h / 2 : h});
    K.push_back({i, i, (is_end ? 1 : 2) / h});
    if (i > 0) K.insert(K.end(), {{i, i - 1, -1 / h}, {i - 1, i, -1 / h}});
  }
  scene::Matrices all;
  all.mass = structures::matrix(elements, M);
  all.stiffness = structures::matrix(elements, K);
  return all;
}

// A mass with `count` equal branches of `length` masses.
scene::Matrices branches(int count, int length) {
  const int size = 1 + count * length;
  structures::Entries M, K = {{0, 0, 1}};
  for (int i = 0; i < size; ++i) M.push_back({i, i, 1});
  for (int i = 1; i < size; ++i) {
    const int to = (i - 1) % length == 0 ? 0 : i - 1;
    K.insert(K.end(), {{i, i, 100}, {to, to, 100}, {i, to, -100}, {to, i, -100}});
  }
  scene::Matrices all;
  all.mass = structures::matrix(size, M);
  all.stiffness = structures::matrix(size, K);
  return all;
}

// Z condensed onto the first b coordinates, without damping.
MatrixXd condensed(const MatrixXd& M, const MatrixXd& K, double omega, Index b) {
  const MatrixXd Z = K - omega * omega * M;
  const Index n = Z.rows() - b;
  return Z.topLeftCorner(b, b) -
         Z.topRightCorner(b, n) * continuation::solve(Z.bottomRightCorner(n, n), Z.bottomLeftCorner(n, b));
}

struct Whole {
  MatrixXd M, K;
};
Whole kept_first(const scene::Matrices& of, const std::vector<int>& kept) {
  std::vector<int> order = kept;
  for (int i = 0; i < of.size(); ++i)
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) order.push_back(i);
  return {structures::dense(of.mass)(order, order), structures::dense(of.stiffness)(order, order)};
}

std::string refusal(const scene::Matrices& of, const std::vector<int>& kept,
                    const structure::Purpose& purpose) {
  try {
    structure::reduce(of, kept, purpose);
  } catch (const structure::ReductionError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("the modes that Craig-Bampton leaves out of a rod are missed by the terms of its closed form") {
  // w cot(w) of the free end, less 2 w^4/(q^2 (q^2 - w^2)) for each q = k pi.
  const double omega = 2;
  double before = 0;
  for (const int modes : {5, 10, 20}) {
    const auto reduced = structure::reduce(rod(400), {399}, by(ReductionMethod::craig_bampton, modes, omega));
    REQUIRE(reduced.M.rows() == 1 + modes);
    double left_out = 0;
    for (int k = modes + 1; k < 4000; ++k) {
      const double square = std::pow(k * std::numbers::pi, 2);
      left_out += 2 * std::pow(omega, 4) / (square * (square - omega * omega));
    }
    const Whole whole = kept_first(rod(400), {399});
    const double exact = condensed(whole.M, whole.K, omega, 1)(0, 0),
                 found = condensed(reduced.M, reduced.K, omega, 1)(0, 0);
    CAPTURE(modes, exact, found, left_out, reduced.error);
    CHECK(exact == Approx(omega / std::tan(omega)).epsilon(1e-4));
    CHECK(found - exact == Approx(left_out).epsilon(0.01));
    // Next to K + (w^2 + 2 s) M of the linear shape, s = 0.09 w^2.
    const double relative = left_out / (1 + 1.18 * omega * omega / 3);
    CHECK(reduced.error > 0.99 * relative);
    CHECK(reduced.error < 4 * relative);
    if (before > 0) CHECK(std::log2(before / left_out) == Approx(3).epsilon(0.1));  // their third order
    before = left_out;
  }
}

TEST_CASE("statics of the rows that are kept are exact with any number of modes") {
  const auto method = GENERATE(ReductionMethod::craig_bampton, ReductionMethod::rubin);
  const int modes = GENERATE(0, 1, 5);
  const bool clamped = GENERATE(true, false);
  const scene::Matrices beam = structures::beam(12, clamped);
  const std::vector<int> kept = {beam.size() - 2, 5, 12};
  const structure::Reduced reduced = structure::reduce(beam, kept, by(method, modes, 50));
  const Whole whole = kept_first(beam, kept);
  const MatrixXd exact = condensed(whole.M, whole.K, 0, 3);
  CHECK(reduced.M.rows() == 3 + modes);
  CHECK((condensed(reduced.M, reduced.K, 0, 3) - exact).norm() < 1e-9 * exact.norm());
}

TEST_CASE("natural frequencies of fixed-interface modes come from above, those of Rubin's are exact") {
  const int modes = 6;
  const scene::Matrices beam = structures::beam(20, false);
  const std::vector<int> kept = {0, 40};
  const Whole whole = kept_first(beam, kept);
  const VectorXd exact = continuation::symmetric_eigenvalues(whole.K, whole.M);
  // The mean rounding of the entries of 20 elements, next to the square of a natural frequency of 500.
  const double rounding = 1e-9;
  SECTION("fixed") {
    const auto reduced = structure::reduce(beam, kept, by(ReductionMethod::craig_bampton, modes, 100));
    const VectorXd found = continuation::symmetric_eigenvalues(reduced.K, reduced.M);
    for (Index i = 2; i < found.size(); ++i) {
      CAPTURE(i, found[i], exact[i]);
      CHECK(found[i] > exact[i] * (1 - rounding));
    }
    CHECK(found[2] == Approx(exact[2]).epsilon(1e-3));
    CHECK(found[2] > exact[2] * (1 + rounding));
  }
  SECTION("free") {
    const auto reduced = structure::reduce(beam, kept, by(ReductionMethod::rubin, modes, 100));
    REQUIRE(reduced.M.rows() == 2 + modes);
    CHECK(reduced.free_below > 0);
    const VectorXd found = continuation::symmetric_eigenvalues(reduced.K, reduced.M);
    CHECK(std::abs(found[0]) < 1e-6);  // motions as a rigid body
    CHECK(std::abs(found[1]) < 1e-6);
    for (Index i = 2; i < modes; ++i) CHECK(found[i] == Approx(exact[i]).epsilon(rounding));
    const double closed[] = {4.7300407449, 7.8532046241, 10.9956078380};
    for (int i = 0; i < 3; ++i)
      CHECK(std::pow(found[2 + i], 0.25) == Approx(closed[i]).epsilon(4e-5));  // of 20 elements
  }
}

TEST_CASE("modes up to a cutoff are all that there are below it, however many are alike") {
  // 20 branches that move alike or against each other at each natural frequency of one that is held.
  const int count = 20, length = 3;
  const scene::Matrices of = branches(count, length);
  const Whole whole = kept_first(of, {0});
  const Index n = count * length;
  const double cutoff = 10;  // between the first and the second
  const VectorXd squares =
      continuation::symmetric_eigenvalues(whole.K.bottomRightCorner(n, n), whole.M.bottomRightCorner(n, n));
  const Index below = (squares.array() < cutoff * cutoff).count();
  REQUIRE(below == count);
  const auto fixed = structure::reduce(of, {0}, by(ReductionMethod::craig_bampton, -1, 5, cutoff));
  CHECK(fixed.M.rows() == 1 + below);
  const auto all = structure::reduce(of, {0}, by(ReductionMethod::craig_bampton, 10000, 5));
  CHECK(all.M.rows() == 1 + n);
  CHECK(all.error < 1e-10);
}

TEST_CASE("modes need statics: parts that float with the rows held are refused") {
  const auto method = GENERATE(ReductionMethod::craig_bampton, ReductionMethod::rubin);
  const scene::Matrices beam = structures::beam(12, false);
  const std::string found = refusal(beam, {24}, by(method, 4, 100));
  CAPTURE(found);
  CHECK(
      found ==
      "the matrices cannot be reduced: a part of the structure floats, or nearly so, where the rows that "
      "the scene uses are held, so that these have no statics; let the scene use more rows of this part, or "
      "reduce by the \"method\" \"krylov\"");
  CHECK(refusal(beam, {24, 25}, by(method, 4, 100)) == "none");
}
