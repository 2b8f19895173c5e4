// Formulas in the frequency domain: coefficients that are known in closed form, and those of the laws that
// are written out as classes.

#include "catch.hpp"

#include "lib/laws/every_law.hpp"

#include <arcslip/laws/memoryless/coulomb.hpp>
#include <arcslip/laws/memoryless/formula_law.hpp>
#include <arcslip/laws/memoryless/formula_type.hpp>
#include <arcslip/laws/memoryless/quadratic_damper.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/scene/faults.hpp>

#include <array>
#include <cmath>
#include <numbers>

using namespace arcslip;
using namespace arcslip::elements;
using Eigen::VectorXd;

namespace {

constexpr double pi = std::numbers::pi;

// A law with parameters without bounds.
class Law1 {
 public:
  explicit Law1(std::vector<std::string> forces, std::vector<std::string> names = {})
      : names_(std::move(names)) {
    for (const std::string& name : names_)
      fields_.push_back({.name = name, .unit = "-", .lower = -scene::infinity, .upper = scene::infinity});
    law_.emplace("own", "", forces, fields_);
  }
  Law1(const Law1&) = delete;
  Law1& operator=(const Law1&) = delete;
  const FormulaLaw& operator*() const { return *law_; }
  const FormulaLaw* operator->() const { return &*law_; }

 private:
  std::vector<std::string> names_;
  std::vector<scene::Field> fields_;
  std::optional<FormulaLaw> law_;
};

// The coefficients of the force of q = A cos theta, v = -w A sin theta.
VectorXd coefficients(const std::string& force, const Harmonics& h, double A, double w = 1) {
  const Law1 law({force});
  const auto element = law->element(h, {});
  element->set_frequency(w);
  VectorXd u = VectorXd::Zero(h.size());
  u[h.cosine_index(1)] = A;
  element->move_to(u, {}, false);
  return element->force();
}

}  // namespace

TEST_CASE("a formula at no angle at all has no force") {
  const Law1 law({"2*3*q^3"});
  const Harmonics h{3, false};
  CHECK(law->force_at(h, VectorXd::Zero(h.size()), {}, {}).rows() == 0);
}

TEST_CASE("the force of a cosine has the coefficients of closed forms") {
  const Harmonics h{12, false};
  const double A = 1.4, w = 1.7;
  VectorXd expected = VectorXd::Zero(h.size());
  const auto compare = [&](const std::string& force, double tolerance) {
    CAPTURE(force, expected);
    CHECK((coefficients(force, h, A, w) - expected).cwiseAbs().maxCoeff() < tolerance);
    expected.setZero();
  };
  // Jacobi and Anger: sin(A cos t) = 2 sum over odd n of (-1)^((n-1)/2) J_n(A) cos n t
  for (int n = 1; n <= 12; n += 2)
    expected[h.cosine_index(n)] = 2 * (n % 4 == 1 ? 1 : -1) * std::cyl_bessel_j(n, A);
  compare("sin(q)", 1e-14);
  for (int n = 0; n <= 12; n += 2)
    expected[h.cosine_index(n)] = (n == 0 ? 1 : 2) * (n % 4 == 0 ? 1 : -1) * std::cyl_bessel_j(n, A);
  compare("cos(q)", 1e-14);
  // exp(A cos t) = I_0 + 2 sum I_n cos n t
  for (int n = 0; n <= 12; ++n) expected[h.cosine_index(n)] = (n == 0 ? 1 : 2) * std::cyl_bessel_i(n, A);
  expected[0] -= 1;
  compare("exp(q) - 1", 1e-13);
  for (int n = 1; n <= 12; n += 2) expected[h.cosine_index(n)] = 2 * std::cyl_bessel_i(n, A);
  compare("sinh(q)", 1e-13);
  // cos^11 t = 2^-10 sum over odd n of binomial(11, (11 - n)/2) cos n t
  double binomial = 1;
  for (int k = 0; k <= 5; ++k) {
    expected[h.cosine_index(11 - 2 * k)] = std::pow(A, 11) * binomial / 1024;
    binomial *= (11.0 - k) / (k + 1);
  }
  compare("q^11", 1e-13 * std::pow(A, 11));
  // 1/(1 - r cos t) = (1 + 2 sum rho^n cos n t)/sqrt(1 - r^2), rho = (1 - sqrt(1 - r^2))/r
  const double r = 0.35 * A, root = std::sqrt(1 - r * r), rho = (1 - root) / r;
  for (int n = 0; n <= 12; ++n) expected[h.cosine_index(n)] = (n == 0 ? 1 : 2) * std::pow(rho, n) / root;
  compare("1/(1 - 0.35*q)", 1e-13);
  // v^3 and v^5 of v = -w A sin t
  const double V = w * A;
  expected[h.sine_index(1)] = -0.75 * std::pow(V, 3);
  expected[h.sine_index(3)] = 0.25 * std::pow(V, 3);
  compare("v^3", 1e-13 * std::pow(V, 3));
  expected[h.sine_index(1)] = -0.625 * std::pow(V, 5);
  expected[h.sine_index(3)] = 0.3125 * std::pow(V, 5);
  expected[h.sine_index(5)] = -0.0625 * std::pow(V, 5);
  compare("v^5", 1e-13 * std::pow(V, 5));
  // cos(2 t) A cos t
  expected[h.cosine_index(1)] = expected[h.cosine_index(3)] = 0.5 * A;
  compare("cos(2*phase)*q", 1e-14);
  expected[h.cosine_index(0)] = 0.5 * A;
  expected[h.cosine_index(2)] = 0.5 * A;
  expected[h.sine_index(5)] = 3;
  compare("q*cos(phase) + 3*sin(5*phase)", 1e-14);
}

