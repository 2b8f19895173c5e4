#pragma once
// The largest amplitude in a window of the excitation frequency, as a function of design parameters:
//
//   A_max(p) = max over the window of A(omega, p) = max over its peaks of A
//
// Its peaks are found from one frequency response and then tracked from design to design by continuation:
// tangent prediction and Newton's method on the equations of the peak, in as many steps as needed.
//
//   resonance   dA/ds = 0 along the response (continuation/special_points/stationary.hpp)
//   corner      onset of slip of an element (hbm/grazing_problem.hpp), with slopes of opposite sign on both
//   sides lower_end, upper_end   the response at the ends of the window; one for each of several extrema of
//   the
//                          motion nearly equally high there, since A has a kink where two are equal
//   kink        another kink, such as two equally high extrema of the motion
//
// The response is traced anew if a peak cannot be tracked, because it vanishes, splits, leaves the window or
// reaches a corner; at every design with a kink; if a parameter has changed by a factor of e since the last
// response; and if the slopes at the last response predict a new peak. Peaks below a share of the highest
// (MonitoredEvents) are not watched: an unexpected new peak is detected at the next response, such as that at
// the end of a search.

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/curves/sensitivity.hpp>
#include <arcslip/analyses/curves/special_point_observer.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/nlopt/interrupted.hpp>
#include <arcslip/results/response.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

enum class PeakKind { resonance, corner, lower_end, upper_end, kink };

/// "resonance" and so on.
const char* name(PeakKind kind);

/// The condition of such a peak. Of a kink that of a corner, which the truncation estimate flags where it is
/// none.
observables::PointCondition held_by(PeakKind kind);

struct Peak {
  PeakKind kind = PeakKind::resonance;
  continuation::Vector x;               // unknowns and omega (rad/s)
  std::optional<hbm::Corner> corner{};  // if it is one
  double amplitude = 0;                 // m
  continuation::Vector gradient{};      // dA/dp of the design parameters, m over their units
  continuation::Matrix along{};         // of a kink: dx/dp, from neighbouring responses; else empty
  double slope = 0;                     // of an end of the window: dA/domega, m s/rad
  std::optional<double> instant{};      // angle of the extremum; none: the largest
  bool is_further = false;              // not the first of several extrema at one end of the window
  std::uint64_t piece = 0;              // of the equations of motion there; 0 at a corner

  double omega() const { return x[x.size() - 1]; }
  /// For an end of the window: the response increases inwards, so that there is a higher peak inside.
  bool rises_inwards() const {
    return (kind == PeakKind::lower_end && slope > 0) || (kind == PeakKind::upper_end && slope < 0);
  }
};

/// Share of the highest amplitude above which limits on observables apply to a peak.
inline constexpr double watched_share = 0.75;

/// Share of the highest amplitude below which peaks are not watched. Kinks cannot be tracked at all.
struct MonitoredEvents {
  double peaks = watched_share, kinks = 0.9;
};

/// With limits on observables. A peak is watched before they apply to it, so that they enter before they
/// are exceeded.
inline constexpr MonitoredEvents watched_for_limits{0.6, watched_share};

/// The peaks at one design.
struct PeakState {
  std::vector<double> design;  // values of the parameters
  std::vector<Peak> peaks;     // the watched ones, in the order of the response
  std::size_t highest = 0;     // index of the highest
  bool unbounded = false;      // a resonance grows without bound: A_max is infinite
  bool complete = true;  // false: the response ends within the window, and the peaks are those up to there
  bool traced = true;    // by a response; false: by tracking, and new peaks may have appeared
  std::string message;   // of an unbounded or incomplete response
  continuation::Vector upper_end;  // unknowns at the upper end of the window, if the response was traced

  /// A_max; infinity if unbounded, NaN without a response.
  double amplitude() const;
};

struct PeakWork {
  int responses = 0;        // traced
  int followed = 0;         // designs reached by tracking
  long factorizations = 0;  // of both
};

using continuation::Vector;
class PeakFollower;

class PeakAmplitude {
 public:
  /// over: indices of parameters of the model. control: asked at each step of each response, and within
  /// evaluations that take long (Model::control); at its end at() and trace() throw Interrupted, and
  /// this object must not be used any more, except to observe an earlier state.
  PeakAmplitude(std::shared_ptr<const model::Model> model, std::vector<int> over,
                const observables::FrequencyWindow& window, control::Control control = {},
                MonitoredEvents watched = {});
  ~PeakAmplitude();

  /// The peaks at a design, by tracking those of the last one. The reference is valid until the next call.
  const PeakState& at(std::span<const double> design);

