#pragma once
// The hysteresis of Bouc and Wen: f = a k q + (1 - a) k z with z' = q' - (b sgn(q' z) + c) |z| q', m. In
// harmonic balance z is an unknown of the element's own, and its equation, which knows no rate, is sampled.

#include <arcslip/elements/law.hpp>
#include <arcslip/elements/samples.hpp>

#include <cmath>
#include <limits>

namespace own_laws {

using namespace arcslip;
using elements::Fields, elements::In, elements::Out;

/// dz/dq, and its derivatives by z and by the sign's factor.
struct Hysteresis {
  double rate, by_z;
};
inline Hysteresis hysteresis(Fields fields, double z, double way) {
  const double turn = fields[2] * (way * z > 0 ? 1 : way * z < 0 ? -1 : 0) + fields[3];
  return {1 - turn * std::abs(z), -turn * (z > 0 ? 1 : z < 0 ? -1 : 0)};
}

class BoucWenElement final : public elements::Element {
 public:
  explicit BoucWenElement(const elements::Harmonics& h)
      : h_(h),
        samples_(h, 4096 / (h.odd ? 2 : 1)),
        moments_(h),
        F_(2 * h.size()),
        J_(F_.size(), F_.size()),
        slope_(h.size(), h.size()) {
    slope_.setZero();  // of the coefficients: those of dx/dtheta
    for (int j = 0; j < h.sines(); ++j) {
      const int n = h.sine_order(j), a = h.cosine_index(n), b = h.sine_index(n);
      slope_(a, b) = n;
      slope_(b, a) = -n;
    }
    for (Eigen::VectorXd* v : {&z_, &dq_, &rest_, &by_way_, &by_z_}) v->resize(samples_.count());
  }

  void move_to(In u, Fields fields, bool jacobian) override {
    const Eigen::Index c = h_.size();
    const double k = fields[0], a = fields[1];
    fields_.assign(fields.begin(), fields.end());
    u_ = u;
    F_.head(c) = a * k * u.head(c) + (1 - a) * k * u.tail(c);
    samples_.values(u.tail(c), z_);
    samples_.values(slope_ * u.head(c), dq_);
    for (Eigen::Index s = 0; s < z_.size(); ++s) {
      const Hysteresis at = hysteresis(fields, z_[s], dq_[s]);
      rest_[s] = at.rate * dq_[s];
      by_way_[s] = at.rate;
      by_z_[s] = at.by_z * dq_[s];
    }
    project(rest_, rest_coefficients_);
    F_.tail(c) = slope_ * u.tail(c) - rest_coefficients_;
    if (!jacobian) return;
    J_.setZero();
    J_.topLeftCorner(c, c).diagonal().setConstant(a * k);
    J_.topRightCorner(c, c).diagonal().setConstant((1 - a) * k);
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(c, c);
    weigh(by_way_, block);
    J_.bottomLeftCorner(c, c) = -block * slope_;
    block.setZero();
    weigh(by_z_, block);
    J_.bottomRightCorner(c, c) = slope_ - block;
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int field, Out dF) const override {
    const Eigen::Index c = h_.size();
    const double k = fields_[0], a = fields_[1];
    dF.setZero();
    if (field == 0) dF.head(c) = a * u_.head(c) + (1 - a) * u_.tail(c);
    if (field == 1) dF.head(c) = k * (u_.head(c) - u_.tail(c));
    if (field < 2) return;
    Eigen::VectorXd change(z_.size()), coefficients;
    for (Eigen::Index s = 0; s < change.size(); ++s) {
      const double sign = dq_[s] * z_[s] > 0 ? 1 : -1;
      change[s] = (field == 2 ? sign : 1) * std::abs(z_[s]) * dq_[s];
    }
    project(change, coefficients);
    dF.tail(c) = coefficients;
  }

 private:
  double factor() const { return (h_.odd ? 2 : 1) / std::numbers::pi * samples_.weight(); }
  void project(const Eigen::VectorXd& values, Eigen::VectorXd& coefficients) const {
    coefficients.setZero(h_.size());
    samples_.project(values, coefficients);
    coefficients *= factor();
    if (!h_.odd) coefficients[0] *= 0.5;
  }
  void weigh(const Eigen::VectorXd& weights, Eigen::MatrixXd& block) {
    samples_.moments(weights, moments_);
    moments_.add_to(block, factor());
    if (!h_.odd) block.row(0) *= 0.5;
  }

