#include "bordered.hpp"
#include "catch.hpp"

#include <stdexcept>

using namespace bordered;

namespace {

// -u'' + c u on n inner points, applied only; c < 0 may make it indefinite.
class Laplacian final : public Operator {
 public:
  Laplacian(int n, double shift) : n_(n), shift_(shift) {}
  void apply(In x, Out y) const override {
    for (Eigen::Index i = 0; i < n_; ++i)
      y[i] = (2 + shift_) * x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < n_ ? x[i + 1] : 0);
  }
  bool apply_transposed(In x, Out y) const override {
    apply(x, y);
    return true;
  }
  Matrix dense() const {
    Matrix J(n_, n_);
    for (int i = 0; i < n_; ++i) {
      Vector column(n_);
      apply(Vector::Unit(n_, i), column);
      J.col(i) = column;
    }
    return J;
  }

 private:
  int n_;
  double shift_;
};

// Conjugate gradients, to a tolerance.
class ConjugateGradients final : public PlainSolver {
 public:
  ConjugateGradients(double tolerance, int iterations) : tolerance_(tolerance), iterations_(iterations) {}
  const char* name() const override { return "CG"; }
  bool prepare(const Jacobian& J) override {
    J_ = &J;
    return true;
  }
  bool solve(In b, Out x) const override {
    Vector r = b, p = b, Jp(b.size());
    x.setZero();
    double square = r.squaredNorm();
    const double enough = tolerance_ * tolerance_ * square;
    for (int k = 0; k < iterations_ && square > enough; ++k) {
      apply(*J_, p, Jp);
      const double step = square / p.dot(Jp), before = square;
      if (!(p.dot(Jp) > 0)) return false;
      x += step * p;
      r -= step * Jp;
      square = r.squaredNorm();
      p = r + square / before * p;
    }
    return square <= enough;
  }

 private:
  double tolerance_;
  int iterations_;
  const Jacobian* J_ = nullptr;
};

}  // namespace

TEST_CASE("an operator's bordered system is solved to rounding around conjugate gradients to 1e-6") {
  const int n = 200;
  const Laplacian J(n, 0.05);
  for (int m : {1, 2}) {
    const Borders borders = random_borders(n, m);
    const Matrix B = whole(J.dense(), borders);
    const Vector b = Vector::Random(n + m);
    for (double tolerance : {1e-3, 1e-6, 1e-12}) {
      CAPTURE(m, tolerance);
      const auto solver = block_elimination(std::make_unique<ConjugateGradients>(tolerance, 500));
      REQUIRE(solver->factorize(static_cast<const Operator*>(&J), borders));
      Vector x = b, y = b;
      solver->solve(x);
      CHECK(residual(B, x, b) < 10);
      CHECK(std::string(solver->name()) == "block elimination around CG");
      CHECK_FALSE(solver->determinant_sign());  // conjugate gradients do not know it
      CHECK_FALSE(solver->solve_transposed(y));
      CHECK(y == b);
    }
  }
}

TEST_CASE("a plain solver that does not get there is not believed") {
  const int n = 200;
  const Laplacian indefinite(n, -0.5), good(n, 0.05);
  const Borders borders = random_borders(n, 1);
  const auto few = block_elimination(std::make_unique<ConjugateGradients>(1e-6, 5));
  CHECK_FALSE(few->factorize(static_cast<const Operator*>(&good), borders));
  const auto solver = block_elimination(std::make_unique<ConjugateGradients>(1e-6, 500));
  CHECK_FALSE(solver->factorize(static_cast<const Operator*>(&indefinite), borders));
  Vector x = Vector::Ones(n + 1);
  solver->solve(x);
  CHECK_FALSE(x.allFinite());
  REQUIRE(solver->factorize(static_cast<const Operator*>(&good), borders));
  x = Vector::Ones(n + 1);
  solver->solve(x);
  CHECK(x.allFinite());
}

namespace {

// Solves with a matrix that is not the Jacobian: wrong by `error` of the identity.
class Wrong final : public PlainSolver {
 public:
  explicit Wrong(double error) : error_(error) {}
  const char* name() const override { return "wrong"; }
  bool prepare(const Jacobian& J) override {
    const Matrix& exact = std::get<Matrix>(J);
    lu_.compute(exact + error_ * Matrix::Identity(exact.rows(), exact.cols()));
    return true;
  }
  bool solve(In b, Out x) const override {
    x = lu_.solve(b);
    return true;
  }

 private:
  double error_;
  Eigen::PartialPivLU<Matrix> lu_;
};

}  // namespace

TEST_CASE("refinement is on the Jacobian itself, and a solver too far from it gives no numbers") {
  const int n = 30;
  const Matrix J = Laplacian(n, 1.0).dense();
  const Borders borders = random_borders(n, 1);
  const Vector b = Vector::Random(n + 1);
  Vector x = b;
  const auto nearly = block_elimination(std::make_unique<Wrong>(1e-4));
  REQUIRE(nearly->factorize(J, borders));
  nearly->solve(x);
  CHECK(residual(whole(J, borders), x, b) < 10);
  const auto far = block_elimination(std::make_unique<Wrong>(-20.0));
  REQUIRE(far->factorize(J, borders));
  x = b;
  far->solve(x);
  CHECK_FALSE(x.allFinite());
}

