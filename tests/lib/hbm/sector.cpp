// One sector of a ring next to the waves of the ring in closed form.
#include "catch.hpp"

#include "lib/hbm/complex_amplitude.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/problem.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

using namespace arcslip;
using continuation::Needs;
using continuation::Vector;
using std::numbers::pi;

namespace {

using Complex = std::complex<double>;

// A disk and a blade in each of `sectors`, with parts of every kind between neighbours, of which one spring
// and one damper go from the blade to the next disk, and forces in the harmonics 0 to 3.
scene::Scene coupled_ring(int sectors, int order, const std::string& elements = "", bool full = false,
                          const std::string& harmonics = "") {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "cyclic": {"sectors": )" +
                       std::to_string(sectors) + R"(, "engine_order": )" + std::to_string(order) +
                       (full ? ", \"full\": true" : "") + R"(},
    "dofs": ["disk", "tip"],
    "masses": [{"name": "md", "at": "disk", "value": 2}, {"name": "mt", "at": "tip", "value": 0.7},
               {"name": "mn", "direction": {"tip": 0.6, "next": {"tip": 0.3}}, "value": 0.2}],
    "springs": [{"name": "kd", "at": "disk", "value": 1.5}, {"name": "kb", "between": ["tip", "disk"], "value": 1.1},
                {"name": "kn", "between": ["disk", {"next": "disk"}], "value": 0.8},
                {"name": "ks", "between": [{"next": "disk"}, "tip"], "value": 0.3}],
    "dampers": [{"name": "cd", "at": {"next": "disk"}, "value": 0.04},
                {"name": "cs", "direction": {"tip": 1, "next": {"disk": -0.7}}, "value": 0.05}],
    "damping": [{"name": "all", "type": "rayleigh", "alpha": 0.02, "beta": 0.03},
                {"name": "loss", "type": "loss_factor", "loss_factor": 0.01}]},
    "elements": [)" + elements +
                       R"(],
    "excitation": [{"name": "mean", "at": "tip", "harmonic": 0, "cosine": 0.4},
                   {"name": "f1", "at": "tip", "cosine": 1, "sine": 0.3},
                   {"name": "f2", "at": "disk", "harmonic": 2, "cosine": 0.2},
                   {"name": "f3", "direction": {"tip": 1, "disk": -2}, "harmonic": 3, "sine": 0.5}],
    "harmonics": {"order": 3)" +
                       harmonics + R"(}, "response": {"at": "tip"}})");
}

// Of harmonic n, with the values of ring().
struct Wave {
  Eigen::Matrix2cd Z;
  Eigen::Vector2cd f;

  Wave(double alpha, int n, double w) {
    const double s = n * w;
    const Complex t = std::polar(1.0, -n * alpha);
    const Complex mass(-s * s, s * 0.02), damper(0, s), spring(1, n > 0 ? s * 0.03 + 0.01 : 0);
    Z.setZero();
    const auto add = [&](Complex g, double value, Complex disk, Complex tip) {
      const Eigen::Vector2cd d(disk, tip);
      Z += g * value * d.conjugate() * d.transpose();
    };
    add(mass, 2, 1, 0);
    add(mass, 0.7, 0, 1);
    add(mass, 0.2, 0, 0.6 + 0.3 * t);
    add(spring, 1.5, 1, 0);
    add(spring, 1.1, -1, 1);
    add(spring, 0.8, 1.0 - t, 0);
    add(spring, 0.3, t, -1);
    add(damper, 0.04, t, 0);
    add(damper, 0.05, -0.7 * t, 1);
    f.setZero();
    if (n == 0) f[1] = 0.4;
    if (n == 1) f[1] = Complex(1, -0.3);
    if (n == 2) f[0] = 0.2;
    if (n == 3) f = Eigen::Vector2cd(Complex(0, 1), Complex(0, -0.5));
  }
};

struct Linear {
  model::Model model;
  hbm::Coordinates coordinates;
  hbm::DynamicStiffness stiffness;
  Vector p;

  explicit Linear(const scene::Scene& s)
      : model(model::build(s)),
        coordinates(hbm::coordinates(model, 1)),
        stiffness(model, coordinates, model.harmonics),
        p(model::defaults(model)) {}
};

}  // namespace

