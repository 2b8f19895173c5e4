#pragma once
// Problems with branch points in closed form, for their location and their curves.

#include "continuation/problems.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/special_points/branch_point.hpp>

#include <Eigen/Dense>

namespace problems {

using Type = BranchPoint::Type;
inline constexpr int lambda = 0;

// The normal forms (lambda - c^2) u - u^2 and - u^3, imperfect by epsilon, of an amplitude.
struct NormalForm {
  int power = 3;
  double value(double u, In p) const { return (p[0] - p[2] * p[2]) * u - std::pow(u, power) + p[1]; }
  double slope(double u, In p) const { return p[0] - p[2] * p[2] - power * std::pow(u, power - 1); }
};

inline std::vector<Parameter> normal_form_parameters() {
  return {parameter("lambda", 0), parameter("epsilon", 0), parameter("c", 0)};
}

inline std::shared_ptr<const Problem> normal_form(int power) {
  const NormalForm f{power};
  return from_functions(
      1, normal_form_parameters(), [=](In u, In p, Out F) { F[0] = f.value(u[0], p); },
      [=](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = f.slope(u[0], p); });
}

// The normal form of y_0 with stable unknowns y_i that follow it, y_i = y_0^2 + sin(i) lambda, in the
// coordinates u = T y + shift, its equations mixed by S.
struct Embedded {
  int n, power;
  Matrix T, S, T_inverse;
  Vector shift;

  Embedded(int size, int k) : n(size), power(k) {
    std::srand(7u + static_cast<unsigned>(n));
    T = Matrix::Random(n, n) / std::sqrt(n) + Matrix::Identity(n, n);
    S = Matrix::Random(n, n) / std::sqrt(n) + Matrix::Identity(n, n);
    T_inverse = T.inverse();
    shift = Vector::Random(n);
  }
  std::shared_ptr<const Problem> problem() const {
    const Embedded e = *this;
    const NormalForm f{power};
    return from_functions(
        n, normal_form_parameters(),
        [=](In u, In p, Out F) {
          const Vector y = e.T_inverse * (u - e.shift);
          Vector f_y(e.n);
          f_y[0] = f.value(y[0], p);
          for (int i = 1; i < e.n; ++i) f_y[i] = y[0] * y[0] + std::sin(i) * p[0] - y[i];
          F = e.S * f_y;
        },
        [=](In u, In p, Eigen::Ref<Matrix> J) {
          const Vector y = e.T_inverse * (u - e.shift);
          Matrix J_y = -Matrix::Identity(e.n, e.n);
          J_y.col(0).setConstant(2 * y[0]);
          J_y(0, 0) = f.slope(y[0], p);
          J = e.S * J_y * e.T_inverse;
        },
        [=](In u, In p, int k, Out dF) {
          const Vector y = e.T_inverse * (u - e.shift);
          Vector f_y = Vector::Zero(e.n);
          f_y[0] = k == 0 ? y[0] : k == 1 ? 1 : -2 * p[2] * y[0];
          for (int i = 1; i < e.n && k == 0; ++i) f_y[i] = std::sin(i);
          dF = e.S * f_y;
        });
  }
  // d(u, lambda) of dy_0 and dlambda, at y_0 = 0, of length 1.
  Vector tangent(double dy, double dlambda) const {
    Vector y(n);
    y[0] = dy;
    for (int i = 1; i < n; ++i) y[i] = std::sin(i) * dlambda;
    Vector t(n + 1);
    t << T * y, dlambda;
    return t.normalized();
  }
  // On the branch y_0 = 0, u at lambda.
  Vector trivial(double at) const {
    Vector y(n);
    y[0] = 0;
    for (int i = 1; i < n; ++i) y[i] = std::sin(i) * at;
    return T * y + shift;
  }
};

inline Vector join(const Vector& u, double p) {
  Vector x(u.size() + 1);
  x << u, p;
  return x;
}

// A solver without transposed solves.
class ForwardOnly final : public LinearSolver {
 public:
  const char* name() const override { return "dense LU without transpose"; }
  bool factorize(const Jacobian& J, const Borders& borders) override { return lu_->factorize(J, borders); }
  void solve(Out x) const override { lu_->solve(x); }
  std::optional<int> determinant_sign() const override { return lu_->determinant_sign(); }

 private:
  std::unique_ptr<LinearSolver> lu_ = dense_lu();
};

inline MakeLinearSolver forward_only() {
  return [] { return std::make_unique<ForwardOnly>(); };
}

inline std::optional<BranchPoint> describe(const Problem& problem,
                                           const std::optional<BranchPointLocation>& at,
                                           const Vector& tangent) {
  if (!at) return {};
  return describe_branch_point(problem, lambda, *at, tangent);
}

}  // namespace problems
