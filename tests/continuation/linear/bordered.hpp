#pragma once
// Bordered matrices for the tests of their solvers.

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace bordered {

using namespace arcslip::continuation;

inline Borders random_borders(int n, int m) {
  Borders borders(n, m);
  borders.columns.setRandom();
  borders.rows.setRandom();
  borders.corner.setRandom();
  return borders;
}

inline Matrix whole(const Matrix& J, const Borders& borders) {
  const Eigen::Index n = J.rows(), m = borders.width();
  Matrix B(n + m, n + m);
  B << J, borders.columns, borders.rows.transpose(), borders.corner;
  return B;
}

/// With entries below and above its diagonal, at random places.
inline SparseMatrix random_sparse(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::uniform_int_distribution<int> place(0, n - 1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, value(random));
    for (int k = 0; k < 3; ++k) entries.emplace_back(i, place(random), value(random));
  }
  SparseMatrix J(n, n);
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

/// tridiag(-1, 2, -1) less its smallest eigenvalue, 4 sin^2(pi/(2 n + 2)), whose eigenvector is sin(pi i/(n +
/// 1)): singular to rounding.
inline SparseMatrix singular_laplacian(int n) {
  const double s = std::sin(std::numbers::pi / (2 * n + 2));
  SparseMatrix J(n, n);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2 - 4 * s * s);
    if (i > 0) entries.emplace_back(i, i - 1, -1);
    if (i + 1 < n) entries.emplace_back(i, i + 1, -1);
  }
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

/// Rows of J and C, in turn by 1, `scale` and 1/scale.
inline void scale_rows(SparseMatrix& J, Borders& borders, double scale) {
  Vector rows = Vector::Ones(J.rows());
  for (Eigen::Index i = 0; i < rows.size(); ++i) rows[i] = i % 3 == 1 ? scale : i % 3 == 2 ? 1 / scale : 1.0;
  J = SparseMatrix(rows.asDiagonal() * J);
  J.makeCompressed();
  borders.columns = rows.asDiagonal() * borders.columns;
}

/// The largest over the rows of |B x - b| / (|B| |x| + |b|), with |B| the row's sum and |x| the largest
/// entry.
inline double residual(const Matrix& B, const Vector& x, const Vector& b) {
  const Vector sizes = B.cwiseAbs().rowwise().sum() * x.cwiseAbs().maxCoeff() + b.cwiseAbs();
  return (B * x - b).cwiseAbs().cwiseQuotient(sizes).maxCoeff() / std::numeric_limits<double>::epsilon();
}

/// A solver of J alone, from a solver of bordered systems without borders.
class Alone final : public PlainSolver {
 public:
  explicit Alone(std::unique_ptr<LinearSolver> solver) : solver_(std::move(solver)) {}
  const char* name() const override { return solver_->name(); }
  bool prepare(const Jacobian& J) override {
    const auto* sparse = std::get_if<SparseMatrix>(&J);
    const Eigen::Index n = sparse ? sparse->rows() : std::get<Matrix>(J).rows();
    return solver_->factorize(J, Borders(static_cast<int>(n), 0));
  }
  bool solve(In b, Out x) const override {
    x = b;
    solver_->solve(x);
    return x.allFinite();
  }
  bool solve_transposed(In b, Out x) const override {
    x = b;
    return solver_->solve_transposed(x) && x.allFinite();
  }
  std::optional<int> determinant_sign() const override { return solver_->determinant_sign(); }

 private:
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace bordered