  /// The peaks at a design, by tracking only. False if one of the peaks `needed` cannot be tracked; the state
  /// is then unchanged. Others that cannot be tracked become kinks, and stay where they are.
  bool follow_to(std::span<const double> design, std::span<const std::size_t> needed);

  /// The peaks at a design, by a frequency response; Steps::curve: with the steps of a study.
  const PeakState& trace(std::span<const double> design,
                         observables::Steps steps = observables::Steps::events);

  /// Of the same model over another window.
  PeakAmplitude over_window(const observables::FrequencyWindow& window) const {
    return {model_, over_, window, control_, watched_};
  }

  const PeakState& state() const { return state_; }
  const PeakWork& work() const { return work_; }
  const observables::FrequencyWindow& window() const { return window_; }

  /// What is asked for at a peak of the state.
  observables::ResponsePoint observe(const Peak& peak,
                                     const observables::Observed& asked = observables::everything) {
    return observe(peak.x, peak.kind, state_.design, asked);
  }

  /// All observables at the highest peak of an earlier state, with its problem.
  observables::ResponsePoint observe(const PeakState& state,
                                     const std::shared_ptr<const hbm::HbmProblem>& problem) const;

  /// A function of the observables.
  using Observable = std::function<double(const observables::ResponsePoint&)>;

  /// Its derivative with respect to design parameter k at a peak of the state: a central difference along the
  /// tangent. NaN if a kink is missing in the neighbouring responses. read: what it takes.
  double change(std::size_t peak, std::size_t k, const Observable& observable,
                const observables::Observed& read = observables::everything);

  /// d2A/dp_j dp_k of a peak of the state, symmetric (sensitivity.hpp). Empty at a kink, or if the equations
  /// of the peak are singular.
  continuation::Matrix hessian(std::size_t peak);

  /// dx/dp_k = d(u, omega)/dp_k of a peak of the state, one column for each design parameter. Empty
  /// like hessian().
  continuation::Matrix tangents(std::size_t peak);

  /// The model at a design.
  std::shared_ptr<const model::Model> model_at(std::span<const double> design) const;
  /// The problem of the last response, in its scale.
  const std::shared_ptr<const hbm::HbmProblem>& problem() const { return problem_; }
  /// All parameters at a design; the frequency is not set.
  continuation::Vector parameters(std::span<const double> design) const;

 private:
  observables::ResponsePoint observe(const continuation::Vector& x, PeakKind kind,
                                     std::span<const double> design, const observables::Observed& asked);
  PeakState response(std::span<const double> design, observables::Steps steps);
  void classify(Peak& peak);
  bool measure(Peak& peak, std::span<const double> design);
  void differences(Peak& peak, observables::Steps steps);
  void add_extremes();
  void watch();
  PeakFollower& follower(std::size_t peak);
  bool follow(std::size_t peak, std::span<const double> to, Peak& followed);
  /// Takes the tracked peaks of a design as its state.
  void move_to(std::span<const double> design, std::vector<Peak>&& tracked);
  bool holds(std::size_t peak, const continuation::Vector& x);
  bool new_peak_expected() const;

  struct LowerPeak {
    double amplitude;
    continuation::Vector gradient;
  };

  /// While one is there, evaluations that take long are given up after a stop: at() and trace() then throw.
  /// Without one they are not, so that the best design is observed after a stop as well.
  class Stoppable {
   public:
    explicit Stoppable(const PeakAmplitude& peaks) : on_(peaks.stoppable_), before_(on_->exchange(true)) {}
    Stoppable(const Stoppable&) = delete;
    Stoppable& operator=(const Stoppable&) = delete;
    ~Stoppable() { *on_ = before_; }

   private:
    std::shared_ptr<std::atomic<bool>> on_;
    bool before_;
  };

  const std::shared_ptr<std::atomic<bool>> stoppable_ =
      std::make_shared<std::atomic<bool>>(false);  // shared with the control of the model
  std::shared_ptr<const model::Model> model_;
  std::vector<int> over_;
  observables::FrequencyWindow window_;
  control::Control control_;
  MonitoredEvents watched_;
  PeakState state_;
  std::vector<double> traced_;    // the design of the last response
  std::vector<LowerPeak> lower_;  // the unwatched peaks there
  PeakWork work_;
  std::shared_ptr<const hbm::HbmProblem> problem_;
  std::unique_ptr<observables::Sensitivity> sensitivity_;
  std::unique_ptr<observables::CurveSection> section_;
  std::vector<std::unique_ptr<PeakFollower>> followers_;  // of the peaks, created when one is tracked
};

}  // namespace arcslip::optimize
