#include <arcslip/laws/memoryless/tanh_friction.hpp>

#include <arcslip/laws/rate_law.hpp>

#include <cmath>

namespace arcslip::elements {
namespace {

constexpr scene::Field tanh_friction_fields[] = {
    {.name = "friction_coefficient",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .help = "Coulomb friction coefficient"},
    {.name = "normal_load", .unit = "N", .lower = 0, .upper = infinity, .help = "normal load"},
    {.name = "reference_velocity",
     .unit = "m/s",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "force = friction_coefficient * normal_load * tanh(velocity/reference_velocity)"},
};

class TanhFriction final : public RateLaw {
 public:
  std::string_view name() const override { return "tanh_friction"; }
  std::string_view help() const override { return "Coulomb friction, regularized by the velocity"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return tanh_friction_fields; }

  Traits traits(Fields fields, int) const override { return {.far_work = 4 * fields[0] * fields[1]}; }
  int samples(int order) const override { return 32 * order + 64; }
  Force force(Fields fields, double, double v, double* by_field) const override {
    const double limit = fields[0] * fields[1], x = v / fields[2], tanh = std::tanh(x);
    const double cosh = std::cosh(x), slope = limit / fields[2] / (cosh * cosh);
    by_field[0] = fields[1] * tanh;
    by_field[1] = fields[0] * tanh;
    by_field[2] = slope > 0 ? -slope * x : 0;  // x may be infinite
    return {limit * tanh, 0, slope};
  }
};

}  // namespace

const PlainLaw& tanh_friction() {
  static const TanhFriction law;
  return law;
}

}  // namespace arcslip::elements