TEST_CASE("a linear sector answers as the travelling wave of its ring in closed form, in every harmonic") {
  for (const int sectors : {2, 5, 24})
    for (const int order : {0, 1, sectors / 2, sectors - 1, sectors + 2, -3}) {
      Linear ring_of(coupled_ring(sectors, order));
      const auto& h = ring_of.model.harmonics;
      REQUIRE(ring_of.coordinates.unknowns == 1);
      for (const double w : {0.05, 0.7, 1.3, 8.0}) {
        ring_of.p[model::frequency] = w;
        REQUIRE(ring_of.stiffness.move_to(ring_of.p));
        Vector u(h.size()), x(h.size());
        ring_of.stiffness.force(u);
        ring_of.stiffness.solve(u);
        ring_of.stiffness.response(u, 1, x);
        double loss = 0;
        for (int n = 0; n <= 3; ++n) {
          CAPTURE(sectors, order, w, n);
          const Wave wave(2 * pi * order / sectors, n, w);
          const Eigen::Vector2cd X = wave.Z.partialPivLu().solve(wave.f);
          CHECK(std::abs(scenes::complex_amplitude(h, x, n) - X[1]) < 1e-12 * X.norm());
          loss += pi * n * (X.adjoint() * wave.Z * X).value().imag();
          const auto forms = ring_of.stiffness.quadratic_forms(n, u, 1);
          CHECK(std::abs(forms.force - (X.adjoint() * wave.f).value()) < 1e-12 * X.norm() * wave.f.norm());
        }
        CHECK(ring_of.stiffness.viscous_energy(u, 1) == Approx(loss).epsilon(1e-12));
      }
    }
}

TEST_CASE("the derivatives of a linear sector are those of differences, and its products those transposed") {
  Linear at(coupled_ring(7, 2));
  const Eigen::Index c = at.model.harmonics.size();
  std::srand(3);
  const Vector u = Vector::Random(c), a = Vector::Random(c);
  at.p[model::frequency] = 0.9;
  Vector dR(c), dx(c), plus(c), minus(c), x_plus(c), x_minus(c);
  for (Eigen::Index k = 0; k < at.p.size(); ++k) {
    CAPTURE(k, at.model.parameters[static_cast<std::size_t>(k)].name);
    REQUIRE(at.stiffness.move_to(at.p));
    at.stiffness.parameter_derivative(static_cast<int>(k), u, 1, dR);
    at.stiffness.response_derivative(static_cast<int>(k), u, 1, dx);
    const double step = 1e-6;
    Vector p = at.p;
    p[k] += step;
    REQUIRE(at.stiffness.move_to(p));
    at.stiffness.residual(u, 1, plus);
    at.stiffness.response(u, 1, x_plus);
    p[k] -= 2 * step;
    REQUIRE(at.stiffness.move_to(p));
    at.stiffness.residual(u, 1, minus);
    at.stiffness.response(u, 1, x_minus);
    CHECK((dR - (plus - minus) / (2 * step)).norm() < 1e-8 * (1 + dR.norm()));
    CHECK((dx - (x_plus - x_minus) / (2 * step)).norm() < 1e-8 * (1 + dx.norm()));
  }
  REQUIRE(at.stiffness.move_to(at.p));
  Vector x(c), g(c), from_rest(c);
  at.stiffness.response(u, 0, x);
  at.stiffness.response_transposed(a, g);
  CHECK(std::abs(a.dot(x) - g.dot(u)) < 1e-13);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(c, c);
  at.stiffness.add_to(J);
  at.stiffness.residual(u, 0, from_rest);
  CHECK((J * u - from_rest).norm() < 1e-13 * J.norm());
  CHECK((J - J.transpose()).norm() > 1e-3 * J.norm());
}

TEST_CASE("with the sectors numbered the other way round, the response is another one") {
  Linear one(coupled_ring(7, 2)), other(coupled_ring(7, -2));
  for (Linear* at : {&one, &other}) {
    at->p[model::frequency] = 1.3;
    REQUIRE(at->stiffness.move_to(at->p));
  }
  const Eigen::Index c = one.model.harmonics.size();
  Vector u(c), v(c);
  one.stiffness.force(u);
  one.stiffness.solve(u);
  other.stiffness.force(v);
  other.stiffness.solve(v);
  CHECK((u - v).norm() > 1e-3 * u.norm());
}

