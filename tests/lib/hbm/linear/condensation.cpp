#include "catch.hpp"

#include "lib/hbm/linear/answers.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/hbm/linear/dynamic_stiffness.hpp>
#include <arcslip/hbm/linear/sparsity_pattern.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <Eigen/Dense>

#include <complex>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

using namespace arcslip;
using continuation::Vector;

TEST_CASE("unknowns are those of the nonlinear elements: 3 masses, 3 elements in 2 directions, 2 unknowns") {
  const model::Model model = model::build(scenes::chain(5, false));
  const hbm::Coordinates c = hbm::coordinates(model);
  CHECK(c.unknowns == 2);
  CHECK(c.linear() == 1);
  // The unknowns are the displacements along the first two elements; the linear coordinate is seen by none.
  for (int e = 0; e < 3; ++e) {
    const Vector seen = c.P.transpose() * model.elements[static_cast<std::size_t>(e)].directions[0];
    CHECK(std::abs(seen[2]) < 1e-14);
    if (e < 2) CHECK((seen.head(2) - Vector::Unit(2, e)).norm() < 1e-14);
  }
}

TEST_CASE("condensed, with its response, a linear structure answers as the full complex system does") {
  for (const bool even : {false, true}) {
    const scene::Scene s = scenes::chain(5, even);
    const model::Model model = model::build(s);
    const hbm::Coordinates coordinates = hbm::coordinates(model);
    hbm::DynamicStiffness stiffness(model, coordinates, model.harmonics);
    Vector p(model.parameters.size());
    for (std::size_t k = 0; k < model.parameters.size(); ++k)
      p[static_cast<Eigen::Index>(k)] = model.parameters[k].value;
    for (double omega : {0.05, 0.9, 1.3, 7.0}) {
      p[model::frequency] = omega;
      REQUIRE(stiffness.move_to(p));
      const int c = model.harmonics.size();
      Vector u(2 * c), x(c);
      stiffness.force(u);
      stiffness.solve(u);
      stiffness.response(u, 1, x);
      const auto M = model::mass_matrix(model, p), C = model::damping_matrix(model, p),
                 K = model::stiffness_matrix(model, p);
      for (int n : {1, even ? 2 : 3}) {
        const std::complex<double> i(0, 1);
        const Eigen::MatrixXcd Z =
            (K - n * n * omega * omega * M).cast<std::complex<double>>() + i * (n * omega * C);
        Eigen::VectorXcd f = Eigen::VectorXcd::Zero(3);
        if (n == 1) f[2] = {1, -0.3};
        if (n != 1) f[1] = 0.2;
        const Eigen::VectorXcd X = continuation::solve_complex(Z, f);
        const auto& h = model.harmonics;
        CHECK(std::abs(X[2] - std::complex<double>(x[h.cosine_index(n)], -x[h.sine_index(n)])) <
              1e-13 * X.norm());
      }
      // R of that solution, and its energy: what the dampers take is the work of the force.
      Vector R(2 * c);
      stiffness.residual(u, 1, R);
      CHECK(R.norm() < 1e-13);
    }
  }
}

