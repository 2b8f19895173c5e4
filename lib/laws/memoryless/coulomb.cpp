#include <arcslip/laws/memoryless/coulomb.hpp>

#include <arcslip/fourier/velocity_sign.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace arcslip::elements {
namespace {

constexpr double least_bend = 1e-8;  // of the bound of |q''|: of reversals that are found apart
constexpr double largest = 1e150;    // so that products stay finite

enum { coulomb_coefficient_field, coulomb_load_field };

constexpr scene::Field coulomb_fields[] = {
    {.name = "friction_coefficient",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .help = "Coulomb friction coefficient"},
    {.name = "normal_load",
     .unit = "N",
     .lower = 0,
     .upper = infinity,
     .help = "normal load; force = friction_coefficient * normal_load against the velocity"},
};

double coulomb_limit(Fields fields) {
  return fields[coulomb_coefficient_field] * fields[coulomb_load_field];
}

double sign(double v) {
  return v > 0 ? 1 : v < 0 ? -1 : 0;
}

class CoulombElement final : public Element {
 public:
  explicit CoulombElement(const Harmonics& h)
      : h_(h),
        sign_(h),
        shape_(h.size()),
        F_(h.size()),
        phi_(h.size()),
        slope_(h.size()),
        J_(Eigen::MatrixXd::Zero(h.size(), h.size())) {}

  void move_to(In u, Fields fields, bool jacobian) override {
    for (int k : {coulomb_coefficient_field, coulomb_load_field})
      fields_[static_cast<std::size_t>(k)] = fields[static_cast<std::size_t>(k)];
    const double p = coulomb_limit(fields), kappa = (h_.odd ? 2 : 1) / std::numbers::pi;
    sign_.move_to(u);
    for (int i = 0; i < h_.cosines(); ++i) shape_[i] = kappa * sign_.integral(h_.cosine_order(i)).real();
    for (int j = 0; j < h_.sines(); ++j)
      shape_[h_.cosines() + j] = kappa * sign_.integral(h_.sine_order(j)).imag();
    if (!h_.odd) shape_[0] *= 0.5;
    F_ = p * shape_;
    jump_over_bend_ = 0;
    if (jacobian) J_.setZero();
    const double least = std::max(least_bend * series_bound(h_, u, 2), std::numeric_limits<double>::min());
    for (const Reversal& r : sign_.reversals()) {
      const double bend = std::max(std::abs(series_values(h_, u, r.theta).d2), least);
      const double ratio = std::min(p / bend, largest);
      jump_over_bend_ = std::max(jump_over_bend_, ratio);
      if (jacobian) add(r.theta, 2 * kappa * ratio);
    }
    if (jacobian && !h_.odd) J_.row(0) *= 0.5;
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int field, Out dF) const override {
    dF =
        fields_[field == coulomb_coefficient_field ? coulomb_load_field : coulomb_coefficient_field] * shape_;
  }
  std::uint64_t piece() const override { return sign_.reversals().size(); }
  double jump_over_bend() const override { return jump_over_bend_; }

 private:
  void add(double theta, double weight) {
    series_basis(h_, theta, phi_);
    for (int j = 0; j < h_.sines(); ++j) {
      const int n = h_.sine_order(j), a = h_.cosine_index(n), b = h_.sine_index(n);
      slope_[a] = -n * phi_[b];
      slope_[b] = n * phi_[a];
    }
    if (!h_.odd) slope_[0] = 0;
    J_.noalias() += weight * phi_ * slope_.transpose();
  }

  Harmonics h_;
  VelocitySign sign_;
  std::array<double, 2> fields_{};
  double jump_over_bend_ = 0;
  Eigen::VectorXd shape_, F_, phi_, slope_;
  Eigen::MatrixXd J_;
};

class CoulombInTime final : public TimeLaw {
 public:
  explicit CoulombInTime(double limit) : limit_(limit) {}
  void begin(In, Out, StepEnd& at) override { at.f[0] = 0; }
  void step(const StepStart&, In dq, StepEnd& end) override {
    end.f[0] = limit_ * sign(dq[0]);
    end.dissipated = limit_ * std::abs(dq[0]);
  }
  double stored(In, In) override { return 0; }

 private:
  double limit_;
};

class Coulomb final : public PlainLaw {
 public:
  std::string_view name() const override { return "coulomb"; }
  std::string_view help() const override { return "rigid Coulomb friction, of motions without stops"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return coulomb_fields; }

  Facts facts() const override { return {.antisymmetric = true, .dissipative = true, .set_valued = true}; }
  Traits traits(Fields fields, int) const override {
    return {.far_work = 4 * coulomb_limit(fields), .limit = coulomb_limit(fields)};
  }
  double stiffness(Fields, int, double) const override { return 0; }  // of a motion

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling&) const override {
    return std::make_unique<CoulombElement>(harmonics);
  }
  Eigen::MatrixXd force_at(const Harmonics& h, In u, Fields fields, Angles angles) const override {
    Eigen::MatrixXd f(static_cast<Eigen::Index>(angles.size()), 1);
    for (std::size_t i = 0; i < angles.size(); ++i)
      f(static_cast<Eigen::Index>(i), 0) = coulomb_limit(fields) * sign(series_values(h, u, angles[i]).d1);
    return f;
  }

  std::unique_ptr<TimeLaw> in_time(Fields fields) const override {
    return std::make_unique<CoulombInTime>(coulomb_limit(fields));
  }
};

}  // namespace

const PlainLaw& coulomb() {
  static const Coulomb law;
  return law;
}

}  // namespace arcslip::elements
