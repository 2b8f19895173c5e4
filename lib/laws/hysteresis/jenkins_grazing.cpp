// Onset of slip of a slider at a reversal of its motion (jenkins.hpp).
#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <arcslip/laws/hysteresis/friction_phases.hpp>
#include <arcslip/laws/reversal_condition.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::elements {
namespace {

// Where a bound begins to carry a slider with a static offset, the lower or the upper one.
enum { slider_carried_up = 4, slider_carried_down };

double sign_of_carrying(const Corner& corner) {
  return corner.guard == slider_carried_up ? 1 : -1;
}

// The force is anchor_sign p at the first angle, and reaches slip_sign p at the second.
struct Signs {
  double anchor, slip;
};

int guard_of_signs(Signs signs) {
  return (signs.anchor > 0 ? 1 : 0) + (signs.slip > 0 ? 2 : 0);
}

Signs signs_of(const Corner& corner) {
  return {(corner.guard & 1) != 0 ? 1.0 : -1.0, (corner.guard & 2) != 0 ? 1.0 : -1.0};
}

class JenkinsCorners final : public Corners {
 public:
  JenkinsCorners(const Harmonics& h, Offset offset) : h_(h), offset_(offset), phi_(h.size()) {}

  void equations(const Corner& corner, In w, Fields fields, Equations& at) override {
    if (corner.guard >= slider_carried_up) return carrying(corner, w, fields, at);
    const Signs sign = signs_of(corner);
    const double k = fields[0], p = fields[1] * fields[2], factor = 0.5 * sign.slip * k;
    const Values anchor = series_values(h_, w, corner.angles[0]),
                 reversal = series_values(h_, w, corner.angles[1]);
    const double range = reversal.x - anchor.x, turned = 1 - sign.slip * sign.anchor;
    at.values[0] = 0.5 * (sign.slip * k * range - turned * p);
    for (const int row : {1, 2}) set_reversal_row(h_, corner, w, row, at);
    series_basis(h_, corner.angles[1], phi_);
    at.by_motion.row(0) = factor * phi_.transpose();
    series_basis(h_, corner.angles[0], phi_);
    at.by_motion.row(0) -= factor * phi_.transpose();
    at.by_angle(0, 0) = -factor * anchor.d1;
    at.by_angle(0, 1) = factor * reversal.d1;
    at.by_field(0, 0) = 0.5 * sign.slip * range;
    at.by_field(0, 1) = -0.5 * turned * fields[2];
    at.by_field(0, 2) = -0.5 * turned * fields[1];
  }

  double size(const Corner&, In w, Fields fields) override { return size(w, fields); }

  bool polish(Corner& corner, In w, Fields) override {
    if (corner.guard >= slider_carried_up)
      return polish_reversal(h_, w, sign_of_carrying(corner), corner.angles[0]);
    const Signs sign = signs_of(corner);
    return polish_reversal(h_, w, sign.anchor, corner.angles[0]) &&
           polish_reversal(h_, w, sign.slip, corner.angles[1]);
  }

  std::vector<Corner> near(In w, Fields fields, double tolerance) override {
    std::vector<Corner> found;
    const double limit = fields[1] * fields[2];
    if (!(limit > 0)) return found;
    const auto add = [&](double anchor, double reversal, Signs sign) {
      Corner corner{guard_of_signs(sign), {anchor, reversal}};
      const double least = sign.anchor == sign.slip ? size(w, fields) : limit;
      if (std::abs(excess(corner, w, fields)) <= tolerance * least && !is_listed(found, corner, w))
        found.push_back(std::move(corner));
    };
    FrictionPhases phases(h_);
    Reversals reversals(h_);
    const auto& all = phases.find(w, limit / fields[0]);
    const auto& turns = reversals.find(w);
    if (turns.empty()) return found;
    if (all.empty()) {
      add(phases.lowest().theta, phases.highest().theta, {-1, 1});
      add_of_stick(turns, phases.highest().x, phases.lowest().x, limit / fields[0], add);
      if (offset_ == Offset::static_loads && !h_.odd)
        add_carrying(turns, w, fields, tolerance * size(w, fields), found);
      return found;
    }
    for (const auto& phase : all) {
      if (phase.slip_end > phase.end) add(phase.begin, phase.slip_end, {phase.sign, phase.slip_sign});
      for (const auto& turn : turns) {
        double theta = turn.theta;
        while (theta <= phase.begin + same_corner_angle) theta += h_.span();
        if (theta < phase.end - same_corner_angle)
          add(phase.begin, theta, {phase.sign, series_values(h_, w, theta).d2 < 0 ? 1.0 : -1.0});
      }
    }
    return found;
  }

