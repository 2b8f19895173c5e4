#pragma once
// What a linear structure answers, to compare ways to condense it.

#include "catch.hpp"

#include <arcslip/hbm/linear/dynamic_stiffness.hpp>

namespace scenes {

/// Its response to the excitation at several frequencies, the gradient of the response, its derivatives by
/// the frequency, and its energies: of the order of 1.
inline Eigen::VectorXd answers(const arcslip::model::Model& model,
                               const arcslip::hbm::Coordinates& coordinates) {
  using Eigen::VectorXd;
  arcslip::hbm::DynamicStiffness stiffness(model, coordinates, model.harmonics);
  VectorXd p = arcslip::model::defaults(model), all(0);
  const int c = model.harmonics.size();
  for (const double omega : {0.5, 20.0, 95.0, 300.0}) {
    p[arcslip::model::frequency] = omega;
    REQUIRE(stiffness.move_to(p));
    VectorXd u(c), x(c), g(c), dR(c), dx(c);
    stiffness.force(u);
    stiffness.solve(u);
    stiffness.response(u, 1, x);
    stiffness.response_transposed(x, g);
    stiffness.parameter_derivative(arcslip::model::frequency, u, 1, dR);
    stiffness.response_derivative(arcslip::model::frequency, u, 1, dx);
    const auto forms = stiffness.quadratic_forms(1, u, 1);
    all.conservativeResize(all.size() + 4 * c + 3);
    all.tail(4 * c + 3) << x / x.norm(), g / g.norm(), dR / dR.norm(), dx / dx.norm(),
        forms.mass / x.squaredNorm(), forms.stiffness / x.squaredNorm() / 1e4,
        stiffness.viscous_energy(u, 1) / forms.damping;
  }
  return all;
}

}  // namespace scenes
