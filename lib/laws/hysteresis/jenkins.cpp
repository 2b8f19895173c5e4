#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <arcslip/laws/hysteresis/friction_phases.hpp>
#include <arcslip/laws/offset_option.hpp>
#include <arcslip/laws/sampled_automata.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

constexpr scene::Field jenkins_fields[] = {
    {.name = "stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "tangential stiffness of the contact in stick"},
    {.name = "friction_coefficient",
     .unit = "-",
     .lower = 0,
     .upper = infinity,
     .help = "Coulomb friction coefficient"},
    {.name = "normal_load",
     .unit = "N",
     .lower = 0,
     .upper = infinity,
     .help = "normal load; the slip limit is friction_coefficient * normal_load"},
};

double jenkins_limit(Fields fields) {
  return fields[jenkins_field::friction_coefficient] * fields[jenkins_field::normal_load];
}

class Jenkins final : public scene::file::KeyedPart<OffsetOption, PlainLaw> {
 public:
  explicit Jenkins(Offset offset) : KeyedPart(offset_option()), offset_(offset) {}
  std::string_view name() const override { return "jenkins"; }
  std::string_view help() const override {
    return "a spring in series with a Coulomb slider (Jenkins element): macroslip";
  }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return jenkins_fields; }
  bool options_bring_fields() const override { return false; }

  std::shared_ptr<const Law> law(const scene::Settings& options) const override;

  Facts facts() const override {
    return {
        .antisymmetric = true, .contact = true, .reports_contact = true, .dissipative = true, .memory = 1};
  }
  Traits traits(Fields fields, int) const override {
    return {.stiffness = fields[jenkins_field::stiffness],
            .stiffness_field = jenkins_field::stiffness,
            .holds_in_stick = offset_ == Offset::static_loads && jenkins_limit(fields) > 0,
            .far_work = 4 * jenkins_limit(fields),
            .limit = jenkins_limit(fields)};
  }
  double stiffness(Fields fields, int, double) const override { return fields[jenkins_field::stiffness]; }
  bool limited_by(int field) const override { return field != jenkins_field::stiffness; }

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override {
    return sampling.exact ? make_jenkins(harmonics, offset_)
                          : sampled_automata(*this, harmonics, sampling.samples);
  }

  std::unique_ptr<Corners> corners(const Harmonics& harmonics) const override {
    return make_jenkins_corners(harmonics, offset_);
  }

  Eigen::MatrixXd force_at(const Harmonics& h, In u, Fields fields, Angles angles) const override {
    const double stiffness = fields[jenkins_field::stiffness], p = jenkins_limit(fields);
    Eigen::MatrixXd force = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(angles.size()), 1);
    if (stiffness == 0 || p == 0) return force;
    FrictionPhases search(h);
    const auto& phases = search.find(u, p / stiffness);
    const double high = search.highest().x, low = search.lowest().x, reach = p / stiffness;
    const StuckSlider at = stuck_slider(offset_, high - reach, low + reach);
    const double mean = h.odd ? 0 : (at.lower - at.upper) * p, centre = at.lower * high + at.upper * low;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double x = series_values(h, u, angles[i]).x;
      auto& f = force(static_cast<Eigen::Index>(i), 0);
      if (phases.empty()) {
        f = stiffness * (h.odd ? x : x - centre) + mean;
        continue;
      }
      const double spans = std::floor((angles[i] - phases.front().begin) / h.span());
      const double theta = angles[i] - spans * h.span();
      const double sign = h.odd && std::fmod(spans, 2) != 0 ? -1 : 1;  // x(theta + pi) = -x(theta)
      const auto after =
          std::upper_bound(phases.begin(), phases.end(), theta,
                           [](double t, const FrictionPhase& phase) { return t < phase.begin; });
      const FrictionPhase& phase = after == phases.begin() ? phases.front() : *(after - 1);
      const double stick = phase.sign * p + stiffness * (sign * x - phase.anchor_x);
      f = sign * (theta < phase.end ? stick : phase.slip_sign * p);
    }
    return force;
  }

  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    Automaton contact = jenkins_automaton(0, fields[jenkins_field::stiffness], jenkins_limit(fields));
    contact.offset = offset_;
    return std::vector{contact};
  }

 private:
  Offset offset_;
};

std::shared_ptr<const Law> Jenkins::law(const scene::Settings& options) const {
  static const Jenkins with_static_offset(Offset::static_loads);
  return {std::shared_ptr<const void>(), offset_of(options) == Offset::centred ? this : &with_static_offset};
}

}  // namespace

Automaton jenkins_automaton(int memory, double k, double p) {
  Automaton contact(memory);
  if (p <= 0) {
    contact.add("free", 0, 0, 0).follows(1, 0, 0);
    return contact;
  }
  Mode& stick = contact.add("stick", k, -k, 0);
  stick.leaves_where(-k, 0, k, p, 1);
  stick.leaves_where(k, 0, -k, p, 2);
  contact.add("slip+", 0, 0, p).follows(1, -p / k, 1).leaves_where(0, 1, 0, 0, 0);
  contact.add("slip-", 0, 0, -p).follows(1, p / k, -1).leaves_where(0, -1, 0, 0, 0);
  return contact;
}

const PlainLaw& jenkins() {
  static const Jenkins law(Offset::centred);
  return law;
}

}  // namespace arcslip::elements
