#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/linear/linear_operator.hpp>

#include <complex>

using namespace arcslip;
using continuation::Vector;

namespace {

using Complex = std::complex<double>;

// Three masses with forces in harmonics 1 and 2, in random coordinates. One parameter is that of a mass, of a
// damper, of a spring and of both parts of a force.
struct Chain {
  model::Model model = model::build(scenes::chain(3, true));
  Eigen::MatrixXd P = Eigen::MatrixXd::Random(3, 3);
  Vector p;

  explicit Chain(bool matrices = false) {
    const int tied = model.masses[0].number.parameter();
    model.dampers[1].number = model.springs[2].number = tied;
    model.excitation[0].cosine = model.excitation[0].sine = tied;
    p.resize(static_cast<Eigen::Index>(model.parameters.size()));
    for (std::size_t k = 0; k < model.parameters.size(); ++k)
      p[static_cast<Eigen::Index>(k)] = model.parameters[k].value;
    p[model::frequency] = 0.8;
    if (matrices) add_matrices();
  }
  // One of each kind, that of the dampers over the tied parameter, further ones over the squares of this and
  // of the frequency, loads with an imaginary part, and proportional damping of all kinds.
  void add_matrices() {
    const auto random = [] {
      const Eigen::MatrixXd A = Eigen::MatrixXd::Random(3, 3);
      return std::make_shared<const Eigen::MatrixXd>(A + A.transpose());
    };
    const int tied = model.masses[0].number.parameter();
    model.matrices = {{model::LinearKind::mass, -1, random()},
                      {model::LinearKind::damper, tied, random()},
                      {model::LinearKind::spring, -1, random()},
                      {model::LinearKind::spring, tied, random(), true, 1.3},
                      {model::LinearKind::spring, model::frequency, random(), true, 2}};
    model.excitation[0].load = Eigen::VectorXd::Random(3);
    model.excitation.push_back(model.excitation[0]);
    model.excitation.back().imaginary = true;
    model.excitation.back().load = Eigen::VectorXd::Random(3);
    const auto first = static_cast<int>(p.size());
    model.damping = {first, first + 1, first + 2};
    for (const double value : {0.3, 0.05, 0.2}) {
      model.parameters.push_back({"damping", "-", value, 1, 0, 1});
      p.conservativeResize(p.size() + 1);
      p[p.size() - 1] = value;
    }
  }
  // K (1 + i s beta + i loss_factor) + M (-s^2 + i s alpha) + i s C
  Eigen::MatrixXcd dynamic_stiffness(double s, const Vector& at) const {
    const auto matrix = [&](model::LinearKind kind) {
      return model::sum_of(model, kind, at).cast<Complex>().eval();
    };
    const double alpha = model.damping ? model.damping->alpha_at(at) : 0;
    const double loss = model.damping ? s * model.damping->beta_at(at) + model.damping->loss_factor_at(at) : 0;
    return Complex(1, loss) * matrix(model::LinearKind::spring) +
           Complex(-s * s, s * alpha) * matrix(model::LinearKind::mass) +
           Complex(0, s) * matrix(model::LinearKind::damper);
  }
  Eigen::VectorXcd force(int n, const Vector& at) const {
    Eigen::VectorXcd f = Eigen::VectorXcd::Zero(3);
    for (const auto& force : model.excitation)
      if (force.harmonic == n) {
        Vector shape = force.direction;
        if (force.load.size() > 0) shape += force.load;
        f += Complex(force.cosine.value(at), -force.sine.value(at)) * (force.imaginary ? Complex(0, 1) : 1.0) * shape;
      }
    return f;
  }
};

}  // namespace

TEST_CASE("the full equation changes with every parameter as its differences do, that of several parts too") {
  const bool matrices = GENERATE(false, true);
  const Chain chain(matrices);
  hbm::LinearParts parts(chain.model, chain.P, chain.model.harmonics);
  parts.move_to(chain.p);
  const Eigen::VectorXcd y = Eigen::VectorXcd::Random(3);
  const Eigen::VectorXcd x = chain.P * y;
  Eigen::VectorXcd v(3);
  int seen = 0;
  for (const int n : {1, 2, 3})
    for (int k = 0; k < chain.p.size(); ++k) {
      CAPTURE(n, chain.model.parameters[static_cast<std::size_t>(k)].name);
      const auto at = [&](double step) {
        Vector p = chain.p;
        p[k] += step;
        const double s = n * p[model::frequency];
        const Eigen::MatrixXcd Z = chain.dynamic_stiffness(s, p);
        return (chain.P.transpose() * (Z * x - 0.7 * chain.force(n, p))).eval();
      };
      parts.differentiate(k, n, y, 0.7, v);
      // Cubic at most: these differences only round.
      const double h = 1e-3;
      CHECK((v - (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)).norm() < 1e-9);
      CHECK((v.norm() == 0 || parts.depend_on(k)));
      if (v.norm() > 0) ++seen;
    }
  CHECK(seen == 3 * (matrices ? 11 : 8) +
                    2);  // frequency, masses, springs, a damper; both parts of the force in harmonic 2
}

TEST_CASE("quadratic forms of a motion are those of the assembled matrices and forces") {
  const Chain chain;
  hbm::LinearParts parts(chain.model, chain.P, chain.model.harmonics);
  parts.move_to(chain.p);
  const Eigen::VectorXcd y = Eigen::VectorXcd::Random(3);
  const Eigen::VectorXcd x = chain.P * y;
  for (const int n : {1, 2, 3}) {
    const hbm::QuadraticForms forms = parts.quadratic_forms(n, y, 0.7);
    CHECK(std::abs(forms.mass - x.dot(model::mass_matrix(chain.model, chain.p) * x)) < 1e-14);
    const double s = n * chain.p[model::frequency];
    CHECK(std::abs(forms.damping - x.dot(chain.dynamic_stiffness(s, chain.p) * x).imag()) < 1e-13);
    CHECK(std::abs(forms.stiffness - x.dot(model::stiffness_matrix(chain.model, chain.p) * x)) < 1e-14);
    CHECK(std::abs(forms.force - 0.7 * x.dot(chain.force(n, chain.p))) < 1e-14);
  }
}
