#include "bordered.hpp"
#include "catch.hpp"

#include <malloc.h>

#include <limits>

using namespace bordered;

namespace {

struct Named {
  const char* name;
  MakeLinearSolver make;
};

// All that take a sparse Jacobian.
std::vector<Named> sparse_solvers() {
  std::vector<Named> all{{"KLU", klu}};
  all.push_back(
      {"block elimination around KLU", [] { return block_elimination(std::make_unique<Alone>(klu())); }});
  return all;
}

constexpr double few = 10;  // rounding units of a residual

// Residuals at rounding, and the sign of the determinant.
void check_solves(LinearSolver& solver, const Matrix& B, const Vector& b) {
  Vector x = b, y = b;
  solver.solve(x);
  CHECK(residual(B, x, b) < few);
  REQUIRE(solver.solve_transposed(y));
  CHECK(residual(B.transpose(), y, b) < 2 * few);
  CHECK(solver.determinant_sign() == (B.determinant() > 0 ? 1 : -1));
}

}  // namespace

TEST_CASE("sparse solvers bear their names") {
  for (const auto& [name, make] : sparse_solvers()) CHECK(std::string(make()->name()) == name);
}

TEST_CASE("sparse bordered solves and transposed solves leave residuals at rounding, and signs are Eigen's") {
  for (const auto& [name, make] : sparse_solvers()) {
    const auto solver = make();  // one for all sizes and patterns
    int negative = 0, cases = 0;
    for (int n : {1, 2, 7, 40, 150})
      for (int m : {0, 1, 2, 3})
        for (unsigned seed : {1u, 2u, 3u, 4u}) {
          const SparseMatrix J = random_sparse(n, seed);
          const Borders borders = random_borders(n, m);
          const Matrix B = whole(J, borders);
          const Vector b = Vector::Random(n + m);
          CAPTURE(name, n, m, seed);
          REQUIRE(solver->factorize(J, borders));
          check_solves(*solver, B, b);
          negative += solver->determinant_sign() < 0;
          ++cases;
        }
    CHECK(negative > cases / 4);
    CHECK(negative < 3 * cases / 4);
  }
}

TEST_CASE(
    "where J is singular to 1e-16 the bordered system is solved to rounding, whatever its rows' scales") {
  for (const auto& [name, make] : sparse_solvers())
    for (int n : {12, 100, 400})
      for (double scale : {1.0, 1e-12, 1e12}) {
        SparseMatrix J = singular_laplacian(n);
        Borders borders(n, 1);
        for (int i = 0; i < n; ++i)
          borders.columns(i, 0) = borders.rows(i, 0) = std::sin(std::numbers::pi * (i + 1) / (n + 1));
        borders.corner(0, 0) = 0;
        scale_rows(J, borders, scale);
        const Matrix B = whole(J, borders);
        const Vector exact = Vector::Random(n + 1), b = B * exact, bt = B.transpose() * exact;
        const auto solver = make();
        CAPTURE(name, n, scale);
        REQUIRE(solver->factorize(J, borders));
        Vector x = b, y = bt;
        solver->solve(x);
        // Block elimination has a factor e/s where J + E is closer to singular than rounding e, up to the
        // condition.
        const bool eliminates = std::string(name).starts_with("block");
        // Full rows of n terms round by sqrt(n).
        const double limit = std::max({few, std::sqrt(n), eliminates ? n * n : 0.0});
        CHECK(residual(B, x, b) < limit);
        // Bordered by its null vector, J has the condition of its other eigenvalues, (n/pi)^2 at most.
        CHECK((x - exact).norm() < 1e-15 * n * n * exact.norm());
        REQUIRE(solver->solve_transposed(y));
        CHECK(residual(B.transpose(), y, bt) < limit);
      }
}

