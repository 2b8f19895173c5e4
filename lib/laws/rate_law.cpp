#include <arcslip/laws/rate_law.hpp>

#include <array>

namespace arcslip::elements {
namespace {

void set_rate_force(const RateLaw& law, Fields fields, Eigen::Index s, double q, double v, SampledForce& at) {
  std::array<double, RateLaw::most_fields> by_field{};
  const RateLaw::Force force = law.force(fields, q, v, by_field.data());
  at.f(s, 0) = force.f;
  at.f_q(s, 0) = force.by_q;
  at.f_v(s, 0) = force.by_v;
  for (std::size_t k = 0; k < fields.size(); ++k) at.f_field(s, static_cast<Eigen::Index>(k)) = by_field[k];
}

}  // namespace

void RateLaw::sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const {
  for (Eigen::Index s = 0; s < q.rows(); ++s) set_rate_force(*this, fields, s, q(s, 0), 0, at);
}

void RateLaw::sample_motion(Fields fields, const SampledMotion& motion, Wanted, SampledForce& at) const {
  for (Eigen::Index s = 0; s < motion.q.rows(); ++s)
    set_rate_force(*this, fields, s, motion.q(s, 0), motion.v(s, 0), at);
}

void RateLaw::step(Fields fields, const StepStart& start, In dq, StepEnd& end) const {
  SampledLaw::step(fields, start, dq, end);
  end.dissipated = 0.5 * (start.f[0] + end.f[0]) * dq[0];
}

}  // namespace arcslip::elements
