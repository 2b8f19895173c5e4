#pragma once
// A spring of two directions with the potential k/4 (q_1^2 + q_2^2)^2: f_i = k (q_1^2 + q_2^2) q_i.

#include <arcslip/laws/sampled_law.hpp>

#include <limits>

namespace own_laws {

using namespace arcslip;
using elements::Fields, elements::In;

class CoupledSpring final : public elements::SampledLaw {
 public:
  std::string_view name() const override { return "coupled_spring"; }
  std::string_view help() const override { return "the same stiffness in all directions of a plane"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return fields_; }
  std::span<const std::string_view> slots() const override { return slots_; }

  elements::Facts facts() const override { return {.antisymmetric = true}; }

  void sample(Fields fields, const Eigen::MatrixXd& q, elements::SampledForce& at) const override {
    for (Eigen::Index s = 0; s < q.rows(); ++s) {
      const double k = fields[0], square = q.row(s).squaredNorm();
      for (int i = 0; i < 2; ++i) {
        at.f(s, i) = k * square * q(s, i);
        at.f_field(s, i) = square * q(s, i);
        for (int j = 0; j < 2; ++j)
          at.f_q(s, 2 * j + i) = k * (2 * q(s, i) * q(s, j) + (i == j ? square : 0));
      }
    }
  }

 private:
  static constexpr std::string_view slots_[] = {"first", "second"};
  static constexpr scene::Field fields_[] = {{.name = "stiffness",
                                              .unit = "N/m^3",
                                              .lower = 0,
                                              .upper = std::numeric_limits<double>::infinity(),
                                              .help = "force = stiffness * |displacement|^2 * displacement"}};
};

}  // namespace own_laws
