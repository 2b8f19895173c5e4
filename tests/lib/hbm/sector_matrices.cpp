// Matrices of a sector that reach into the next one, beside the same parts in the scene and beside sums entry
// by entry.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/problem.hpp>
#include <arcslip/hbm/sparse_links.hpp>
#include <arcslip/observables/stops.hpp>
#include <arcslip/observables/truncation.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

using namespace arcslip;
using continuation::Needs;
using continuation::Vector;
using model::LinearKind;
using std::numbers::pi;

namespace {

using Complex = std::complex<double>;

// A disk, a blade and its tip in each sector, with parts of every kind to the next one.
scene::Scene ring(int sectors, int order, const std::string& elements, bool odd = false) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "cyclic": {"sectors": )" +
                       std::to_string(sectors) + R"(, "engine_order": )" + std::to_string(order) + R"(},
    "dofs": ["disk", "blade", "tip"],
    "masses": [{"name": "md", "at": "disk", "value": 2}, {"name": "mb", "at": "blade", "value": 0.9},
               {"name": "mt", "at": "tip", "value": 0.7},
               {"name": "mn", "direction": {"tip": 0.6, "next": {"blade": 0.3}}, "value": 0.2}],
    "springs": [{"name": "kd", "at": "disk", "value": 1.5}, {"name": "kb", "between": ["blade", "disk"], "value": 1.1},
                {"name": "kt", "between": ["tip", "blade"], "value": 1.3},
                {"name": "kn", "between": ["disk", {"next": "disk"}], "value": 0.8},
                {"name": "ks", "between": [{"next": "disk"}, "blade"], "value": 0.3}],
    "dampers": [{"name": "cd", "at": {"next": "disk"}, "value": 0.04},
                {"name": "cs", "direction": {"tip": 1, "next": {"disk": -0.7}}, "value": 0.05}],
    "damping": [{"name": "all", "type": "rayleigh", "alpha": 0.02, "beta": 0.03},
                {"name": "loss", "type": "loss_factor", "loss_factor": 0.01}]},
    "elements": [)" + elements +
                       R"(],
    "excitation": [)" + (odd ? "" : R"({"name": "mean", "at": "tip", "harmonic": 0, "cosine": 0.4},
                   {"name": "f2", "at": "disk", "harmonic": 2, "cosine": 0.2},)") +
                       R"(
                   {"name": "f1", "at": "tip", "cosine": 1, "sine": 0.3},
                   {"name": "f3", "direction": {"tip": 1, "disk": -2}, "harmonic": 3, "sine": 0.5}],
    "harmonics": {"order": 3}, "response": {"at": "tip"}})");
}

const std::string friction = R"({"name": "j", "type": "jenkins", "between": ["tip", {"next": "tip"}],
  "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 0.9},
  {"name": "c", "type": "cubic_spring", "direction": {"tip": 0.5, "next": {"tip": -1}}, "stiffness": 0.2})";

// A matrix of a ring, of one sector and between neighbours, in its waves.
struct Reaching {
  Eigen::MatrixXd own, next, previous;

  static Reaching of(const Eigen::VectorXd& d, const Eigen::VectorXd& next) {
    return {d * d.transpose() + next * next.transpose(), d * next.transpose(), next * d.transpose()};
  }
  // sign 1: symmetric, -1: skew-symmetric, 0: neither.
  static Reaching random(int dofs, int sign) {
    Reaching all{Eigen::MatrixXd::Random(dofs, dofs), 0.4 * Eigen::MatrixXd::Random(dofs, dofs),
                 0.4 * Eigen::MatrixXd::Random(dofs, dofs)};
    if (sign == 0) return all;
    all.own = (all.own + sign * all.own.transpose()).eval();
    all.previous = sign * all.next.transpose();
    return all;
  }
  Eigen::MatrixXcd in_wave(int diameter, int count) const {
    const Complex t = std::polar(1.0, -2 * pi * diameter / count);
    return own.cast<Complex>() + t * next + std::conj(t) * previous;
  }
  model::MatrixPart part(LinearKind kind, int parameter, int count, bool symmetric = true) const {
    std::vector<Eigen::MatrixXcd> of_diameter;
    for (int d = 0; 2 * d <= count; ++d) of_diameter.push_back(in_wave(d, count));
    model::MatrixPart made{kind, parameter, std::make_shared<const Eigen::MatrixXd>(own + next + previous)};
    made.symmetric = symmetric;
    made.waves = std::make_shared<const model::WaveMatrices>(count, std::move(of_diameter));
    return made;
  }
};

