#pragma once
// The phases of a slider over one span of its motion, from the sequence of its reversals. Shared by all laws
// whose force follows a play: the phases depend on x(theta) and on the slip displacement x_s = p/k_d alone.

#include <arcslip/fourier/reversals.hpp>

#include <cstdint>

namespace arcslip::elements {

/// Sticking from the anchor (begin, x), where f = sign p, to `end`; then slipping with -1 or +1 to
/// `slip_end`.
struct FrictionPhase {
  double begin, anchor_x, sign;
  double end;
  double slip_sign, slip_end;  // slip_end == end: no slip follows
};

/// All phases of one span, beginning at the largest x, where f = +p. Empty: no slip in the whole period.
class FrictionPhases {
 public:
  explicit FrictionPhases(const Harmonics& harmonics);

  /// x_s: slip displacement, >= 0.
  const std::vector<FrictionPhase>& find(In u, double slip_displacement);

  /// Largest and smallest x of the last search; the angles where they are.
  Reversal highest() const { return highest_; }
  Reversal lowest() const { return lowest_; }
  /// Where there is no slip and the motion has a mean, how many reversals the highest comes after the lowest:
  /// another number where another reversal becomes the highest or the lowest.
  std::uint64_t extremes() const { return extremes_; }

 private:
  void set_path(const std::vector<Reversal>& turns);
  void follow_path(In u, double slip_displacement);
  void choose_extremes(const std::vector<Reversal>& turns);

  Harmonics harmonics_;
  Reversals reversals_;
  std::vector<Reversal> path_;
  std::vector<FrictionPhase> phases_;
  Reversal highest_{}, lowest_{};
  std::uint64_t extremes_ = 0;
};

}  // namespace arcslip::elements
