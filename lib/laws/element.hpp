#pragma once
// A nonlinear element in the frequency domain: maps Fourier coefficients of a displacement to those of a
// force, with derivatives.
//
// The force acts against the motion: the equation of motion is M x'' + C x' + K x + f(x) = excitation. The
// coefficients of f are those of its Fourier series in the layout of fourier/harmonics.hpp:
//   F_n = (1/pi) integral of f(theta) (cos n theta, sin n theta) over a period (1/(2 pi) for the mean).

#include <arcslip/fourier/series.hpp>
#include <arcslip/results/contact_interval.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace arcslip::elements {

/// Contact of a friction element over one period.
struct FrictionState {
  double stick_share = 0;             // 0 to 1
  std::vector<double> slip_onsets;    // rad in [0, 2 pi), ascending
  std::vector<double> slip_ends;      // rad in [0, 2 pi), ascending: the reversals where slip ends
  double open_share = 0;              // 0 to 1
  double load_max = 0, load_min = 0;  // of the normal load, N, where Law::has_normal_load()
  // What the mean force along the first direction may be, N: an interval where the slider sticks throughout
  // (slider_offset.hpp). NaN: not reported.
  double mean_min = std::numeric_limits<double>::quiet_NaN(), mean_max = mean_min;
};

/// A number with all bits of x mixed, of which sums may be taken to number what a contact does: the last step
/// of SplitMix64.
inline std::uint64_t mixed_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// For one set of harmonics; owns its buffers. move_to() does not allocate.
class Element {
 public:
  virtual ~Element() = default;

  /// u: harmonics.size() coefficients of each direction, and of each auxiliary unknown after them. fields: as
  /// listed with the element's type. The Jacobian is computed only on request.
  virtual void move_to(In u, std::span<const double> fields, bool jacobian) = 0;

  /// The base frequency, rad/s, of the next places: where the force depends on velocities.
  virtual void set_frequency(double base_frequency) { static_cast<void>(base_frequency); }

  virtual const Eigen::VectorXd& force() const = 0;            // F(u), as u
  virtual const Eigen::MatrixXd& jacobian() const = 0;         // dF/du
  virtual void field_derivative(int field, Out dF) const = 0;  // dF/d(fields[field]) at the last place

  /// dF/d(base frequency) at the last place.
  virtual void frequency_derivative(Out dF) const;

  /// The smooth piece of F at the last point.
  virtual std::uint64_t piece() const { return 0; }

  /// Where the force jumps at reversals of the motion: the largest ratio of half the jump to |d2q/dtheta2|
  /// there, N/(m/rad^2). At that reversal friction holds the motion, which stops, unless m omega^2 is larger,
  /// with the base frequency omega and the inertia 1/m = d^T M^-1 d along the direction. 0: no jump.
  virtual double jump_over_bend() const { return 0; }

  /// False if the element has no contact. Angles of the last point.
  virtual bool friction(FrictionState&) const { return false; }

  /// Where a slider that sticks throughout the period rests at the next places, in place of its law's choice
  /// (slider_offset.hpp): at this share of the way from its lower bound, 0, to its upper one, 1. The mean
  /// force falls linearly from FrictionState::mean_max to mean_min. False if it cannot be placed.
  virtual bool place_slider(double share) {
    static_cast<void>(share);
    return false;
  }

  /// What its contact does at the last point: intervals that follow each other over one period, in any
  /// representation that put_in_order() takes. Empty: not reported.
  virtual void contact(std::vector<ContactInterval>& intervals) const { intervals.clear(); }
};

}  // namespace arcslip::elements