// The same model with every part, or every second one, as a matrix in waves.
model::Model in_matrices(model::Model model, int of_which) {
  const auto move = [&](LinearKind kind, std::vector<model::LinearPart>& parts) {
    std::vector<model::LinearPart> rest;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if ((k + parts.size()) % static_cast<std::size_t>(of_which) > 0) {
        rest.push_back(parts[k]);
        continue;
      }
      const Vector next = parts[k].next.size() > 0 ? Vector(parts[k].next) : Vector::Zero(model.dofs);
      model.matrices.push_back(
          Reaching::of(parts[k].direction, next).part(kind, parts[k].parameter, model.sector->count));
    }
    parts = rest;
  };
  move(LinearKind::mass, model.masses);
  move(LinearKind::damper, model.dampers);
  move(LinearKind::spring, model.springs);
  model.linked = true;
  return model;
}

// A sector with random matrices of all kinds, and what they are in the ring.
struct Random {
  model::Model model;
  std::vector<Reaching> matrices;
  Vector p;
  int speed;

  Random(int sectors, int order, bool reach = true) : model(model::build(ring(sectors, order, ""))) {
    std::srand(11);
    speed = static_cast<int>(model.parameters.size());
    model.parameters.push_back({"speed", "-", 0.7, 1, 0, 1});
    p = model::defaults(model);
    const auto add = [&](LinearKind kind, int parameter, int sign) -> model::MatrixPart& {
      Reaching matrix = Reaching::random(model.dofs, sign);
      if (!reach) matrix.next.setZero(), matrix.previous.setZero();
      model.matrices.push_back(matrix.part(kind, parameter, sectors, sign == 1));
      if (!reach) model.matrices.back().waves = nullptr;
      matrices.push_back(matrix);
      return model.matrices.back();
    };
    add(LinearKind::mass, -1, 1);
    add(LinearKind::damper, -1, 1);
    add(LinearKind::spring, -1, 1);
    add(LinearKind::spring, -1, 0);
    add(LinearKind::damper, -1, 0);
    add(LinearKind::damper, speed, -1);
    add(LinearKind::circulatory, speed, -1);
    auto& stiffening = add(LinearKind::spring, speed, 1);
    stiffening.squared = true;
    stiffening.scale = 1.3;
    auto& by_frequency = add(LinearKind::spring, model::frequency, 1);
    by_frequency.squared = true;
    by_frequency.scale = 2;
    add(LinearKind::damper, model::frequency, -1).scale = 3;
    model.linked = true;
  }
  // g of kind k at the angular frequency s, and what a harmonic sees of it.
  Complex factor(LinearKind kind, double s, const Vector& at) const {
    const auto& damping = *model.damping;
    if (kind == LinearKind::mass) return {-s * s, s * damping.alpha_at(at)};
    if (kind == LinearKind::damper) return {0, s};
    if (kind == LinearKind::circulatory) return 1;
    return {1, s > 0 ? s * damping.beta_at(at) + damping.loss_factor_at(at) : 0};
  }
  template <class Each>  // kind, value * matrix in the wave of harmonic n
  void for_each(int n, const Vector& at, const Each& each) const {
    const int count = model.sector->count;
    const Complex t = std::polar(1.0, -2 * pi * n * model.sector->engine_order / count);
    const auto parts = [&](LinearKind kind, const std::vector<model::LinearPart>& all) {
      for (const auto& part : all) {
        Eigen::VectorXcd d = Vector(part.direction).cast<Complex>();
        if (part.next.size() > 0) d += t * Vector(part.next);
        each(kind, Eigen::MatrixXcd(at[part.parameter] * d.conjugate() * d.transpose()));
      }
    };
    parts(LinearKind::mass, model.masses);
    parts(LinearKind::damper, model.dampers);
    parts(LinearKind::spring, model.springs);
    for (std::size_t k = 0; k < matrices.size(); ++k)
      each(model.matrices[k].kind,
           Eigen::MatrixXcd(model.matrices[k].value(at) *
                            matrices[k].in_wave(n * model.sector->engine_order, count)));
  }
  Eigen::MatrixXcd dynamic_stiffness(int n, const Vector& at) const {
    Eigen::MatrixXcd Z = Eigen::MatrixXcd::Zero(model.dofs, model.dofs);
    for_each(n, at, [&](LinearKind kind, const Eigen::MatrixXcd& A) {
      Z += factor(kind, n * at[model::frequency], at) * A;
    });
    return Z;
  }
  Eigen::VectorXcd force(int n, const Vector& at) const {
    Eigen::VectorXcd f = Eigen::VectorXcd::Zero(model.dofs);
    for (const auto& force : model.excitation)
      if (force.harmonic == n) f += force.amplitude(at) * Vector(force.direction);
    return f;
  }
};