TEST_CASE("kinks and jumps are exact, between harmonics of any order") {
  for (const int order : {1, 4, 9, 31}) {
    const Harmonics h{order, false};
    const double A = 1.4;
    VectorXd expected = VectorXd::Zero(h.size());
    const auto compare = [&](const std::string& force) {
      CAPTURE(force, order);
      CHECK((coefficients(force, h, A) - expected).cwiseAbs().maxCoeff() < 1e-13);
      expected.setZero();
    };
    const auto even = [](int n) { return (n % 4 == 2 ? 1 : -1) / (1.0 * n * n - 1); };
    // |cos t| = 2/pi + (4/pi) sum over even n of (-1)^(n/2+1)/(n^2 - 1) cos n t
    expected[0] = 2 / pi * A;
    for (int n = 2; n <= order; n += 2) expected[h.cosine_index(n)] = 4 / pi * A * even(n);
    compare("abs(q)");
    // sign(v): -(4/pi) sum over odd n of sin n t / n
    for (int n = 1; n <= order; n += 2) expected[h.sine_index(n)] = -4 / pi / n;
    compare("3*sign(v)/3");
    for (const char* force : {"max(q, 0)", "if(q > 0, q, 0)", "q*(q > 0)", "0.5*(q + abs(q))"}) {
      expected[0] = A / pi;
      expected[h.cosine_index(1)] = A / 2;
      for (int n = 2; n <= order; n += 2) expected[h.cosine_index(n)] = 2 / pi * A * even(n);
      compare(force);
    }
    // 1 where cos t > cos b, that is for |t| < b
    const double b = 0.7;
    expected[0] = b / pi;
    for (int n = 1; n <= order; ++n) expected[h.cosine_index(n)] = 2 / pi * std::sin(n * b) / n;
    compare("q > " + scene::file::number_text(A * std::cos(b)));
    // cos t where the excitation pulls
    expected[0] = A / pi;
    expected[h.cosine_index(1)] = A / 2;
    for (int n = 2; n <= order; n += 2) expected[h.cosine_index(n)] = 2 / pi * A * even(n);
    compare("if(cos(phase) >= 0, q, 0)");
  }
}

TEST_CASE("a formula of abs(v)*v is the exact law") {
  const Harmonics h{9, false};
  const VectorXd u = every_law::falling_motion(h, 1, 3);
  const auto force = [&](const elements::Law& law, std::vector<double> fields) {
    const auto element = law.element(h, {});
    element->set_frequency(1.3);
    element->move_to(u, fields, true);
    return std::pair(VectorXd(element->force()), Eigen::MatrixXd(element->jacobian()));
  };
  const Law1 damper({"c*abs(v)*v"}, {"c"});
  const auto exact = force(quadratic_damper(), {0.7}), own = force(*damper, {0.7});
  CHECK((exact.first - own.first).norm() < 1e-13 * exact.first.norm());
  CHECK((exact.second - own.second).norm() < 1e-12 * exact.second.norm());
}

TEST_CASE("rigid friction by sign(v) is that of its law, and reports where it would stop") {
  for (const bool odd : {false, true}) {
    const Harmonics h{9, odd};
    const VectorXd u = every_law::falling_motion(h, 1, 3);
    const Law1 friction({"n*sign(v)"}, {"n"});
    const auto exact = coulomb().element(h, {}), own = friction->element(h, {});
    own->set_frequency(1.3);
    exact->move_to(u, std::array{0.5, 0.8}, true);
    own->move_to(u, std::array{0.4}, true);
    CHECK((exact->force() - own->force()).norm() < 1e-12);
    CHECK((exact->jacobian() - own->jacobian()).norm() < 1e-5 * exact->jacobian().norm());
    CHECK(own->jump_over_bend() == Approx(exact->jump_over_bend()).epsilon(1e-5));
  }
}

