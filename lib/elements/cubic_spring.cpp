#include <arcslip/elements/cubic_spring.hpp>

#include <arcslip/elements/samples.hpp>

namespace arcslip::elements {
namespace {

class SampledCube final : public Element {
 public:
  explicit SampledCube(const Harmonics& h)
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

constexpr scene::Field all_fields[] = {
    {.name = "stiffness",
     .unit = "N/m^3",
     .lower = -std::numeric_limits<double>::infinity(),
     .upper = std::numeric_limits<double>::infinity(),
     .help = "force = stiffness * displacement^3"},
};

class CubicSpring final : public PlainLaw {
 public:
  std::string_view name() const override { return "cubic_spring"; }
  std::string_view help() const override { return "a spring that hardens, or softens, with the cube"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return all_fields; }

  bool antisymmetric() const override { return true; }
  Traits traits(Fields fields, int) const override {
    if (fields[0] == 0) return {};
    return {.stiffness = std::numeric_limits<double>::infinity(),
            .holds_mean = true,
            .several_responses = true,
            .far_power = 3};
  }
  double stiffness(Fields fields, int, double reach) const override {
    return fields[0] == 0 ? 0 : 3 * fields[0] * reach * reach;
  }

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling&) const override {
    return std::make_unique<SampledCube>(harmonics);
  }
  Eigen::MatrixXd force_at(const Harmonics& h, In u, Fields fields, Angles angles) const override {
    Eigen::MatrixXd force(static_cast<Eigen::Index>(angles.size()), 1);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double x = series_values(h, u, angles[i]).x;
      force(static_cast<Eigen::Index>(i), 0) = fields[0] * x * x * x;
    }
    return force;
  }

  void begin(Fields fields, In q, Out, StepEnd& at) const override {
    at.f[0] = fields[0] * q[0] * q[0] * q[0];
    at.f_q(0, 0) = 3 * fields[0] * q[0] * q[0];
  }
  void step(Fields fields, const StepStart& start, In dq, StepEnd& end) const override {
    const double q = start.q[0] + dq[0];
    end.f[0] = fields[0] * q * q * q;
    end.f_q(0, 0) = 3 * fields[0] * q * q;
  }
  double stored(Fields fields, In q, In) const override {
    return 0.25 * fields[0] * q[0] * q[0] * q[0] * q[0];
  }
  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    if (fields[0] != 0) return {};
    Automaton nothing(-1);
    nothing.add("without force", 0, 0, 0);
    return std::vector{nothing};
  }
};

}  // namespace

const PlainLaw& cubic_spring() {
  static const CubicSpring law;
  return law;
}

}  // namespace arcslip::elements
