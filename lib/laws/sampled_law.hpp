#pragma once
// Laws without memory, f(q) or f(q, v), from the force alone: sampled at equal intervals of the period
// (alternating frequency/time, Cameron & Griffin 1989), with the exact Jacobian of the sampled force.
//
//   class Sinh final : public elements::SampledLaw {
//     void sample(Fields fields, const Matrix& q, SampledForce& at) const override {
//       at.f = fields[0] * (q / fields[1]).array().sinh(); ...
//
// Coefficients and Jacobian are exact for the harmonics kept where f is a polynomial of degree g and there
// are more than (g + 1) N samples; else the error falls as fast as the harmonics of f do.

#include <arcslip/laws/law.hpp>

namespace arcslip::elements {

class SampledLaw : public PlainLaw {
 public:
  /// Samples in a period for harmonics up to N.
  virtual int samples(int order) const { return 4 * order + 2; }
  /// Force and derivatives at the displacements q, a column for each direction. `at` has its size.
  virtual void sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const = 0;
  /// The same at velocities v (m/s), likewise a column each, and with f_v: of laws that are rate-dependent.
  virtual void sample_moving(Fields fields, const Eigen::MatrixXd& q, const Eigen::MatrixXd& v,
                             SampledForce& at) const {
    static_cast<void>(v);
    sample(fields, q, at);
  }

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override;
  Eigen::MatrixXd force_at(const Harmonics& harmonics, In u, Fields fields, Angles angles) const override;
  Eigen::MatrixXd moving_force_at(const Harmonics& harmonics, In u, double base_frequency, Fields fields,
                                  Angles angles) const override;
  void begin(Fields fields, In q, Out z, StepEnd& at) const override;
  void step(Fields fields, const StepStart& start, In dq, StepEnd& end) const override;
};

}  // namespace arcslip::elements
