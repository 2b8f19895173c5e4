#include "catch.hpp"

#include <arcslip/hbm/element_gather.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/model/model.hpp>

#include <cmath>

using namespace arcslip;
using Eigen::MatrixXd, Eigen::VectorXd;

namespace {

// Two blocks of an element over three coordinates, some of them a part of a period ahead.
const std::vector<hbm::ElementMap::Share> shares{
    {0, 0, 1.0}, {0, 2, -0.5, 0.7}, {1, 1, 2.0, -1.9}, {1, 2, 0.3}};

MatrixXd matrix_of(const hbm::ElementMap& map, Eigen::Index unknowns) {
  MatrixXd E(map.size(), unknowns);
  for (Eigen::Index k = 0; k < unknowns; ++k) {
    VectorXd w(map.size());
    map.gather(VectorXd::Unit(unknowns, k), w);
    E.col(k) = w;
  }
  return E;
}

}  // namespace

TEST_CASE("a share with a phase is the motion of its coordinate that much ahead") {
  for (const elements::Harmonics h : {elements::Harmonics{4, false}, elements::Harmonics{5, true}}) {
    const hbm::ElementMap map(shares, 2, h);
    std::srand(1);
    const VectorXd u = VectorXd::Random(3 * h.size());
    VectorXd w(map.size());
    map.gather(u, w);
    for (const double theta : {0.0, 0.4, 3.0}) {
      const auto at = [&](const VectorXd& all, int block, double angle) {
        return elements::series_values(h, all.segment(block * h.size(), h.size()), angle).x;
      };
      CHECK(std::abs(at(w, 0, theta) - at(u, 0, theta) + 0.5 * at(u, 2, theta + 0.7)) < 1e-14);
      CHECK(std::abs(at(w, 1, theta) - 2 * at(u, 1, theta - 1.9) - 0.3 * at(u, 2, theta)) < 1e-14);
    }
  }
}

TEST_CASE("forces and Jacobians go back by the transposed map") {
  for (const elements::Harmonics h : {elements::Harmonics{4, false}, elements::Harmonics{5, true}}) {
    const hbm::ElementMap map(shares, 2, h);
    const Eigen::Index unknowns = 3 * h.size();
    const MatrixXd E = matrix_of(map, unknowns);
    std::srand(2);
    const VectorXd F = VectorXd::Random(map.size());
    VectorXd R = VectorXd::Random(unknowns);
    const VectorXd expected = R + E.transpose() * F;
    map.add(F, R);
    CHECK((R - expected).cwiseAbs().maxCoeff() < 1e-14);
    const MatrixXd J_element = MatrixXd::Random(map.size(), map.size());
    MatrixXd J = MatrixXd::Random(unknowns, unknowns);
    const MatrixXd sum = J + E.transpose() * J_element * E;
    map.add(J_element, J);
    CHECK((J - sum).cwiseAbs().maxCoeff() < 1e-13);
  }
}

TEST_CASE("the Jacobian of one order is that part of the whole one") {
  const elements::Harmonics h{4, false};
  const hbm::ElementMap map(shares, 2, h);
  std::srand(3);
  const MatrixXd J_element = MatrixXd::Random(map.size(), map.size());
  MatrixXd J = MatrixXd::Zero(3 * h.size(), 3 * h.size());
  map.add(J_element, J);
  for (const int n : {1, 3, 4}) {
    MatrixXd J_n = MatrixXd::Ones(6, 6);
    map.add_order(n, J_element, J_n);
    const int place[2] = {h.cosine_index(n), h.sine_index(n)};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        CHECK(std::abs(J_n(i, j) - 1 - J(i / 2 * h.size() + place[i % 2], j / 2 * h.size() + place[j % 2])) <
              1e-14);
  }
}

TEST_CASE("a model keeps of a direction what is not zero: 10 000 springs on 10 000 degrees of freedom") {
  constexpr int n = 10'000;
  scene::Scene s;
  for (int i = 0; i < n; ++i) {
    const std::string number = std::to_string(i);
    s.dofs.push_back("x" + number);
    const scene::Direction along = i > 0 ? scene::Direction{{i, 1}, {i - 1, -1}} : scene::Direction{{i, 1}};
    s.masses.push_back({"m" + number, &scene::mass_type(), {{{i, 1.0}}}, {1}});
    s.springs.push_back({"k" + number, &scene::spring_type(), {along}, {1}});
    if (i % 10 == 0) s.elements.push_back({"d" + number, &elements::jenkins(), {along}, {1, 0.5, 1}});
  }
  s.excitation.push_back({"f", &scene::force_type(), {{{0, 1.0}}}, {1, 0}});
  s.response() = {{0, 1.0}};
  const model::Model model = model::build(s);
  Eigen::Index entries = 0;
  for (const auto& spring : model.springs) entries += spring.direction.nonZeros();
  for (const auto& element : model.elements) entries += element.directions[0].nonZeros();
  CHECK(entries == 2 * n - 1 + 2 * (n / 10) - 1);
  CHECK(model.springs.back().direction.size() == n);
}
