#include <arcslip/laws/contact/contact_3d.hpp>

#include <arcslip/laws/contact/normal_contact.hpp>
#include <arcslip/laws/contact/planar_slider.hpp>
#include <arcslip/laws/offset_option.hpp>
#include <arcslip/laws/planar_friction.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

using Eigen::Vector2d;

enum { tangential_1, tangential_2, plane_normal };

constexpr std::string_view contact_3d_slots[] = {"tangential_1", "tangential_2", "normal"};

constexpr scene::Field contact_3d_fields[] = {
    {.name = "tangential_stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "tangential stiffness of the contact in stick, in both directions"},
    {.name = "normal_stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .help = "normal stiffness of the contact; 0: the normal load is constant"},
    {.name = "friction_coefficient",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .help = "Coulomb friction coefficient"},
    {.name = "normal_load",
     .unit = "N",
     .lower = -infinity,
     .upper = infinity,
     .help = "normal load at rest, positive in compression; a negative one is a gap of -normal_load / "
             "normal_stiffness"},
};

struct PlaneContactLaw : PlaneFriction::Contact {
  double load(double x_n) const { return std::max(N_0 + k_n * x_n, 0.0); }
};

PlaneContactLaw plane_contact_law(Fields fields) {
  return {{fields[contact_field::tangential_stiffness], fields[contact_field::normal_stiffness],
           fields[contact_field::friction_coefficient], fields[contact_field::normal_load]}};
}

// y, the stretch of the slider's spring, after a step in contact from y_0, in which x moves by d and the
// radius from h_0 by e, both linear in s, 0 <= s <= 1; with the derivatives of y(1) by all of these.
//
// In slip y = h n(psi), and the angle b from d to n obeys b' = -|d| sin(b)/h, so that
//   tan(b/2) = tan(b_on/2) exp(-|d| integral of 1/h)
class Stretch {
 public:
  Vector2d y;
  Eigen::Matrix2d by_y, by_d;
  Vector2d by_h = Vector2d::Zero(), by_e = Vector2d::Zero();
  double onset = 1;       // s where slip begins
  double dissipated = 0;  // over k_t

  // Until s = end, where the radius may be 0.
  Stretch(const Vector2d& y_0, const Vector2d& d, double h_0, double e, double end)
      : y(y_0 + end * d), by_y(Eigen::Matrix2d::Identity()), by_d(Eigen::Matrix2d::Identity()), onset(end) {
    const double h_1 = std::max(h_0 + end * e, 0.0);
    if (y.norm() <= h_1) return;
    const double a = (d.norm() - e) * (d.norm() + e), b = y_0.dot(d) - h_0 * e;
    const double c = std::min((y_0.norm() - h_0) * (y_0.norm() + h_0), 0.0);
    const double root = std::sqrt(std::max(b * b - a * c, 0.0));
    const double s = b > 0 ? -c / (b + root) : a > 0 ? (root - b) / a : 0.0;
    onset = std::clamp(std::isfinite(s) ? s : 0.0, 0.0, end);
    slip(y_0, d, h_0, e, end, h_1);
  }

 private:
  void slip(const Vector2d& y_0, const Vector2d& d, double h_0, double e, double end, double h_1) {
    const double s = onset, length = end - s, h = h_0 + s * e, speed = d.norm();
    const Vector2d y_on = y_0 + s * d;
    const Vector2d n_on = y_on.norm() > 0 ? Vector2d(y_on.normalized()) : Vector2d(d.normalized());
    const Vector2d t_on = quarter_turn(n_on), along = speed > 0 ? Vector2d(d / speed) : n_on,
                   side = quarter_turn(along);
    const double r = h > 0 ? e * length / h : -1;
    const double integral = h_1 > 0 ? length / h * log_over(r) : infinity;  // of 1/h
    const double decay = speed > 0 ? std::exp(-std::min(speed * integral, 700.0)) : 1;
    const double half = 0.5 * std::atan2(along[0] * n_on[1] - along[1] * n_on[0], along.dot(n_on));
    const double cosine = std::cos(half), sine = std::sin(half);
    const double below = cosine * cosine + sine * sine * decay * decay;
    const double angle = 2 * std::atan2(sine * decay, cosine);
    const Vector2d n = std::cos(angle) * along + std::sin(angle) * side, t = quarter_turn(n);
    y = h_1 * n;
    dissipate(2 * half, speed, h, e, length);
    by_y.setZero();
    by_d.setZero();
    if (!(h_1 > 0) || !(h > 0)) return;
    // By s at the onset, then by all else.
    const double rate = y_on.dot(d) - h * e;
    const Vector2d s_by_y = rate > 0 ? Vector2d(-y_on / rate) : Vector2d(0, 0);
    const double s_by_h = rate > 0 ? h / rate : 0;
    const double ratio = decay / below, sin_end = 2 * sine * cosine * decay / below;
    const double across = t_on.dot(d) / h;  // of psi at the onset by s
    // |d| times the integral of 1/h.
    const double by_onset = -speed / h, by_radius = -speed * length / (h * h_1);
    const double by_slope = s * by_radius - speed * length * length / (h * h) * second_moment(r);
    const double psi_by_s = ratio * across - sin_end * by_onset;
    const Vector2d psi_by_y = ratio / h * t_on + psi_by_s * s_by_y;
    Vector2d psi_by_d = s * psi_by_y;
    if (speed > 0)
      psi_by_d += (1 - ratio) / speed * side - sin_end * integral * along;
    else
      psi_by_d += integral * t_on;
    const double psi_by_h = psi_by_s * s_by_h - sin_end * by_radius;
    const double psi_by_e = psi_by_s * s * s_by_h - sin_end * by_slope;
    by_y = h_1 * t * psi_by_y.transpose();
    by_d = h_1 * t * psi_by_d.transpose();
    by_h = n + h_1 * psi_by_h * t;
    by_e = end * n + h_1 * psi_by_e * t;
  }

  // ln(1 + r)/r
  static double log_over(double r) { return std::abs(r) < 1e-8 ? 1 - 0.5 * r : std::log1p(r) / r; }
  // (ln(1 + r) - r/(1 + r))/r^2
  static double second_moment(double r) {
    if (std::abs(r) > 0.02) return (std::log1p(r) - r / (1 + r)) / (r * r);
    double sum = 0, power = 1;
    for (int k = 0; k < 9; ++k, power *= -r) sum += power * (k + 1) / (k + 2);
    return sum;
  }

  // The integral of h (|d| cos b - e), by Gauss's rule with 5 points.
  void dissipate(double begin, double speed, double h, double e, double length) {
    constexpr double at[] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332};
    constexpr double weight[] = {0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                                 0.118463442528095};
    for (int i = 0; i < 5; ++i) {
      const double s = at[i] * length, here = h + s * e;
      const double gone = h > 0 ? s / h * log_over(e * s / h) : infinity;
      const double decay = speed > 0 ? std::exp(-std::min(speed * gone, 700.0)) : 1;
      const double b = 2 * std::atan2(std::sin(0.5 * begin) * decay, std::cos(0.5 * begin));
      dissipated += weight[i] * length * std::max(here, 0.0) * std::max(speed * std::cos(b) - e, 0.0);
    }
  }
};

scene::file::KeysOf<OffsetOption> contact_3d_keys() {
  scene::file::KeysOf<OffsetOption> keys;
  keys.add(centred_offset<OffsetOption>(
      "where a slider that never slips rests: in the middle of its possible positions, without a mean force",
      "which a contact in a plane does not have: its slider, where it sticks throughout the period, holds no "
      "mean force; where one is to be held, put elements of type \"jenkins\" or \"contact_2d\" with "
      "\"offset\": "
      "\"static\" along both directions"));
  return keys;
}

class Contact3dInTime final : public TimeLaw {
 public:
  explicit Contact3dInTime(const PlaneContactLaw& law) : law_(law) {}

  void memory_at(In q, In f, Out z) override { z.head<2>() = q.head<2>() - f.head<2>() / law_.k_t; }

  void begin(In q, Out z, StepEnd& at) override {
    const double N = law_.load(q[plane_normal]), limit = law_.mu * N;
    const Vector2d elastic = law_.k_t * (q.head<2>() - z.head<2>());
    const double size = elastic.norm();
    at.f.head<2>() = size > limit ? Vector2d(limit / size * elastic) : elastic;
    at.f[plane_normal] = N - std::max(law_.N_0, 0.0);
    at.f_q.setZero();
    at.f_z.setZero();
    if (N > 0) {
      at.f_q.diagonal() << law_.k_t, law_.k_t, law_.k_n;
      at.f_z.topRows<2>().diagonal().setConstant(-law_.k_t);
    }
    if (size > limit) z.head<2>() = q.head<2>() - at.f.head<2>() / law_.k_t;
  }

  // Along the step the radius and N are linear: the contact opens or closes once at most.
  void step(const StepStart& start, In dq, StepEnd& end) override {
    const double k = law_.k_t, ratio = law_.mu * law_.k_n / k;
    const Vector2d d = dq.head<2>(), y = start.f.head<2>() / k;
    const double N_begin = law_.N_0 + law_.k_n * start.q[plane_normal], dN = law_.k_n * dq[plane_normal];
    const double N_end = N_begin + dN;
    clear(end);
    end.f[plane_normal] = std::max(N_end, 0.0) - std::max(law_.N_0, 0.0);
    end.z_q.leftCols<2>().setIdentity();
    if (N_end > 0) end.f_q(plane_normal, plane_normal) = law_.k_n;
    if (N_begin <= 0 && N_end <= 0) {  // open
      end.dz = d + y;
      end.open_share = 1;
      return;
    }
    if (N_begin <= 0) return close(law_, N_begin, dN, d, y, end);
    const double contact = N_end > 0 ? 1 : N_begin / (N_begin - N_end);
    const Stretch at(y, d, law_.mu * N_begin / k, law_.mu * dN / k, contact);
    end.stick_share = law_.mu > 0 ? at.onset : 0;
    end.open_share = 1 - contact;
    end.dissipated = k * at.dissipated;
    if (contact < 1) {
      end.dz = d + y;
      return;
    }
    Eigen::Matrix<double, 2, 3> by_end, by_start;
    by_end << at.by_d, ratio * at.by_e;
    by_start << at.by_y - at.by_d, ratio * (at.by_h - at.by_e);
    end.dz = d + y - at.y;
    set(k, at.y, by_end, by_start, end);
    end.f_z.topRows<2>() = -k * at.by_y;
    end.z_z = at.by_y;
  }

  double stored(In q, In z) override {
    const double x = q[plane_normal];
    const double energy = 0.5 * law_.k_t * (q.head<2>() - z.head<2>()).squaredNorm();
    if (law_.k_n == 0) return energy;
    const double touch = -law_.N_0 / law_.k_n;  // where N = 0
    if (law_.N_0 <= 0) return energy + (x > touch ? 0.5 * law_.k_n * (x - touch) * (x - touch) : 0);
    return energy + (x > touch ? 0.5 * law_.k_n * x * x : law_.N_0 * (0.5 * touch - x));
  }

 private:
  static void clear(StepEnd& end) {
    for (Eigen::MatrixXd* m : {&end.f_q, &end.f_z, &end.f_start, &end.z_q, &end.z_z, &end.z_start})
      m->setZero();
    end.f.setZero();
    end.dz.setZero();
    end.dissipated = end.stick_share = end.open_share = 0;
  }
  // The force k y and the memory x - y at the end.
  static void set(double k, const Vector2d& y, const Eigen::Matrix<double, 2, 3>& by_end,
                  const Eigen::Matrix<double, 2, 3>& by_start, StepEnd& end) {
    end.f.head<2>() = k * y;
    end.f_q.topRows<2>() = k * by_end;
    end.f_start.topRows<2>() = k * by_start;
    end.z_q -= by_end;
    end.z_start -= by_start;
  }

  // The contact closes after the share s of the step, with w = x there.
  static void close(const PlaneContactLaw& law, double N_begin, double dN, const Vector2d& d,
                    const Vector2d& y, StepEnd& end) {
    const double s = -N_begin / dN, k = law.k_t, N_end = N_begin + dN, h = law.mu * N_end / k;
    const double speed = d.norm();
    const Vector2d elastic = (1 - s) * d;
    Eigen::Matrix<double, 2, 3> by_end, by_start;
    Vector2d stretch;
    end.open_share = s;
    if (elastic.norm() < h) {
      stretch = elastic;
      const Vector2d by_s = -law.k_n / dN * d;  // of the stretch, by the share s of a change of x_n
      by_end << (1 - s) * Eigen::Matrix2d::Identity(), -s * by_s;
      by_start << -(1 - s) * Eigen::Matrix2d::Identity(), -(1 - s) * by_s;
      end.stick_share = 1 - s;
    } else {
      const Vector2d n = speed > 0 ? Vector2d(d / speed) : Vector2d(1, 0), t = quarter_turn(n);
      stretch = h * n;
      const Eigen::Matrix2d by_d =
          speed > 0 ? Eigen::Matrix2d(h / speed * t * t.transpose()) : Eigen::Matrix2d::Zero();
      by_end << by_d, law.mu * law.k_n / k * n;
      by_start << -by_d, Vector2d(0, 0);
      // h grows from 0: the integral of h (|d| - h').
      end.dissipated = 0.5 * k * h * ((1 - s) * speed - h);
    }
    end.dz = d + y - stretch;
    set(k, stretch, by_end, by_start, end);
  }

  PlaneContactLaw law_;
};

class Contact3d final : public scene::file::KeyedPart<OffsetOption, PlainLaw>, public PlaneFriction {
 public:
  Contact3d() : KeyedPart(contact_3d_keys()) {}
  std::string_view name() const override { return "contact_3d"; }
  std::string_view help() const override {
    return "friction in a plane under a normal load that varies, with separation";
  }
  std::span<const std::string_view> slots() const override { return contact_3d_slots; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return contact_3d_fields; }
  bool options_bring_fields() const override { return false; }
  Contact contact(Fields fields) const override { return plane_contact_law(fields); }

  Facts facts() const override {
    return {.contact = true,
            .reports_contact = true,
            .normal_load = true,
            .dissipative = true,
            .symmetric_step = false,
            .memory = 2};
  }
  double normal_load_at(Fields fields, double x_n) const override {
    return plane_contact_law(fields).load(x_n);
  }
  Traits traits(Fields fields, int direction) const override {
    const PlaneContactLaw law = plane_contact_law(fields);
    const double limit = law.mu * std::max(law.N_0, 0.0);
    if (direction == plane_normal)
      return {.stiffness = law.k_n,
              .stiffness_field = contact_field::normal_stiffness,
              .holds_mean = law.k_n > 0 && law.N_0 > 0,
              .several_responses = true,
              .far_power = law.k_n > 0 ? 1.0 : 0.0};
    return {.stiffness = law.k_t,
            .stiffness_field = contact_field::tangential_stiffness,
            .several_responses = law.k_n > 0,
            .far_work = 4 * limit,
            .limit = limit};
  }
  double stiffness(Fields fields, int direction, double) const override {
    return fields[direction == plane_normal ? contact_field::normal_stiffness
                                            : contact_field::tangential_stiffness];
  }
  bool limited_by(int field) const override {
    return field == contact_field::friction_coefficient || field == contact_field::normal_load;
  }

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling&) const override {
    return make_contact_3d(harmonics);
  }
  std::unique_ptr<Corners> corners(const Harmonics& harmonics) const override {
    return make_contact_3d_corners(harmonics);
  }
  Eigen::MatrixXd force_at(const Harmonics& h, In u, Fields fields, Angles angles) const override {
    return contact_3d_force(h, u, fields, angles);
  }

  std::unique_ptr<TimeLaw> in_time(Fields fields) const override {
    return std::make_unique<Contact3dInTime>(plane_contact_law(fields));
  }
  std::vector<Slider> sliders(Fields) const override {
    const Eigen::RowVectorXd x = Eigen::RowVectorXd::Unit(3, 0), y = Eigen::RowVectorXd::Unit(3, 1);
    return {{0, 0, x, x, 0, {}}, {1, 1, y, y, 0, {}}};
  }
  const PlaneFriction* plane_friction() const override { return this; }
};

}  // namespace

const PlainLaw& contact_3d() {
  static const Contact3d law;
  return law;
}

}  // namespace arcslip::elements
