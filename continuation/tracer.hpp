#pragma once
// Traces a solution branch of F(u, p) = 0 by pseudo-arclength continuation (Keller 1977), with events.
//
//   Branch branch = trace(problem, {.u = u0, .p = p0, .free = 0}, {.lower = -1, .upper = 1},
//   {fold_monitor()});
//
// Each accepted point is linearized once. The factors give its tangent, serve its monitors, and correct the
// next point by chord steps as long as these contract.

#include <arcslip/continuation/branch.hpp>
#include <arcslip/continuation/corrector.hpp>
#include <arcslip/continuation/crossed_modes.hpp>
#include <arcslip/continuation/ends.hpp>
#include <arcslip/continuation/event_locator.hpp>
#include <arcslip/continuation/monitor.hpp>
#include <arcslip/continuation/options.hpp>
#include <arcslip/continuation/state.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace arcslip::continuation {

/// The start of a branch: an approximate solution u at the parameters p.
struct Start {
  Vector u;           // n
  Vector p;           // all parameters
  int free = 0;       // index of the free one
  int direction = 1;  // +1: towards larger values of the free parameter, -1: towards smaller ones
  Vector tangent{};   // n + 1, or none: the initial direction, in place of `direction`; the solution is then
                      // sought in the plane normal to it, and not at p[free]
};

/// Called at each accepted point and, with the event, at each event, as soon as it is certain. Returns false
/// to stop. Exceptions are passed on by step() and trace().
using Observer = std::function<bool(const Accepted&, const Event*)>;

class Tracer {
 public:
  /// Throws std::invalid_argument for invalid options, sizes or start.
  Tracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
         std::vector<Monitor> monitors = {}, Observer observer = {});

  /// Resumes a saved trace of the same problem with the same options and monitors.
  Tracer(std::shared_ptr<const Problem> problem, State state, const Options& options,
         std::vector<Monitor> monitors = {}, Observer observer = {});

  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Adds a point (the first call corrects the start). False if the branch has ended: see branch().stop.
  bool step();

  /// The current state. Saving does not affect this trace.
  State save() const;

  const Branch& branch() const { return s_.branch; }
  Branch take() { return std::move(s_.branch); }

 private:
  enum class Attempt { accepted, rejected, unresolved, ended };

  void make_tools();
  bool begin();
  std::string singular_start(bool has_tangent) const;
  Attempt refuse(Rejected why, double value, double limit, Attempt as = Attempt::rejected);
  void log_rejection();
  void suspect(const Vector& v);
  void look_at_jacobian(const Vector& v);
  std::string doubt(const Vector& v);
  bool gets_on() const;
  static bool is_due(long times);
  // A turn of which this share remains in a step shortened by this factor is a kink.
  static constexpr double kink_step = 0.25;

  Attempt attempt();
  bool corner();
  bool step_beyond_corner();
  const Place& last_section() const { return corners_.empty() ? s_.here : corners_.back().beyond; }
  Attempt take(double length, double next_ds, bool kink, const Correction& correction);
  std::optional<Exit> exit(bool kink);
  void predict(Vector& v) const;
  bool went_back(const Place& next) const;
  std::optional<Attempt> look_for_crossing(double length);
  bool measure(Place& place);
  void divide();
  bool stretch_is_short(double share) const;
  void begin_stretch(double length);
  bool resolved(double length);
  bool tells(const Place& from, const Place& to, double length);
  double chord_departure(const Place& from, const Place& to, std::size_t m, double length) const;
  bool is_kink(double turn, const Place& next);
  bool accept(Place&& place, const Correction& correction);
  bool pass(const Place& from, const Corner& corner);
  std::optional<LocatedEvent> unlocated_branch_point(const Place& from, const Place& to) const;
  std::vector<LocatedEvent> with_crossing(std::vector<LocatedEvent>&& found);
  bool report(std::vector<LocatedEvent>&& found);
  void warn_of_undefined(const Place& place);
  const Event* add(Event&& event);
  void keep(const Place& place, const Correction& correction);
  bool end_at(const Place& place);
  bool notify();
  bool within_limits();
  bool runs_along(double bound) const;
  void end_in_tail(double bound);
  double curve_error();
  double curve_error(const Place& from, const Place& to);
  bool hides_a_piece(double length);
  double unresolved_factor() const;
  double error_growth() const;
  double choose_step(double angle, const Correction& correction) const;
  double largest_parameter_step() const;
  double limited(double ds) const;
  bool end(StopReason reason, double value, double limit, std::string message);

  std::shared_ptr<const Problem> problem_;
  Options options_;
  std::vector<Monitor> monitors_;
  Observer observer_;
  State s_;
  int n_;
  std::unique_ptr<Corrector> main_;
  std::unique_ptr<EventLocator> events_;
  std::unique_ptr<ModeCounter> modes_;  // if branch points are monitored
  Place next_;
  Rejection rejection_;               // the last one
  std::size_t unresolved_ = 0;        // the monitor of the unresolved quantity
  bool evaluated_ = true;             // the last rejection came from the corrector, not from the problem
  double curve_error_ = 0;            // of the curve along the last step, relative to its tolerance
  bool other_piece_between_ = false;  // within the last step, unnoticed by its sections
  double chord_error_ = 0;       // of the monitored quantities in the last step, relative to the tolerance
  std::vector<Corner> corners_;  // in the attempted step, in order
  std::optional<Place> terminal_;
  std::optional<LocatedEvent> crossing_;  // the branch point in the attempted step
  std::string failure_;                   // of the last rejection
  Vector row_;
  mutable Vector v_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// Traces the branch until it ends.
Branch trace(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
             std::vector<Monitor> monitors = {}, Observer observer = {});

}  // namespace arcslip::continuation