TEST_CASE("with kinks and jumps the Jacobian and all derivatives are those of differences") {
  const struct {
    std::vector<std::string> forces;
    std::vector<std::string> names;
    std::vector<double> fields;
  } all[] = {{{"c*abs(v)*v + k*q^3"}, {"c", "k"}, {0.7, 0.3}},
             {{"k*max(q - g, 0) + c*max(-q - 0.3, 0)*v"}, {"k", "g", "c"}, {2, 0.4, 0.3}},
             {{"n*(m + (s - m)*exp(-abs(v)/w))*sign(v)"}, {"n", "m", "s", "w"}, {0.4, 0.6, 0.9, 0.5}},
             {{"if(abs(q) > g, k*q, -k*q^2)"}, {"g", "k"}, {0.6, 0.8}},
             {{"k*q*(q > g*v)"}, {"g", "k"}, {0.3, 0.8}},
             {{"k*q*(sin(phase + a) > 0)"}, {"k", "a"}, {0.8, 0.4}},
             {{"k*max(q1 - q2 - g, 0)", "-k*max(q1 - q2 - g, 0) + n*sign(v2 - v1)"},
              {"k", "g", "n"},
              {2, 0.3, 0.2}}};
  for (const auto& each : all)
    for (const bool odd : {false, true}) {
      const Law1 law(each.forces, each.names);
      if (odd && !law->antisymmetric()) continue;
      CAPTURE(each.forces, odd);
      every_law::check_element(*law, each.fields, 1, odd, 1e-6, 2e-5, 2e-4, 7);
    }
}

TEST_CASE("over several displacements forces need no potential") {
  const Law1 law({"k*q1^3 + p*q2", "c*v1*q2^2 - p*v2"}, {"k", "p", "c"});
  const std::vector<double> fields = {0.7, 0.4, -0.3};
  CHECK(law->directions() == 2);
  CHECK(law->rate_dependent());
  CHECK(law->antisymmetric());
  CHECK_FALSE(law->symmetric_step());
  every_law::check_element(*law, fields, 1, false, 1e-6, 1e-7, 1e-6, 3);
  every_law::check_element(*law, fields, 1, true, 1e-6, 1e-7, 1e-6, 4);
  every_law::check_step(*law, fields, 1, 1e-6, 1e-8, 5);
  // Nothing is stored, so that all work is dissipated.
  const every_law::State from(*law, fields, VectorXd{{0.3, -0.2}}, VectorXd(), VectorXd{{0.5, 0.1}});
  const VectorXd dq{{0.01, 0.02}};
  const auto end = from.step(dq, VectorXd{{0.4, 0.2}});
  CHECK(end.dissipated == Approx(0.5 * (from.f + end.f).dot(dq)).epsilon(1e-14));
}

