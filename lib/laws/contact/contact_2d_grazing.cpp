// Corners of a contact with a varying normal load: guards 0 and 1 of its load, 2 to 7 of its slider,
// 8 and 9 where a bound begins to carry a slider with a static offset from w = 0.
#include <arcslip/laws/contact/contact_2d.hpp>

#include <arcslip/laws/contact/separation_onset.hpp>
#include <arcslip/laws/reversal_condition.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::elements {
namespace {

enum { first_onset = load_guard::count, contact_carried_up = 8, contact_carried_down };

// Onset of slip of the sign given, of a slider that rests since it was left.
struct SlipOnset {
  SliderRest::At rest;
  double slip;
};

int guard_of_onset(SlipOnset onset) {
  return first_onset + static_cast<int>(onset.rest) + (onset.slip > 0 ? 3 : 0);
}

SlipOnset onset_of(const Corner& corner) {
  const int k = corner.guard - first_onset;
  return {static_cast<SliderRest::At>(k % 3), k >= 3 ? 1.0 : -1.0};
}

// w at a rest is x_t + sign h; the bound that slips with sign s is x_t - s h.
double sign_of(SliderRest::At rest) {
  return SliderRest{rest}.sign();
}

class Contact2dCorners final : public Corners {
 public:
  Contact2dCorners(const Harmonics& h, Offset offset)
      : h_(h), offset_(offset), c_(h.size()), phi_(c_), derivative_(c_) {}

  void equations(const Corner& corner, In w, Fields fields, Equations& at) override {
    set(contact_law(fields), w);
    if (corner.guard < first_onset)
      return set_load_corner(h_, corner, corner.guard == load_guard::closing, w.tail(c_),
                             {law_.k_n, law_.N_0, 1, 3}, at);
    at.values.setZero();
    for (Eigen::MatrixXd* m : {&at.by_motion, &at.by_angle, &at.by_field}) m->setZero();
    if (corner.guard >= contact_carried_up) {  // k_t x_t - mu N, or -(k_t x_t + mu N)
      const double sign = corner.guard == contact_carried_up ? 1 : -1;
      add_bound(sign * law_.k_t, -sign, corner.angles[0], 0, at);
      at.by_field(0, 0) += at.values[0] / law_.k_t;
      add_slope(-sign, corner.angles[0], 0, 1, at);
      return;
    }
    const SlipOnset onset = onset_of(corner);
    const double k = 0.5 * onset.slip * law_.k_t;
    add_bound(k, -onset.slip, corner.angles[1], 1, at);
    add_bound(-k, sign_of(onset.rest), corner.angles[0], 0, at);
    at.by_field(0, 0) += at.values[0] / law_.k_t;
    add_slope(-onset.slip, corner.angles[1], 1, 2, at);
    if (onset.rest == SliderRest::At::closing)
      add_load(corner.angles[0], 0, 1, at);
    else
      add_slope(sign_of(onset.rest), corner.angles[0], 0, 1, at);
  }

  double size(const Corner&, In w, Fields fields) override {
    const ContactLaw law = contact_law(fields);
    const double normal = law.k_n * (std::abs(w[c_]) + series_bound(h_, w.tail(c_), 0));
    return std::max(std::abs(law.N_0) + normal, law.k_t * series_bound(h_, w.head(c_), 0));
  }

  bool polish(Corner& corner, In w, Fields fields) override {
    set(contact_law(fields), w);
    if (corner.guard < first_onset)
      return polish_reversal(h_, w.tail(c_), corner.guard == load_guard::closing ? 1 : -1, corner.angles[0]);
    if (corner.guard >= contact_carried_up) {
      const double sign = corner.guard == contact_carried_up ? 1 : -1;
      return polish_reversal(h_, bound(-sign), sign, corner.angles[0]);
    }
    const SlipOnset onset = onset_of(corner);
    if (!polish_reversal(h_, bound(-onset.slip), onset.slip, corner.angles[1])) return false;
    if (onset.rest != SliderRest::At::closing)
      return polish_reversal(h_, bound(sign_of(onset.rest)), -sign_of(onset.rest), corner.angles[0]);
    return polish_closing(corner.angles[0], w);
  }

