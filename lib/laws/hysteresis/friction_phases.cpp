#include <arcslip/laws/hysteresis/friction_phases.hpp>

#include <algorithm>

namespace arcslip::elements {

FrictionPhases::FrictionPhases(const Harmonics& harmonics) : harmonics_(harmonics), reversals_(harmonics) {
  path_.reserve(static_cast<std::size_t>(8 * harmonics.order + 32));
  phases_.reserve(path_.capacity());
}

const std::vector<FrictionPhase>& FrictionPhases::find(In u, double slip_displacement) {
  phases_.clear();
  const auto& turns = reversals_.find(u);
  if (turns.empty()) {
    highest_ = lowest_ = {0, harmonics_.odd ? 0.0 : u[0]};
    return phases_;
  }
  set_path(turns);
  if (!(highest_.x - lowest_.x <= 2 * slip_displacement))
    follow_path(u, slip_displacement);
  else if (!harmonics_.odd)
    choose_extremes(turns);
  return phases_;
}

// One span from the highest point back to it (or, where the motion is odd, to its mirror image, the lowest).
void FrictionPhases::set_path(const std::vector<Reversal>& turns) {
  path_.clear();
  const double span = harmonics_.span();
  std::size_t top = 0;
  bool mirrored = false;
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const bool flip = harmonics_.odd && turns[k].x < 0;
    const double x = flip ? -turns[k].x : turns[k].x;
    const double best = mirrored ? -turns[top].x : turns[top].x;
    if (k == 0 || x > best) {
      top = k;
      mirrored = flip;
    }
  }
  const double sign = mirrored ? -1 : 1, shift = mirrored ? span : 0;
  for (std::size_t k = 0; k <= turns.size(); ++k) {
    const std::size_t index = (top + k) % turns.size();
    const bool wrapped = top + k >= turns.size();
    const double turned = wrapped && harmonics_.odd ? -1 : 1;
    path_.push_back({turns[index].theta + shift + (wrapped ? span : 0), sign * turned * turns[index].x});
  }
  highest_ = path_.front();
  std::size_t bottom = path_.size() - 1;
  if (!harmonics_.odd)
    for (std::size_t k = 0; k < path_.size(); ++k)
      if (path_[k].x < path_[bottom].x) bottom = k;
  lowest_ = path_[bottom];
}

void FrictionPhases::follow_path(In u, double slip_displacement) {
  Reversal anchor = path_.front();
  double anchored = 1;
  for (std::size_t k = 0; k + 1 < path_.size(); ++k) {
    const Reversal &from = path_[k], &to = path_[k + 1];
    const bool rises = to.x > from.x;
    // f = anchored p + k_d (x - anchor.x) reaches +p or -p at
    const double limit =
        rises ? anchor.x + (1 - anchored) * slip_displacement : anchor.x - (1 + anchored) * slip_displacement;
    if (rises ? to.x <= limit : to.x >= limit) continue;
    const double onset = reversals_.crossing(u, {from.theta, from.x}, {to.theta, to.x}, limit);
    phases_.push_back({anchor.theta, anchor.x, anchored, onset, rises ? 1.0 : -1.0, to.theta});
    anchor = to;
    anchored = rises ? 1 : -1;
  }
  // Rounding may leave the way back to the last extreme without slip: then it sticks to the end.
  if (anchor.theta < path_.back().theta)
    phases_.push_back({anchor.theta, anchor.x, anchored, path_.back().theta, 1, path_.back().theta});
}

// Of several highest and lowest reversals, as in a motion with a shorter period than the force, the nearest
// two: which of them is the highest is decided by rounding only.
void FrictionPhases::choose_extremes(const std::vector<Reversal>& turns) {
  const double same = same_height * (highest_.x - lowest_.x);
  extremes_ = turns.size();
  for (std::size_t bottom = 0; bottom < turns.size(); ++bottom) {
    if (turns[bottom].x > lowest_.x + same) continue;
    for (std::size_t way = 1; way < extremes_; ++way) {
      const Reversal& top = turns[(bottom + way) % turns.size()];
      if (top.x < highest_.x - same) continue;
      extremes_ = way;
      highest_.theta = top.theta;
      lowest_.theta = turns[bottom].theta;
    }
  }
}

}  // namespace arcslip::elements
