#pragma once
// A problem made of plain functions:
//
//   auto cusp = from_functions(1, {{"mu", "", 0}, {"lambda", "", 1}},
//       [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); });
//
// Derivatives that are not given are taken by central differences.

#include <arcslip/continuation/problem.hpp>

#include <functional>
#include <vector>

namespace arcslip::continuation {

/// F(u, p) -> F. To say that (u, p) is outside the domain, leave a NaN in F.
using ResidualFunction = std::function<void(In u, In p, Out F)>;
/// J(u, p) -> n x n.
using JacobianFunction = std::function<void(In u, In p, Eigen::Ref<Eigen::MatrixXd> J)>;
/// dF/dp_k(u, p) -> n.
using ParameterFunction = std::function<void(In u, In p, int k, Out dF)>;

/// Throws std::invalid_argument where size < 1 or the residual is empty.
std::shared_ptr<const Problem> from_functions(int size, std::vector<Parameter> parameters,
                                              ResidualFunction residual, JacobianFunction jacobian = {},
                                              ParameterFunction derivative = {}, Vector scales = {});

}  // namespace arcslip::continuation
