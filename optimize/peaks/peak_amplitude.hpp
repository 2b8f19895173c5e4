#pragma once
// The largest amplitude in a window of the excitation frequency, as a function of design parameters:
//
//   A_max(p) = max over the window of A(omega, p) = max over its peaks of A
//
// Its peaks are found by one frequency response and then followed from design to design by continuation: a
// tangent, and Newton's method on the equations of the peak, in as many steps as they need.
//
//   resonance   dA/ds = 0 along the response (continuation/special_points/stationary.hpp)
//   corner      at which an element begins to slip (hbm/corner.hpp), with slopes of opposite sign on its
//               sides
//   lower_end, upper_end   the response at the ends of the window; of several extremes of the motion that are
//                          nearly as high there, one for each, since A has a kink where two are equal
//   kink        at another kink, such as where two extremes of the motion are equally high
//
// The response is traced anew where a peak cannot be followed, because it vanishes, splits, leaves the window
// or comes to a corner; at every design where there is a kink; where a parameter has changed by a factor of e
// since the last response; and where a peak is expected to have come up, by its slopes there. Peaks below
// a share of the highest (Watched) are not watched: what grows above the others otherwise than expected is
// seen at the next response, as at the end of a search.

#include <arcslip/observables/curve_section.hpp>
#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/observables/sensitivity.hpp>
#include <arcslip/optimize/nlopt/interrupted.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

enum class PeakKind { resonance, corner, lower_end, upper_end, kink };

/// "resonance" and so on.
const char* name(PeakKind kind);

struct Peak {
  PeakKind kind = PeakKind::resonance;
  continuation::Vector x;               // unknowns and omega (rad/s)
  std::optional<hbm::Corner> corner{};  // where it sits at one
  double amplitude = 0;                 // m
  continuation::Vector gradient{};      // dA/dp of the design parameters, m over their units
  continuation::Matrix along{};         // of a kink: dx/dp, by responses beside it; else empty
  double slope = 0;                     // of an end of the window: dA/domega, m s/rad
  std::optional<double> instant{};      // of which extreme: its angle; none: of the largest
  bool is_further = false;              // one of several extremes at one end of the window, not the first
  std::uint64_t piece = 0;              // of the equations of motion there; 0 at a corner, between two

  double omega() const { return x[x.size() - 1]; }
  /// Of an end of the window: the response rises inwards, so that there is a higher peak within.
  bool rises_inwards() const {
    return (kind == PeakKind::lower_end && slope > 0) || (kind == PeakKind::upper_end && slope < 0);
  }
};

/// Of the highest amplitude: limits on observables hold at peaks that are at least so high.
inline constexpr double watched_share = 0.75;

/// Of the highest amplitude: lower peaks are not watched. Kinks cannot be followed at all.
struct Watched {
  double peaks = watched_share, kinks = 0.9;
};

/// Where there are limits on observables. A peak is watched before it is as high as those at which they hold:
/// so they come in where they are not yet exceeded.
inline constexpr Watched watched_for_limits{0.6, watched_share};

/// The peaks at one design.
struct PeakState {
  std::vector<double> design;      // values of the parameters
  std::vector<Peak> peaks;         // those that are watched, in the order of the response
  std::size_t highest = 0;         // which of them
  bool unbounded = false;          // a resonance grows without bound: A_max is infinite
  bool complete = true;            // false: the response ends within the window; the peaks are those before
  bool traced = true;              // by a response; false: by following, and others may have come up
  std::string message;             // of an unbounded or incomplete response
  continuation::Vector upper_end;  // unknowns at the upper end of the window, where the response was traced

  /// A_max; infinity where it is unbounded, NaN where there is no response.
  double amplitude() const;
};

struct PeakWork {
  int responses = 0;        // traced
  int followed = 0;         // designs reached by following
  long factorizations = 0;  // of both
};

using continuation::Vector;
class Follower;

