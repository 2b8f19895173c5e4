#pragma once
// A problem made of plain functions:
//
//   auto cusp = from_functions(1, {{"mu", "", 0}, {"lambda", "", 1}},
//       [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); });
//
// and with further properties, by name:
//
//   auto bratu = from_functions({.size = n, .parameters = {{"lambda", "", 0}}, .residual = residual,
//                                .sparse_jacobian = jacobian});
//
// Derivatives that are not given are approximated by central differences, within the smooth piece of F:
// next to a kink by one-sided ones. The step of unknown i is 6e-6 max(|u_i|, scale_i). That of a parameter is
// 6e-6 max(|p|, scale), where the two are within a factor of 10 or F hardly bends over it. Where it may, as
// at p = 1e-6 of a window to 1e6, or at p = 0, steps 1/32 as long follow, down to 6e-6 min(|p|, scale)
// or 1e-12 of the first at p = 0, until two agree to 1e-8; each row of F takes its own. The
// error of dF/dp is that of the rounding of F over the step, and 1e-8 relative, the cost 2 residuals a step.
// The free parameter of a trace has by default the scale of its window.

#include <arcslip/continuation/problem/choices.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace arcslip::continuation {

/// F(u, p) -> F. A NaN in F means that (u, p) is outside the domain.
using ResidualFunction = std::function<void(In u, In p, Out F)>;
/// J(u, p) -> n x n.
using JacobianFunction = std::function<void(In u, In p, Eigen::Ref<Matrix> J)>;
/// J(u, p) -> n x n, compressed. J is passed as the last call left it, so that a function may overwrite the
/// values only. The pattern must not change.
using SparseJacobianFunction = std::function<void(In u, In p, SparseMatrix& J)>;
/// y = J(u, p) x, for a matrix-free linear solver of the user.
using ApplyFunction = std::function<void(In u, In p, In x, Out y)>;
/// dF/dp_k(u, p) -> n.
using ParameterFunction = std::function<void(In u, In p, int k, Out dF)>;
/// Second derivatives, as Evaluator::second_derivative.
using SecondFunction = std::function<void(In u, In p, In w, In v, In q, Out du, Out dp)>;
/// d^order / ds^order F(u + s v, p + s q) at s = 0, order 2 or 3, as Evaluator::directional_derivative.
using DirectionalFunction = std::function<void(int order, In u, In p, In v, In q, Out d)>;
/// The index of the smooth piece of F at (u, p), for a piecewise smooth F.
using PieceFunction = std::function<std::uint64_t(In u, In p)>;

/// Functions that make choices (choices.hpp), in place of those of the same name in `Functions` and of
/// `piece`. The derivatives are called with the choices of the residual at (u, p): they are `made[call]`, and
/// the same calls in the same order make them again.
struct ChoosingFunctions {
  std::function<void(In u, In p, Choices& choose, Out F)> residual{};
  std::function<void(In u, In p, Choices& made, Eigen::Ref<Matrix> J)> jacobian{};
  std::function<void(In u, In p, Choices& made, SparseMatrix& J)> sparse_jacobian{};
  std::function<void(In u, In p, Choices& made, int k, Out dF)> derivative{};
};

/// The functions and properties of a problem; defaults are those of problem.hpp. At most one of the three
/// Jacobians may be given; without one it is dense, by differences.
struct Functions {
  int size = 0;  // n >= 1
  std::vector<Parameter> parameters{};
  ResidualFunction residual{};
  JacobianFunction jacobian{};
  SparseJacobianFunction sparse_jacobian{};
  ApplyFunction apply_jacobian{};
  ApplyFunction apply_transposed_jacobian{};  // optional, with apply_jacobian
  ParameterFunction derivative{};
  SecondFunction second{};
  DirectionalFunction directional{};
  PieceFunction piece{};
  Vector scales{};  // n, or none: all 1
  MakeLinearSolver linear_solver{};
  ChoosingFunctions choosing{};
};

/// The state of a problem after the last accepted point (Problem::initial_state()), as functions see it: one
/// that keeps a copy always sees the present one.
class AcceptedState {
 public:
  explicit AcceptedState(std::shared_ptr<const Vector> values) : values_(std::move(values)) {}
  const Vector& operator*() const { return *values_; }
  double operator[](Eigen::Index i) const { return (*values_)[i]; }
  Eigen::Index size() const { return values_->size(); }

 private:
  std::shared_ptr<const Vector> values_;
};

/// A problem whose F depends on a state that changes with each accepted point: damage, plastic strain, slip.
///
///   StateFunctions spring;
///   spring.initial = Vector::Constant(1, limit);                 // the largest extension so far, at least
///   this spring.functions = [=](AcceptedState largest) {
///     Functions f{.size = 1, .parameters = {{"force", "N"}}};
///     f.choosing.residual = [=](In u, In p, Choices& choose, Out F) {
///       F[0] = softened(choose.max(u[0], largest[0])) * u[0] - p[0];
///     };
///     return f;
///   };
///   spring.next = [](In u, In, In largest, Out next) { next[0] = std::max(u[0], largest[0]); };
struct StateFunctions {
  Vector initial;                                            // before the first point, 1 number or more
  std::function<Functions(AcceptedState)> functions;         // called once for each evaluator
  std::function<void(In u, In p, In state, Out next)> next;  // the state that (u, p) leaves if it is accepted
};

/// Both throw std::invalid_argument if something is missing or inconsistent.
std::shared_ptr<const Problem> from_functions(Functions functions);
std::shared_ptr<const Problem> from_functions(StateFunctions functions);

/// The common case.
std::shared_ptr<const Problem> from_functions(int size, std::vector<Parameter> parameters,
                                              ResidualFunction residual, JacobianFunction jacobian = {},
                                              ParameterFunction derivative = {}, Vector scales = {});

}  // namespace arcslip::continuation