TEST_CASE("what follows from a formula: symmetry, growth, stiffness, and a single response") {
  const auto traits = [](const std::string& force) {
    const Law1 law({force});
    return law->traits({}, 0);
  };
  CHECK(Law1({"q^3 + v"})->antisymmetric());
  CHECK_FALSE(Law1({"q^2"})->antisymmetric());
  CHECK_FALSE(Law1({"q*cos(phase)"})->antisymmetric());
  CHECK(Law1({"q*cos(phase)"})->phase_dependent());
  CHECK_FALSE(Law1({"q^3"})->approximates());
  CHECK(Law1({"sin(q)"})->approximates());
  CHECK_FALSE(Law1({"q^3"})->dissipative());
  CHECK(Law1({"v"})->dissipative());
  CHECK(traits("3*q").stiffness == 3);
  CHECK(traits("3*q").holds_mean);
  CHECK(traits("-3*q").stiffness == 3);
  CHECK_FALSE(traits("3*q").several_responses);
  CHECK(std::isinf(traits("q^3").stiffness));
  CHECK(traits("q^3").far_power == 3);
  CHECK(traits("q^3").several_responses);
  CHECK_FALSE(traits("q^2").holds_mean);
  CHECK(traits("q^2").several_responses);
  CHECK(traits("q^2 + q").holds_mean);
  CHECK_FALSE(traits("cosh(q)").holds_mean);
  CHECK(traits("sinh(q)").holds_mean);
  CHECK(Law1({"k*q"}, {"k"})->traits(std::array{2.0}, 0).stiffness_field == 0);
  CHECK(Law1({"k*q + q"}, {"k"})->traits(std::array{2.0}, 0).stiffness_field == -1);
  CHECK(traits("0*q^3").stiffness == 0);
  CHECK_FALSE(traits("0*q^3").holds_mean);
  CHECK_FALSE(traits("0*q^3 + 2*q").several_responses);
  CHECK(traits("v").stiffness == 0);
  CHECK_FALSE(traits("v").holds_mean);
  CHECK(std::isinf(traits("v").far_work));
  CHECK(traits("-v").far_work == 0);
  CHECK_FALSE(traits("v^3").several_responses);
  CHECK(traits("v^3 - v").several_responses);
  CHECK(traits("(q^2 - 1)*v").several_responses);
  CHECK(std::isinf(traits("(q^2 - 1)*v").far_work));
  CHECK(traits("5*tanh(v/0.01)").far_work == Approx(20).epsilon(1e-6));
  CHECK(traits("sign(v)").far_work == Approx(4).epsilon(1e-6));
  CHECK(traits("sqrt(1 + q^2)*q").far_power == Approx(2).epsilon(1e-6));
  CHECK(traits("sin(q)").far_power == Approx(0).margin(0.01));
  CHECK(std::isinf(traits("sinh(q)").far_power));
  CHECK(traits("(1 - 0.3*cos(2*phase))*q").stiffness == Approx(1.3));
  CHECK_FALSE(traits("(1 - 0.3*cos(2*phase))*q").several_responses);
  CHECK(Law1({"q^3"})->stiffness({}, 0, 2) == 12);
  CHECK(Law1({"sin(q)"})->stiffness({}, 0, 2) == 1);
}

TEST_CASE("the energy stored is the integral of the force") {
  const auto stored = [](const std::string& force, double q) {
    return Law1({force})->in_time({})->stored(VectorXd::Constant(1, q), VectorXd());
  };
  CHECK(stored("q^3 - 2*q", 1.5) == Approx(std::pow(1.5, 4) / 4 - 1.5 * 1.5).epsilon(1e-15));
  CHECK(stored("sin(q)", 2) == Approx(1 - std::cos(2)).epsilon(1e-13));
  CHECK(stored("exp(q)", -3) == Approx(std::exp(-3) - 1).epsilon(1e-13));
  CHECK(stored("abs(q)*q", -2) == Approx(8.0 / 3).epsilon(1e-12));
  CHECK(stored("q^3 + v^3", 2) == 4);
  CHECK(stored("v^3", 2) == 0);
  CHECK(stored("q*cos(phase)", 2) == 0);
}

TEST_CASE("a step dissipates the work of what is not stored") {
  const Law1 law({"k*q^3 + c*v"}, {"k", "c"});
  const std::vector<double> fields = {2, 0.7};
  const auto one = [](double x) { return VectorXd::Constant(1, x).eval(); };
  const every_law::State from(*law, fields, one(0.3), VectorXd(), one(0.5));
  const auto end = from.step(one(0.2), one(0.4));
  CHECK(end.dissipated == Approx(0.5 * 0.7 * (0.5 + 0.4) * 0.2).epsilon(1e-13));
}

TEST_CASE("a formula that is linear is integrated exactly in time") {
  const Law1 law({"k*(q - 0.5)"}, {"k"});
  const auto automata = law->automata(std::array{3.0});
  REQUIRE(automata);
  const auto& mode = (*automata)[0].modes[0];
  CHECK(mode.f_q(0, 0) == 3);
  CHECK(mode.f_0[0] == -1.5);
  CHECK_FALSE(Law1({"q^3"})->automata({}));
  CHECK_FALSE(Law1({"v"})->automata({}));
  CHECK_FALSE(Law1({"q*cos(phase)"})->automata({}));
}

TEST_CASE("options made in code refuse names that no parameter may have") {
  CHECK_THROWS_AS(formula_options({"k*q"}, {{"q"}, {"k"}}), std::invalid_argument);
  CHECK_THROWS_AS(formula_options({"k*q"}, {{"pi"}, {"k"}}), std::invalid_argument);
  CHECK_THROWS_AS(formula_options({"k*q"}, {{"2k"}, {"k"}}), std::invalid_argument);
  CHECK_THROWS_AS(formula_options({"k*q + x"}, {{"k"}}), formula::FormulaError);
  CHECK(formula_type().law(formula_options({"k*q"}, {{"k", "N/m"}}))->directions() == 1);
}
