#pragma once
// The offset of a slider that sticks throughout the period: with the bounds x - h and x + h of w, every w
// from a = max (x - h) to b = min (x + h) is a periodic state, and each has another mean force.
//
//   centred       w = (a + b)/2: no mean force of its own, the limit from slip
//   static_loads  w = min(max(0, a), b): the slider, unstressed with the structure at rest, has moved no
//                 farther than its bounds carried it, so that it holds a mean force
//   placed        w = (1 - s) a + s b: at a share s of the way
//
// All meet at a = b, the onset of slip.

namespace arcslip::elements {

enum class Offset { centred, static_loads, placed };

/// w = lower a + upper b, with the same derivatives. Both are 0 where w rests at 0.
struct StuckSlider {
  double lower = 0.5, upper = 0.5;
};

inline StuckSlider stuck_slider(Offset offset, double a, double b, double share = 0.5) {
  if (offset == Offset::centred) return {};
  if (offset == Offset::placed) return {1 - share, share};
  if (a > 0) return {1, 0};
  return {0, b < 0 ? 1.0 : 0.0};
}

}  // namespace arcslip::elements
