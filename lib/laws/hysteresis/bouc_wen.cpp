#include <arcslip/laws/hysteresis/bouc_wen.hpp>

#include <arcslip/laws/hysteresis.hpp>
#include <arcslip/laws/hysteresis/bouc_wen_element.hpp>

#include <algorithm>
#include <limits>

namespace arcslip::elements {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

constexpr scene::Field bouc_wen_fields[] = {
    {.name = "stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "stiffness at small displacements"},
    {.name = "elastic_share",
     .unit = "-",
     .lower = 0,
     .upper = 1,
     .default_value = 0,
     .help = "stiffness far beyond the yield displacement, over that at small displacements"},
    {.name = "yield_displacement",
     .unit = "m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "bound of the hysteretic displacement z"},
    {.name = "exponent",
     .unit = "-",
     .lower = 1,
     .upper = 100,
     .default_value = 1,
     .help = "n of (z/yield_displacement)^n: the larger, the sharper the yield"},
    {.name = "shape",
     .unit = "-",
     .lower = 0.5,
     .upper = infinity,
     .default_value = 0.5,
     .help = "share of the term with the size of the velocity; 0.5: elastic unloading"},
};

/// One step of the midpoint rule in q, 2 (z_m - z) = rate(z_m) dq. Its left side less the right grows with
/// z_m and changes its sign between z and the bound of z that q moves towards.
struct Midpoint {
  Midpoint(const BoucWenFields& at, double z, double dq) {
    const double bound = dq > 0 ? at.z_y : -at.z_y;
    double low = std::min(z, bound), high = std::max(z, bound);
    middle = z;
    for (int i = 0; i < 100; ++i) {
      const BoucWenRate r(at, middle, dq);
      const double excess = 2 * (middle - z) - r.rate * dq;
      (excess > 0 ? high : low) = middle;
      double next = middle - excess / (2 - r.by_z * dq);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double change = std::abs(next - middle);
      middle = next;
      if (change <= eps * (std::abs(middle) + std::abs(z))) break;
    }
    const BoucWenRate r(at, middle, dq);
    const double by_z = r.by_z * dq, solved = 1 / (1 - 0.5 * by_z);
    dz = 2 * (middle - z);
    z_q = r.rate * solved;
    z_z = 1 + by_z * solved;
  }
  double middle, dz, z_q, z_z;
};

class BoucWenInTime final : public TimeLaw {
 public:
  explicit BoucWenInTime(const BoucWenFields& at) : at_(at) {}

  void memory_at(In q, In f, Out z) override {
    if (at_.a < 1) z[0] = std::clamp((f[0] / at_.k - at_.a * q[0]) / (1 - at_.a), -at_.z_y, at_.z_y);
  }
  void begin(In q, Out z, StepEnd& end) override {
    z[0] = std::clamp(z[0], -at_.z_y, at_.z_y);
    end.f[0] = at_.k * (at_.a * q[0] + (1 - at_.a) * z[0]);
    end.f_q(0, 0) = at_.a * at_.k;
    end.f_z(0, 0) = (1 - at_.a) * at_.k;
  }
  void step(const StepStart& start, In dq, StepEnd& end) override {
    const double part = at_.z_y / at_.n;
    double z = start.z[0], rest = dq[0], loss = 0;
    end.z_q.setZero();
    end.z_z.setOnes();
    while (rest != 0) {
      const double way = std::clamp(rest, -part, part);
      const Midpoint step(at_, z, way);
      rest -= way;
      loss += step.middle * (way - step.dz);
      z += step.dz;
      end.z_q(0, 0) = step.z_q;
      end.z_z(0, 0) *= step.z_z;
      if (std::abs(step.dz) > eps * at_.z_y) continue;
      loss += step.middle * rest;  // z has come to its bound
      break;
    }
    end.dz[0] = z - start.z[0];
    end.f[0] = at_.k * (at_.a * (start.q[0] + dq[0]) + (1 - at_.a) * z);
    end.f_q(0, 0) = at_.k * (at_.a + (1 - at_.a) * end.z_q(0, 0));
    end.f_z = (1 - at_.a) * at_.k * end.z_z;
    end.z_start = -end.z_q;  // of the way dq alone
    end.f_start = -(1 - at_.a) * at_.k * end.z_q;
    end.dissipated = (1 - at_.a) * at_.k * loss;
  }
  double stored(In q, In z) override {
    return 0.5 * at_.k * (at_.a * q[0] * q[0] + (1 - at_.a) * z[0] * z[0]);
  }

 private:
  BoucWenFields at_;
};

class BoucWen final : public PlainLaw, public Hysteresis {
 public:
  std::string_view name() const override { return "bouc_wen"; }
  std::string_view help() const override { return "smooth hysteresis"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return bouc_wen_fields; }

  Facts facts() const override {
    return {.antisymmetric = true, .dissipative = true, .auxiliary = 1, .memory = 1};
  }
  Traits traits(Fields fields, int) const override {
    const BoucWenFields at(fields);
    return {.stiffness = stiffness(fields, 0, 0),
            .stiffness_field = at.s == 0.5 ? 0 : -1,
            .holds_mean = at.a > 0,
            .far_power = at.a > 0 ? 1.0 : 0.0,
            .far_work = 4 * (1 - at.a) * at.k * at.z_y};
  }
  double stiffness(Fields fields, int, double) const override {
    const BoucWenFields at(fields);
    return at.k * (at.a + (1 - at.a) * 2 * at.s);
  }

  double auxiliary_scale(Fields fields) const override { return BoucWenFields(fields).z_y; }
  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override {
    return bouc_wen_element(harmonics, sampling);
  }
  Eigen::MatrixXd force_at(const Harmonics& h, In u, Fields fields, Angles angles) const override {
    const BoucWenFields at(fields);
    Eigen::MatrixXd f(static_cast<Eigen::Index>(angles.size()), 1);
    for (Eigen::Index s = 0; s < f.rows(); ++s) {
      const double theta = angles[static_cast<std::size_t>(s)];
      f(s, 0) = at.k * (at.a * series_values(h, u.head(h.size()), theta).x +
                        (1 - at.a) * series_values(h, u.tail(h.size()), theta).x);
    }
    return f;
  }

  std::unique_ptr<TimeLaw> in_time(Fields fields) const override {
    return std::make_unique<BoucWenInTime>(BoucWenFields(fields));
  }
  const Hysteresis* hysteresis() const override { return this; }

  double bound(Fields fields) const override { return BoucWenFields(fields).z_y; }
  double rate(Fields fields, double x) const override {
    const BoucWenFields at(fields);
    return BoucWenRate(at, x * at.z_y, 1).rate;
  }
};

}  // namespace

const PlainLaw& bouc_wen() {
  static const BoucWen law;
  return law;
}

}  // namespace arcslip::elements
