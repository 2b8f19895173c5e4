#include <arcslip/laws/memoryless/quadratic_damper.hpp>

#include <arcslip/fourier/velocity_sign.hpp>
#include <arcslip/laws/rate_law.hpp>

#include <cmath>

namespace arcslip::elements {
namespace {

constexpr scene::Field quadratic_damper_fields[] = {
    {.name = "coefficient",
     .unit = "N s^2/m^2",
     .lower = 0,
     .upper = infinity,
     .help = "force = coefficient * abs(velocity) * velocity"},
};

class QuadraticElement final : public Element {
 public:
  explicit QuadraticElement(const Harmonics& h)
      : h_(h),
        sign_(h),
        moments_(h),
        v_(h.size()),
        shape_(h.size()),
        F_(h.size()),
        G_(h.size(), h.size()),
        J_(h.size(), h.size()) {}

  void set_frequency(double base_frequency) override { frequency_ = base_frequency; }
  void move_to(In u, Fields fields, bool jacobian) override {
    c_ = fields[0];
    sign_.move_to(u);
    series_slope(h_, u, v_);
    v_ *= frequency_;
    sign_.moments(v_, moments_);
    const double kappa = (h_.odd ? 2 : 1) / std::numbers::pi;
    shape_.setZero();
    moments_.times(v_, kappa, shape_);
    if (!h_.odd) shape_[0] *= 0.5;
    F_ = c_ * shape_;
    if (!jacobian) return;
    G_.setZero();
    moments_.add_to(G_, 2 * kappa * c_ * frequency_);
    if (!h_.odd) G_.row(0) *= 0.5;
    J_.setZero();
    for (int j = 0; j < h_.sines(); ++j) {
      const int n = h_.sine_order(j), a = h_.cosine_index(n), b = h_.sine_index(n);
      J_.col(a) = -n * G_.col(b);
      J_.col(b) = n * G_.col(a);
    }
  }
  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int, Out dF) const override { dF = shape_; }
  void frequency_derivative(Out dF) const override { dF = 2 / frequency_ * F_; }

 private:
  Harmonics h_;
  VelocitySign sign_;
  Moments moments_;
  double c_ = 0, frequency_ = 1;
  Eigen::VectorXd v_, shape_, F_;
  Eigen::MatrixXd G_, J_;
};

class QuadraticDamper final : public RateLaw {
 public:
  std::string_view name() const override { return "quadratic_damper"; }
  std::string_view help() const override { return "a damper whose force grows as the velocity squared"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override {
    return quadratic_damper_fields;
  }

  Traits traits(Fields fields, int) const override { return {.far_work = fields[0] > 0 ? infinity : 0}; }
  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling&) const override {
    return std::make_unique<QuadraticElement>(harmonics);
  }
  Force force(Fields fields, double, double v, double* by_field) const override {
    by_field[0] = std::abs(v) * v;
    return {fields[0] * by_field[0], 0, 2 * fields[0] * std::abs(v)};
  }
};

}  // namespace

const PlainLaw& quadratic_damper() {
  static const QuadraticDamper law;
  return law;
}

}  // namespace arcslip::elements