Complex amplitude(const elements::Harmonics& h, const Vector& x, int n) {
  return {x[h.cosine_index(n)], n > 0 ? -x[h.sine_index(n)] : 0.0};
}

bool same(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance = 1e-12) {
  return (a - b).norm() <= tolerance * b.norm();
}

}  // namespace

TEST_CASE("parts that reach into the next sector are the same as parts and as matrices in waves") {
  for (const int sectors : {2, 5, 24})
    for (const int order : {0, 1, sectors / 2, sectors - 1, sectors + 2, -3})
      for (const bool odd : {false, true})
        for (const int of_which : {1, 2}) {
          CAPTURE(sectors, order, odd, of_which);
          const auto of_parts =
              std::make_shared<const model::Model>(model::build(ring(sectors, order, friction, odd)));
          REQUIRE(of_parts->harmonics.odd == odd);
          const auto of_matrices = std::make_shared<const model::Model>(in_matrices(*of_parts, of_which));
          const hbm::HbmProblem one(of_parts, of_parts->harmonics, 1, 1),
              other(of_matrices, of_parts->harmonics, 1, 1);
          REQUIRE(one.coordinates().linear() == 2);
          const auto a = one.hbm_evaluator(), b = other.hbm_evaluator();
          std::srand(5);
          const Vector u = Vector::Random(one.size());
          for (const double w : {0.6, 1.7}) {
            const Vector p = hbm::parameters_at(one, w);
            REQUIRE(a->move_to(u, p, Needs::jacobian) == continuation::Evaluated::ok);
            REQUIRE(b->move_to(u, p, Needs::jacobian) == continuation::Evaluated::ok);
            CHECK(same(b->residual(), a->residual()));
            CHECK(same(std::get<Eigen::MatrixXd>(b->jacobian()), std::get<Eigen::MatrixXd>(a->jacobian())));
            Vector of_a(u.size()), of_b(u.size());
            const auto &stiffness = a->stiffness(), &found = b->stiffness();
            const int c = one.harmonics().size();
            Vector x_a(c), x_b(c);
            stiffness.response(u, 1, x_a);
            found.response(u, 1, x_b);
            CHECK(same(x_b, x_a));
            for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(of_parts->parameters.size()); ++k) {
              CAPTURE(of_parts->parameters[static_cast<std::size_t>(k)].name);
              a->parameter_derivative(static_cast<int>(k), of_a);
              b->parameter_derivative(static_cast<int>(k), of_b);
              CHECK((of_a - of_b).norm() <= 1e-12 * (1 + of_a.norm()));
              stiffness.response_derivative(static_cast<int>(k), u, 1, x_a);
              found.response_derivative(static_cast<int>(k), u, 1, x_b);
              CHECK((x_a - x_b).norm() <= 1e-12 * (1 + x_a.norm()));
            }
            CHECK(found.viscous_energy(u, 1) == Approx(stiffness.viscous_energy(u, 1)).epsilon(1e-12));
            for (int n = odd ? 1 : 0; n <= 3; n += odd ? 2 : 1) {
              const auto expected = stiffness.quadratic_forms(n, u, 1),
                         forms = found.quadratic_forms(n, u, 1);
              CHECK(forms.mass == Approx(expected.mass).epsilon(1e-12));
              CHECK(forms.stiffness == Approx(expected.stiffness).epsilon(1e-12));
              CHECK(std::abs(forms.damping - expected.damping) <= 1e-12 * std::abs(expected.stiffness));
              CHECK(std::abs(forms.force - expected.force) <= 1e-12 * (1 + std::abs(expected.force)));
            }
          }
          const Vector own = model::defaults(*of_parts);
          CHECK(observables::highest_natural_frequency(*of_matrices, own) ==
                Approx(observables::highest_natural_frequency(*of_parts, own)).epsilon(1e-12));
        }
}

