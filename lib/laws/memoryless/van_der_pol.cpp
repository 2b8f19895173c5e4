#include <arcslip/laws/memoryless/van_der_pol.hpp>

#include <arcslip/laws/rate_law.hpp>

namespace arcslip::elements {
namespace {

constexpr scene::Field van_der_pol_fields[] = {
    {.name = "coefficient",
     .unit = "N s/m",
     .lower = 0,
     .upper = infinity,
     .help = "force = coefficient * (displacement^2/amplitude^2 - 1) * velocity"},
    {.name = "amplitude",
     .unit = "m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "displacement at which the damping changes its sign"},
};

class VanDerPol final : public RateLaw {
 public:
  std::string_view name() const override { return "van_der_pol"; }
  std::string_view help() const override { return "a damper that feeds small motions and damps large ones"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return van_der_pol_fields; }

  Traits traits(Fields fields, int) const override {
    return {.several_responses = fields[0] > 0, .far_work = fields[0] > 0 ? infinity : 0};
  }
  Force force(Fields fields, double q, double v, double* by_field) const override {
    const double c = fields[0], x = q / fields[1];
    by_field[0] = (x * x - 1) * v;
    by_field[1] = -2 * c * x * x / fields[1] * v;
    return {c * by_field[0], 2 * c * x / fields[1] * v, c * (x * x - 1)};
  }
};

}  // namespace

const PlainLaw& van_der_pol() {
  static const VanDerPol law;
  return law;
}

}  // namespace arcslip::elements
