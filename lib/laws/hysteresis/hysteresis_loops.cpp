#include <arcslip/laws/hysteresis/hysteresis_loops.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

constexpr double no_loop = 1e-14;  // of the largest |x|: rounding

}  // namespace

HysteresisLoops::HysteresisLoops(const Harmonics& harmonics) : harmonics_(harmonics), reversals_(harmonics) {
  const auto most = static_cast<std::size_t>(4 * harmonics.order + 32);
  path_.reserve(most);
  anchors_.reserve(most);
  parts_.reserve(2 * most);
  open_.reserve(most);
}

// The reversals of one span from the highest back to it (or, where the motion is odd, to its mirror image),
// without those whose loops are rounding.
void HysteresisLoops::find_path(In u) {
  path_.clear();
  range_ = 0;
  const auto& turns = reversals_.find(u);
  if (turns.empty()) return;
  const auto height = [&](const Reversal& at) { return harmonics_.odd ? std::abs(at.x) : at.x; };
  const auto top = std::max_element(turns.begin(), turns.end(), [&](const Reversal& a, const Reversal& b) {
    return height(a) < height(b);
  });
  const bool mirrored = harmonics_.odd && top->x < 0;
  const double span = harmonics_.span(), highest = height(*top);
  double lowest = harmonics_.odd ? -highest : highest;
  for (const Reversal& at : turns) lowest = harmonics_.odd ? lowest : std::min(lowest, at.x);
  range_ = highest - lowest;
  const double tolerance = no_loop * std::max(std::abs(highest), std::abs(lowest));
  const auto first = static_cast<std::size_t>(top - turns.begin());
  for (std::size_t k = 0; k <= turns.size(); ++k) {
    const Reversal& turn = turns[(first + k) % turns.size()];
    const bool wrapped = first + k >= turns.size();
    const double sign = (mirrored ? -1 : 1) * (wrapped && harmonics_.odd ? -1 : 1);
    const Reversal at{turn.theta + (mirrored ? span : 0) + (wrapped ? span : 0), sign * turn.x};
    const bool returned = k == turns.size(), same = k > 0 && std::abs(at.x - path_.back().x) <= tolerance;
    if (same && path_.size() > 1) path_.pop_back();
    if (!same || returned) path_.push_back(at);
  }
  if (path_.size() < 2 || !(range_ > tolerance)) {
    path_.clear();
    range_ = 0;
  }
}

void HysteresisLoops::find(In u) {
  find_path(u);
  anchors_.clear();
  parts_.clear();
  open_.clear();
  lowest_ = -1;
  if (path_.empty()) return;
  const double same = same_height * range_;
  anchors_.push_back({path_[0].theta, path_[0].x, -1, -1});
  open_.push_back(0);
  for (std::size_t k = 0; k + 1 < path_.size(); ++k) {
    const Reversal to = path_[k + 1];
    Reversal from = path_[k];
    const double way = to.x > from.x ? 1 : -1;
    bool closes_there = false;
    while (open_.size() >= 3 && !closes_there) {
      const double limit = anchors_[static_cast<std::size_t>(open_[open_.size() - 2])].x;
      const double beyond = way * (to.x - limit);
      if (beyond < -same) break;
      closes_there = beyond <= same;
      const Reversal end = closes_there ? to : Reversal{reversals_.crossing(u, from, to, limit), limit};
      if (end.theta > from.theta) parts_.push_back({from, end, open_.back()});
      open_.resize(open_.size() - 2);
      from = end;
    }
    if (!closes_there && to.theta > from.theta) parts_.push_back({from, to, open_.back()});
    if (k + 2 == path_.size()) break;
    const int parent = open_.back();
    open_.push_back(static_cast<int>(anchors_.size()));
    anchors_.push_back({to.theta, to.x, -way, parent});
  }
  if (harmonics_.odd) return;
  lowest_ = 0;
  for (std::size_t k = 1; k < anchors_.size(); ++k)
    if (anchors_[k].x < anchors_[static_cast<std::size_t>(lowest_)].x - same) lowest_ = static_cast<int>(k);
}

}  // namespace arcslip::elements