TEST_CASE("the response's gradient and its change with every parameter are those of differences") {
  const model::Model model = model::build(scenes::chain(4, true));
  hbm::DynamicStiffness stiffness(model, hbm::coordinates(model), model.harmonics);
  Vector p(model.parameters.size());
  for (std::size_t k = 0; k < model.parameters.size(); ++k)
    p[static_cast<Eigen::Index>(k)] = model.parameters[k].value;
  const int c = model.harmonics.size();
  const Vector u = Vector::Random(2 * c), v = Vector::Random(2 * c), a = Vector::Random(c);
  Vector x(c), g(2 * c), plus(c), minus(c), dx(c);
  p[model::frequency] = 0.8;
  stiffness.move_to(p);
  stiffness.response(v, 0, x);
  stiffness.response_transposed(a, g);
  CHECK(std::abs(a.dot(x) - g.dot(v)) < 1e-13);
  int seen = 0;
  for (int k = 0; k < p.size(); ++k) {
    CAPTURE(model.parameters[static_cast<std::size_t>(k)].name);
    Vector q = p;
    stiffness.move_to(q);
    stiffness.response_derivative(k, u, 1, dx);
    q[k] = p[k] + 1e-6;
    stiffness.move_to(q);
    stiffness.response(u, 1, plus);
    q[k] = p[k] - 1e-6;
    stiffness.move_to(q);
    stiffness.response(u, 1, minus);
    CHECK((dx - (plus - minus) / 2e-6).norm() <= 1e-8 * dx.norm());
    if (dx.norm() > 0) ++seen;
  }
  CHECK(seen ==
        7);  // frequency, mc, kbc, kc, cbc, and both parts of the force on c: all that moves c by itself
}

TEST_CASE("a resonance of the condensed part alone, undamped, is no place to evaluate") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"], "masses": [{"name": "ma", "at": "a", "value": 1},
      {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "between": ["a", "b"], "value": 4}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "a", "stiffness": 1}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}], "harmonics": {"order": 1}, "response": {"at": "a"}})");
  const model::Model model = model::build(s);
  hbm::DynamicStiffness stiffness(model, hbm::coordinates(model), model.harmonics);
  Vector p(model.parameters.size());
  for (std::size_t k = 0; k < model.parameters.size(); ++k)
    p[static_cast<Eigen::Index>(k)] = model.parameters[k].value;
  p[model::frequency] = 2;
  CHECK_FALSE(stiffness.move_to(p));
  p[model::frequency] = 2.0000001;
  CHECK(stiffness.move_to(p));
}

namespace {

/// A row of masses to ground, the last one with a friction damper. `linked`: each also to every other one by
/// a spring of zero, which changes nothing but that no entry is left out.
scene::Scene long_chain(int dofs, bool linked) {
  scene::Scene s;
  for (int i = 0; i < dofs; ++i) {
    const std::string n = std::to_string(i);
    s.dofs.push_back("x" + n);
    s.masses.push_back({"m" + n, &scene::mass_type(), {{{i, 1.0}}}, {1 + 0.3 * (i % 3)}});
    const scene::Direction along =
        i > 0 ? scene::Direction{{i, 1.0}, {i - 1, -1.0}} : scene::Direction{{i, 1.0}};
    s.springs.push_back({"k" + n, &scene::spring_type(), {along}, {1e4}});
    s.dampers.push_back({"c" + n, &scene::damper_type(), {along}, {2.0}});
    for (int j = 0; linked && j + 1 < i; ++j)
      s.springs.push_back(
          {"z" + n + "_" + std::to_string(j), &scene::spring_type(), {{{i, 1.0}, {j, -1.0}}}, {0.0}});
  }
  s.elements.push_back({"d", &elements::jenkins(), {{{dofs - 1, 1.0}}}, {1e3, 0.5, 2.0}});
  s.excitation.push_back({"f", &scene::force_type(), {{{dofs / 2, 1.0}}}, {1.0, 0.0}});
  s.harmonics.order = 3;
  s.response() = {{dofs / 3, 1.0}};
  return s;
}

}  // namespace

namespace {

// Of the linear coordinates.
bool is_sparse(const model::Model& model) {
  const hbm::Coordinates c = hbm::coordinates(model);
  hbm::LinearParts parts(model, c.P, model.harmonics);
  return hbm::sparse_is_cheaper(parts.pattern().bottomRightCorner(c.linear(), c.linear()));
}

// The same structure by its matrices, which have parameters of their own.
model::Model in_matrices(model::Model model) {
  const Vector p = model::defaults(model);
  for (const auto kind : {model::LinearKind::mass, model::LinearKind::damper, model::LinearKind::spring})
    model.matrices.push_back({kind, static_cast<int>(model.parameters.size()),
                              std::make_shared<const Eigen::MatrixXd>(model::sum_of(model, kind, p))});
  model.parameters.push_back({"all", "-", 1, 1, 0, 1});
  model.masses.clear();
  model.dampers.clear();
  model.springs.clear();
  return model;
}

}  // namespace