TEST_CASE("the equation of a harmonic has the matrices of its wave, whatever their symmetry") {
  for (const bool reach : {true, false})
    for (const int sectors : {2, 7, 12})
      for (const int order : {0, 1, sectors / 2, sectors - 1, -2}) {
        const Random at(sectors, order, reach);
        const int dofs = at.model.dofs;
        const Eigen::MatrixXd P = Eigen::MatrixXd::Random(dofs, dofs);
        const Eigen::VectorXcd y = Eigen::VectorXcd::Random(dofs), x = P * y;
        hbm::LinearParts parts(at.model, P, at.model.harmonics);
        REQUIRE_FALSE(parts.symmetric());
        hbm::ComplexSparse Z = parts.pattern();
        for (const double w : {0.8, 2.1}) {
          Vector p = at.p;
          p[model::frequency] = w;
          parts.move_to(p);
          for (int n = 0; n <= 3; ++n) {
            CAPTURE(reach, sectors, order, w, n);
            const double s = n * w;
            const Eigen::MatrixXcd of_x = at.dynamic_stiffness(n, p);
            const Eigen::MatrixXcd expected = P.transpose() * of_x * P;
            parts.dynamic_stiffness(n, Z);
            CHECK((Eigen::MatrixXcd(Z) - expected).norm() < 1e-13 * expected.norm());
            // Of Hermitian and skew-Hermitian parts.
            Complex mass = 0, stiffness = 0, skew = 0;
            at.for_each(n, p, [&](LinearKind kind, const Eigen::MatrixXcd& A) {
              if (kind == LinearKind::mass) mass += x.dot(0.5 * (A + A.adjoint()) * x);
              if (kind == LinearKind::spring) stiffness += x.dot(0.5 * (A + A.adjoint()) * x);
              skew += at.factor(kind, s, p) * x.dot(0.5 * (A - A.adjoint()) * x);
            });
            const hbm::QuadraticForms forms = parts.quadratic_forms(n, y, 0.7);
            const double size = expected.norm() * y.squaredNorm();
            CHECK(std::abs(forms.mass - mass) < 1e-13 * size);
            CHECK(std::abs(forms.stiffness - stiffness) < 1e-13 * size);
            CHECK(std::abs(forms.gyroscopic - skew.real()) < 1e-13 * size);
            CHECK(std::abs(forms.damping - x.dot(of_x * x).imag()) < 1e-13 * size);
            CHECK(std::abs(forms.force - 0.7 * x.dot(at.force(n, p))) < 1e-13 * size);
            Eigen::VectorXcd v(dofs);
            for (int k = 0; k < p.size(); ++k) {
              CAPTURE(at.model.parameters[static_cast<std::size_t>(k)].name);
              const auto change = [&](double step) {
                Vector q = p;
                q[k] += step;
                return (P.transpose() * (at.dynamic_stiffness(n, q) * x - 0.7 * at.force(n, q))).eval();
              };
              parts.differentiate(k, n, y, 0.7, v);
              // Cubic at most: these differences only round.
              const double h = 1e-2;
              CHECK(
                  (v - (8 * (change(h) - change(-h)) - (change(2 * h) - change(-2 * h))) / (12 * h)).norm() <
                  1e-11 * size);
              CHECK((v.norm() == 0 || parts.depend_on(k)));
            }
          }
        }
      }
}

