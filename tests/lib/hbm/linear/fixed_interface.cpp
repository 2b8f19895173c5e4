// Linear coordinates that are fixed-interface modes, next to factorizations of the matrices.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/linear/dynamic_stiffness.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <complex>
#include <map>
#include <numbers>
#include <string>
#include <utility>

using namespace arcslip;
using continuation::Vector;

namespace {

constexpr int chain_dofs = 40;
constexpr double typical = 60;  // rad/s

enum class Damping { none, proportional, few_dampers };

/// A chain with two friction dampers, a massless and a floating degree of freedom, forces in harmonics 1
/// and 3.
scene::Scene chain(Damping damping, int length = chain_dofs) {
  scene::Scene s;
  const auto part = [](const std::string& name, const scene::PartType& type, scene::Direction along,
                       double value) { return scene::Part{name, &type, {std::move(along)}, {value}}; };
  for (int i = 0; i < length; ++i) {
    const std::string n = std::to_string(i);
    s.dofs.push_back("x" + n);
    const scene::Direction along = i > 0 && i + 1 < length ? scene::Direction{{i, 1.0}, {i - 1, -1.0}}
                                   : i > 0                 ? scene::Direction{}
                                                           : scene::Direction{{i, 1.0}};
    if (i != 9) s.masses.push_back(part("m" + n, scene::mass_type(), {{i, 1.0}}, 1 + 0.3 * (i % 3)));
    if (along.empty()) continue;  // the last one has no spring
    s.springs.push_back(part("k" + n, scene::spring_type(), along, 1e4 + 300 * (i % 7)));
    if (damping == Damping::proportional)
      s.dampers.push_back(part("c" + n, scene::damper_type(), along, 2e-4 * (1e4 + 300 * (i % 7))));
    if (damping == Damping::few_dampers && i % 8 == 3)
      s.dampers.push_back(part("c" + n, scene::damper_type(), along, 20 + i));
  }
  s.elements.push_back({"d", &elements::jenkins(), {{{5, 1.0}, {20, -1.0}}}, {1e3, 0.5, 2.0}});
  s.elements.push_back({"e", &elements::jenkins(), {{{30, 1.0}}}, {1e3, 0.5, 2.0}});
  for (const int n : {1, 3})
    s.excitation.push_back(
        {"f" + std::to_string(n), &scene::force_type(), {{{7 * n, 1.0}, {20, 0.3}}}, {1.0 / n, 0.4}, n});
  s.harmonics.order = 3;
  s.response() = {{length - 4, 1.0}, {2, -0.5}};
  return s;
}

struct Structure {
  std::shared_ptr<const model::Model> model;
  hbm::Coordinates coordinates;
  hbm::DynamicStiffness stiffness;

  Structure(const scene::Scene& s, bool modal)
      : model(std::make_shared<model::Model>(model::build(s))),
        coordinates(hbm::coordinates(*model, modal ? typical : 0)),
        stiffness(*model, coordinates, model->harmonics) {}

  /// Everything that is read off at p, each kind of quantity over its largest: far from the contacts some are
  /// many decades smaller.
  Vector at(const Vector& p, const Vector& u) {
    REQUIRE(stiffness.move_to(p));
    Vector all(0);
    const auto add = [&](const Vector& v, double size) {
      all.conservativeResize(all.size() + v.size());
      all.tail(v.size()) = v / size;
    };
    const Eigen::Index c = model->harmonics.size();
    Vector R(u.size()), x(c), g(u.size());
    stiffness.residual(u, 0.7, R);
    add(R, R.norm());
    stiffness.force(R);
    add(R, 1);
    R = u;
    stiffness.solve(R);
    add(R, R.norm());
    for (int place = 0; place < stiffness.places(); ++place) {
      stiffness.response(u, 0.7, x, place);
      add(x, u.norm());
    }
    stiffness.response_transposed(Vector::LinSpaced(c, 1, 2), g);
    add(g, 1);
    add(stiffness.motion(coordinates.P, u, 0.7).reshaped(), u.norm());
    const hbm::QuadraticForms forms = stiffness.quadratic_forms(3, u, 0.7);
    const double size = std::max(forms.mass * 9 * p[model::frequency] * p[model::frequency], forms.stiffness);
    add(Vector{{forms.mass, forms.damping, forms.stiffness, forms.force.real()}},
        std::max({forms.mass, forms.damping, forms.stiffness}));
    add(Vector::Constant(1, stiffness.viscous_energy(u, 0.7)), size);
    std::map<std::string, std::pair<Vector, Vector>> by_unit;
    for (int k = 0; k < p.size(); ++k) {
      stiffness.parameter_derivative(k, u, 0.7, R);
      auto& [residuals, responses] = by_unit[model->parameters[static_cast<std::size_t>(k)].unit];
      const auto append = [](Vector& list, const Vector& v) {
        list.conservativeResize(list.size() + v.size());
        list.tail(v.size()) = v;
      };
      append(residuals, R);
      for (int place = 0; place < stiffness.places(); ++place) {
        stiffness.response_derivative(k, u, 0.7, x, place);
        append(responses, x);
      }
    }
    for (const auto& [unit, derivatives] : by_unit)
      for (const Vector* of : {&derivatives.first, &derivatives.second})
        add(*of, std::max(of->cwiseAbs().maxCoeff(), 1e-6));  // m/N and more, if not 0
    return all;
  }
};

}  // namespace