TEST_CASE("the dense solver and block elimination around it solve what is singular without its border") {
  for (int n : {12, 100}) {
    const Matrix J = singular_laplacian(n);
    for (const auto& make : {MakeLinearSolver(dense_lu), MakeLinearSolver([] {
                               return block_elimination(std::make_unique<Alone>(dense_lu()));
                             })}) {
      const Borders borders = random_borders(n, 1);
      const Matrix B = whole(J, borders);
      const Vector b = Vector::Random(n + 1);
      const auto solver = make();
      CAPTURE(solver->name(), n);
      REQUIRE(solver->factorize(J, borders));
      check_solves(*solver, B, b);
    }
  }
}

TEST_CASE("pivots that were good are given up where J turns singular") {
  const int n = 50;
  for (const auto& [name, make] : sparse_solvers()) {
    const auto solver = make();
    const Borders borders = random_borders(n, 1);
    const SparseMatrix singular = singular_laplacian(n);
    SparseMatrix J = singular;
    // From a definite J through the singular one to an indefinite one, with the same pattern all the way.
    for (double shift : {1.0, 0.1, 1e-3, 1e-6, 1e-10, 1e-13, 0.0, -1e-13, -1e-8, -1e-3, -0.3}) {
      for (int i = 0; i < n; ++i) J.coeffRef(i, i) = singular.coeff(i, i) + shift;
      const Matrix B = whole(J, borders);
      const Vector b = Vector::Random(n + 1);
      CAPTURE(name, shift);
      REQUIRE(solver->factorize(J, borders));
      Vector x = b;
      solver->solve(x);
      CHECK(residual(B, x, b) < few);
      CHECK(solver->determinant_sign() == (B.determinant() > 0 ? 1 : -1));
    }
  }
}