TEST_CASE("a large structure responds the same as parts or matrices, sparse or dense") {
  const int dofs = 100;
  std::vector<Vector> found;
  for (const bool linked : {false, true})
    for (const bool matrices : {false, true}) {
      model::Model model = model::build(long_chain(dofs, linked));
      if (matrices) model = in_matrices(model);
      CHECK(is_sparse(model) == (matrices || !linked));  // a spring of 0 is no entry of a matrix
      found.push_back(scenes::answers(model, hbm::coordinates(model)));
    }
  for (const Vector& other : found) CHECK((found[0] - other).norm() < 1e-10 * found[0].norm());
}

TEST_CASE("a large structure whose linear coordinates resonate undamped has a pole, sparse or dense") {
  for (const bool linked : {false, true}) {
    scene::Scene s = long_chain(100, linked);
    s.dampers.clear();
    for (auto& mass : s.masses) mass.values = {1.0};
    const model::Model model = model::build(s);
    hbm::DynamicStiffness stiffness(model, hbm::coordinates(model), model.harmonics);
    Vector p(model.parameters.size());
    for (std::size_t k = 0; k < model.parameters.size(); ++k)
      p[static_cast<Eigen::Index>(k)] = model.parameters[k].value;
    // 99 masses between two walls, for the last one stands still.
    p[model::frequency] = 2 * 100 * std::sin(std::numbers::pi / 2 * 7 / 100);
    CHECK_FALSE(stiffness.move_to(p));
    p[model::frequency] *= 1 + 1e-6;
    CHECK(stiffness.move_to(p));
  }
}

namespace {

/// Equations of a row of masses, the first of which remain; sizes and links for each way to take out the
/// rest.
struct Row {
  int dofs, unknowns;
  bool linked;
};
constexpr Row no_linear{3, 3, false}, few{7, 2, false}, some{14, 2, true}, dense{40, 3, true},
    sparse{80, 2, false};

struct FullEquation {
  model::Model model;
  hbm::LinearParts parts;
  Vector p;

  explicit FullEquation(const scene::Scene& s)
      : model(model::build(s)),
        parts(model, Eigen::MatrixXd::Identity(model.dofs, model.dofs), model.harmonics) {
    p.resize(static_cast<Eigen::Index>(model.parameters.size()));
    for (std::size_t k = 0; k < model.parameters.size(); ++k)
      p[static_cast<Eigen::Index>(k)] = model.parameters[k].value;
    p[model::frequency] = 40;
    p[model.excitation.front().sine.parameter()] = 0.4;
    for (const auto& damper : model.dampers)
      p[damper.number.parameter()] *= 50;  // so that resonances are wide
  }
  bool condense(hbm::Condensation& condensation, int n, const Vector& at, hbm::Condensed& into) {
    Eigen::VectorXcd f(model.dofs);
    parts.move_to(at);
    parts.force(n, f);
    return condensation.condense(parts.matrices(), parts.factors(n * at[model::frequency]), f, into);
  }
};

}  // namespace

