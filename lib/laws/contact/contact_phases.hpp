#pragma once
// The phases of a contact with a varying normal load over one period of its motion, from the tangential and
// the normal displacement, x_t and x_n:
//
//   N = max(N_0 + k_n x_n, 0),   lower bound x_t - h,   upper bound x_t + h,   h = mu N/k_t
//
// The slider w is a play in the moving interval between the bounds: it rests inside, and is carried by the
// bound that reaches it, the lower one upwards (slip, sign 1), the upper one downwards (sign -1). While the
// contact is open the interval is the point x_t, and w follows. Carrying w through a period is a composition
// of clamps, so that the state after one period, from any start, is periodic. Where the contact never opens,
// a = max(x_t - h) <= b = min(x_t + h) is full stick: each w in [a, b] is periodic, and nothing else is.
//
// All events are roots of trigonometric polynomials: N = 0, the reversals of the bounds, and the onsets of
// slip between reversals, where a bound is monotonic.

#include <arcslip/laws/contact/normal_contact.hpp>
#include <arcslip/laws/slider_offset.hpp>

#include <cstdint>
#include <span>

namespace arcslip::elements {

/// A law of a tangential spring k_t with a slider, and its normal load N_0 + k_n x_n.
struct ContactLaw {
  double k_t, k_n, mu, N_0;
};

/// Where a slider came to rest, and w there.
struct SliderRest {
  enum class At { closing, lower_reversal, upper_reversal };
  At at = At::closing;
  double theta = 0, w = 0;

  /// w = x_t + sign h.
  double sign() const { return at == At::lower_reversal ? -1 : at == At::upper_reversal ? 1 : 0; }
};

struct ContactPhase {
  enum class State { open, stick, slip };
  State state = State::open;
  double begin = 0, end = 0;
  double sign = 0;    // of slip: that of the force
  SliderRest rest{};  // of stick
};

/// Owns its buffers.
class ContactPhases {
 public:
  explicit ContactPhases(const Harmonics& harmonics, Offset offset = Offset::centred);

  /// The phases of a period, one after the other. Full stick: a single one, with the w of stuck_slider() and
  /// no place of rest.
  const std::vector<ContactPhase>& find(In u_t, In u_n, const ContactLaw& law);

  /// Where it rests in full stick, from now on: Offset::placed.
  void place(double share) { offset_ = Offset::placed, share_ = share; }

  // Of the last search.
  bool full_stick() const { return full_stick_; }
  Reversal largest_lower() const { return largest_lower_; }    // a, where the contact never opens
  Reversal smallest_upper() const { return smallest_upper_; }  // b
  StuckSlider held() const { return held_; }                   // in full stick
  const NormalContact& normal() const { return normal_; }
  /// A number for the sequence of phases, wherever it begins.
  std::uint64_t sequence() const;
  void tell(FrictionState& state) const;
  void tell(std::vector<ContactInterval>& intervals) const;

  const std::vector<Reversal>& reversals_of_lower() const { return lower_.turns; }
  const std::vector<Reversal>& reversals_of_upper() const { return upper_.turns; }

 private:
  struct Bound {
    Eigen::VectorXd u;
    std::vector<Reversal> turns;

    Reversal turn(long i) const;     // the i-th from the first; any integer
    long piece(double theta) const;  // the index of the last turn before theta
    bool rises(long i) const { return turn(i + 1).x > turn(i).x; }
  };
  struct Onset {
    double theta;
    long piece;
  };

  std::uint64_t sequence_of_phases() const;
  void choose_nearest();
  Onset onset(const Bound& bound, bool upwards, double begin, double end, double until, double w) const;
  void sweep(SliderRest rest, double end);
  void slip(double sign, Onset from, double end, SliderRest& rest);

  Harmonics harmonics_;
  Reversals reversals_;
  NormalContact normal_;
  Bound lower_, upper_;
  std::vector<ContactPhase> phases_;
  Offset offset_;
  double share_ = 0.5;
  StuckSlider held_;
  Reversal largest_lower_{}, smallest_upper_{};
  bool full_stick_ = false, frictionless_ = false, gap_ = false;
};

}  // namespace arcslip::elements
