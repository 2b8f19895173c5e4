#include <arcslip/elements/cubic_spring.hpp>

#include <arcslip/elements/samples.hpp>

namespace arcslip::elements {
namespace {

class CubicSpring final : public Element {
 public:
  explicit CubicSpring(const Harmonics& h)
      : h_(h),
        samples_(h, h.odd ? 2 * h.order + 2 : 4 * h.order + 2),
        moments_(h),
        x_(samples_.count()),
        f_(samples_.count()),
        cube_(h.size()),
        F_(h.size()),
        J_(h.size(), h.size()) {}

  void move_to(In u, std::span<const double> fields, bool jacobian) override {
    const double k3 = fields[0];
    const double kappa = (h_.odd ? 2 : 1) / std::numbers::pi * samples_.weight();
    samples_.values(u, x_);
    f_ = kappa * x_.array().cube();
    cube_.setZero();
    samples_.project(f_, cube_);
    if (!h_.odd) cube_[0] *= 0.5;
    F_ = k3 * cube_;
    if (!jacobian) return;
    f_ = 3 * kappa * k3 * x_.array().square();
    samples_.moments(f_, moments_);
    J_.setZero();
    moments_.add_to(J_, 1);
    if (!h_.odd) J_.row(0) *= 0.5;
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int, Out dF) const override { dF = cube_; }

 private:
  Harmonics h_;
  Samples samples_;
  Moments moments_;
  Eigen::VectorXd x_, f_, cube_, F_;
  Eigen::MatrixXd J_;
};

}  // namespace

std::unique_ptr<Element> make_cubic_spring(const Harmonics& harmonics) {
  return std::make_unique<CubicSpring>(harmonics);
}

}  // namespace arcslip::elements
