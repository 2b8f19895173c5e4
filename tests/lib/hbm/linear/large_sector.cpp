// Large sectors, sparse and dense.
#include "catch.hpp"

#include "lib/hbm/linear/answers.hpp"
#include "lib/hbm/linear/reaching.hpp"

#include <arcslip/hbm/linear/sparsity_pattern.hpp>
#include <arcslip/hbm/problem.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

using namespace arcslip;
using continuation::Vector;
using model::LinearKind;
using scenes::in_matrices, scenes::Reaching;
using std::numbers::pi;

namespace {

// A row of masses in each sector, linked in some places to the next one, with one of them seen by an element,
// and gyroscopic forces between neighbours. dense: the same with matrices of zeros that link all of them.
model::Model long_sector(int dofs, int sectors, int order, bool reach, bool matrices, bool dense) {
  std::string names, masses, springs, dampers;
  const auto add = [](std::string& to, const std::string& what) { to += (to.empty() ? "" : ", ") + what; };
  for (int i = 0; i < dofs; ++i) {
    const std::string n = std::to_string(i), before = std::to_string(i - 1);
    const std::string along =
        i > 0 ? R"("between": ["x)" + n + R"(", "x)" + before + R"("])" : std::string(R"("at": "x0")");
    add(names, "\"x" + n + "\"");
    add(masses, R"({"name": "m)" + n + R"(", "at": "x)" + n + R"(", "value": )" +
                    std::to_string(1 + 0.3 * (i % 3)) + "}");
    add(springs, R"({"name": "k)" + n + R"(", )" + along + R"(, "value": 1e4})");
    add(dampers, R"({"name": "c)" + n + R"(", )" + along + R"(, "value": 2})");
    if (i % 10 == 3 && reach)
      add(springs, R"({"name": "n)" + n + R"(", "between": ["x)" + n + R"(", {"next": "x)" +
                       std::to_string(i - 3) + R"("}], "value": 3e3})");
  }
  const std::string last = "\"x" + std::to_string(dofs - 1) + "\"";
  model::Model model =
      model::build(scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "cyclic": {"sectors": )" + std::to_string(sectors) +
                                 R"(, "engine_order": )" + std::to_string(order) + R"(},
    "dofs": [)" + names + R"(], "masses": [)" +
                                 masses + R"(], "springs": [)" + springs + R"(], "dampers": [)" + dampers +
                                 R"(]}, "elements": [{"name": "j", "type": "jenkins", "at": )" + last +
                                 R"(, "stiffness": 1e3, "friction_coefficient": 0.5, "normal_load": 2}],
    "excitation": [{"name": "f", "at": "x)" +
                                 std::to_string(dofs / 2) + R"(", "cosine": 1}],
    "harmonics": {"order": 5}, "response": {"at": "x)" +
                                 std::to_string(dofs / 3) + R"("}})"));
  if (matrices) model = in_matrices(model, 1);
  Reaching G{Eigen::MatrixXd::Zero(dofs, dofs), Eigen::MatrixXd::Zero(dofs, dofs),
             Eigen::MatrixXd::Zero(dofs, dofs)};
  for (int i = 0; i + 1 < dofs; ++i) G.own(i, i + 1) = 3, G.own(i + 1, i) = -3;
  if (reach) G.next(3, 5) = 2, G.previous(5, 3) = -2;
  model.matrices.push_back(G.part(LinearKind::damper, -1, sectors, false));
  if (!reach) model.matrices.back().waves = nullptr;
  if (dense) {
    model.matrices.push_back({LinearKind::spring, model::frequency,
                              std::make_shared<const Eigen::MatrixXd>(Eigen::MatrixXd::Ones(dofs, dofs))});
    model.matrices.back().scale = 1e300;
  }
  return model;
}

Eigen::Index nonzeros(const model::Model& model) {
  const hbm::Coordinates c = hbm::coordinates(model, 1);
  const hbm::LinearParts parts(model, c.P, model.harmonics);
  return parts.pattern().nonZeros();
}

}  // namespace

TEST_CASE("a large sector responds the same whether its matrices are taken as sparse or as dense") {
  constexpr int dofs = 60;
  for (const bool reach : {false, true})
    for (const bool matrices : {false, true}) {
      CAPTURE(reach, matrices);
      std::vector<Vector> found;
      for (const bool dense : {false, true}) {
        const model::Model model = long_sector(dofs, 7, 2, reach, matrices, dense);
        const hbm::Coordinates coordinates = hbm::coordinates(model, 1);
        const hbm::ComplexSparse pattern = hbm::LinearParts(model, coordinates.P, model.harmonics).pattern();
        const hbm::ComplexSparse of_linear = pattern.bottomRightCorner(dofs - 1, dofs - 1);
        CHECK(hbm::sparse_is_cheaper_than_lu(of_linear) == !dense);
        found.push_back(scenes::answers(model, coordinates));
      }
      CHECK((found[0] - found[1]).norm() < 1e-10 * found[0].norm());
    }
}

TEST_CASE("coordinates that no element sees are links of the structure and nothing else") {
  constexpr int dofs = 60;
  const model::Model model = long_sector(dofs, 7, 2, true, true, false);
  // Each mass with its neighbours, and six links to the next sector and back next to that of the gyroscopic
  // one.
  CHECK(nonzeros(model) == dofs + 2 * (dofs - 1) + 2 * 6 + 2);
}

TEST_CASE("an undamped resonance of the linear coordinates of a large sector is found, sparse or dense") {
  constexpr int dofs = 60;
  for (const bool dense : {false, true}) {
    model::Model model = long_sector(dofs, 7, 0, false, false, dense);
    model.dampers.clear();
    model.matrices.front().number = static_cast<int>(model.parameters.size());
    model.parameters.push_back({"speed", "-", 0, 1, 0, 1});
    for (auto& mass : model.masses) model.parameters[static_cast<std::size_t>(mass.number.parameter())].value = 1;
    hbm::DynamicStiffness stiffness(model, hbm::coordinates(model, 1), model.harmonics);
    Vector p = model::defaults(model);
    // 59 masses between two walls, for the last one stands still.
    p[model::frequency] = 2 * 100 * std::sin(pi / 2 * 7 / dofs);
    CHECK_FALSE(stiffness.move_to(p));
    p[model::frequency] *= 1 + 1e-6;
    CHECK(stiffness.move_to(p));
  }
}
