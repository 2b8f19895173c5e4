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
    for (Eigen::Index i = 0; i < directions_; ++i) samples_.coefficients(at_.f.col(i), F_.segment(i * c, c));
    if (!jacobian) return;
    J_.setZero();
    for (Eigen::Index j = 0; j < directions_; ++j)
      for (Eigen::Index i = 0; i < directions_; ++i) {
        samples_.moments(at_.f_q.col(j * directions_ + i), moments_);
        auto block = J_.block(i * c, j * c, c, c);
        moments_.add_to(block, samples_.factor());
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
      samples_.coefficients(weights_, dF.segment(i * c, c));
    }
  }
  void field_derivative(int field, Out dF) const override {
    const Eigen::Index c = h_.size();
    if (!has_field_derivatives_) law_.sample_motion(fields_, {q_, v_, phase_}, Wanted::by_fields, at_);
    has_field_derivatives_ = true;
    for (Eigen::Index i = 0; i < directions_; ++i)
      samples_.coefficients(at_.f_field.col(field * directions_ + i), dF.segment(i * c, c));
  }

 private:
  // Adds G(f_v) times the matrix that makes coefficients of v of those of q.
  void add_rate(Eigen::Index column, Eigen::Ref<Eigen::MatrixXd> block) {
    samples_.moments(at_.f_v.col(column), moments_);
    block_.setZero();
    moments_.add_to(block_, samples_.factor() * frequency_);
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

class SampledInTime final : public TimeLaw {
 public:
  SampledInTime(const SampledLaw& law, Fields fields)
      : law_(law), fields_(fields.begin(), fields.end()), probe_(law, fields), at_rest_(law, fields) {}

  void begin(In q, Out, StepEnd& at) override { set(q.transpose(), at); }
  void step(const StepStart& start, In dq, StepEnd& end) override {
    end_ = start.q + dq;
    set(end_.transpose(), end);
    end.dissipated = law_.dissipative() ? 0.5 * (start.f + end.f).dot(dq) - stored_in_step(start, dq) : 0;
  }
  double stored(In q, In) override { return law_.stored(fields_, q); }

 private:
  void set(const Eigen::Ref<const Eigen::RowVectorXd>& q, StepEnd& at) {
    const Eigen::Index d = at.f.size();
    probe_.q = q;
    probe_.v = at.v.transpose();
    probe_.phase[0] = at.phase;
    const SampledForce& sample = probe_.tangent();
    at.f = sample.f.row(0).transpose();
    at.f_q = sample.f_q.reshaped(d, d);
    if (law_.rate_dependent()) at.f_v = sample.f_v.reshaped(d, d);
  }
  // Along one direction by the trapezoidal rule, as the work.
  double stored_in_step(const StepStart& start, In dq) {
    if (dq.size() > 1) return law_.stored(fields_, end_) - law_.stored(fields_, start.q);
    if (law_.phase_dependent() || !law_.rate_dependent()) return 0;
    double sum = 0;
    for (const double q : {start.q[0], end_[0]}) {
      at_rest_.q(0, 0) = q;
      sum += at_rest_.force().f(0, 0);
    }
    return 0.5 * sum * dq[0];
  }

  const SampledLaw& law_;
  std::vector<double> fields_;
  ForceProbe probe_, at_rest_;
  Eigen::VectorXd end_;
};

}  // namespace

SampledForce::SampledForce(Eigen::Index rows, Eigen::Index directions, Eigen::Index fields)
    : f(Eigen::MatrixXd::Zero(rows, directions)),
      f_q(Eigen::MatrixXd::Zero(rows, directions * directions)),
      f_v(f_q),
      f_field(Eigen::MatrixXd::Zero(rows, directions * fields)) {}

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

std::unique_ptr<TimeLaw> SampledLaw::in_time(Fields fields) const {
  return std::make_unique<SampledInTime>(*this, fields);
}

ForceProbe::ForceProbe(const SampledLaw& law, Fields fields)
    : q(Eigen::MatrixXd::Zero(1, law.directions())),
      v(q),
      phase(Eigen::VectorXd::Zero(1)),
      law_(law),
      fields_(fields.begin(), fields.end()),
      at_(1, law.directions(), static_cast<Eigen::Index>(fields.size())) {}

const SampledForce& ForceProbe::sample(Wanted wanted) {
  law_.sample_motion(fields_, {q, v, phase}, wanted, at_);
  return at_;
}

}  // namespace arcslip::elements
