#include <arcslip/laws/contact/contact_2d.hpp>

#include <arcslip/laws/offset_option.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

enum { tangential, normal };

constexpr std::string_view contact_2d_slots[] = {"tangential", "normal"};

constexpr scene::Field contact_2d_fields[] = {
    {.name = "tangential_stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "tangential stiffness of the contact in stick"},
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

// What T and N are at a normal displacement.
double load(const ContactLaw& law, double x_n) {
  return std::max(law.N_0 + law.k_n * x_n, 0.0);
}

class Contact2d final : public scene::file::KeyedPart<OffsetOption, PlainLaw> {
 public:
  explicit Contact2d(Offset offset) : KeyedPart(offset_option()), offset_(offset) {}
  std::string_view name() const override { return "contact_2d"; }
  std::string_view help() const override {
    return "friction in one direction under a normal load that varies, with separation";
  }
  std::span<const std::string_view> slots() const override { return contact_2d_slots; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return contact_2d_fields; }
  bool options_bring_fields() const override { return false; }

  std::shared_ptr<const Law> law(const scene::Settings& options) const override;

  Facts facts() const override {
    return {.contact = true,
            .reports_contact = true,
            .normal_load = true,
            .dissipative = true,
            .symmetric_step = false,
            .memory = 1};
  }
  double normal_load_at(Fields fields, double x_n) const override { return load(contact_law(fields), x_n); }
  Traits traits(Fields fields, int direction) const override {
    const ContactLaw law = contact_law(fields);
    const double limit = law.mu * std::max(law.N_0, 0.0);
    if (direction == normal)
      return {.stiffness = law.k_n,
              .stiffness_field = contact_field::normal_stiffness,
              .holds_mean = law.k_n > 0 && law.N_0 > 0,
              .several_responses = true,
              .far_power = law.k_n > 0 ? 1.0 : 0.0};
    return {.stiffness = law.k_t,
            .stiffness_field = contact_field::tangential_stiffness,
            .holds_in_stick = offset_ == Offset::static_loads && limit > 0,
            .several_responses = law.k_n > 0,
            .far_work = 4 * limit,
            .limit = limit};
  }
  double stiffness(Fields fields, int direction, double) const override { return fields[direction]; }
  bool limited_by(int field) const override {
    return field == contact_field::friction_coefficient || field == contact_field::normal_load;
  }

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling&) const override {
    return make_contact_2d(harmonics, offset_);
  }
  std::unique_ptr<Corners> corners(const Harmonics& harmonics) const override {
    return make_contact_2d_corners(harmonics, offset_);
  }

  Eigen::MatrixXd force_at(const Harmonics& h, In u, Fields fields, Angles angles) const override {
    const ContactLaw law = contact_law(fields);
    const auto u_t = u.head(h.size()), u_n = u.tail(h.size());
    ContactPhases search(h, offset_);
    const auto& phases = search.find(u_t, u_n, law);
    Eigen::MatrixXd force(static_cast<Eigen::Index>(angles.size()), 2);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const double N = load(law, series_values(h, u_n, angles[i]).x);
      const ContactPhase& phase = phase_at(phases, angles[i]);
      force(row, normal) = N - std::max(law.N_0, 0.0);
      force(row, tangential) = phase.state == ContactPhase::State::open ? 0
                               : phase.state == ContactPhase::State::slip
                                   ? phase.sign * law.mu * N
                                   : law.k_t * (series_values(h, u_t, angles[i]).x - phase.rest.w);
    }
    return force;
  }

  int slider_direction(int) const override { return tangential; }
  Eigen::RowVectorXd slider_bound(Fields fields, int, int side) const override {
    const ContactLaw law = contact_law(fields);
    return Eigen::RowVector2d(1, side * law.mu * law.k_n / law.k_t);
  }
  std::optional<double> slider_room(Fields fields, int) const override {
    if (offset_ == Offset::centred) return {};
    const ContactLaw law = contact_law(fields);
    return law.mu * law.N_0 / law.k_t;
  }

  void memory_at(Fields fields, In q, In f, Out z) const override {
    z[0] = q[tangential] - f[tangential] / fields[contact_field::tangential_stiffness];
  }

  void begin(Fields fields, In q, Out z, StepEnd& at) const override {
    const ContactLaw law = contact_law(fields);
    const double N = load(law, q[normal]), elastic = law.k_t * (q[tangential] - z[0]);
    const bool open = N == 0;
    at.f[tangential] = std::clamp(elastic, -law.mu * N, law.mu * N);
    at.f[normal] = N - std::max(law.N_0, 0.0);
    at.f_q << (open ? 0 : law.k_t), 0, 0, (open ? 0 : law.k_n);
    at.f_z << (open ? 0 : -law.k_t), 0;
    if (at.f[tangential] != elastic) z[0] = q[tangential] - at.f[tangential] / law.k_t;
  }

  // Along the step both bounds and N are linear: the contact opens or closes once at most, and slips at the
  // end of the contact if at all.
  void step(Fields fields, const StepStart& start, In dq, StepEnd& end) const override {
    const ContactLaw law = contact_law(fields);
    const double k = law.k_t, mu = law.mu, dt = dq[tangential];
    const double N_begin = law.N_0 + law.k_n * start.q[normal], dN = law.k_n * dq[normal];
    const double N_end = N_begin + dN;
    clear(end);
    end.f[normal] = std::max(N_end, 0.0) - std::max(law.N_0, 0.0);
    if (N_begin <= 0 && N_end <= 0) {  // open
      end.dz[0] = dt + start.f[tangential] / k;
      end.open_share = 1;
      follow(end, 0);
      return;
    }
    if (N_begin <= 0) {
      close(law, N_begin, dN, dt, start.f[tangential], end);
      return;
    }
    const double T = start.f[tangential], contact = N_end > 0 ? 1 : N_begin / (N_begin - N_end);
    const double at_end = contact < 1 ? 0 : N_end;  // the load at the end of contact
    const double elastic = T + k * contact * dt, limit = mu * at_end;
    const bool sticks = contact == 1 && std::abs(elastic) < limit;
    if (N_end > 0) end.f_q(normal, normal) = law.k_n;
    if (sticks) {
      end.f[tangential] = elastic;
      end.f_q(tangential, tangential) = k;
      end.f_z(tangential, 0) = -k;
      end.z_z(0, 0) = 1;
      end.stick_share = 1;
      return;
    }
    const double sign = elastic < 0 ? -1 : 1, rate = k * dt - sign * mu * dN;
    const double onset = rate != 0 ? std::clamp((sign * mu * N_begin - T) / rate, 0.0, contact) : 0;
    const double force = sign * limit, slip = contact * dt - (force - T) / k;
    end.dissipated = 0.5 * (sign * mu * (N_begin + onset * dN) + force) * slip;
    end.stick_share = mu > 0 ? onset : 0;
    end.open_share = 1 - contact;
    if (contact < 1) {
      end.dz[0] = slip + (1 - contact) * dt;
      follow(end, 0);
    } else {
      end.dz[0] = slip;
      end.f[tangential] = force;
      end.f_q(tangential, normal) = sign * mu * law.k_n;
      follow(end, sign * mu * law.k_n / k);
    }
  }

  double stored(Fields fields, In q, In z) const override {
    const ContactLaw law = contact_law(fields);
    const double stretch = q[tangential] - z[0], x = q[normal];
    double energy = 0.5 * law.k_t * stretch * stretch;
    if (law.k_n == 0) return energy;
    const double touch = -law.N_0 / law.k_n;  // where N = 0
    if (law.N_0 <= 0) return energy + (x > touch ? 0.5 * law.k_n * (x - touch) * (x - touch) : 0);
    return energy + (x > touch ? 0.5 * law.k_n * x * x : law.N_0 * (0.5 * touch - x));
  }

  // Stick comes first: an automaton begins there, with the memory that it has.
  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    const ContactLaw law = contact_law(fields);
    enum { stick, slip_up, slip_down, open };
    Automaton contact(0);
    const auto add = [&](std::string_view name, double k_t, double k_n) -> Mode& {
      Mode& mode = contact.modes.emplace_back();
      mode.name = name;
      mode.f_q = Eigen::Matrix2d{{k_t, 0}, {0, k_n}};
      mode.f_z = Eigen::Vector2d(-k_t, 0);
      mode.f_0 = Eigen::Vector2d(0, std::min(law.N_0, 0.0));
      return mode;
    };
    const auto follows = [](Mode& mode, double by_normal, double z_0, int way) {
      mode.rests = false;
      mode.f_z.setZero();
      mode.z_q = Eigen::RowVector2d(1, by_normal);
      mode.z_0 = z_0;
      mode.way = way;
    };
    const Eigen::RowVector2d load(0, law.k_n), none(0, 0);
    const double h = law.mu * law.N_0 / law.k_t, h_n = law.mu * law.k_n / law.k_t;
    Mode& stuck = add("stick", law.k_t, law.k_n);
    stuck.leaves.push_back({load, none, 0, law.N_0, open});  // the first of several that fall at once
    if (law.mu > 0) {
      stuck.leaves.push_back({Eigen::RowVector2d(-1, h_n), none, 1, h, slip_up});
      stuck.leaves.push_back({Eigen::RowVector2d(1, h_n), none, -1, h, slip_down});
    } else {
      stuck.leaves.push_back({none, none, 0, -1, slip_up});  // at once
    }
    for (const int sign : {1, -1}) {
      Mode& slip = add(sign > 0 ? "slip+" : "slip-", 0, law.k_n);
      slip.f_q(tangential, normal) = sign * law.mu * law.k_n;
      slip.f_0[tangential] = sign * law.mu * law.N_0;
      follows(slip, -sign * h_n, -sign * h, law.mu > 0 ? sign : 0);
      slip.leaves.push_back({load, none, 0, law.N_0, open});
      if (law.mu > 0) slip.leaves.push_back({none, Eigen::RowVector2d(sign, -h_n), 0, 0, stick});
    }
    Mode& apart = add("open", 0, 0);
    apart.open = true;
    apart.f_0[normal] = -std::max(law.N_0, 0.0);
    follows(apart, 0, 0, 0);
    apart.leaves.push_back({-load, none, 0, -law.N_0, law.mu > 0 ? stick : slip_up});
    return std::vector{contact};
  }

 private:
  static const ContactPhase& phase_at(const std::vector<ContactPhase>& phases, double angle) {
    const double begin = phases.front().begin;
    angle -= std::floor((angle - begin) / (2 * std::numbers::pi)) * 2 * std::numbers::pi;
    const auto after =
        std::upper_bound(phases.begin(), phases.end(), angle,
                         [](double theta, const ContactPhase& phase) { return theta < phase.begin; });
    return after == phases.begin() ? phases.front() : *(after - 1);
  }

  static void clear(StepEnd& end) {
    for (Eigen::MatrixXd* m : {&end.f_q, &end.f_z, &end.f_start, &end.z_q, &end.z_z, &end.z_start})
      m->setZero();
    end.f.setZero();
    end.dz.setZero();
    end.dissipated = end.stick_share = end.open_share = 0;
  }
  // w = x_t - by_normal x_n + ... at the end.
  static void follow(StepEnd& end, double by_normal) { end.z_q << 1, -by_normal; }

  // The contact closes after the share s of the step, with w = x_t there.
  static void close(const ContactLaw& law, double N_begin, double dN, double dt, double T, StepEnd& end) {
    const double s = -N_begin / dN, k = law.k_t, N_end = N_begin + dN;
    const double elastic = k * (1 - s) * dt, limit = law.mu * N_end;
    const double follows = s * dt + T / k;
    end.f_q(normal, normal) = law.k_n;
    end.open_share = s;
    if (std::abs(elastic) < limit) {
      const double shift = -law.k_n * dt / dN;  // of w per share of a change of x_n
      end.dz[0] = follows;
      end.f[tangential] = elastic;
      end.z_q << s, s * shift;
      end.z_start << 1 - s, (1 - s) * shift;
      end.f_q(tangential, tangential) = k * (1 - s);
      end.f_q(tangential, normal) = -k * s * shift;
      end.f_start.row(tangential) = -k * end.z_start;
      end.stick_share = 1 - s;
      return;
    }
    const double sign = elastic < 0 ? -1 : 1, slip = (1 - s) * dt - sign * limit / k;
    end.dz[0] = follows + slip;
    end.f[tangential] = sign * limit;
    end.dissipated = 0.5 * sign * limit * slip;
    end.f_q(tangential, normal) = sign * law.mu * law.k_n;
    follow(end, sign * law.mu * law.k_n / k);
  }

  Offset offset_;
};

std::shared_ptr<const Law> Contact2d::law(const scene::Settings& options) const {
  static const Contact2d with_static_offset(Offset::static_loads);
  return {std::shared_ptr<const void>(), offset_of(options) == Offset::centred ? this : &with_static_offset};
}

}  // namespace

ContactLaw contact_law(Fields fields) {
  return {fields[contact_field::tangential_stiffness], fields[contact_field::normal_stiffness],
          fields[contact_field::friction_coefficient], fields[contact_field::normal_load]};
}

const PlainLaw& contact_2d() {
  static const Contact2d law(Offset::centred);
  return law;
}

}  // namespace arcslip::elements
