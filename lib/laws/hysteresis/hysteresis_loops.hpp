#pragma once
// The loops of a motion under the rules of Masing, from the sequence of its reversals. Shared by all laws
// whose force is made of sliders in parallel, of any distribution:
//
//   f(theta) = f_a + 2 s F(s (x - x_a)/2),   s = sign(x')
//
// from the last reversal a, the anchor, with the force F(x) of a first loading, the backbone. Where x returns
// to the reversal before its anchor, the loop between the two closes, is forgotten, and the branch goes on
// from the anchor before them (Madelung's rules). In steady state the outermost loop lies between the largest
// and the smallest x, and is symmetric: f = F((max x - min x)/2) at the largest.

#include <arcslip/fourier/reversals.hpp>

namespace arcslip::elements {

/// A reversal from which branches begin.
struct Anchor {
  double theta, x;
  double way;  // sign of x' on its branches
  int parent;  // the anchor of the branch on which it was reached; -1: it has the largest x
};

/// A part of a branch between reversals and closing loops; x is monotone.
struct BranchPart {
  Reversal begin, end;
  int anchor;
};

class HysteresisLoops {
 public:
  explicit HysteresisLoops(const Harmonics& harmonics);

  /// One span of the motion from its largest x, in the order of theta. No parts where x is constant.
  void find(In u);

  /// Anchors follow their parents; the first has the largest x.
  const std::vector<Anchor>& anchors() const { return anchors_; }
  const std::vector<BranchPart>& parts() const { return parts_; }
  /// The anchor of the smallest x. Where the motion is odd it lies half a period after the first, not in the
  /// list: -1.
  int lowest() const { return lowest_; }
  /// max x - min x.
  double range() const { return range_; }
  /// See Reversals.
  double crossing(In u, const Reversal& from, const Reversal& to, double target) const {
    return reversals_.crossing(u, from, to, target);
  }

 private:
  void find_path(In u);

  Harmonics harmonics_;
  Reversals reversals_;
  std::vector<Reversal> path_;
  std::vector<Anchor> anchors_;
  std::vector<BranchPart> parts_;
  std::vector<int> open_;  // the anchors of loops that are not closed yet
  int lowest_ = -1;
  double range_ = 0;
};

}  // namespace arcslip::elements