  std::vector<Corner> near(In w, Fields fields, double tolerance) override {
    std::vector<Corner> found;
    ContactPhases search(h_, offset_);
    const ContactLaw law = contact_law(fields);
    set(law, w);
    const auto& phases = search.find(w.head(c_), w.tail(c_), law);
    Equations at(w.size(), 2, static_cast<Eigen::Index>(fields.size()));
    const auto add = [&](int guard, std::vector<double> angles) {
      Corner corner{guard, std::move(angles)};
      at = {w.size(), static_cast<int>(corner.angles.size()), static_cast<Eigen::Index>(fields.size())};
      equations(corner, w, fields, at);
      if (std::abs(at.values[0]) <= tolerance * size(corner, w, fields) && !is_listed(found, corner, w))
        found.push_back(std::move(corner));
    };
    for (const Reversal& turn : search.normal().reversals())
      add(series_values(h_, w.tail(c_), turn.theta).d2 < 0 ? load_guard::closing : load_guard::separation,
          {turn.theta});
    if (!(law.mu > 0)) return found;
    if (search.full_stick()) {
      add_of_stick(search, add);
      return found;
    }
    for (std::size_t i = 0; i < phases.size(); ++i) {
      const ContactPhase& phase = phases[i];
      if (phase.state != ContactPhase::State::stick) continue;
      const ContactPhase &next = phases[(i + 1) % phases.size()], &then = phases[(i + 2) % phases.size()];
      const auto add_onset = [&](double slip, double theta) {
        add(guard_of_onset({phase.rest.at, slip}), {phase.rest.theta, theta});
      };
      if (next.state == ContactPhase::State::slip && then.state != ContactPhase::State::open) {
        const double turns = next.begin < phase.begin ? 2 * std::numbers::pi : 0;
        add_onset(next.sign, next.end + turns);
      }
      for (const double slip : {1.0, -1.0})
        for (const Reversal& turn : slip > 0 ? search.reversals_of_lower() : search.reversals_of_upper()) {
          double theta = turn.theta;
          while (theta <= phase.begin + same_corner_angle) theta += 2 * std::numbers::pi;
          while (theta - 2 * std::numbers::pi > phase.begin + same_corner_angle)
            theta -= 2 * std::numbers::pi;
          const double bend = series_values(h_, bound(-slip), theta).d2;
          if (theta < phase.end - same_corner_angle && slip * bend < 0) add_onset(slip, theta);
        }
    }
    return found;
  }

 private:
  using Equations = Corners::Equations;

  void set(const ContactLaw& law, In w) {
    law_ = law;
    w_ = w;
    const double ratio = law.k_t > 0 ? law.mu * law.k_n / law.k_t : 0;
    lower_ = w.head(c_) - ratio * w.tail(c_);
    upper_ = w.head(c_) + ratio * w.tail(c_);
  }
  // x_t + sign h but for a constant; the same as x_t where sign is 0.
  const Eigen::VectorXd& bound(double sign) const { return sign < 0 ? lower_ : upper_; }

  // factor (x_t + sign mu N/k_t) at an angle, to h.
  void add_bound(double factor, double sign, double theta, int angle, Equations& at) {
    const Values t = series_values(h_, w_.head(c_), theta), n = series_values(h_, w_.tail(c_), theta);
    const double N = law_.N_0 + law_.k_n * n.x, by_N = factor * sign * law_.mu / law_.k_t;
    series_basis(h_, theta, phi_);
    at.values[0] += factor * t.x + by_N * N;
    at.by_motion.row(0).head(c_) += factor * phi_.transpose();
    at.by_motion.row(0).tail(c_) += by_N * law_.k_n * phi_.transpose();
    at.by_angle(0, angle) += factor * t.d1 + by_N * law_.k_n * n.d1;
    at.by_field(0, 0) -= by_N * N / law_.k_t;
    at.by_field(0, 1) += by_N * n.x;
    at.by_field(0, 2) += factor * sign * N / law_.k_t;
    at.by_field(0, 3) += by_N;
  }
  // N at an angle, to a row.
  void add_load(double theta, int angle, int row, Equations& at) {
    const Values n = series_values(h_, w_.tail(c_), theta);
    series_basis(h_, theta, phi_);
    at.values[row] += law_.N_0 + law_.k_n * n.x;
    at.by_motion.row(row).tail(c_) += law_.k_n * phi_.transpose();
    at.by_angle(row, angle) += law_.k_n * n.d1;
    at.by_field(row, 1) += n.x;
    at.by_field(row, 3) += 1;
  }
  // The slope of x_t + sign mu k_n/k_t x_n at an angle.
  void add_slope(double sign, double theta, int angle, int row, Equations& at) {
    const double normal = sign * law_.mu * law_.k_n / law_.k_t;
    const Values t = series_values(h_, w_.head(c_), theta), n = series_values(h_, w_.tail(c_), theta);
    derivative_[0] = 0;
    for (int k = 1; k <= h_.order; ++k) {
      derivative_[h_.cosine_index(k)] = -k * std::sin(k * theta);
      derivative_[h_.sine_index(k)] = k * std::cos(k * theta);
    }
    at.values[row] += t.d1 + normal * n.d1;
    at.by_motion.row(row).head(c_) += derivative_.transpose();
    at.by_motion.row(row).tail(c_) += normal * derivative_.transpose();
    at.by_angle(row, angle) += t.d2 + normal * n.d2;
    at.by_field(row, 0) -= normal / law_.k_t * n.d1;
    at.by_field(row, 1) += sign * law_.mu / law_.k_t * n.d1;
    at.by_field(row, 2) += sign * law_.k_n / law_.k_t * n.d1;
  }

