// Solutions that are not isolated, for want of a phase condition, and what a trace says of them.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <complex>

using namespace problems;

namespace {

bool names_symmetry(const Branch& branch) {
  return branch.stop.message.find("not isolated") != std::string::npos &&
         branch.stop.message.find("phase condition") != std::string::npos;
}

// (p - |z|^2) z = 0: of each solution z all z e^ia are solutions.
Functions rotations(bool exact) {
  Functions f{.size = 2, .parameters = {parameter("p", 1)}, .residual = [](In u, In p, Out F) {
                F = (p[0] - u.squaredNorm()) * u;
              }};
  if (!exact) return f;
  f.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) {
    J = -2 * u * u.transpose();
    J.diagonal().array() += p[0] - u.squaredNorm();
  };
  f.derivative = [](In u, In, int, Out dF) { dF = u; };
  return f;
}

}  // namespace

TEST_CASE("where solutions are orbits of a symmetry, the end names it and the phase condition") {
  for (const Vector& u : {Vector{{1.0, 0.0}}, Vector{{0.6, 0.8}}, Vector{{0.61, 0.77}}})
    for (const bool branch_points : {false, true}) {
      std::vector<Monitor> monitors{fold_monitor()};
      if (branch_points) monitors.push_back(branch_point_monitor());
      const Branch branch =
          trace(from_functions(rotations(true)), {u, Vector{{1.0}}, 0, 1}, window(0.1, 3), monitors);
      CAPTURE(u, branch_points, branch.stop.message);
      CHECK(branch.stop.reason != StopReason::boundary);
      CHECK(names_symmetry(branch));
    }
  // two coupled rotors, with a Jacobian by differences
  const auto rotors = from_functions(4, {parameter("p", 1)}, [](In u, In p, Out F) {
    const std::complex<double> z(u[0], u[1]), w(u[2], u[3]);
    const auto a = (p[0] - std::norm(z)) * z + 0.3 * (w - z),
               b = (1.2 * p[0] - std::norm(w)) * w + 0.3 * (z - w);
    F << a.real(), a.imag(), b.real(), b.imag();
  });
  const Branch branch =
      trace(rotors, {Vector{{0.6, 0.8, 0.63, 0.84}}, Vector{{1.0}}, 0, 1}, window(0.1, 3), {fold_monitor()});
  CAPTURE(branch.stop.message);
  CHECK(names_symmetry(branch));
}

TEST_CASE("with a phase condition the orbits are a branch, and its ends name no symmetry") {
  // Im z = 0, and the unfolding of the rotation as a further unknown
  const auto fixed = from_functions(3, {parameter("p", 1)}, [](In u, In p, Out F) {
    const double r = p[0] - u[0] * u[0] - u[1] * u[1];
    F << r * u[0] - u[2] * u[1], r * u[1] + u[2] * u[0], u[1];
  });
  const Branch branch =
      trace(fixed, {Vector{{1.0, 0.0, 0.0}}, Vector{{1.0}}, 0, 1}, window(0.1, 3), {fold_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(std::abs(branch.points.back().u[0] - std::sqrt(3.0)) < 1e-12);
  // an end of a branch that has nothing to do with a symmetry
  const auto ends = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) {
    F[0] = std::abs(u[0] - 0.3) + (u[0] - 0.3) - p[0] + (p[0] > 0.5 ? 1 : 0);
  });
  const Branch other = trace(ends, {Vector{{0.4}}, Vector{{0.2}}, 0, 1}, window(0, 1));
  CAPTURE(other.stop.message);
  CHECK(other.stop.message.find("not isolated") == std::string::npos);
}