TEST_CASE("dR/du and dR/dp with elements between sectors are those of central differences") {
  const std::string elements = R"(
    {"name": "j", "type": "jenkins", "between": ["tip", {"next": "tip"}], "stiffness": 0.6,
     "friction_coefficient": 0.4, "normal_load": 0.9},
    {"name": "c", "type": "cubic_spring", "direction": {"disk": 0.5, "next": {"tip": -1, "disk": 0.2}},
     "stiffness": 0.2},
    {"name": "g", "type": "gap_spring", "at": "tip", "stiffness": 0.5, "gap": 0.3},
    {"name": "p", "type": "contact_2d", "tangential": {"between": ["tip", {"next": "disk"}]},
     "normal": {"at": {"next": "tip"}}, "tangential_stiffness": 0.5, "normal_stiffness": 0.8,
     "friction_coefficient": 0.4, "normal_load": 0.6})";
  for (const int order : {0, 2, 5}) {
    const auto model = std::make_shared<const model::Model>(model::build(coupled_ring(9, order, elements)));
    REQUIRE_FALSE(model->harmonics.odd);
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    CHECK(problem.coordinates().unknowns == 2);
    const auto at = problem.hbm_evaluator();
    std::srand(7);
    const Vector u = Vector::Random(problem.size()), p = hbm::parameters_at(problem, 1.1);
    REQUIRE(at->move_to(u, p, Needs::jacobian) == continuation::Evaluated::ok);
    const auto J = std::get<Eigen::MatrixXd>(at->jacobian());
    Vector dR(problem.size());
    const auto piece = at->piece();
    const auto difference = [&](const Vector& du, const Vector& dp) -> std::optional<Vector> {
      constexpr double step = 1e-6;
      at->move_to(u + step * du, p + step * dp, Needs::residual);
      const Vector plus = at->residual();
      const bool kink = at->piece() != piece;
      at->move_to(u - step * du, p - step * dp, Needs::residual);
      if (kink || at->piece() != piece) return {};
      return Vector((plus - at->residual()) / (2 * step));
    };
    int checked = 0;
    const Vector no_du = Vector::Zero(u.size()), no_dp = Vector::Zero(p.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const auto found = difference(Vector::Unit(u.size(), i), no_dp);
      if (!found) continue;
      ++checked;
      CHECK((*found - J.col(i)).norm() < 1e-7 * J.norm());
    }
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      at->move_to(u, p, Needs::jacobian);
      at->parameter_derivative(static_cast<int>(k), dR);
      const auto found = difference(no_du, Vector::Unit(p.size(), k));
      if (!found) continue;
      ++checked;
      CAPTURE(k);
      CHECK((*found - dR).norm() < 1e-7 * (1 + dR.norm()));
    }
    CHECK(checked > u.size());
    at->move_to(u, p, Needs::jacobian);
    Vector Ju(u.size());
    at->apply_jacobian(u, Ju);
    CHECK((Ju - J * u).norm() < 1e-13 * J.norm() * u.norm());
    Eigen::MatrixXd J_2(2 * problem.blocks(), 2 * problem.blocks());
    at->jacobian_of_order(2, J_2);
    const auto& h = problem.harmonics();
    for (int i = 0; i < problem.blocks(); ++i)
      for (int j = 0; j < problem.blocks(); ++j)
        CHECK(std::abs(J_2(2 * i, 2 * j + 1) - J(i * h.size() + h.cosine_index(2),
                                                 j * h.size() + h.sine_index(2))) < 1e-14 * J.norm());
  }
}

// The motion of all sectors from that of one, in the coefficients of `h`.
Vector later(const elements::Harmonics& h, const Vector& x, double angle) {
  Vector moved = x;
  for (int j = 0; j < h.sines(); ++j) {
    const int n = h.sine_order(j);
    const Complex X = scenes::complex_amplitude(h, x, n) * std::polar(1.0, -n * angle);
    moved[h.cosine_index(n)] = X.real();
    moved[h.sine_index(n)] = -X.imag();
  }
  return moved;
}

