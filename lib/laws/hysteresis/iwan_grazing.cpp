// Onset of slip of single sliders, and reversals that become as high as an earlier one (iwan.hpp).
#include <arcslip/laws/hysteresis/iwan.hpp>

#include <arcslip/laws/hysteresis/hysteresis_loops.hpp>
#include <arcslip/laws/reversal_condition.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::elements {
namespace {

class IwanCorners final : public Corners {
 public:
  IwanCorners(const Harmonics& h, IwanOnsets onsets)
      : h_(h), onsets_(std::move(onsets)), loops_(h), phi_(h.size()), by_field_(onsets_.fields) {}

  void equations(const Corner& corner, In w, Fields fields, Equations& at) override {
    const double sign = sign_of(corner), factor = 0.5 * sign * stiffness(fields);
    const Values from = series_values(h_, w, corner.angles[0]), to = series_values(h_, w, corner.angles[1]);
    at.by_field.row(0).setZero();
    at.values[0] = factor * (to.x - from.x);
    if (!is_tie(corner)) {
      at.values[0] -= onsets_.force(fields, slider_of(corner), by_field_);
      at.by_field.row(0) = -by_field_.transpose();
    }
    at.by_field(0, 0) += factor / fields[0] * (to.x - from.x);
    for (const int row : {1, 2}) set_reversal_row(h_, corner, w, row, at);
    series_basis(h_, corner.angles[1], phi_);
    at.by_motion.row(0) = factor * phi_.transpose();
    series_basis(h_, corner.angles[0], phi_);
    at.by_motion.row(0) -= factor * phi_.transpose();
    at.by_angle(0, 0) = -factor * from.d1;
    at.by_angle(0, 1) = factor * to.d1;
  }

  double size(const Corner& corner, In w, Fields fields) override {
    const double most = stiffness(fields) * series_bound(h_, w, 0);
    return is_tie(corner) ? most : std::min(most, onsets_.force(fields, slider_of(corner), by_field_));
  }

  bool polish(Corner& corner, In w, Fields) override {
    const double sign = sign_of(corner);
    return polish_reversal(h_, w, is_tie(corner) ? sign : -sign, corner.angles[0]) &&
           polish_reversal(h_, w, sign, corner.angles[1]);
  }

  std::vector<Corner> near(In w, Fields fields, double tolerance) override {
    std::vector<Corner> found;
    loops_.find(w);
    const auto& anchors = loops_.anchors();
    if (anchors.empty()) return found;
    const double half = 0.5 * stiffness(fields);
    const auto add = [&](int guard, double from, double to) {
      Corner corner{guard, {from, to}};
      if (!is_listed(found, corner, w)) found.push_back(std::move(corner));
    };
    const auto add_onsets = [&](double range, double sign, double from, double to) {
      for (int j = 0; j < onsets_.count; ++j) {
        const double force = onsets_.force(fields, j, by_field_);
        if (force > 0 && std::abs(half * range - force) <= tolerance * force)
          add(2 * j + (sign > 0 ? 1 : 0), from, to);
      }
    };
    const double top = anchors.front().theta;
    add_onsets(loops_.range(), 1, h_.odd ? top - std::numbers::pi : lowest().theta, top);
    for (std::size_t i = 1; i < anchors.size(); ++i) {
      const Anchor& from = anchors[static_cast<std::size_t>(anchors[i].parent)];
      if (static_cast<int>(i) != loops_.lowest())  // the same as the first above
        add_onsets(std::abs(anchors[i].x - from.x), from.way, from.theta, anchors[i].theta);
    }
    add_ties(w, fields, tolerance, add);
    return found;
  }

 private:
  double stiffness(Fields fields) const { return onsets_.stiffness(fields); }
  bool is_tie(const Corner& corner) const { return corner.guard / 2 == onsets_.count; }
  int slider_of(const Corner& corner) const { return corner.guard / 2; }
  static double sign_of(const Corner& corner) { return corner.guard % 2 == 1 ? 1 : -1; }
  const Anchor& lowest() const { return loops_.anchors()[static_cast<std::size_t>(loops_.lowest())]; }

  // Reversals of one kind that are equally high, with none beyond them in between.
  template <class Add>
  void add_ties(In w, Fields fields, double tolerance, Add&& add) {
    std::vector<Anchor> all = loops_.anchors();
    if (h_.odd)
      for (const Anchor& at : loops_.anchors())
        all.push_back({at.theta + std::numbers::pi, -at.x, -at.way, at.parent});
    const double same = 2 * tolerance * series_bound(h_, w, 0);
    const double first = onsets_.microslip ? 0 : onsets_.force(fields, 0, by_field_);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t step = 1; step < all.size(); ++step) {
        const Anchor& other = all[(i + step) % all.size()];
        if (other.way != all[i].way) continue;
        const double beyond = all[i].way * (all[i].x - other.x);
        if (beyond > same) break;  // a higher one hides those behind it
        if (beyond < -same) continue;
        const double reach = 0.5 * stiffness(fields) * std::abs(all[i].x - before(all, i));
        if (reach >= first || is_extreme(all[i], same))
          add(2 * onsets_.count + (all[i].way < 0 ? 1 : 0), all[i].theta, other.theta);
        break;
      }
  }
  // x of the last reversal of the other kind before number i.
  static double before(const std::vector<Anchor>& all, std::size_t i) {
    return all[(i + all.size() - 1) % all.size()].x;
  }
  bool is_extreme(const Anchor& at, double same) const {
    if (h_.odd) return false;
    return std::abs(at.x - loops_.anchors().front().x) <= same || std::abs(at.x - lowest().x) <= same;
  }

  // The same corner, or an image of it by a symmetry of the motion; of a tie also in the other order.
  bool is_listed(const std::vector<Corner>& all, const Corner& corner, In w) const {
    return std::any_of(all.begin(), all.end(), [&](const Corner& other) {
      if (other.guard / 2 != corner.guard / 2) return false;
      const double sign = sign_of(other) * sign_of(corner);
      const auto same = [&](double from, double to) {
        const double turn = from - other.angles[0], apart = to - other.angles[1] - turn;
        return std::abs(std::remainder(apart, 2 * std::numbers::pi)) <= same_corner_angle &&
               is_image(h_, w, turn, sign);
      };
      return same(corner.angles[0], corner.angles[1]) ||
             (is_tie(corner) && same(corner.angles[1], corner.angles[0]));
    });
  }

  Harmonics h_;
  IwanOnsets onsets_;
  HysteresisLoops loops_;
  Eigen::VectorXd phi_, by_field_;
};

}  // namespace

std::unique_ptr<Corners> make_iwan_corners(const Harmonics& harmonics, IwanOnsets onsets) {
  return std::make_unique<IwanCorners>(harmonics, std::move(onsets));
}

}  // namespace arcslip::elements
