#pragma once
// A rotor that rubs on a ring around it: once its centre q is farther off than the clearance c, the ring
// pushes it back by k (r - c), r = |q|, and friction by mu times as much against the rotation:
//
//   f = K (q + mu J q),   K = k (1 - c/r) where r > c,   J q = (-q_2, q_1)

#include <arcslip/laws/sampled_law.hpp>

#include <limits>

class Rub final : public arcslip::elements::SampledLaw {
 public:
  std::string_view name() const override { return "rub"; }
  std::string_view help() const override { return "a ring around a rotor, with friction"; }
  std::span<const arcslip::scene::Field> fields(const arcslip::scene::Settings&) const override {
    return all;
  }
  std::span<const std::string_view> slots() const override { return directions_; }

  arcslip::elements::Facts facts() const override {
    return {.antisymmetric = true, .dissipative = true, .symmetric_step = false};  // friction turns the force
  }
  arcslip::elements::Traits traits(arcslip::elements::Fields fields, int) const override {
    return {.stiffness = fields[0], .stiffness_field = 0, .several_responses = true, .far_power = 1};
  }

  double stiffness(arcslip::elements::Fields fields, int, double reach) const override {
    return reach > fields[1] ? fields[0] * (1 + fields[2]) : 0;
  }

  // All samples of a period at once.
  void sample(arcslip::elements::Fields fields, const Eigen::MatrixXd& q,
              arcslip::elements::SampledForce& at) const override {
    const double k = fields[0], c = fields[1], mu = fields[2];
    at.f.setZero();
    at.f_q.setZero();
    at.f_field.setZero();
    int touching = 0;
    for (Eigen::Index s = 0; s < q.rows(); ++s) {
      const double r = q.row(s).norm();
      if (r <= c) continue;
      ++touching;
      const Eigen::RowVector2d across(-q(s, 1), q(s, 0)), along = q.row(s) + mu * across;
      const double K = k * (1 - c / r);
      at.f.row(s) = K * along;
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
          const double turned = i == j ? 1 : i == 0 ? -mu : mu;
          at.f_q(s, 2 * j + i) = K * turned + along[i] * k * c * q(s, j) / (r * r * r);
        }
      at.f_field.row(s) << along * (1 - c / r), along * (-k / r), K * across;
    }
    at.piece = touching == 0 ? 0 : touching < q.rows() ? 1 : 2;  // a round orbit touches all around at once
  }

  double stored(arcslip::elements::Fields fields, arcslip::elements::In q) const override {
    const double depth = std::max(q.norm() - fields[1], 0.0);
    return 0.5 * fields[0] * depth * depth;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr std::string_view directions_[] = {"first", "second"};
  static constexpr arcslip::scene::Field all[] = {
      {.name = "stiffness",
       .unit = "N/m",
       .lower = 0,
       .upper = infinity,
       .lower_open = true,
       .help = "of the ring"},
      {.name = "clearance", .unit = "m", .lower = 0, .upper = infinity, .help = "between rotor and ring"},
      {.name = "friction_coefficient",
       .unit = "-",
       .lower = 0,
       .upper = infinity,
       .help = "against the rotation"}};
};