TEST_CASE("KLU's factors stay sparse where a tridiagonal J is indefinite or singular") {
  // One step of a full border row chosen too early makes n^2/2 entries, here 40 GB.
  const int n = 100000;
  SparseMatrix J = singular_laplacian(n);
  Borders borders(n, 1);
  borders.columns.setOnes(), borders.rows.setOnes(), borders.corner.setZero();
  const auto solver = klu();
  const Vector b = Vector::Random(n + 1);
  for (double shift : {0.0, -1e-8, -1e-3}) {
    for (int i = 0; i < n; ++i) J.coeffRef(i, i) += shift;
    REQUIRE(solver->factorize(J, borders));
    Vector x = b;
    solver->solve(x);
    const Vector r = J * x.head(n) + borders.columns * x[n] - b.head(n);
    CHECK(r.cwiseAbs().maxCoeff() < 1e-15 * few * x.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("KLU's factors stay sparse where F_p is 1e23 at the top of a peak and 1 next to it") {
  // -u'' = p e^u near p = 0: J is a Laplacian with p e^u at its top, F_p = -e^u.
  const int n = 4000;
  SparseMatrix J = singular_laplacian(n);
  Borders borders(n, 1);
  borders.rows.setOnes(), borders.corner.setOnes();
  const auto solver = klu();
  for (const double top : {10.0, 30.0, 53.0}) {
    for (int i = 0; i < n; ++i) borders.columns(i, 0) = -std::exp(top * (1 - std::abs(2.0 * i / n - 1)));
    J.coeffRef(n / 2, n / 2) -= 0.7;
    Vector exact = Vector::Random(n + 1);
    exact[n] *= std::exp(-top);
    const std::size_t before = mallinfo2().uordblks + mallinfo2().hblkhd;
    REQUIRE(solver->factorize(J, borders));
    CAPTURE(top);
    CHECK(mallinfo2().uordblks + mallinfo2().hblkhd < before + 4'000'000);  // full: 100 million
    Vector b(n + 1), x;
    b.head(n) = J * exact.head(n) + borders.columns * exact[n];
    b[n] = exact.sum();
    x = b;
    solver->solve(x);
    const Vector r = J * x.head(n) + borders.columns * x[n] - b.head(n);
    CHECK((r.cwiseAbs().array() / (b.head(n).cwiseAbs().array() + 1)).maxCoeff() < 1e-12);
    CHECK(std::abs(x.sum() - b[n]) < 1e-9);
  }
}

TEST_CASE("another pattern with as many entries is a new pattern") {
  const int n = 30;
  const auto shifted = [](int by) {
    SparseMatrix J(n, n);
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, 2 + 0.1 * i);
      entries.emplace_back(i, (i + by) % n, -1);
    }
    J.setFromTriplets(entries.begin(), entries.end());
    return J;
  };
  // The same entries in other columns: the row indices in their order are those of the diagonal, both times.
  SparseMatrix first(2, 2), second(2, 2);
  first.insert(0, 0) = 1, first.insert(0, 1) = 2, first.insert(1, 1) = 3;
  second.insert(0, 0) = 1, second.insert(1, 0) = 2, second.insert(1, 1) = 3;
  for (const auto& [name, make] : sparse_solvers()) {
    const auto solver = make();
    const auto check = [&](const SparseMatrix& J) {
      const Borders borders = random_borders(static_cast<int>(J.rows()), 1);
      const Vector b = Vector::Random(J.rows() + 1);
      Vector x = b;
      REQUIRE(solver->factorize(J, borders));
      solver->solve(x);
      CHECK(residual(whole(J, borders), x, b) < few);
    };
    for (int by : {1, 2, 7, 1}) check(shifted(by));
    for (int k = 0; k < 2; ++k) {
      check(first);  // not compressed: insert() leaves gaps
      check(second);
    }
  }
}

TEST_CASE("singular and non-finite sparse matrices are refused, and good ones are taken afterwards") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  const int n = 20;
  for (const auto& [name, make] : sparse_solvers()) {
    CAPTURE(name);
    const auto solver = make();
    const SparseMatrix good = random_sparse(n, 5);
    const Borders borders = random_borders(n, 1);
    const auto takes_good = [&] {
      const Vector b = Vector::Random(n + 1);
      Vector x = b;
      if (!solver->factorize(good, borders)) return false;
      solver->solve(x);
      return residual(whole(good, borders), x, b) < few;
    };
    for (double bad : {nan, infinite, -infinite}) {
      SparseMatrix J = good;
      J.valuePtr()[J.nonZeros() / 2] = bad;
      CHECK_FALSE(solver->factorize(J, borders));
      CHECK(takes_good());
      Borders bad_borders = borders;
      bad_borders.columns(3, 0) = bad;
      CHECK_FALSE(solver->factorize(good, bad_borders));
      CHECK(takes_good());
    }
    SparseMatrix zero = good;
    Eigen::Map<Vector>(zero.valuePtr(), zero.nonZeros()).setZero();
    CHECK_FALSE(solver->factorize(zero, borders));
    CHECK(takes_good());
    CHECK_FALSE(solver->factorize(SparseMatrix(n, n), borders));  // structurally
    CHECK(takes_good());
    Borders nothing(n, 1);
    nothing.columns.setZero(), nothing.rows.setZero(), nothing.corner.setZero();
    CHECK_FALSE(solver->factorize(good, nothing));
    CHECK(takes_good());
  }
  for (const Jacobian& J :
       {Jacobian(Matrix::Identity(n, n)), Jacobian(static_cast<const Operator*>(nullptr))})
    CHECK_THROWS_AS(klu()->factorize(J, random_borders(n, 1)), std::invalid_argument);
}

TEST_CASE("more entries than an int counts are an error that says so") {
  SparseMatrix J(1, 1);
  J.insert(0, 0) = 1;
  J.makeCompressed();
  J.outerIndexPtr()[1] = std::numeric_limits<int>::max();  // only counted, never read
  CHECK_THROWS_WITH(klu()->factorize(J, random_borders(1, 1)),
                    "the bordered matrix has 2147483650 entries, more than the 2147483647 that a sparse "
                    "matrix of int indices holds");
}
