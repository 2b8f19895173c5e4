#pragma once
// Laws without memory that depend on the velocity along one direction: f(q, v), v = q'. Their force does no
// work that could be recovered: they store nothing, and dissipate the whole of it, which may be negative.

#include <arcslip/laws/sampled_law.hpp>

namespace arcslip::elements {

class RateLaw : public SampledLaw {
 public:
  struct Force {
    double f, by_q, by_v;
  };
  static constexpr std::size_t most_fields = 4;

  /// f and its derivatives; by_field: one for each field.
  virtual Force force(Fields fields, double q, double v, double* by_field) const = 0;

  Facts facts() const override {
    return {.antisymmetric = true, .dissipative = true, .rate_dependent = true};
  }
  double stiffness(Fields, int, double) const final { return 0; }  // at rest
  double stored(Fields, In, In) const final { return 0; }

  void sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const final;  // at rest
  void sample_motion(Fields fields, const SampledMotion& motion, Wanted wanted, SampledForce& at) const final;
  void step(Fields fields, const StepStart& start, In dq, StepEnd& end) const final;
};

}  // namespace arcslip::elements
