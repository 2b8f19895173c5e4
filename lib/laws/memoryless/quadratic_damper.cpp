#include <arcslip/laws/memoryless/quadratic_damper.hpp>

#include <arcslip/fourier/velocity_sign.hpp>
#include <arcslip/laws/memoryless/formula_law.hpp>

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

// What a formula says, integrated in closed form: some thirty times as fast as by its kinks.
class QuadraticDamper final : public FormulaLaw {
 public:
  QuadraticDamper()
      : FormulaLaw("quadratic_damper", "a damper whose force grows as the velocity squared",
                   {"coefficient*abs(v)*v"}, quadratic_damper_fields) {}
  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling&) const override {
    return std::make_unique<QuadraticElement>(harmonics);
  }
};

}  // namespace

const PlainLaw& quadratic_damper() {
  static const QuadraticDamper law;
  return law;
}

}  // namespace arcslip::elements
