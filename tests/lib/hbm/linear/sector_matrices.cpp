// Matrices of a sector that reach into the next one, next to the same parts in the scene and next to sums
// entry by entry.
#include "catch.hpp"

#include "lib/hbm/complex_amplitude.hpp"
#include "lib/hbm/linear/reaching.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/unresolved_resonances.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

using namespace arcslip;
using continuation::Needs;
using continuation::Vector;
using model::LinearKind;
using scenes::in_matrices, scenes::Reaching, scenes::ring;
using std::numbers::pi;

namespace {

using Complex = std::complex<double>;

const std::string friction = R"({"name": "j", "type": "jenkins", "between": ["tip", {"next": "tip"}],
  "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 0.9},
  {"name": "c", "type": "cubic_spring", "direction": {"tip": 0.5, "next": {"tip": -1}}, "stiffness": 0.2})";

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
        each(kind, Eigen::MatrixXcd(part.number.value(at) * d.conjugate() * d.transpose()));
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
          const Eigen::VectorXcd X = continuation::solve_complex(Z, at.force(n, p));
          CHECK(std::abs(scenes::complex_amplitude(h, x, n) - X[2]) < 1e-11 * X.norm());
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
          all += part.number.value(p) * along.conjugate() * along.transpose();
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
