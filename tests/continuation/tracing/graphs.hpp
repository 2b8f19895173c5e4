#pragma once
// Branches that are the graph of a function.

#include "continuation/problems.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace graphs {

using namespace problems;

using Function = std::function<double(double)>;

inline std::shared_ptr<const Problem> graph(const Function& u_of, const Function& slope,
                                            PieceFunction piece = {}) {
  return from_functions({.size = 1,
                         .parameters = {parameter("p", 0)},
                         .residual = [=](In u, In p, Out F) { F[0] = u[0] - u_of(p[0]); },
                         .jacobian = [](In, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1; },
                         .derivative = [=](In, In p, int, Out dF) { dF[0] = -slope(p[0]); },
                         .piece = std::move(piece)});
}

inline Start on(const Function& u_of, double p) {
  return at(u_of(p), p);
}

// Greatest values of u.
inline Monitor peak_of_u() {
  Monitor peak{"peak", [](const Accepted& now) { return now.tangent[0]; }, Crossing::falling};
  peak.quantity = [](const Accepted& now) { return now.u[0]; };
  return peak;
}

}  // namespace graphs
