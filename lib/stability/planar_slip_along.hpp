#pragma once
// The slider w of a contact in a plane (laws/contact/contact_3d.hpp) along a periodic motion of x = (x_1,
// x_2) and x_n, and what a disturbance makes of it. Private.
//
// In slip w = x - h n with h = mu N/k_t, n = (cos psi, sin psi), t = n turned, and h psi' = x'.t. A
// disturbance dw is constant in stick. In slip only y = -t.dw is free,
//
//   dw = n (n.dx - dh) - t y,    y' = -g (y + t.dx) + psi' (n.dx - dh),    g = (x'.n - h')/h
//
// and with dh = mu k_n dx_n/k_t the tangential force k_t (x - w) changes by
//
//   k_t (dx - dw)   in stick       k_t n dh + k_t t (t.dx + y)   in slip
//
// Where slip begins or ends, dw and the force are continuous although the instant moves: of w' only the part
// along n jumps, which is not free. Where the contact closes and slips, h = 0 and so y = -t.dx; where it
// closes and sticks, dw = dx - (x'/h') dh. An open contact has no memory.
//
// With e = y + t.dx and S = t.dx' - psi' dh it is e' = -g e + S. Where g is large by all else, e follows at
// once, by the first two moments of the memory,
//
//   e = a S - b S',   a = r/(1 + r'),   b = r^2/((1 + r')(1 + 2 r')),   r = 1/g
//
// with errors of the order of (r d/dtheta)^2: friction across the direction of slip is then a damping. g
// grows without bounds where the contact closes and opens; up to 1e-6 rad from there e is 0 to that order.

#include <arcslip/laws/contact/normal_contact.hpp>
#include <arcslip/laws/contact/planar_phases.hpp>
#include <arcslip/laws/planar_friction.hpp>
#include <arcslip/time/equation/equation_of_motion.hpp>

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace arcslip::time {

class DiscCourse {
 public:
  /// Of the forces (tangential 1 and 2, normal) by dx, dx', dx'' and the memory: dw in stick, (y, 0) in slip.
  struct Values {
    Eigen::Matrix3d by_q;
    Eigen::Matrix<double, 3, 2> by_memory;
    Eigen::Matrix2d rate_by_memory;
    Eigen::Matrix<double, 2, 3> rate_by_q;
    bool relaxes;  // may also be without memory, by:
    Eigen::Matrix3d relaxed_by_q, by_v, by_a;
  };

  explicit DiscCourse(const elements::PlaneFriction::Contact& contact) : contact_(contact) {}

  /// q: coefficients, a column for each direction; fastest: frequency of the structure, rad/rad. False: not
  /// finite.
  bool follow(const elements::Harmonics& harmonics, const Matrix& q, double fastest);

  /// Angles at which the phase changes, in [0, 2 pi), in any order.
  const std::vector<double>& changes() const { return changes_; }
  /// Further angles at which the values are not smooth.
  const std::vector<double>& breaks() const { return breaks_; }
  /// At an angle between two of these.
  void at(double theta, Values& values) const;
  /// The memory at the end of a part that is relaxed: dq, dq', dq'' and the memory, a row for each start.
  void relax(double theta, const Matrix& dq, const Matrix& dv, const Matrix& da, Matrix& memory) const;
  /// Passes a change.
  void pass(std::size_t change, const Matrix& dq, Matrix& memory) const;
  /// How much of the memory is free at an angle, as starts: 2 in stick, 1 in slip, else 0, as where the
  /// slider sticks throughout.
  int free_at(double theta) const;
  /// How much is not, but follows at once; 0 where the slider sticks throughout.
  int following_at(double theta) const { return full_stick_ ? 0 : 2 - free_at(theta); }

 private:
  using State = elements::DiscPhase::State;
  struct Phase {
    State state;
    double begin, end;
    std::size_t first_panel, last_panel;  // of slip; none: without friction
    double from, to;                      // the part that is not next to an opening or a closing
    double settled;                       // from there on its beginning is forgotten
  };
  // Slip at one angle: g, psi', psi'', and the moments a and b.
  struct Slip {
    Eigen::Vector2d n, t;
    double g, turning, turning_rate, first, second;
    bool nearby, relaxes;  // an opening or a closing
  };

  struct Place {
    const Phase* phase;
    double theta;  // from its begin to its end
  };
  Place place_of(double theta) const;
  Eigen::Vector2d normal_at(const Phase& phase, double theta) const;
  Slip slip_at(const Place& place) const;
  double settled_from(const Phase& phase) const;
  double radius_by_normal() const { return contact_.mu * contact_.k_n / contact_.k_t; }
  bool has_friction(const Phase& phase) const { return phase.first_panel < phase.last_panel; }
  void add_without_friction(std::span<const std::pair<double, double>> closed);
  void cut_ends(std::size_t k);
  void add(State state, double begin, double end, std::size_t first_panel = 0, std::size_t last_panel = 0);

  elements::PlaneFriction::Contact contact_;
  struct Followed {
    elements::NormalContact normal;
    elements::Disc disc;
    elements::DiscPhases phases;
    explicit Followed(const elements::Harmonics& harmonics)
        : normal(harmonics), disc(harmonics), phases(harmonics) {}
  };
  std::optional<Followed> of_;
  std::vector<Phase> phases_;  // without gaps, over one period
  bool full_stick_ = false;
  double fast_ = 0;  // g from which slip relaxes
  std::vector<double> changes_, breaks_;
};

}  // namespace arcslip::time
