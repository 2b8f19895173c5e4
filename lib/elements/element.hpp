#pragma once
// A nonlinear element in the frequency domain: coefficients of a displacement in, coefficients of a force and
// its derivatives out.
//
// The force acts against the motion: the equation of motion is M x'' + C x' + K x + f(x) = excitation. The
// coefficients of f are those of its Fourier series in the layout of harmonics.hpp:
//   F_n = (1/pi) integral of f(theta) (cos n theta, sin n theta) over a period (1/(2 pi) for the mean).

#include <arcslip/elements/series.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace arcslip::elements {

/// Contact of a friction element over one period.
struct FrictionState {
  double stick_share = 0;           // 0 to 1
  std::vector<double> slip_onsets;  // rad in [0, 2 pi), ascending
  std::vector<double> slip_ends;    // rad in [0, 2 pi), ascending: the reversals where slip ends
};

/// Made for one harmonic set; owns its buffers and allocates nothing in move_to().
class Element {
 public:
  virtual ~Element() = default;

  /// u: harmonics.size() coefficients of each direction, and of each auxiliary unknown after them. fields: as
  /// listed with the element's type. The Jacobian is made only when asked for.
  virtual void move_to(In u, std::span<const double> fields, bool jacobian) = 0;

  virtual const Eigen::VectorXd& force() const = 0;            // F(u), as u
  virtual const Eigen::MatrixXd& jacobian() const = 0;         // dF/du
  virtual void field_derivative(int field, Out dF) const = 0;  // dF/d(fields[field]) at the last place

  /// Number of the smooth piece of F that the last place lies on.
  virtual std::uint64_t piece() const { return 0; }

  /// False where the element has no contact. Angles are those of the last place.
  virtual bool friction(FrictionState&) const { return false; }
};

}  // namespace arcslip::elements