TEST_CASE("with fixed-interface modes a structure is the same, for proportional and for few dampers") {
  for (const Damping damping : {Damping::none, Damping::proportional, Damping::few_dampers})
    for (const int more_contacts : {0, 10}) {
      scene::Scene s = chain(damping);
      for (int i = 10; i < 10 + more_contacts; ++i)
        s.elements.push_back({"d" + std::to_string(i), &elements::jenkins(), {{{i, 1.0}}}, {1e3, 0.5, 2.0}});
      Structure modal(s, true), direct(s, false);
      REQUIRE(modal.coordinates.modes);
      CHECK(modal.coordinates.modes->damped == (damping != Damping::few_dampers));
      CHECK_FALSE(direct.coordinates.modes);
      Vector p = model::defaults(*modal.model);
      const Vector u = Vector::Random(modal.coordinates.unknowns * modal.model->harmonics.size());
      for (const double omega : {0.3, 21.0, 64.0, 900.0}) {
        CAPTURE(static_cast<int>(damping), more_contacts, omega);
        p[model::frequency] = omega;
        CHECK((modal.at(p, u) - direct.at(p, u)).cwiseAbs().maxCoeff() < 1e-9);
      }
    }
}

TEST_CASE("with fixed-interface modes and many contacts a place is the same whatever places were before") {
  scene::Scene s = chain(Damping::proportional);
  for (int i = 10; i < 20; ++i)
    s.elements.push_back({"d" + std::to_string(i), &elements::jenkins(), {{{i, 1.0}}}, {1e3, 0.5, 2.0}});
  s.springs.push_back({"hold", &scene::spring_type(), {{{chain_dofs - 1, 1.0}}}, {5e3}});  // for a mean
  s.excitation.push_back({"mean", &scene::force_type(), {{{25, 1.0}}}, {2.0, 0.0}, 0});
  Structure modal(s, true), direct(s, false);
  REQUIRE(modal.coordinates.modes);
  const Vector u = Vector::Random(modal.coordinates.unknowns * modal.model->harmonics.size());
  Vector p = model::defaults(*modal.model);
  const auto check = [&](const std::string& parameter, double factor) {
    const auto& all = modal.model->parameters;
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == parameter; });
    REQUIRE(at != all.end());
    p[at - all.begin()] *= factor;
    CAPTURE(parameter, factor);
    CHECK((modal.at(p, u) - direct.at(p, u)).cwiseAbs().maxCoeff() < 1e-9);
  };
  p[model::frequency] = 64;
  check("k7.value", 1);
  check("mean.cosine", 3);
  for (const double omega : {21.0, 30.0, 64.0}) {  // the mean stays
    p[model::frequency] = omega;
    check("mean.cosine", 1);
  }
  check("mean.cosine", 0.5);
  check("k7.value", 1.25);
  p[model::frequency] = 21;
  check("mean.cosine", 0.5);
  check("k7.value", 0.8);
  check("d12.normal_load", 2);
}

TEST_CASE("fixed-interface modes have the same digits in units of mass and force 512 times as large") {
  scene::Scene s = chain(Damping::proportional);
  const Structure one(s, true);
  for (auto* parts : {&s.masses, &s.springs, &s.dampers})
    for (scene::Part& part : *parts) part.values[0] *= 512;
  for (scene::Part& jenkins : s.elements)
    for (const int field : {0, 2}) jenkins.values[static_cast<std::size_t>(field)] *= 512;
  const Structure other(s, true);
  REQUIRE((one.coordinates.modes && other.coordinates.modes));
  const auto &modes = *one.coordinates.modes, &heavier = *other.coordinates.modes;
  CHECK(modes.of_linear == heavier.of_linear);
  for (const auto of :
       {&hbm::FixedInterfaceModes::M, &hbm::FixedInterfaceModes::C, &hbm::FixedInterfaceModes::K}) {
    CHECK((512 * (modes.*of).ll).eval() == (heavier.*of).ll);
    CHECK((512 * (modes.*of).lq).eval() == (heavier.*of).lq);
  }
}