namespace {

// Dense LU of J alone, and what it does where a pivot is zero.
class OfDenseJ final : public PlainSolver {
 public:
  enum class At { refuses, throws, divides };
  explicit OfDenseJ(At singular) : singular_(singular) {}
  const char* name() const override { return "dense"; }
  bool prepare(const Jacobian& J) override {
    regular_ = lu_->factorize(J, Borders(static_cast<int>(std::get<Matrix>(J).rows()), 0));
    if (!regular_ && singular_ == At::throws) throw std::runtime_error("zero pivot");
    return regular_ || singular_ == At::divides;
  }
  bool solve(In b, Out x) const override {
    x = b;
    if (!regular_) x /= 0.0;
    if (regular_) lu_->solve(x);
    return true;
  }
  bool solve_transposed(In b, Out x) const override {
    x = b;
    return lu_->solve_transposed(x);
  }
  std::optional<int> determinant_sign() const override { return lu_->determinant_sign(); }

 private:
  At singular_;
  bool regular_ = false;
  std::unique_ptr<LinearSolver> lu_ = dense_lu();
};

// Singular to the last bit: a zero pivot, a row and a column of zeros, a nilpotent matrix, zero, and what
// cancels; in units that differ.
std::vector<Matrix> singular_matrices() {
  Matrix pivot = Matrix::Identity(5, 5), cross = Matrix::Constant(4, 4, 0.5), shift = Matrix::Zero(3, 3);
  pivot(2, 2) = 0;
  cross.diagonal().setLinSpaced(2, 5);
  cross.row(1).setZero();
  cross.col(3).setZero();
  shift(0, 1) = shift(1, 2) = 1;
  Matrix sums(4, 4);
  sums << 1, 2, 3, 4, 2, 4, 6, 8, 1, 0, 2, 0, 0, 1, 0, 2;
  Matrix units = sums;
  units.row(0) *= 0x1p20;
  units.col(2) *= 0x1p-17;
  return {pivot, cross, shift, Matrix::Zero(1, 1), sums, units};
}

}  // namespace

TEST_CASE("block elimination works next to a J that is singular to the last bit, to rounding with J itself") {
  for (const Matrix& J : singular_matrices())
    for (const OfDenseJ::At at : {OfDenseJ::At::refuses, OfDenseJ::At::throws, OfDenseJ::At::divides}) {
      const int n = static_cast<int>(J.rows());
      CAPTURE(n, static_cast<int>(at), J.norm());
      REQUIRE(J.determinant() == 0);
      std::srand(11);
      const int m = n - static_cast<int>(J.fullPivLu().rank());
      const Borders borders = random_borders(n, m);
      const Matrix B = whole(J, borders);
      const auto solver = block_elimination(std::make_unique<OfDenseJ>(at));
      REQUIRE(solver->factorize(J, borders));
      const Vector b = Vector::Random(n + m);
      Vector x = b, y = b;
      solver->solve(x);
      CHECK(residual(B, x, b) < 10);
      REQUIRE(solver->solve_transposed(y));
      CHECK(residual(B.transpose(), y, b) < 10);
      CHECK(solver->determinant_sign() == (B.determinant() > 0 ? 1 : -1));
    }
}

TEST_CASE("but says false where the bordered matrix is singular as well, and throws what its solver throws") {
  for (const Matrix& J : singular_matrices()) {
    const int n = static_cast<int>(J.rows());
    Borders borders(n, 1);  // with J, a row of zeros
    borders.columns.setConstant(1);
    borders.columns = J * borders.columns;
    borders.rows.setRandom();
    borders.corner.setOnes();
    for (const OfDenseJ::At at : {OfDenseJ::At::refuses, OfDenseJ::At::divides})
      CHECK_FALSE(block_elimination(std::make_unique<OfDenseJ>(at))->factorize(J, borders));
    const auto throwing = block_elimination(std::make_unique<OfDenseJ>(OfDenseJ::At::throws));
    CHECK_THROWS_WITH(throwing->factorize(J, borders), "zero pivot");
  }
}

TEST_CASE("block elimination solves to rounding down to a J that is singular to 1e-17") {
  // s, 1, ..., 1 on the diagonal: a solver of J loses all digits along the first unknown.
  const int n = 20;
  const Vector b = Vector::Random(n + 1);
  for (double s : {1e-8, 1e-14, -1e-15, 1e-16, -1e-17}) {
    Matrix J = Matrix::Identity(n, n);
    for (int i = 1; i < n; ++i) J(i, i - 1) = 0.5;
    J(0, 0) = s;
    const Borders borders = random_borders(n, 1);
    const Matrix B = whole(J, borders);
    const auto solver = block_elimination(std::make_unique<Alone>(dense_lu()));
    CAPTURE(s);
    REQUIRE(solver->factorize(J, borders));
    Vector x = b, y = b;
    solver->solve(x);
    CHECK(residual(B, x, b) < 10);
    REQUIRE(solver->solve_transposed(y));
    CHECK(residual(B.transpose(), y, b) < 10);
    CHECK(solver->determinant_sign() == (B.determinant() > 0 ? 1 : -1));
  }
}

TEST_CASE("block elimination needs a solver") {
  CHECK_THROWS_AS(block_elimination(nullptr), std::invalid_argument);
}
