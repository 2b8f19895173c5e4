#pragma once
// The memory z of a hysteretic law (elements/hysteresis.hpp) along a periodic motion q(theta), and what a
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
// x(g) is marched in cells by extrapolation of the midpoint rule to order 10 (Gragg 1965; Hairer, Norsett &
// Wanner 1993, section II.9), each as long as leaves an error below 1e-14. A cell ends where x passes 0.

#include <arcslip/elements/hysteresis.hpp>
#include <arcslip/elements/reversals.hpp>

#include <optional>
#include <span>
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

  /// q: coefficients. False: not finite. A motion that is constant has no reversals, and z = 0.
  bool follow(const elements::Hysteresis& law, std::span<const double> fields,
              const elements::Harmonics& harmonics, elements::In q);

  /// At any angle, rad.
  Values at(double theta) const;
  /// The reversals in one span of the harmonics, in any order.
  const std::vector<Turn>& turns() const { return turns_; }
  /// Angles between which r and phi are smooth and resolved by polynomials of a low order, in any order; in
  /// [0, span).
  const std::vector<double>& breaks() const { return breaks_; }

 private:
  struct Cell {
    double g, x;
  };
  struct Section {
    elements::Reversal from;
    double length, r;      // in g; r at its start
    std::size_t cell;      // the first
    double saturated = 0;  // g from which on z is at its bound
  };
  struct Step {
    double x, error;
  };

  double rate(double x) const { return law_->rate(fields_, x); }
  Step step(double x, double g) const;
  double march(double x, Section& section);
  double around(double x, double& by_x);
  double periodic(double guess, double scale);
  void locate();
  double within(double theta) const;

  const elements::Hysteresis* law_ = nullptr;
  std::vector<double> fields_;
  double bound_ = 1;
  elements::Harmonics harmonics_;
  std::optional<elements::Reversals> reversals_;
  Eigen::VectorXd q_;
  std::vector<Section> sections_;
  std::vector<Cell> cells_;
  std::vector<Turn> turns_;
  std::vector<double> breaks_;
};

}  // namespace arcslip::time