TEST_CASE("the response of one sector, spread over the ring, solves the equations of the full ring") {
  constexpr int sectors = 8;  // by which the samples of laws that are sampled are divided
  const std::string friction = R"({"name": "j", "type": "jenkins", "between": ["tip", {"next": "tip"}],
    "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 0.9})";
  const std::string gap = R"({"name": "g", "type": "gap_spring", "between": ["tip", "disk"], "stiffness": 1,
    "gap": 0.4})";
  const std::string contact =
      R"({"name": "p", "type": "contact_2d", "tangential": {"between": ["tip", {"next": "disk"}]},
    "normal": {"direction": {"tip": -1, "next": {"tip": 0.5}}}, "tangential_stiffness": 0.5, "normal_stiffness": 0.3,
    "friction_coefficient": 0.4, "normal_load": 0.6})";
  const std::string memory = R"({"name": "b", "type": "bouc_wen", "between": ["disk", {"next": "tip"}],
    "stiffness": 0.3, "elastic_share": 0.2, "yield_displacement": 0.6})";
  for (const std::string& elements : {friction, friction + ", " + gap, contact, memory + ", " + friction})
    for (const int order : {0, 1, 3, 4, 7, -2}) {
      CAPTURE(elements, order);
      const std::string sampled =
          elements.starts_with(memory) ? R"(, "friction": "sampled", "samples": 512)" : "";
      const auto one = std::make_shared<const model::Model>(
          model::build(coupled_ring(sectors, order, elements, false, sampled)));
      const auto all = std::make_shared<const model::Model>(
          model::build(coupled_ring(sectors, order, elements, true, sampled)));
      const auto problem = std::make_shared<const hbm::HbmProblem>(one, one->harmonics, 1, 1);
      const hbm::HbmProblem full(all, all->harmonics, 1, 1);
      const Vector p = hbm::parameters_at(*problem, 0.9);
      const auto u = hbm::steady_state(problem, p).u;
      REQUIRE(u);
      const auto at = problem->hbm_evaluator();
      REQUIRE(at->move_to(*u, p, Needs::residual) == continuation::Evaluated::ok);
      const auto& h = problem->harmonics();
      const Eigen::MatrixXd x = at->stiffness().motion(problem->coordinates().P, *u, 1);
      const double alpha = 2 * pi * order / sectors;
      Eigen::MatrixXd spread(h.size(), 2 * sectors);
      for (int j = 0; j < sectors; ++j)
        for (int dof = 0; dof < 2; ++dof) spread.col(dof * sectors + j) = later(h, x.col(dof), j * alpha);
      const Eigen::MatrixXd y =
          full.coordinates().P.partialPivLu().solve(Eigen::MatrixXd(spread.transpose()));
      Vector v(full.size());
      const int r = full.coordinates().unknowns, own = problem->coordinates().unknowns;
      for (int i = 0; i < r; ++i) v.segment(i * h.size(), h.size()) = y.row(i);
      for (int i = own; i < problem->blocks(); ++i)
        for (int j = 0; j < sectors; ++j)
          v.segment((r + (i - own) * sectors + j) * h.size(), h.size()) =
              later(h, u->segment(i * h.size(), h.size()), j * alpha);
      const auto there = full.hbm_evaluator();
      REQUIRE(there->move_to(v, hbm::parameters_at(full, 0.9), Needs::residual) ==
              continuation::Evaluated::ok);
      CHECK(there->residual().norm() < 1e-11);
      CHECK(there->stiffness().viscous_energy(v, 1) ==
            Approx(sectors * at->stiffness().viscous_energy(*u, 1)).epsilon(1e-11));
      // Not so with the sectors numbered the other way round.
      if (2 * order % sectors == 0) continue;
      for (int i = own; i < problem->blocks(); ++i) v.tail(v.size() - r * h.size()).setZero();
      for (int j = 0; j < sectors; ++j)
        for (int dof = 0; dof < 2; ++dof) spread.col(dof * sectors + j) = later(h, x.col(dof), -j * alpha);
      const Eigen::MatrixXd back =
          full.coordinates().P.partialPivLu().solve(Eigen::MatrixXd(spread.transpose()));
      for (int i = 0; i < r; ++i) v.segment(i * h.size(), h.size()) = back.row(i);
      there->move_to(v, hbm::parameters_at(full, 0.9), Needs::residual);
      CHECK(there->residual().norm() > 0.01);
    }
}
