#include <arcslip/laws/sampled_law.hpp>

#include <arcslip/fourier/samples.hpp>

#include <utility>
#include <vector>

namespace arcslip::elements {
namespace {

class SampledElement final : public Element {
 public:
  SampledElement(const SampledLaw& law, const Harmonics& h)
      : law_(law),
        h_(h),
        directions_(law.directions()),
        moves_(law.rate_dependent()),
        samples_(h, h.odd ? (law.samples(h) + 1) / 2 : law.samples(h)),
        moments_(h),
        q_(samples_.count(), directions_),
        v_(moves_ ? samples_.count() : 0, directions_),
        phase_(law.phase_dependent() ? samples_.count() : 0),
        at_(samples_.count(), directions_, static_cast<Eigen::Index>(law.fields({}).size())),
        F_(directions_ * h.size()),
        J_(F_.size(), F_.size()),
        slope_(h.size()),
        weights_(samples_.count()),
        block_(moves_ ? h.size() : 0, h.size()) {
    for (Eigen::Index s = 0; s < phase_.size(); ++s)
      phase_[s] = h.period * samples_.angle(static_cast<int>(s));
  }

  void set_frequency(double base_frequency) override { frequency_ = base_frequency; }

  void move_to(In u, Fields fields, bool jacobian) override {
    const Eigen::Index c = h_.size();
    for (Eigen::Index i = 0; i < directions_; ++i) samples_.values(u.segment(i * c, c), q_.col(i));
    if (moves_) {
      for (Eigen::Index i = 0; i < directions_; ++i) {
        series_slope(h_, u.segment(i * c, c), slope_);
        slope_ *= frequency_;
        samples_.values(slope_, v_.col(i));
      }
    }
    fields_.assign(fields.begin(), fields.end());
    has_field_derivatives_ = false;
    has_tangent_ = jacobian;
    law_.sample_motion(fields_, {q_, v_, phase_}, jacobian ? Wanted::tangent : Wanted::force, at_);
    for (Eigen::Index i = 0; i < directions_; ++i) project(at_.f.col(i), F_.segment(i * c, c));
    if (!jacobian) return;
    J_.setZero();
    for (Eigen::Index j = 0; j < directions_; ++j)
      for (Eigen::Index i = 0; i < directions_; ++i) {
        samples_.moments(at_.f_q.col(j * directions_ + i), moments_);
        auto block = J_.block(i * c, j * c, c, c);
        moments_.add_to(block, factor());
        if (moves_) add_rate(j * directions_ + i, block);
        if (!h_.odd) block.row(0) *= 0.5;
      }
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  std::uint64_t piece() const override { return at_.piece; }
  void frequency_derivative(Out dF) const override {
    dF.setZero();
    if (!moves_) return;
    if (!has_tangent_) law_.sample_motion(fields_, {q_, v_, phase_}, Wanted::tangent, at_);
    has_tangent_ = true;
    const Eigen::Index c = h_.size();
    for (Eigen::Index i = 0; i < directions_; ++i) {
      weights_.setZero();
      for (Eigen::Index j = 0; j < directions_; ++j)
        weights_.array() += at_.f_v.col(j * directions_ + i).array() * v_.col(j).array() / frequency_;
      project(weights_, dF.segment(i * c, c));
    }
  }
  void field_derivative(int field, Out dF) const override {
    const Eigen::Index c = h_.size();
    if (!has_field_derivatives_) law_.sample_motion(fields_, {q_, v_, phase_}, Wanted::by_fields, at_);
    has_field_derivatives_ = true;
    for (Eigen::Index i = 0; i < directions_; ++i)
      project(at_.f_field.col(field * directions_ + i), dF.segment(i * c, c));
  }

 private:
  double factor() const { return (h_.odd ? 2 : 1) / std::numbers::pi * samples_.weight(); }
  void project(In f, Out F) const {
    F.setZero();
    samples_.project(f, F);
    F *= factor();
    if (!h_.odd) F[0] *= 0.5;
  }

  // Adds G(f_v) times the matrix that makes coefficients of v of those of q.
  void add_rate(Eigen::Index column, Eigen::Ref<Eigen::MatrixXd> block) {
    samples_.moments(at_.f_v.col(column), moments_);
    block_.setZero();
    moments_.add_to(block_, factor() * frequency_);
    for (int j = 0; j < h_.sines(); ++j) {
      const int n = h_.sine_order(j), a = h_.cosine_index(n), b = h_.sine_index(n);
      block.col(a) -= n * block_.col(b);
      block.col(b) += n * block_.col(a);
    }
  }

  const SampledLaw& law_;
  Harmonics h_;
  Eigen::Index directions_;
  bool moves_;
  Samples samples_;
  Moments moments_;
  Eigen::MatrixXd q_, v_;
  Eigen::VectorXd phase_;
  std::vector<double> fields_;
  mutable SampledForce at_;
  mutable bool has_field_derivatives_ = false, has_tangent_ = false;
  Eigen::VectorXd F_;
  Eigen::MatrixXd J_;
  double frequency_ = 0;
  Eigen::VectorXd slope_;
  mutable Eigen::VectorXd weights_;
  Eigen::MatrixXd block_;
};

void set_sample_force(const SampledLaw& law, Fields fields, StepEnd& at) {
  const Eigen::Index d = at.f.size();
  if (at.sample.f.size() == 0) {
    at.sample = {1, d, static_cast<Eigen::Index>(fields.size())};
    at.sample_phase.resize(1);
  }
  at.sample_v = at.v.transpose();
  at.sample_phase[0] = at.phase;
  law.sample_motion(fields, {at.sample_q, at.sample_v, at.sample_phase}, Wanted::tangent, at.sample);
  at.f = at.sample.f.row(0).transpose();
  at.f_q = at.sample.f_q.reshaped(d, d);
  if (law.rate_dependent()) at.f_v = at.sample.f_v.reshaped(d, d);
}

}  // namespace

std::unique_ptr<Element> SampledLaw::element(const Harmonics& harmonics, const Sampling&) const {
  return std::make_unique<SampledElement>(*this, harmonics);
}

Eigen::MatrixXd SampledLaw::force_at(const Harmonics& h, In u, Fields fields, Angles angles) const {
  return moving_force_at(h, u, 0, fields, angles);
}

Eigen::MatrixXd SampledLaw::moving_force_at(const Harmonics& h, In u, double base_frequency, Fields fields,
                                            Angles angles) const {
  Eigen::MatrixXd q(static_cast<Eigen::Index>(angles.size()), directions()), v(q.rows(), q.cols());
  const Eigen::VectorXd phase = h.period * Eigen::Map<const Eigen::VectorXd>(angles.data(), q.rows());
  for (Eigen::Index s = 0; s < q.rows(); ++s)
    for (Eigen::Index i = 0; i < q.cols(); ++i) {
      const Values at =
          series_values(h, u.segment(i * h.size(), h.size()), angles[static_cast<std::size_t>(s)]);
      q(s, i) = at.x;
      v(s, i) = base_frequency * at.d1;
    }
  SampledForce at(q.rows(), directions(), static_cast<Eigen::Index>(fields.size()));
  sample_motion(fields, {q, v, phase}, Wanted::force, at);
  return std::move(at.f);
}

void SampledLaw::begin(Fields fields, In q, Out, StepEnd& at) const {
  at.sample_q = q.transpose();
  set_sample_force(*this, fields, at);
}

void SampledLaw::step(Fields fields, const StepStart& start, In dq, StepEnd& end) const {
  end.sample_q = (start.q + dq).transpose();
  set_sample_force(*this, fields, end);
}

}  // namespace arcslip::elements
