#pragma once
// Laws without memory, f(q) or f(q, v), from the force alone: sampled at equal intervals of the period
// (alternating frequency/time, Cameron & Griffin 1989), with the exact Jacobian of the sampled force.
//
//   class Sinh final : public elements::SampledLaw {
//     std::string_view name() const override { return "sinh"; }
//     std::span<const scene::Field> fields(const scene::Settings&) const override { return all; }
//     void sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const override {
//       at.f = fields[0] * (q / fields[1]).array().sinh(); ...
//
// is a whole law. Its traits, stiffnesses and energy follow from the force at some displacements; a law that
// knows better has functions of its own, and facts.
//
// Coefficients and Jacobian are exact for the harmonics kept where f is a polynomial of degree g and there
// are more than (g + 1) N samples; else the error falls as fast as the harmonics of f do.

#include <arcslip/laws/law_type.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace arcslip::elements {

/// What a law keeps between its calls with the same SampledForce.
struct Scratch {
  virtual ~Scratch() = default;
};

/// The force of a law without memory at several q at once: a row for each. A law sets everything that may
/// differ from its previous values here.
struct SampledForce {
  SampledForce() = default;
  SampledForce(Eigen::Index rows, Eigen::Index directions, Eigen::Index fields);

  Eigen::MatrixXd f;                 // a column for each direction, N
  Eigen::MatrixXd f_q;               // df_i/dq_j in column j * directions + i
  Eigen::MatrixXd f_v;               // df_i/dv_j likewise, where the law is rate-dependent
  Eigen::MatrixXd f_field;           // df_i/d(fields[k]) in column k * directions + i
  std::uint64_t piece = 0;           // another number where many samples go over a kink of f together
  std::unique_ptr<Scratch> scratch;  // the law's own; none at first
};

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

  /// The energy stored at q, J. Along one direction that of the force at rest; along several it is 0 where
  /// the law dissipates. The rest of the work is dissipated, which may be negative.
  virtual double stored(Fields fields, In q) const;

  Traits traits(Fields fields, int direction) const override;
  double stiffness(Fields fields, int direction, double reach) const override;
  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override;
  Eigen::MatrixXd force_at(const Harmonics& harmonics, In u, Fields fields, Angles angles) const override;
  Eigen::MatrixXd moving_force_at(const Harmonics& harmonics, In u, double base_frequency, Fields fields,
                                  Angles angles) const override;
  std::unique_ptr<TimeLaw> in_time(Fields fields) const override;

 protected:
  /// The force along a direction as a function of the displacement along it.
  struct Shape {
    bool elastic = true;  // it depends on it
    bool linear = false;
    bool smooth_rates = true;  // its velocities alone do not make several responses
    std::optional<std::vector<double>>
        polynomial;  // at rest, where it is known: coefficients up to the last that is not 0
  };
  /// By default from the force at some displacements.
  virtual Shape shape(Fields fields, int direction) const;
};

/// The force of a law at one place; owns its buffers.
class ForceProbe {
 public:
  ForceProbe(const SampledLaw& law, Fields fields);

  Eigen::MatrixXd q, v;   // one row: set these and the phase first
  Eigen::VectorXd phase;  // one

  const SampledForce& force() { return sample(Wanted::force); }
  const SampledForce& tangent() { return sample(Wanted::tangent); }

 private:
  const SampledForce& sample(Wanted wanted);

  const SampledLaw& law_;
  std::vector<double> fields_;
  SampledForce at_;
};

}  // namespace arcslip::elements