  elements::Harmonics h_;
  elements::Samples samples_;
  elements::Moments moments_;
  Eigen::VectorXd u_, F_, z_, dq_, rest_, by_way_, by_z_, rest_coefficients_;
  Eigen::MatrixXd J_, slope_;
  std::vector<double> fields_;
};

class BoucWen final : public elements::PlainLaw {
 public:
  std::string_view name() const override { return "bouc_wen"; }
  std::string_view help() const override { return "smooth hysteresis"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return fields_; }

  bool antisymmetric() const override { return true; }
  bool dissipative() const override { return true; }
  elements::Traits traits(Fields fields, int) const override {
    return {.stiffness = fields[0], .stiffness_field = 0, .holds_mean = fields[1] > 0, .far_power = 1};
  }
  double stiffness(Fields fields, int, double) const override { return fields[0]; }
  std::unique_ptr<elements::Element> element(const elements::Harmonics& harmonics,
                                             const elements::Sampling&) const override {
    return std::make_unique<BoucWenElement>(harmonics);
  }
  int auxiliary() const override { return 1; }
  double auxiliary_scale(Fields fields) const override { return 1 / (fields[2] + fields[3]); }
  Eigen::MatrixXd force_at(const elements::Harmonics& h, In u, Fields fields,
                           elements::Angles angles) const override {
    Eigen::MatrixXd f(static_cast<Eigen::Index>(angles.size()), 1);
    for (Eigen::Index s = 0; s < f.rows(); ++s) {
      const double theta = angles[static_cast<std::size_t>(s)];
      const double q = elements::series_values(h, u.head(h.size()), theta).x;
      const double z = elements::series_values(h, u.tail(h.size()), theta).x;
      f(s, 0) = fields[1] * fields[0] * q + (1 - fields[1]) * fields[0] * z;
    }
    return f;
  }

  int memory() const override { return 1; }
  void memory_at(Fields fields, In q, In f, Out z) const override {
    z[0] = (f[0] - fields[1] * fields[0] * q[0]) / ((1 - fields[1]) * fields[0]);
  }
  void begin(Fields fields, In q, Out z, elements::StepEnd& at) const override {
    const double k = fields[0], a = fields[1];
    at.f[0] = a * k * q[0] + (1 - a) * k * z[0];
    at.f_q(0, 0) = a * k;
    at.f_z(0, 0) = (1 - a) * k;
  }
  // The middle of the step decides: dz = (1 - (...) |z + dz/2|) dq.
  void step(Fields fields, const elements::StepStart& start, In dq, elements::StepEnd& end) const override {
    const double k = fields[0], a = fields[1], z0 = start.z[0];
    double dz = dq[0];
    Hysteresis at{};
    for (int i = 0; i < 50; ++i) {
      at = hysteresis(fields, z0 + 0.5 * dz, dq[0]);
      const double step = (at.rate * dq[0] - dz) / (1 - 0.5 * at.by_z * dq[0]);
      dz += step;
      if (std::abs(step) <= 1e-16 * (std::abs(z0) + std::abs(dz))) break;
    }
    at = hysteresis(fields, z0 + 0.5 * dz, dq[0]);
    const double by_z = at.by_z * dq[0], solved = 1 / (1 - 0.5 * by_z);
    end.dz[0] = dz;
    end.f[0] = a * k * (start.q[0] + dq[0]) + (1 - a) * k * (z0 + dz);
    end.z_q(0, 0) = at.rate * solved;
    end.z_z(0, 0) = 1 + by_z * solved;
    end.f_q(0, 0) = a * k + (1 - a) * k * end.z_q(0, 0);
    end.f_z(0, 0) = (1 - a) * k * end.z_z(0, 0);
    end.z_start = -end.z_q;  // of the way dq alone
    end.f_start(0, 0) = -(1 - a) * k * end.z_q(0, 0);
    end.dissipated = (1 - a) * k * (z0 + 0.5 * dz) * (dq[0] - dz);
  }
  double stored(Fields fields, In q, In z) const override {
    return 0.5 * fields[0] * (fields[1] * q[0] * q[0] + (1 - fields[1]) * z[0] * z[0]);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr scene::Field fields_[] = {
      {.name = "stiffness", .unit = "N/m", .lower = 0, .upper = infinity, .lower_open = true, .help = "k"},
      {.name = "elastic_share", .unit = "-", .lower = 0, .upper = 1, .help = "a"},
      {.name = "growth", .unit = "1/m", .lower = 0, .upper = infinity, .help = "b"},
      {.name = "softening", .unit = "1/m", .lower = -infinity, .upper = infinity, .help = "c"}};
};

}  // namespace own_laws
