#pragma once
// The phases of a slider w in a disc that moves, over one period: centre x(theta), radius h(theta) >= 0.
//
//   stick  w rests while |x - w| < h
//   slip   w = x - h n is carried along by the edge of the disc (slip_collocation.hpp)
//   open   the disc is the point x where N = 0, and w = x
//
// The onset of slip is where |x - w|^2 - h^2 becomes positive (slip_onset.hpp). Slip ends where x'.n = h'.
//
// Where the contact opens, the phases follow from its closing in one pass. Else the map of w over one period
// is non-expansive. If a rest is possible (stick_feasibility.hpp) there is full stick, with the centred rest.
// If not, the periodic motion is unique and attracting: Newton's method for w after one period, with the map
// itself as a safeguard.

#include <arcslip/laws/contact/slip_collocation.hpp>
#include <arcslip/laws/contact/stick_feasibility.hpp>
#include <arcslip/laws/element.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace arcslip::elements {

struct DiscPhase {
  enum class State { open, stick, slip };
  enum class Begin { closing, slip_end, onset, start, opening };
  State state = State::open;
  Begin from = Begin::start;
  double begin = 0, end = 0;
  Eigen::Vector2d w = Eigen::Vector2d::Zero();  // of stick
  std::size_t first_panel = 0, last_panel = 0;  // of slip: [first, last)
};

/// The phases of a slider from its state at an angle, as they follow. Owns its buffers.
class DiscMarch {
 public:
  struct State {
    bool slips = false;
    Eigen::Vector2d w = Eigen::Vector2d::Zero();
    double psi = 0;
    Eigen::Vector2d moved = Eigen::Vector2d::Zero();  // of w, by slip
  };
  struct Period {
    Eigen::Vector2d moved;  // change of w
    Eigen::Matrix2d by;     // dw at the end by w at the beginning
  };

  explicit DiscMarch(const Harmonics& harmonics);

  /// Before the marches of a motion. `opens`: the contact is open for a part of the period.
  void begin(const Disc& disc, bool opens);
  /// Without a phase; what was marched is forgotten, or kept as a guess of the march that follows.
  void clear();
  void again();
  State closing(const Disc& disc, double theta) const;
  /// A slider beyond the edge is moved to it.
  State at_rest(const Disc& disc, double theta, const Eigen::Vector2d& w) const;
  /// Adds the phases of an interval in contact. by: the derivative of w, which is multiplied.
  void march(const Disc& disc, State& state, DiscPhase::Begin from, double begin, double end,
             Eigen::Matrix2d* by);
  void add(const DiscPhase& phase) { phases_.push_back(phase); }
  /// again() and the phases of a period from a rest.
  Period period(const Disc& disc, double begin, const Eigen::Vector2d& w);
  /// Turns the list of a periodic motion so that it begins where slip ends, if the phase in which the period
  /// began is the same before and after.
  bool begin_at_slip_end();

  const std::vector<DiscPhase>& phases() const { return phases_; }
  std::size_t panels() const { return panels_.size(); }
  const SlipPanel& panel(std::size_t k) const { return panels_[k]; }
  const SlipCollocation& collocation() const { return collocation_; }
  /// x - w at an angle, of a list that is periodic.
  Eigen::Vector2d stretch(const Disc& disc, double theta) const;

 private:
  struct Lengths {                   // of panels, rad
    double next = 0, least = 1e-12;  // the least is not divided any further
    bool held = false;
  };
  struct Bracket {
    double below, f_below, above, f_above;
  };

  std::pair<double, double> spare(const Disc& disc, const SlipPanel& panel, double theta) const;
  std::optional<Bracket> end_of_slip(const Disc& disc, const SlipPanel& panel) const;
  double root_in(const Disc& disc, const SlipPanel& panel, const Bracket& bracket) const;
  bool add_panel(const Disc& disc, double theta, double end, double psi, Lengths& lengths);
  double decay_exponent(const SlipPanel& panel) const;
  const SlipPanel* known_near(double theta);
  double first_length(const Disc& disc, double theta) const;
  double solve(const Disc& disc, const SlipPanel* known, double theta, double to, double psi);
  bool close_slip(const Disc& disc, double root);
  double slip(const Disc& disc, State& state, double begin, double end, double& decay, bool& ends);
  Eigen::Vector2d displacement(const SlipPanel& panel) const;

  Harmonics harmonics_;
  SlipCollocation collocation_;
  std::vector<DiscPhase> phases_;
  std::vector<SlipPanel> panels_, before_;  // of this march and of the one before, of the same motion
  std::size_t cursor_ = 0;                  // in before_
  double tolerance_ = 0, longest_ = 0;
  bool opens_ = false;
};

/// The phases of the periodic motion. Owns its buffers.
class DiscPhases {
 public:
  explicit DiscPhases(const Harmonics& harmonics);

  /// closed: the intervals in contact; the whole period where the contact never opens, none where it is open
  /// throughout. `opens`: it is open for a part of the period. The first phase begins at a closing, at the
  /// end of slip or, in full slip, anywhere; the last one ends a period later.
  const std::vector<DiscPhase>& find(const Disc& disc, std::span<const std::pair<double, double>> closed,
                                     bool opens);

  // Of the last search.
  const std::vector<DiscPhase>& list() const { return march_.phases(); }
  bool full_stick() const { return full_stick_; }
  const StickCentre& centre() const { return centre_; }  // of full stick
  /// By how much at least the radius falls short of full stick, if the contact never opens; else 0.
  double short_of_stick() const { return short_of_stick_; }
  const SlipPanel& panel(std::size_t k) const { return march_.panel(k); }
  const SlipCollocation& collocation() const { return march_.collocation(); }
  /// Whether the state after the period is that before it, to rounding.
  bool periodic() const { return periodic_; }
  /// x - w at an angle.
  Eigen::Vector2d stretch(const Disc& disc, double theta) const { return march_.stretch(disc, theta); }
  /// A number for the sequence of phases, wherever it begins.
  std::uint64_t sequence() const;
  void tell(FrictionState& state) const;
  void tell(std::vector<ContactInterval>& intervals) const;

 private:
  double iterate(const Disc& disc, double enough, Eigen::Vector2d& w);
  bool surely_slips(const Disc& disc);
  void find_periodic(const Disc& disc, bool near_stick);

  DiscMarch march_;
  StickCentre centre_;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();  // of the search for a slider that slips
  DiscAngles angles_;
  std::vector<DiscInstant> instants_;  // there
  double short_of_stick_ = 0;
  bool full_stick_ = false, periodic_ = true;
};

}  // namespace arcslip::elements
