// The fields of masses, springs, dampers and forces: names, units, bounds and defaults. Those of the elements
// are defined with their laws.
#include <arcslip/scene/part_type.hpp>
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
constexpr Field base_displacement_fields[] = {
    {.name = "cosine",
     .unit = "m",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the displacement of the ground along cos(harmonic w t)"},
    {.name = "sine",
     .unit = "m",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the displacement of the ground along sin(harmonic w t)"},
};
constexpr Field base_acceleration_fields[] = {
    {.name = "cosine",
     .unit = "m/s^2",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the acceleration of the ground along cos(harmonic w t)"},
    {.name = "sine",
     .unit = "m/s^2",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the acceleration of the ground along sin(harmonic w t)"},
};
class Section final : public PartType {
 public:
  constexpr Section(std::string_view name, std::span<const Field> fields) : name_(name), fields_(fields) {}
  std::string_view name() const override { return name_; }
  std::span<const Field> fields(const Settings&) const override { return fields_; }

 private:
  std::string_view name_;
  std::span<const Field> fields_;
};

}  // namespace

const PartType& mass_type() {
  static const Section type("mass", mass_fields);
  return type;
}

const PartType& spring_type() {
  static const Section type("spring", spring_fields);
  return type;
}

const PartType& damper_type() {
  static const Section type("damper", damper_fields);
  return type;
}

const PartType& force_type() {
  static const Section type("force", force_fields);
  return type;
}

const PartType& base_displacement_type() {
  static const Section type("base_displacement", base_displacement_fields);
  return type;
}

const PartType& base_acceleration_type() {
  static const Section type("base_acceleration", base_acceleration_fields);
  return type;
}

std::span<const PartType* const> excitation_types() {
  static const std::array<const PartType*, 3> types = {&force_type(), &base_displacement_type(),
                                                       &base_acceleration_type()};
  return types;
}

bool is_base_motion(const PartType& type) {
  return &type == &base_displacement_type() || &type == &base_acceleration_type();
}

std::span<const Field> Part::fields() const {
  return type->fields(options);
}

double to_rad_per_s(FrequencyUnit unit) {
  return unit == FrequencyUnit::hertz ? 2 * std::numbers::pi : 1.0;
}

}  // namespace arcslip::scene
