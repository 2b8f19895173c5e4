#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <arcslip/laws/hysteresis/friction_phases.hpp>
#include <arcslip/laws/offset_option.hpp>

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
                          : make_sampled_jenkins(harmonics, sampling.samples, offset_);
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

  int slider_direction(int) const override { return 0; }
  std::optional<double> slider_room(Fields fields, int) const override {
    if (offset_ == Offset::centred) return {};
    return jenkins_limit(fields) / fields[jenkins_field::stiffness];
  }

  void memory_at(Fields fields, In q, In f, Out z) const override {
    z[0] = q[0] - f[0] / fields[jenkins_field::stiffness];
  }

  void begin(Fields fields, In q, Out z, StepEnd& at) const override {
    const double k = fields[jenkins_field::stiffness], elastic = k * (q[0] - z[0]), p = jenkins_limit(fields);
    at.f[0] = std::clamp(elastic, -p, p);
    at.f_q(0, 0) = k;
    at.f_z(0, 0) = -k;
    if (at.f[0] != elastic) z[0] = q[0] - at.f[0] / k;
  }

  void step(Fields fields, const StepStart& start, In dq, StepEnd& end) const override {
    const double k = fields[jenkins_field::stiffness], p = jenkins_limit(fields), f = start.f[0] + k * dq[0];
    const bool sticks = std::abs(f) < p;
    end.f[0] = sticks ? f : std::copysign(p, f);
    end.f_q(0, 0) = sticks ? k : 0;
    end.f_z(0, 0) = sticks ? -k : 0;
    end.z_q(0, 0) = sticks ? 0 : 1;
    end.z_z(0, 0) = sticks ? 1 : 0;
    const double way = (end.f[0] - start.f[0]) / k, slip = sticks ? 0 : dq[0] - way;
    end.dz[0] = slip;
    end.dissipated = 0.5 * (start.f[0] + end.f[0]) * slip;
    end.stick_share = slip == 0 ? 1 : std::abs(way) / (std::abs(way) + std::abs(slip));
    if (p <= 0) end.stick_share = 0;
  }

  double stored(Fields fields, In q, In z) const override {
    const double stretch = q[0] - z[0];
    return 0.5 * fields[jenkins_field::stiffness] * stretch * stretch;
  }

  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    const double k = fields[jenkins_field::stiffness], p = jenkins_limit(fields);
    Automaton contact(0);
    if (p <= 0) {
      contact.add("free", 0, 0, 0).follows(1, 0, 0);
    } else {
      Mode& stick = contact.add("stick", k, -k, 0);
      stick.leaves_where(-k, 0, k, p, 1);
      stick.leaves_where(k, 0, -k, p, 2);
      contact.add("slip+", 0, 0, p).follows(1, -p / k, 1).leaves_where(0, 1, 0, 0, 0);
      contact.add("slip-", 0, 0, -p).follows(1, p / k, -1).leaves_where(0, -1, 0, 0, 0);
    }
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

const PlainLaw& jenkins() {
  static const Jenkins law(Offset::centred);
  return law;
}

}  // namespace arcslip::elements
