#pragma once
// The memory z of a hysteretic law (laws/hysteresis.hpp) along a periodic motion q(theta), and what a
// disturbance makes of it. Private.
//
// From a reversal q_a of the motion to the next one, in x = sgn(q') z/b and g = |q - q_a|/b,
//
//   dx/dg = r(x)
//
// and x changes its sign at a reversal. The only periodic z is the fixed point of the map of x over all
// reversals, which contracts. A disturbance dq, dz = r dq + y obeys
//
//   y' = (dr/dz) q' y,   so that y = phi y_a,   phi = r/r_a,     as dr/dg = (dr/dx) r, too
//   y_after = y_before + (r_before - r_after) dq                 at a reversal:
//
// z' = r q' vanishes there on both sides, so that dz has no jump. Where r < 1e-13 the memory is at its bound,
// and r = phi = 0.
//
// All sections are parts of one curve x(g) (hysteresis_curve.hpp).

#include <arcslip/fourier/reversals.hpp>
#include <arcslip/stability/hysteresis_curve.hpp>

#include <utility>
#include <vector>

namespace arcslip::time {

class HysteresisCourse {
 public:
  struct Values {
    double r, phi;
  };
  /// The end of a section between two reversals. theta: rad, in [0, span); r on both sides; phi at its end.
  struct Turn {
    double theta, before, after, phi;
  };

  /// The law must outlive this.
  HysteresisCourse(const elements::Hysteresis& law, std::span<const double> fields)
      : curve_(law, fields), bound_(law.bound(fields)) {}

  /// q: coefficients. False: not finite. A motion that is constant has no reversals, and z = 0.
  bool follow(const elements::Harmonics& harmonics, elements::In q);

  /// At any angle, rad.
  Values at(double theta, double cos_theta, double sin_theta) const;
  /// The reversals in one span of the harmonics, in any order.
  const std::vector<Turn>& turns() const { return turns_; }
  /// Angles between which r and phi are smooth, and monotone from one reversal to the next: where z passes 0
  /// and where it comes to its bound; in any order, in [0, span).
  const std::vector<double>& breaks() const { return breaks_; }

 private:
  struct Section {
    elements::Reversal from;
    double length;        // of q, over b
    double g = 0, r = 0;  // at its start: on the curve
    double end() const { return g + length; }
  };

  elements::Reversals& reversals_of(const elements::Harmonics& harmonics);
  elements::Reversal end_of(std::size_t section) const;
  bool is_at_bound(const Section& section) const { return section.end() >= curve_.end(); }
  double around(double x, double& by_x);
  double periodic(double guess, double scale);
  void locate(const elements::Reversals& reversals);
  double within(double theta) const;
  double displacement(double cos_theta, double sin_theta) const;

  HysteresisCurve curve_;
  double bound_;
  std::vector<std::pair<elements::Harmonics, elements::Reversals>> reversals_;  // the last ones used
  elements::Harmonics harmonics_;
  Eigen::VectorXd q_;
  std::vector<Section> sections_;
  std::vector<Turn> turns_;
  std::vector<double> breaks_;
};

}  // namespace arcslip::time