TEST_CASE(
    "a linear sector with matrices of all kinds answers as its ring in closed form, in every harmonic") {
  for (const int sectors : {2, 7, 12})
    for (const int order : {0, 1, sectors / 2, sectors - 1, sectors + 2, -3}) {
      const Random at(sectors, order);
      hbm::DynamicStiffness stiffness(at.model, hbm::coordinates(at.model, 1), at.model.harmonics);
      const auto& h = at.model.harmonics;
      for (const double w : {0.3, 1.1}) {
        Vector p = at.p;
        p[model::frequency] = w;
        REQUIRE(stiffness.move_to(p));
        Vector u(h.size()), x(h.size());
        stiffness.force(u);
        stiffness.solve(u);
        stiffness.response(u, 1, x);
        double loss = 0, size = 0;
        for (int n = 0; n <= 3; ++n) {
          CAPTURE(sectors, order, w, n);
          const Eigen::MatrixXcd Z = at.dynamic_stiffness(n, p);
          const Eigen::VectorXcd X = Z.partialPivLu().solve(at.force(n, p));
          CHECK(std::abs(amplitude(h, x, n) - X[2]) < 1e-11 * X.norm());
          loss += pi * n * X.dot(Z * X).imag();
          size += Z.norm() * X.squaredNorm();
        }
        CHECK(std::abs(stiffness.viscous_energy(u, 1) - loss) < 1e-12 * size);
      }
    }
}

TEST_CASE("the highest natural frequency of a sector with gyroscopic matrices is that of its waves") {
  for (const bool reach : {false, true}) {
    constexpr int sectors = 7, order = 2;
    const Reaching gyroscopic = Reaching::random(3, -1);
    model::Model model = model::build(ring(sectors, order, ""));
    const model::Model plain = model;
    Reaching G = gyroscopic;
    if (!reach) G.next.setZero(), G.previous.setZero();
    model.matrices.push_back(G.part(LinearKind::damper, -1, sectors, false));
    if (!reach) model.matrices.back().waves = nullptr;
    const Vector p = model::defaults(model);
    double highest = 0;
    for (int d = 0; d < sectors; ++d) {
      const Complex t = std::polar(1.0, -2 * pi * d / sectors);
      const auto sum = [&](const std::vector<model::LinearPart>& parts) {
        Eigen::MatrixXcd all = Eigen::MatrixXcd::Zero(3, 3);
        for (const auto& part : parts) {
          Eigen::VectorXcd along = Vector(part.direction).cast<Complex>();
          if (part.next.size() > 0) along += t * Vector(part.next);
          all += p[part.parameter] * along.conjugate() * along.transpose();
        }
        return all;
      };
      Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(6, 6);
      const auto M = sum(plain.masses).partialPivLu();
      A.topRightCorner(3, 3).setIdentity();
      A.bottomLeftCorner(3, 3) = -M.solve(sum(plain.springs));
      A.bottomRightCorner(3, 3) = -M.solve(G.in_wave(d, sectors));
      highest = std::max(highest,
                         Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(A).eigenvalues().cwiseAbs().maxCoeff());
    }
    CHECK(observables::highest_natural_frequency(model, p) == Approx(highest).epsilon(1e-11));
  }
}

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
        hbm::DynamicStiffness stiffness(model, coordinates, model.harmonics);
        Vector p = model::defaults(model);
        const int c = model.harmonics.size();
        Vector all(0);
        for (const double omega : {0.5, 20.0, 95.0, 300.0}) {
          p[model::frequency] = omega;
          REQUIRE(stiffness.move_to(p));
          Vector u(c), x(c), g(c), dR(c), dx(c);
          stiffness.force(u);
          stiffness.solve(u);
          stiffness.response(u, 1, x);
          stiffness.response_transposed(x, g);
          stiffness.parameter_derivative(model::frequency, u, 1, dR);
          stiffness.response_derivative(model::frequency, u, 1, dx);
          all.conservativeResize(all.size() + 4 * c);
          all.tail(4 * c) << x / x.norm(), g / g.norm(), dR / dR.norm(), dx / dx.norm();
        }
        found.push_back(all);
      }
      CHECK((found[0] - found[1]).norm() < 1e-10);
    }
}

