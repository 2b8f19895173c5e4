// The tables of what each part of a scene holds: the one place of names, units, bounds and defaults.
#include <arcslip/scene/scene.hpp>

#include <array>
#include <numbers>

namespace arcslip::scene {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr Field mass_fields[] = {
    {.name = "value", .unit = "kg", .lower = 0, .upper = infinity, .help = "mass"},
};
constexpr Field spring_fields[] = {
    {.name = "value", .unit = "N/m", .lower = -infinity, .upper = infinity, .help = "linear stiffness"},
};
constexpr Field damper_fields[] = {
    {.name = "value", .unit = "N s/m", .lower = 0, .upper = infinity, .help = "viscous damping"},
};
constexpr Field force_fields[] = {
    {.name = "cosine",
     .unit = "N",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the force along cos(harmonic w t)"},
    {.name = "sine",
     .unit = "N",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the force along sin(harmonic w t)"},
};
constexpr Field jenkins_fields[] = {
    {.name = "stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "tangential stiffness of the contact in stick"},
    {.name = "friction_coefficient",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .help = "Coulomb friction coefficient"},
    {.name = "normal_load",
     .unit = "N",
     .lower = 0,
     .upper = infinity,
     .help = "normal load; the slip limit is friction_coefficient * normal_load"},
};
constexpr Field cubic_spring_fields[] = {
    {.name = "stiffness",
     .unit = "N/m^3",
     .lower = -infinity,
     .upper = infinity,
     .help = "force = stiffness * displacement^3"},
};

}  // namespace

constinit const PartType mass_type{"mass", mass_fields};
constinit const PartType spring_type{"spring", spring_fields};
constinit const PartType damper_type{"damper", damper_fields};
constinit const PartType force_type{"force", force_fields};
constinit const PartType jenkins_type{"jenkins", jenkins_fields};
constinit const PartType cubic_spring_type{"cubic_spring", cubic_spring_fields};

std::span<const PartType* const> element_types() {
  static constexpr std::array<const PartType*, 2> types = {&jenkins_type, &cubic_spring_type};
  return types;
}

double to_rad_per_s(FrequencyUnit unit) {
  return unit == FrequencyUnit::hertz ? 2 * std::numbers::pi : 1.0;
}

}  // namespace arcslip::scene