class PeakAmplitude {
 public:
  /// over: indices of parameters of the model. go_on: asked at each step of each response; where it says
  /// false at() and trace() throw Interrupted, and this is of no more use.
  PeakAmplitude(std::shared_ptr<const model::Model> model, std::vector<int> over,
                const observables::FrequencyWindow& window, observables::GoOn go_on = {},
                Watched watched = {});
  ~PeakAmplitude();

  /// At a design, by following the peaks of the last one. The reference holds until the next call.
  const PeakState& at(std::span<const double> design);

  /// At a design, by following alone. False where one of the peaks `needed` cannot be followed; the state is
  /// then as it was. Others that cannot be become kinks, and stay where they are.
  bool follow_to(std::span<const double> design, std::span<const std::size_t> needed);

  /// At a design, by a frequency response; with the steps of a curve by that which a study of it computes.
  const PeakState& trace(std::span<const double> design,
                         observables::Steps steps = observables::Steps::events);

  const PeakState& state() const { return state_; }
  const PeakWork& work() const { return work_; }
  const observables::FrequencyWindow& window() const { return window_; }

  /// All observables at a peak of the state.
  observables::ResponsePoint observe(const Peak& peak) { return observe(peak.x, state_.design); }

  /// All observables at the highest peak of a state that this had, and the problem of that time.
  observables::ResponsePoint observe(const PeakState& state,
                                     const std::shared_ptr<const hbm::HbmProblem>& problem) const;

  /// What is taken from the observables.
  using Observable = std::function<double(const observables::ResponsePoint&)>;

  /// Its derivative by design parameter k, as a peak of the state follows its equations: a central difference
  /// along the tangent. NaN where a kink is not in the responses beside it.
  double change(std::size_t peak, std::size_t k, const Observable& observable);

  /// d2A/dp_j dp_k of a peak of the state, symmetric (sensitivity.hpp). Empty at a kink, or where the
  /// equations of the peak are singular.
  continuation::Matrix hessian(std::size_t peak);

  /// dx/dp_k = d(u, omega)/dp_k of a peak of the state, a column for each design parameter. Empty as
  /// hessian().
  continuation::Matrix tangents(std::size_t peak);

  /// The model with a design's values.
  std::shared_ptr<const model::Model> model_at(std::span<const double> design) const;
  /// Of the last response, in its scale.
  const std::shared_ptr<const hbm::HbmProblem>& problem() const { return problem_; }
  /// All parameters at a design; the frequency is not set.
  continuation::Vector parameters(std::span<const double> design) const;

 private:
  observables::ResponsePoint observe(const continuation::Vector& x, std::span<const double> design);
  PeakState response(std::span<const double> design, observables::Steps steps);
  void classify(Peak& peak);
  bool measure(Peak& peak, std::span<const double> design);
  void differences(Peak& peak, observables::Steps steps);
  void add_extremes();
  void watch();
  Follower& follower(std::size_t peak);
  bool follow(std::size_t peak, std::span<const double> to, Peak& followed);
  bool holds(std::size_t peak, const continuation::Vector& x);
  bool came_up() const;

  struct LowerPeak {
    double amplitude;
    continuation::Vector gradient;
  };

  std::shared_ptr<const model::Model> model_;
  std::vector<int> over_;
  observables::FrequencyWindow window_;
  observables::GoOn go_on_;
  Watched watched_;
  PeakState state_;
  std::vector<double> traced_;    // the design of the last response
  std::vector<LowerPeak> lower_;  // the peaks there that are not watched
  PeakWork work_;
  std::shared_ptr<const hbm::HbmProblem> problem_;
  std::unique_ptr<observables::Sensitivity> sensitivity_;
  std::unique_ptr<observables::CurveSection> section_;
  std::vector<std::unique_ptr<Follower>> followers_;  // of the peaks, made when one is followed
};

}  // namespace arcslip::optimize
