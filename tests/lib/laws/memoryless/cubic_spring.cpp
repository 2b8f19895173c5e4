#include "catch.hpp"

#include <arcslip/laws/memoryless/smooth_laws.hpp>

#include <array>

using namespace arcslip::elements;

TEST_CASE("the cube of a cosine has the coefficients 3/4 and 1/4") {
  for (bool odd : {true, false}) {
    const Harmonics h{3, odd};
    const auto element = cubic_spring().element(h, {});
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    u[h.cosine_index(1)] = 2;
    element->move_to(u, std::array{5.0}, true);
    Eigen::VectorXd F = Eigen::VectorXd::Zero(h.size());
    F[h.cosine_index(1)] = 5 * 8 * 0.75;
    F[h.cosine_index(3)] = 5 * 8 * 0.25;
    CHECK((element->force() - F).norm() < 1e-13);
    Eigen::VectorXd dF(h.size());
    element->field_derivative(0, dF);
    CHECK((dF - F / 5).norm() < 1e-14);
  }
}

TEST_CASE(
    "the cubic spring's Jacobian is exact: F is homogeneous of degree 3, J u = 3 F, and J is symmetric") {
  for (bool odd : {true, false})
    for (int order : {1, 2, 7, 20}) {
      const Harmonics h{order, odd};
      const auto element = cubic_spring().element(h, {});
      const Eigen::VectorXd u = Eigen::VectorXd::Random(h.size());
      element->move_to(u, std::array{2.0}, true);
      const auto& J = element->jacobian();
      CHECK((J * u - 3 * element->force()).norm() < 1e-12 * element->force().norm());
      Eigen::MatrixXd weighted = J;  // the mean's row stands for an integral over 2 pi, the others over pi
      if (!odd) weighted.row(0) *= 2;
      CHECK((weighted - weighted.transpose()).norm() < 1e-12 * J.norm());
      Eigen::VectorXd v = u;
      const Eigen::VectorXd d = Eigen::VectorXd::Random(h.size());
      element->move_to(v, std::array{2.0}, true);
      const Eigen::VectorXd expected = element->jacobian() * d;
      element->move_to(u + 1e-5 * d, std::array{2.0}, false);
      const Eigen::VectorXd plus = element->force();
      element->move_to(u - 1e-5 * d, std::array{2.0}, false);
      CHECK((expected - (plus - element->force()) / 2e-5).norm() < 1e-8 * expected.norm());
    }
}
