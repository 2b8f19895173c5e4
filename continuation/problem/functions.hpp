#pragma once
// A problem made of plain functions:
//
//   auto cusp = from_functions(1, {{"mu", "", 0}, {"lambda", "", 1}},
//       [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); });
//
// and with more of what there is to say about it, by name:
//
//   auto bratu = from_functions({.size = n, .parameters = {{"lambda", "", 0}}, .residual = residual,
//                                .sparse_jacobian = jacobian});
//
// Derivatives that are not given are taken by central differences.

#include <arcslip/continuation/problem/problem.hpp>

#include <functional>
#include <vector>

namespace arcslip::continuation {

/// F(u, p) -> F. To say that (u, p) is outside the domain, leave a NaN in F.
using ResidualFunction = std::function<void(In u, In p, Out F)>;
/// J(u, p) -> n x n.
using JacobianFunction = std::function<void(In u, In p, Eigen::Ref<Matrix> J)>;
/// J(u, p) -> n x n, compressed. J comes as it was left by the last call, so that a function that writes its
/// values only need not make the pattern again, which must not change.
using SparseJacobianFunction = std::function<void(In u, In p, SparseMatrix& J)>;
/// y = J(u, p) x, for a linear solver of the user's that needs no more.
using ApplyFunction = std::function<void(In u, In p, In x, Out y)>;
/// dF/dp_k(u, p) -> n.
using ParameterFunction = std::function<void(In u, In p, int k, Out dF)>;
/// Second derivatives, as Evaluator::second_derivative.
using SecondFunction = std::function<void(In u, In p, In w, In v, In q, Out du, Out dp)>;
/// The smooth piece of F that (u, p) is in, for a piecewise smooth F.
using PieceFunction = std::function<std::uint64_t(In u, In p)>;

/// All that can be said of a problem; what is left out is as in problem.hpp. At most one of the three
/// Jacobians; with none it is dense, by differences.
struct Functions {
  int size = 0;  // n >= 1
  std::vector<Parameter> parameters{};
  ResidualFunction residual{};
  JacobianFunction jacobian{};
  SparseJacobianFunction sparse_jacobian{};
  ApplyFunction apply_jacobian{};
  ApplyFunction apply_transposed_jacobian{};  // beside apply_jacobian, where there is one
  ParameterFunction derivative{};
  SecondFunction second{};
  PieceFunction piece{};
  Vector scales{};  // n, or none: all 1
  MakeLinearSolver linear_solver{};
};

/// Throws std::invalid_argument where something is missing or does not fit.
std::shared_ptr<const Problem> from_functions(Functions functions);

/// The usual few.
std::shared_ptr<const Problem> from_functions(int size, std::vector<Parameter> parameters,
                                              ResidualFunction residual, JacobianFunction jacobian = {},
                                              ParameterFunction derivative = {}, Vector scales = {});

}  // namespace arcslip::continuation
