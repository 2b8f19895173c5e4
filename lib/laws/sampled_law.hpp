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

/// What a law is sampled at: a row for each sample, a column for each direction.
struct SampledMotion {
  const Eigen::MatrixXd& q;      // m
  const Eigen::MatrixXd& v;      // m/s, of laws that are rate-dependent
  const Eigen::VectorXd& phase;  // of the excitation, rad, of laws that depend on it
};

/// What is needed of a sampled force. A law may always set all of it.
enum class Wanted { force, tangent, by_fields };  // f; with f_q and f_v; f_field alone

class SampledLaw : public PlainLaw {
 public:
  /// Samples in a period of the motion.
  virtual int samples(const Harmonics& harmonics) const { return 4 * harmonics.order + 2; }
  /// Force and derivatives at the displacements q, a column for each direction. `at` has its size.
  virtual void sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const = 0;
  /// The same of laws that depend on more than that, with f_v where they are rate-dependent.
  virtual void sample_motion(Fields fields, const SampledMotion& motion, Wanted wanted,
                             SampledForce& at) const {
    static_cast<void>(wanted);
    sample(fields, motion.q, at);
  }

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override;
  Eigen::MatrixXd force_at(const Harmonics& harmonics, In u, Fields fields, Angles angles) const override;
  Eigen::MatrixXd moving_force_at(const Harmonics& harmonics, In u, double base_frequency, Fields fields,
                                  Angles angles) const override;
  void begin(Fields fields, In q, Out z, StepEnd& at) const override;
  void step(Fields fields, const StepStart& start, In dq, StepEnd& end) const override;
};

}  // namespace arcslip::elements
