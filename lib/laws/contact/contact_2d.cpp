#include <arcslip/laws/contact/contact_2d.hpp>

#include <arcslip/laws/offset_option.hpp>
#include <arcslip/laws/sampled_automata.hpp>

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

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override {
    return sampling.exact ? make_contact_2d(harmonics, offset_)
                          : sampled_automata(*this, harmonics, sampling.samples);
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

  // Stick comes first: an automaton begins there, with the memory that it has.
  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    const ContactLaw law = contact_law(fields);
    enum { stick, slip_up, slip_down, open };
    Automaton contact(0);
    contact.offset = offset_;
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
