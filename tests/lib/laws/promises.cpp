// Every law keeps what Law promises, those of the library as those of tests.
#include "lib/laws/every_law.hpp"

#include "lib/laws/coupled_spring.hpp"
#include "lib/laws/hysteresis/iwan_laws.hpp"
#include "lib/laws/polynomial.hpp"
#include "lib/laws/renamed_jenkins.hpp"

#include "lib/laws/memoryless/piecewise_linear_laws.hpp"

#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/laws/hysteresis/bouc_wen.hpp>
#include <arcslip/laws/memoryless/formula_type.hpp>
#include <arcslip/laws/memoryless/polynomial_spring.hpp>
#include <arcslip/laws/memoryless/quadratic_damper.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>

using namespace every_law;

namespace {

const own_laws::RenamedJenkins renamed_law;
const own_laws::CoupledSpring coupled_law;
const own_laws::PolynomialLaw quartic_law(4);
const auto gap = piecewise_linear_laws::gap(false), gaps = piecewise_linear_laws::gap(true),
           bilinear = piecewise_linear_laws::bilinear(false),
           bilinear_on_one_side = piecewise_linear_laws::bilinear(true),
           softening_table =
               piecewise_linear_laws::table({{-0.6, -0.9}, {-0.2, -1}, {0.1, 0.8}, {0.5, 0.3}, {0.7, 1}});
const auto uniform = iwan_laws::law(iwan_laws::uniform),
           four_parameter = iwan_laws::law(iwan_laws::four_parameter),
           table = iwan_laws::law(iwan_laws::table({{0.7, 0.2}, {1.1, 0.4}, {0.3, 0.35}}));
const auto odd_powers = elements::polynomial_spring().law(elements::polynomial_powers({9, 1, 3}));
const auto own = [](const std::string& force, std::vector<elements::FormulaParameter> parameters) {
  return elements::formula_type().law(elements::formula_options({force}, std::move(parameters)));
};
const auto exponential = own("k*(exp(q/a) - 1) + c*v^3", {{"k"}, {"a"}, {"c"}}),
           of_both = own("k*tanh(q*v/20) + c*v/sqrt(400 + v^2)", {{"k"}, {"c"}});
const auto some_powers = elements::polynomial_spring().law(elements::polynomial_powers({2, 5, 8}));

struct Example {
  const elements::Law& law;
  std::vector<double> fields;
  double rough;  // of differences of an element in the frequency domain, where it is sampled and has kinks
};

// Rigid friction, whose force jumps, has checks of its own: laws/memoryless/coulomb.cpp.
const Example all[] = {
    {elements::jenkins(), {2, 0.5, 1}, 1e-7},
    {renamed_law, {0.5, 1, 2}, 1e-7},
    {elements::cubic_spring(), {0.7}, 1e-7},
    {coupled_law, {0.7}, 1e-7},
    {*gap, {3, 0.2}, 1e-6},
    {*gap, {3, -0.2}, 1e-6},
    {*gaps, {3, 0.2}, 1e-6},
    {*gaps, {3, -0.2}, 1e-6},
    {*bilinear, {2, 0.5, 0.3}, 1e-6},
    {*bilinear, {-1, 2, 0.3}, 1e-6},
    {*bilinear_on_one_side, {2, 5, 0.2}, 1e-6},
    {*softening_table, {1.7}, 1e-6},
    {elements::contact_2d(), {2, 1.5, 0.5, 1}, 1e-6},
    {elements::contact_2d(), {2, 1.5, 0.5, -0.3}, 1e-6},
    {elements::contact_2d(), {2, 0, 0.5, 1}, 1e-7},
    {elements::contact_3d(), {2, 1.5, 0.5, 1}, 1e-6},
    {elements::contact_3d(), {2, 1.5, 0.5, -0.3}, 1e-6},
    {elements::contact_3d(), {2, 0, 0.5, 1}, 1e-6},
    {quartic_law, {0.3, -0.2, 0.5, 0.1}, 1e-7},
    {*uniform, {2, 0.8}, 1e-7},
    {*four_parameter, {2, 0.8, -0.3, 0.4}, 1e-7},
    {*table, {1.2, 0.9}, 1e-7},
    {*odd_powers, {-0.3, 0.5, 0.1}, 1e-7},
    {*some_powers, {0.3, 0.2, -0.1}, 1e-7},
    {elements::bouc_wen(), {0.8, 0.2, 0.7, 1, 0.7}, 1e-6},
    {elements::bouc_wen(), {0.8, 0, 0.9, 2.5, 0.5}, 1e-6},
    {*exponential, {0.4, 1.3, 0.2}, 1e-7},
    {*of_both, {0.4, 0.3}, 1e-7},
    {elements::quadratic_damper(), {0.7}, 1e-7},
    {elements::van_der_pol(), {0.7, 0.1}, 1e-7},
    {elements::tanh_friction(), {0.7, 1.2, 20}, 1e-7},
};

}  // namespace

TEST_CASE("the derivatives of a step in time are those of its differences, for every law") {
  for (const Example& each : all) check_step(each.law, each.fields, 1, 1e-6, 1e-8, 11);
}

TEST_CASE("what a law dissipates is the work of a closed path less what it stores") {
  for (const Example& each : all) check_energy(each.law, each.fields, 1, 1e-5, 5);
}

TEST_CASE("the derivatives of an element in harmonics are those of its differences, for every law") {
  for (const Example& each : all)
    for (const bool odd : {false, true}) {
      if (odd && !each.law.antisymmetric()) continue;
      check_element(each.law, each.fields, 1, odd, 1e-6, each.rough, 1e-6, 7);
    }
}