TEST_CASE("an evaluation with large factors asks for a stop before each harmonic, and fails after one") {
  const auto model = std::make_shared<model::Model>(model::build(chain(Damping::few_dampers, 140)));
  int asked = 0;
  model->control = controls::polled([&] { return ++asked < 2; });
  const hbm::Coordinates coordinates = hbm::coordinates(*model, 0);
  hbm::DynamicStiffness stopped(*model, coordinates, model->harmonics);
  Vector p = model::defaults(*model);
  p[model::frequency] = typical;
  CHECK_FALSE(stopped.move_to(p));
  CHECK(asked == 2);
  model->control = controls::polled([&] { return ++asked < 5; });
  hbm::DynamicStiffness stiffness(*model, coordinates, model->harmonics);
  REQUIRE(stiffness.move_to(p));
  CHECK(asked == 4);
  model->control = {};
  hbm::DynamicStiffness unasked(*model, coordinates, model->harmonics);
  REQUIRE(unasked.move_to(p));
  const Vector u = Vector::Random(coordinates.unknowns * model->harmonics.size());
  Vector R(u.size()), expected(u.size());
  stiffness.residual(u, 1, R);
  unasked.residual(u, 1, expected);
  CHECK(R == expected);
}

TEST_CASE("with fixed-interface modes a structure on a moving ground is the same, at all of its places") {
  scene::Scene s = chain(Damping::none);
  s.damping.push_back({"r", &scene::rayleigh_type(), {}, {0.3, 2e-4}});
  scene::Direction all;
  for (int i = 0; i < chain_dofs; ++i) all.push_back({i, 1.0});
  for (const int n : {1, 3})
    s.excitation.push_back({"g" + std::to_string(n),
                            n == 1 ? &scene::base_acceleration_type() : &scene::base_displacement_type(),
                            {all},
                            {0.02, 0.01},
                            n});
  s.responses.front().others = {{{0, 1.0}}, {{20, 1.0}, {21, -1.0}}};
  s.responses.front().frame = scene::Frame::absolute;
  Structure modal(s, true), direct(s, false);
  REQUIRE(modal.coordinates.modes);
  REQUIRE(modal.stiffness.places() == 3);
  Vector p = model::defaults(*modal.model);
  const Vector u = Vector::Random(modal.coordinates.unknowns * modal.model->harmonics.size());
  for (const double omega : {0.3, 21.0, 64.0, 900.0}) {
    CAPTURE(omega);
    p[model::frequency] = omega;
    CHECK((modal.at(p, u) - direct.at(p, u)).cwiseAbs().maxCoeff() < 1e-9);
  }
  p[modal.model->springs[4].number.parameter()] *= 3;  // a change next to the modes
  CHECK((modal.at(p, u) - direct.at(p, u)).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("parts that change next to the modes are exact, a few by their rank and many by a factorization") {
  const scene::Scene s = chain(Damping::few_dampers);
  Structure modal(s, true), direct(s, false);
  const Vector u = Vector::Random(modal.coordinates.unknowns * modal.model->harmonics.size());
  Vector p = model::defaults(*modal.model);
  p[model::frequency] = 47;
  const model::Model& m = *modal.model;
  const auto check = [&] { CHECK((modal.at(p, u) - direct.at(p, u)).cwiseAbs().maxCoeff() < 1e-9); };
  p[m.springs[4].number.parameter()] = 0;
  p[m.springs[12].number.parameter()] *= 1e3;
  check();
  p[m.masses[3].number.parameter()] *= 30;
  p[m.dampers[1].number.parameter()] = 500;
  check();
  for (const auto& spring : m.springs) p[spring.number.parameter()] *= 1.1;
  check();
  p.segment(1, p.size() - 1) = model::defaults(m).tail(p.size() - 1);  // and back
  check();
}

TEST_CASE("undamped modes at resonance are a pole, and none next to it") {
  scene::Scene s = chain(Damping::none);
  s.elements.clear();
  s.elements.push_back({"e", &elements::jenkins(), {{{chain_dofs - 1, 1.0}}}, {1e3, 0.5, 2.0}});
  s.masses.clear();
  for (int i = 0; i < chain_dofs; ++i)
    s.masses.push_back({"m" + std::to_string(i), &scene::mass_type(), {{{i, 1.0}}}, {1.0}});
  for (auto& spring : s.springs) spring.values = {1e4};
  Structure modal(s, true);
  REQUIRE(modal.coordinates.modes);
  Vector p = model::defaults(*modal.model);
  // dofs - 1 masses, clamped at one end and free at the other.
  p[model::frequency] = 2 * 100 * std::sin(std::numbers::pi / 2 * 15 / (2 * (chain_dofs - 1) + 1));
  CHECK_FALSE(modal.stiffness.move_to(p));
  p[model::frequency] *= 1 + 1e-6;
  CHECK(modal.stiffness.move_to(p));
}

TEST_CASE("structures without a gain from modes, or outside of what they can, are without") {
  const auto has_modes = [](const scene::Scene& s) {
    return hbm::coordinates(model::build(s), typical).modes != nullptr;
  };
  CHECK(has_modes(chain(Damping::proportional)));
  scene::Scene stiff = chain(Damping::proportional);
  stiff.springs[3].values = {1e12};
  CHECK_FALSE(has_modes(stiff));
  scene::Scene many = chain(Damping::proportional);
  for (std::size_t i = 0; i < many.dampers.size(); ++i)
    many.dampers[i].values[0] *= 1 + 0.1 * static_cast<double>(i);
  CHECK_FALSE(has_modes(many));
  CHECK_FALSE(has_modes(scenes::chain(3, false)));
}
