// The fields of masses, springs, dampers and damping: names, units, bounds and defaults. Those of excitations
// stand in scene/files/shape.cpp, those of elements with their laws.
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>

#include <array>
#include <numbers>

namespace arcslip::scene {
namespace {

constexpr Field mass_fields[] = {
    {.name = "value", .unit = "kg", .lower = 0, .upper = infinity, .help = "mass"},
};
constexpr Field spring_fields[] = {
    {.name = "value", .unit = "N/m", .lower = -infinity, .upper = infinity, .help = "linear stiffness"},
};
constexpr Field damper_fields[] = {
    {.name = "value", .unit = "N s/m", .lower = 0, .upper = infinity, .help = "viscous damping"},
};
constexpr Field rayleigh_fields[] = {
    {.name = "alpha",
     .unit = "1/s",
     .lower = 0,
     .upper = infinity,
     .default_value = 0.0,
     .help = "damping over mass"},
    {.name = "beta",
     .unit = "s",
     .lower = 0,
     .upper = infinity,
     .default_value = 0.0,
     .help = "damping over stiffness"},
};
constexpr Field loss_factor_fields[] = {
    {.name = "loss_factor", .unit = "-", .lower = 0, .upper = infinity, .help = "of a complex stiffness"},
};
constexpr Field modal_damping_fields[] = {
    {.name = "ratio",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .help = "damping ratio of each mode of the structure without its elements"},
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

// Of the whole structure: without a place.
class Damping final : public PartType {
 public:
  constexpr Damping(std::string_view name, std::span<const Field> fields, std::string_view help)
      : name_(name), fields_(fields), help_(help) {}
  std::string_view name() const override { return name_; }
  std::string_view help() const override { return help_; }
  bool names_directions() const override { return true; }
  std::span<const Field> fields(const Settings&) const override { return fields_; }

 private:
  std::string_view name_;
  std::span<const Field> fields_;
  std::string_view help_;
};

}  // namespace

const PartType& rayleigh_type() {
  static const Damping type("rayleigh", rayleigh_fields, "C = alpha M + beta K");
  return type;
}

const PartType& loss_factor_type() {
  static const Damping type("loss_factor", loss_factor_fields, "a complex stiffness K (1 + i loss_factor)");
  return type;
}

const PartType& modal_damping_type() {
  static const Damping type("modal", modal_damping_fields, "the same damping ratio for all modes");
  return type;
}

std::span<const PartType* const> damping_types() {
  static const std::array<const PartType*, 3> types = {&rayleigh_type(), &loss_factor_type(),
                                                       &modal_damping_type()};
  return types;
}

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

std::span<const Field> Part::fields() const {
  return type->fields(options);
}

double to_rad_per_s(FrequencyUnit unit) {
  return unit == FrequencyUnit::hertz ? 2 * std::numbers::pi : 1.0;
}

}  // namespace arcslip::scene
