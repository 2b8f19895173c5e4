#include <arcslip/elements/sampled_law.hpp>

#include <arcslip/elements/samples.hpp>

#include <utility>

namespace arcslip::elements {
namespace {

class SampledElement final : public Element {
 public:
  SampledElement(const SampledLaw& law, const Harmonics& h)
      : law_(law),
        h_(h),
        directions_(law.directions()),
        samples_(h, h.odd ? (law.samples(h.order) + 1) / 2 : law.samples(h.order)),
        moments_(h),
        q_(samples_.count(), directions_),
        at_(samples_.count(), directions_, static_cast<Eigen::Index>(law.fields({}).size())),
        F_(directions_ * h.size()),
        J_(F_.size(), F_.size()) {}

  void move_to(In u, Fields fields, bool jacobian) override {
    const Eigen::Index c = h_.size();
    for (Eigen::Index i = 0; i < directions_; ++i) samples_.values(u.segment(i * c, c), q_.col(i));
    law_.sample(fields, q_, at_);
    for (Eigen::Index i = 0; i < directions_; ++i) project(at_.f.col(i), F_.segment(i * c, c));
    if (!jacobian) return;
    J_.setZero();
    for (Eigen::Index j = 0; j < directions_; ++j)
      for (Eigen::Index i = 0; i < directions_; ++i) {
        samples_.moments(at_.f_q.col(j * directions_ + i), moments_);
        auto block = J_.block(i * c, j * c, c, c);
        moments_.add_to(block, factor());
        if (!h_.odd) block.row(0) *= 0.5;
      }
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  std::uint64_t piece() const override { return at_.piece; }
  void field_derivative(int field, Out dF) const override {
    const Eigen::Index c = h_.size();
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

  const SampledLaw& law_;
  Harmonics h_;
  Eigen::Index directions_;
  Samples samples_;
  Moments moments_;
  Eigen::MatrixXd q_;
  SampledForce at_;
  Eigen::VectorXd F_;
  Eigen::MatrixXd J_;
};

void set(const SampledLaw& law, Fields fields, StepEnd& at) {
  const Eigen::Index d = at.f.size();
  if (at.sample.f.size() == 0) at.sample = {1, d, static_cast<Eigen::Index>(fields.size())};
  law.sample(fields, at.sample_q, at.sample);
  at.f = at.sample.f.row(0).transpose();
  at.f_q = at.sample.f_q.reshaped(d, d);
}

}  // namespace

std::unique_ptr<Element> SampledLaw::element(const Harmonics& harmonics, const Sampling&) const {
  return std::make_unique<SampledElement>(*this, harmonics);
}

Eigen::MatrixXd SampledLaw::force_at(const Harmonics& h, In u, Fields fields, Angles angles) const {
  Eigen::MatrixXd q(static_cast<Eigen::Index>(angles.size()), directions());
  for (Eigen::Index s = 0; s < q.rows(); ++s)
    for (Eigen::Index i = 0; i < q.cols(); ++i)
      q(s, i) = series_values(h, u.segment(i * h.size(), h.size()), angles[static_cast<std::size_t>(s)]).x;
  SampledForce at(q.rows(), directions(), static_cast<Eigen::Index>(fields.size()));
  sample(fields, q, at);
  return std::move(at.f);
}

void SampledLaw::begin(Fields fields, In q, Out, StepEnd& at) const {
  at.sample_q = q.transpose();
  set(*this, fields, at);
}

void SampledLaw::step(Fields fields, const StepStart& start, In dq, StepEnd& end) const {
  end.sample_q = (start.q + dq).transpose();
  set(*this, fields, end);
}

}  // namespace arcslip::elements
