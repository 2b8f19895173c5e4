#include <arcslip/laws/hysteresis/bouc_wen_element.hpp>

#include <arcslip/fourier/samples.hpp>

#include <algorithm>
#include <array>

namespace arcslip::elements {
namespace {

// Of the mean of z in its equation, which does not hold it in a motion of no size.
constexpr double held_mean = 1e-12;

int sample_count(const Harmonics& h, const Sampling& sampling) {
  const int own = 2 * std::min(h.order, 32) * h.order + 128;
  const int count = sampling.exact ? own : std::max(own, sampling.samples);
  return h.odd ? (count + 1) / 2 : count;
}

class BoucWenElement final : public Element {
 public:
  BoucWenElement(const Harmonics& h, const Sampling& sampling)
      : h_(h),
        samples_(h, sample_count(h, sampling)),
        moments_(h),
        u_(2 * h.size()),
        F_(u_.size()),
        slope_(h.size()),
        J_(F_.size(), F_.size()),
        block_(h.size(), h.size()) {
    for (Eigen::VectorXd* v : {&z_, &dq_, &values_}) v->resize(samples_.count());
  }

  void move_to(In u, Fields fields, bool jacobian) override {
    const Eigen::Index c = h_.size();
    std::copy(fields.begin(), fields.end(), fields_.begin());
    u_ = u;
    const BoucWenFields at(fields);
    F_.head(c) = at.a * at.k * u.head(c) + (1 - at.a) * at.k * u.tail(c);
    samples_.values(u.tail(c), z_);
    series_slope(h_, u.head(c), slope_);
    samples_.values(slope_, dq_);
    // dz/dtheta - rate dq/dtheta
    each([](const BoucWenRate& r, double dq) { return r.rate * dq; });
    samples_.coefficients(values_, F_.tail(c));
    series_slope(h_, u.tail(c), slope_);
    F_.tail(c) = slope_ - F_.tail(c);
    if (!h_.odd) F_[c] += held_mean * u[c];
    if (!jacobian) return;
    J_.setZero();
    J_.topLeftCorner(c, c).diagonal().setConstant(at.a * at.k);
    J_.topRightCorner(c, c).diagonal().setConstant((1 - at.a) * at.k);
    each([](const BoucWenRate& r, double) { return r.rate; });
    weigh();
    auto by_q = J_.bottomLeftCorner(c, c);
    auto by_z = J_.bottomRightCorner(c, c);
    for (int j = 0; j < h_.sines(); ++j) {
      const int n = h_.sine_order(j), a = h_.cosine_index(n), b = h_.sine_index(n);
      by_q.col(a) = n * block_.col(b);
      by_q.col(b) = -n * block_.col(a);
    }
    each([](const BoucWenRate& r, double dq) { return r.by_z * dq; });
    weigh();
    by_z = -block_;
    if (!h_.odd) by_z(0, 0) += held_mean;
    for (int j = 0; j < h_.sines(); ++j) {
      const int n = h_.sine_order(j), a = h_.cosine_index(n), b = h_.sine_index(n);
      by_z(a, b) += n;
      by_z(b, a) -= n;
    }
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int field, Out dF) const override {
    const Eigen::Index c = h_.size();
    const BoucWenFields at(fields_);
    dF.setZero();
    if (field == 0) dF.head(c) = at.a * u_.head(c) + (1 - at.a) * u_.tail(c);
    if (field == 1) dF.head(c) = at.k * (u_.head(c) - u_.tail(c));
    if (field == 2)
      each([&](const BoucWenRate& r, double dq) { return -at.n / at.z_y * r.power * r.turn * dq; });
    if (field == 3)
      each([](const BoucWenRate& r, double dq) {
        return r.share > 0 ? r.power * std::log(r.share) * r.turn * dq : 0;
      });
    if (field == 4) each([&](const BoucWenRate& r, double dq) { return r.power * (r.turn - 1) / at.s * dq; });
    if (field >= 2) samples_.coefficients(values_, dF.tail(c));
  }

 private:
  template <class Value>
  void each(Value value) const {
    const BoucWenFields at(fields_);
    for (Eigen::Index s = 0; s < z_.size(); ++s) values_[s] = value(BoucWenRate(at, z_[s], dq_[s]), dq_[s]);
  }
  void weigh() {
    samples_.moments(values_, moments_);
    block_.setZero();
    moments_.add_to(block_, samples_.factor());
    if (!h_.odd) block_.row(0) *= 0.5;
  }

  Harmonics h_;
  Samples samples_;
  Moments moments_;
  Eigen::VectorXd u_, F_, slope_, z_, dq_;
  mutable Eigen::VectorXd values_;
  Eigen::MatrixXd J_, block_;
  std::array<double, 5> fields_{};
};

}  // namespace

std::unique_ptr<Element> bouc_wen_element(const Harmonics& harmonics, const Sampling& sampling) {
  return std::make_unique<BoucWenElement>(harmonics, sampling);
}

}  // namespace arcslip::elements
