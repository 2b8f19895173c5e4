#include <arcslip/laws/memoryless/smooth_laws.hpp>

#include <arcslip/laws/memoryless/formula_law.hpp>

namespace arcslip::elements {
namespace {

constexpr scene::Field any(std::string_view name, std::string_view unit, std::string_view help) {
  return {.name = name, .unit = unit, .lower = -infinity, .upper = infinity, .help = help};
}
constexpr scene::Field at_least_0(std::string_view name, std::string_view unit, std::string_view help) {
  return {.name = name, .unit = unit, .lower = 0, .upper = infinity, .help = help};
}
constexpr scene::Field above_0(std::string_view name, std::string_view unit, std::string_view help) {
  return {.name = name, .unit = unit, .lower = 0, .upper = infinity, .lower_open = true, .help = help};
}

constexpr scene::Field cubic_spring_fields[] = {
    any("stiffness", "N/m^3", "force = stiffness * displacement^3")};

constexpr scene::Field van_der_pol_fields[] = {
    at_least_0("coefficient", "N s/m", "force = coefficient * (displacement^2/amplitude^2 - 1) * velocity"),
    above_0("amplitude", "m", "displacement at which the damping changes its sign")};

constexpr scene::Field tanh_friction_fields[] = {
    at_least_0("friction_coefficient", "-", "Coulomb friction coefficient"),
    at_least_0("normal_load", "N", "normal load"),
    above_0("reference_velocity", "m/s",
            "force = friction_coefficient * normal_load * tanh(velocity/reference_velocity)")};

}  // namespace

const PlainLaw& cubic_spring() {
  static const FormulaLaw law("cubic_spring", "a cubic spring, hardening or softening", {"stiffness*q^3"},
                              cubic_spring_fields);
  return law;
}

const PlainLaw& van_der_pol() {
  static const FormulaLaw law("van_der_pol", "a damper that feeds small motions and damps large ones",
                              {"coefficient*((q/amplitude)^2 - 1)*v"}, van_der_pol_fields);
  return law;
}

const PlainLaw& tanh_friction() {
  static const FormulaLaw law("tanh_friction", "Coulomb friction, regularized by the velocity",
                              {"friction_coefficient*normal_load*tanh(v/reference_velocity)"},
                              tanh_friction_fields);
  return law;
}

}  // namespace arcslip::elements
