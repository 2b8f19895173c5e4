#include <arcslip/laws/memoryless/cubic_spring.hpp>

#include <arcslip/laws/sampled_law.hpp>

#include <cmath>

namespace arcslip::elements {
namespace {

constexpr scene::Field cubic_spring_fields[] = {
    {.name = "stiffness",
     .unit = "N/m^3",
     .lower = -std::numeric_limits<double>::infinity(),
     .upper = std::numeric_limits<double>::infinity(),
     .help = "force = stiffness * displacement^3"},
};

class CubicSpring final : public SampledLaw {
 public:
  std::string_view name() const override { return "cubic_spring"; }
  std::string_view help() const override { return "a cubic spring, hardening or softening"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return cubic_spring_fields; }

  bool antisymmetric() const override { return true; }
  Traits traits(Fields fields, int) const override {
    if (fields[0] == 0) return {};
    return {.stiffness = std::numeric_limits<double>::infinity(),
            .holds_mean = true,
            .several_responses = true,
            .far_power = 3};
  }
  double stiffness(Fields fields, int, double reach) const override {
    return 3 * std::abs(fields[0]) * reach * reach;
  }

  void sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const override {
    at.f_field = q.array().cube();
    at.f = fields[0] * at.f_field;
    at.f_q = 3 * fields[0] * q.array().square();
  }
  double stored(Fields fields, In q, In) const override {
    return 0.25 * fields[0] * q[0] * q[0] * q[0] * q[0];
  }
  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    if (fields[0] != 0) return {};
    Automaton nothing(-1);
    nothing.add("without force", 0, 0, 0);
    return std::vector{nothing};
  }
};

}  // namespace

const PlainLaw& cubic_spring() {
  static const CubicSpring law;
  return law;
}

}  // namespace arcslip::elements