TEST_CASE("coordinates that no element sees are links of the structure and nothing else") {
  constexpr int dofs = 60;
  const model::Model model = long_sector(dofs, 7, 2, true, true, false);
  // Each mass with its neighbours, and six links to the next sector and back beside that of the gyroscopic
  // one.
  CHECK(nonzeros(model) == dofs + 2 * (dofs - 1) + 2 * 6 + 2);
}

TEST_CASE("an undamped resonance of the linear coordinates of a large sector is found, sparse or dense") {
  constexpr int dofs = 60;
  for (const bool dense : {false, true}) {
    model::Model model = long_sector(dofs, 7, 0, false, false, dense);
    model.dampers.clear();
    model.matrices.front().parameter = static_cast<int>(model.parameters.size());
    model.parameters.push_back({"speed", "-", 0, 1, 0, 1});
    for (auto& mass : model.masses) model.parameters[static_cast<std::size_t>(mass.parameter)].value = 1;
    hbm::DynamicStiffness stiffness(model, hbm::coordinates(model, 1), model.harmonics);
    Vector p = model::defaults(model);
    // 59 masses between two walls, for the last one stands still.
    p[model::frequency] = 2 * 100 * std::sin(pi / 2 * 7 / dofs);
    CHECK_FALSE(stiffness.move_to(p));
    p[model::frequency] *= 1 + 1e-6;
    CHECK(stiffness.move_to(p));
  }
}

namespace {

// Friction that jumps by a given ratio to the bend of its motion.
class Jump : public elements::Element {
 public:
  explicit Jump(double ratio) : ratio_(ratio) {}
  void move_to(elements::In, std::span<const double>, bool) override {}
  const Eigen::VectorXd& force() const override { return none_; }
  const Eigen::MatrixXd& jacobian() const override { return no_rates_; }
  void field_derivative(int, elements::Out dF) const override { dF.setZero(); }
  double jump_over_bend() const override { return ratio_; }

 private:
  double ratio_;
  Eigen::VectorXd none_;
  Eigen::MatrixXd no_rates_;
};

}  // namespace

namespace {

const std::string between = R"({"name": "j", "type": "jenkins", "between": ["tip", {"next": "blade"}],
  "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 0.9})";

}  // namespace

TEST_CASE(
    "motions of a sector that shares masses stop below the inertia of the ring, of all that stop at once") {
  for (const int sectors : {2, 5, 6})
    for (const int order : {0, 1, 2, 3})
      for (const bool matrices : {false, true}) {
        CAPTURE(sectors, order, matrices);
        model::Model model = model::build(ring(sectors, order, between));
        if (matrices) model = in_matrices(model, 2);
        const Vector p = model::defaults(model);
        // In the ring.
        const int n = model.dofs, shift = sectors / std::gcd(order, sectors);
        Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n * sectors, n * sectors);
        const model::Model of_parts = model::build(ring(sectors, order, between));
        Vector force = Vector::Zero(n * sectors), first = force;
        for (int j = 0; j < sectors; ++j) {
          const auto here = Eigen::seqN(j * n, n), next = Eigen::seqN((j + 1) % sectors * n, n);
          const auto in_ring = [&](const model::Direction& d, const model::Direction& of_next) {
            Vector whole = Vector::Zero(n * sectors);
            whole(here) += Vector(d);
            if (of_next.size() > 0) whole(next) += Vector(of_next);
            return whole;
          };
          for (const auto& mass : of_parts.masses) {
            const Vector d = in_ring(mass.direction, mass.next);
            M += p[mass.parameter] * d * d.transpose();
          }
          const Vector d = in_ring(model.elements[0].directions[0], model.elements[0].next[0]);
          if (j == 0) first = d;
          if (j % shift == 0) force += d;
        }
        const double expected = 1 / first.dot(M.ldlt().solve(force));
        observables::Stops stops(model);
        Vector at = p;
        at[model::frequency] = 2;
        CHECK(stops.at_reversals(Jump(4 * expected * (1 + 1e-12)), 0, at));
        CHECK_FALSE(stops.at_reversals(Jump(4 * expected * (1 - 1e-12)), 0, at));
      }
}