 private:
  double size(In w, Fields fields) const {
    return std::min(fields[1] * fields[2], fields[0] * series_bound(h_, w, 0));
  }

  double excess(const Corner& corner, In w, Fields fields) const {
    const Signs sign = signs_of(corner);
    const double range = series_values(h_, w, corner.angles[1]).x - series_values(h_, w, corner.angles[0]).x;
    return 0.5 * (sign.slip * fields[0] * range - (1 - sign.slip * sign.anchor) * fields[1] * fields[2]);
  }

  // The same corner, or an image of it by a symmetry of the motion.
  bool is_listed(const std::vector<Corner>& all, const Corner& corner, In w) const {
    const Signs own = signs_of(corner);
    return std::any_of(all.begin(), all.end(), [&](const Corner& other) {
      if (other.guard >= slider_carried_up) return false;
      const Signs its = signs_of(other);
      const double sign = its.slip * own.slip, turn = corner.angles[0] - other.angles[0];
      const double apart = corner.angles[1] - other.angles[1] - turn;
      return its.anchor * own.anchor == sign &&
             std::abs(std::remainder(apart, 2 * std::numbers::pi)) <= same_corner_angle &&
             is_image(h_, w, turn, sign);
    });
  }

  // s k_d w(theta) - p
  void carrying(const Corner& corner, In w, Fields fields, Equations& at) {
    const double sign = sign_of_carrying(corner), k = fields[0];
    const Values turn = series_values(h_, w, corner.angles[0]);
    at.values[0] = sign * k * turn.x - fields[1] * fields[2];
    set_reversal_row(h_, corner, w, 1, at);
    series_basis(h_, corner.angles[0], phi_);
    at.by_motion.row(0) = sign * k * phi_.transpose();
    at.by_angle(0, 0) = sign * k * turn.d1;
    at.by_field(0, 0) = sign * turn.x;
    at.by_field(0, 1) = -fields[2];
    at.by_field(0, 2) = -fields[1];
  }

  void add_carrying(const std::vector<Reversal>& turns, In w, Fields fields, double tolerance,
                    std::vector<Corner>& found) const {
    for (const auto& turn : turns) {
      const bool is_top = series_values(h_, w, turn.theta).d2 < 0;
      const double sign = is_top ? 1 : -1;
      if (std::abs(sign * fields[0] * turn.x - fields[1] * fields[2]) > tolerance) continue;
      const int guard = is_top ? slider_carried_up : slider_carried_down;
      const bool is_listed = std::any_of(found.begin(), found.end(), [&](const Corner& other) {
        return other.guard >= slider_carried_up &&
               is_image(h_, w, turn.theta - other.angles[0], other.guard == guard ? 1 : -1);
      });
      if (!is_listed) found.push_back({guard, {turn.theta}});
    }
  }

  // Of full stick: from the lowest reversal to the highest and, where there is a mean, from one that is the
  // highest or lowest to one that is next to be. Several may be next to be these.
  template <class Add>
  void add_of_stick(const std::vector<Reversal>& turns, double highest, double lowest, double reach,
                    Add&& add) const {
    const StuckSlider held = stuck_slider(offset_, highest - reach, lowest + reach);
    const double near = next_extreme * (highest - lowest);
    std::vector<double> tops, bottoms;
    for (const auto& turn : turns) {
      if (h_.odd) {
        const bool is_top = turn.x > 0;
        if (std::abs(turn.x) >= highest - near)
          tops.push_back(is_top ? turn.theta : turn.theta + std::numbers::pi);
      } else if (turn.x >= highest - near) {
        tops.push_back(turn.theta);
      } else if (turn.x <= lowest + near) {
        bottoms.push_back(turn.theta);
      }
    }
    if (h_.odd) {
      for (const double top : tops) add(top - std::numbers::pi, top, {-1, 1});
      return;
    }
    for (std::size_t i = 0; i < tops.size(); ++i) {
      for (const double bottom : bottoms) add(bottom, tops[i], {-1, 1});
      for (std::size_t j = 0; j < i && held.lower > 0; ++j) add(tops[j], tops[i], {1, 1});
    }
    for (std::size_t i = 0; i < bottoms.size(); ++i)
      for (std::size_t j = 0; j < i && held.upper > 0; ++j) add(bottoms[j], bottoms[i], {-1, -1});
  }

  Harmonics h_;
  Offset offset_;
  Eigen::VectorXd phi_;
};

}  // namespace

std::unique_ptr<Corners> make_jenkins_corners(const Harmonics& harmonics, Offset offset) {
  return std::make_unique<JenkinsCorners>(harmonics, offset);
}

}  // namespace arcslip::elements