  bool polish_closing(double& theta, In w) const {
    const double begin = theta;
    for (int i = 0; i < 20; ++i) {
      const Values n = series_values(h_, w.tail(c_), theta);
      if (!(n.d1 > 0)) return false;
      const double step = -(law_.N_0 / law_.k_n + n.x) / n.d1;
      theta += step;
      if (!(std::abs(theta - begin) <= 0.3)) return false;
      if (std::abs(step) <= 1e-14) break;
    }
    return true;
  }

  // Between the largest of the lower bound and the smallest of the upper one, and those next to be these.
  template <class Add>
  void add_of_stick(const ContactPhases& search, Add&& add) const {
    const Reversal low = search.largest_lower(), high = search.smallest_upper();
    const auto &lower = search.reversals_of_lower(), &upper = search.reversals_of_upper();
    if (lower.empty() || upper.empty()) return;
    const double near = next_extreme * (series_bound(h_, lower_, 0) + series_bound(h_, upper_, 0));
    std::vector<double> tops, bottoms;
    for (const Reversal& at : lower)
      if (at.x >= low.x - near) tops.push_back(at.theta);
    for (const Reversal& at : upper)
      if (at.x <= high.x + near) bottoms.push_back(at.theta);
    for (std::size_t i = 0; i < tops.size(); ++i) {
      for (const double bottom : bottoms)
        add(guard_of_onset({SliderRest::At::upper_reversal, 1}), {bottom, tops[i]});
      for (std::size_t j = 0; j < i && search.held().lower > 0; ++j)
        add(guard_of_onset({SliderRest::At::lower_reversal, 1}), {tops[j], tops[i]});
    }
    if (offset_ == Offset::static_loads) {
      for (const double top : tops) add(contact_carried_up, {top});
      for (const double bottom : bottoms) add(contact_carried_down, {bottom});
    }
    for (std::size_t i = 0; i < bottoms.size(); ++i)
      for (std::size_t j = 0; j < i && search.held().upper > 0; ++j)
        add(guard_of_onset({SliderRest::At::upper_reversal, -1}), {bottoms[j], bottoms[i]});
  }

  // The same corner, or an image of it in a motion of a shorter period.
  bool is_listed(const std::vector<Corner>& all, const Corner& corner, In w) const {
    return std::any_of(all.begin(), all.end(), [&](const Corner& other) {
      if (other.guard != corner.guard) return false;
      const double turn = corner.angles[0] - other.angles[0];
      for (std::size_t i = 1; i < corner.angles.size(); ++i) {
        const double apart = corner.angles[i] - other.angles[i] - turn;
        if (std::abs(std::remainder(apart, 2 * std::numbers::pi)) > same_corner_angle) return false;
      }
      return is_image(h_, w.head(c_), turn, 1) && is_image(h_, w.tail(c_), turn, 1);
    });
  }

  Harmonics h_;
  Offset offset_;
  Eigen::Index c_;
  ContactLaw law_{};
  Eigen::VectorXd w_, lower_, upper_, phi_, derivative_;
};

}  // namespace

std::unique_ptr<Corners> make_contact_2d_corners(const Harmonics& harmonics, Offset offset) {
  return std::make_unique<Contact2dCorners>(harmonics, offset);
}

}  // namespace arcslip::elements