TEST_CASE("a condensed equation has the solution of the full one, whatever its size and its links") {
  for (const Row row : {no_linear, few, some, dense, sparse})
    for (const int n : {1, 3}) {
      CAPTURE(row.dofs, row.unknowns, row.linked, n);
      scene::Scene scene = long_chain(row.dofs, row.linked);
      scene.excitation.front().harmonic = n;
      FullEquation full(scene);
      hbm::Condensation condensation(full.parts, row.unknowns, full.model.response);
      hbm::Condensed condensed;
      REQUIRE(full.condense(condensation, n, full.p, condensed));
      const std::complex<double> i(0, 1);
      const double s = n * full.p[model::frequency];
      const Eigen::MatrixXcd Z =
          (model::stiffness_matrix(full.model, full.p) - s * s * model::mass_matrix(full.model, full.p))
              .cast<std::complex<double>>() +
          i * s * model::damping_matrix(full.model, full.p);
      const Eigen::VectorXcd f =
          std::complex<double>(1, -0.4) * Vector(full.model.excitation.front().direction);
      const Eigen::VectorXcd expected = continuation::solve_complex(Z, 0.7 * f);
      Eigen::VectorXcd y(row.dofs);
      y.head(row.unknowns) = condensed.Z.partialPivLu().solve(0.7 * condensed.f);
      condensed.expand(0.7, y);
      CHECK((y - expected).norm() < 1e-12 * expected.norm());
    }
}

TEST_CASE("a condensed equation and what is observed change with parameters as their differences do") {
  for (const Row row : {no_linear, few, some, dense, sparse}) {
    FullEquation full(long_chain(row.dofs, row.linked));
    hbm::Condensation condensation(full.parts, row.unknowns, full.model.response);
    hbm::Condensed condensed;
    Eigen::VectorXcd y = Eigen::VectorXcd::Random(row.dofs), v(row.dofs);
    const Eigen::VectorXcd q = y.head(row.unknowns);
    const auto& force = full.model.excitation.front();
    const int last = row.dofs - 1;
    for (const int k :
         {model::frequency, full.model.masses.front().number.parameter(),
          full.model.masses[static_cast<std::size_t>(last)].number.parameter(),
          full.model.dampers[static_cast<std::size_t>(last / 2)].number.parameter(),
          full.model.springs[1].number.parameter(), force.cosine.parameter(), force.sine.parameter()}) {
      CAPTURE(row.dofs, row.unknowns, full.model.parameters[static_cast<std::size_t>(k)].name);
      // The condensed residual at q and, last, what is observed.
      const auto at = [&](double value) {
        Vector p = full.p;
        p[k] = value;
        REQUIRE(full.condense(condensation, 1, p, condensed));
        condensed.expand(0.7, y);
        Eigen::VectorXcd both(row.unknowns + 1);
        both << condensed.Z * q - 0.7 * condensed.f, full.model.response.cast<std::complex<double>>().dot(y);
        return both;
      };
      const double step = 1e-5 * full.p[k];
      const Eigen::VectorXcd difference = (at(full.p[k] + step) - at(full.p[k] - step)) / (2 * step);
      at(full.p[k]);
      full.parts.differentiate(k, 1, y, 0.7, v);
      const auto observed = condensed.observed_change(v);
      condensed.project(v);
      const double rounding = 1e-10 / full.p[k];
      CHECK((v.head(row.unknowns) - difference.head(row.unknowns)).norm() <
            1e-7 * difference.norm() + rounding * (condensed.Z * q).norm());
      CHECK(std::abs(observed - difference[row.unknowns]) < 1e-7 * std::abs(observed) + rounding * y.norm());
    }
  }
}

TEST_CASE("a singular block of the linear coordinates is found, whatever its size") {
  for (const Row row : {few, some, dense, sparse}) {
    CAPTURE(row.dofs);
    scene::Scene s = long_chain(row.dofs, row.linked);
    s.dampers.clear();
    for (auto& mass : s.masses) mass.values = {1.0};
    FullEquation full(s);
    hbm::Condensation condensation(full.parts, row.unknowns, full.model.response);
    hbm::Condensed condensed;
    // A row whose one end stands still and whose other end is free.
    const int linear = row.dofs - row.unknowns;
    full.p[model::frequency] = 2 * 100 * std::sin(std::numbers::pi / 2 * 3 / (2 * linear + 1));
    CHECK_FALSE(full.condense(condensation, 1, full.p, condensed));
    full.p[model::frequency] *= 1 + 1e-6;
    CHECK(full.condense(condensation, 1, full.p, condensed));
  }
}
