#pragma once
// Traces a solution branch of F(u, p) = 0 by pseudo-arclength continuation (Keller 1977), with events.
//
//   Branch branch = trace(problem, {.u = u0, .p = p0, .free = 0}, {.lower = -1, .upper = 1},
//   {fold_monitor()});
//
// Each accepted point is linearized once. Those factors give its tangent, serve its monitors, and correct the
// next point by chord steps while these contract.

#include <arcslip/continuation/branch.hpp>
#include <arcslip/continuation/corrector.hpp>
#include <arcslip/continuation/event_locator.hpp>
#include <arcslip/continuation/monitor.hpp>
#include <arcslip/continuation/options.hpp>
#include <arcslip/continuation/place.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace arcslip::continuation {

/// Where a branch begins: u need only be near a solution at the parameters p.
struct Start {
  Vector u;           // n
  Vector p;           // all parameters
  int free = 0;       // index of the free one
  int direction = 1;  // +1: towards larger values of the free parameter, -1: smaller
};

/// Called at each accepted point and, with the event, at each event, as soon as it is certain. Returns false
/// to stop.
using Observer = std::function<bool(const Accepted&, const Event*)>;

class Tracer {
 public:
  /// Throws std::invalid_argument where options, sizes or the start do not fit.
  Tracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
         std::vector<Monitor> monitors = {}, Observer observer = {});

  /// One more point (the first call corrects the start). False once the branch has ended: see branch().stop.
  bool step();

  const Branch& branch() const { return branch_; }
  Branch take() { return std::move(branch_); }

 private:
  enum class Attempt { accepted, rejected, unresolved, ended };

  bool begin();
  Attempt attempt();
  bool corner();
  struct Corner {  // both sides of a kink within the step
    Place before, beyond;
  };
  bool look_beside(const Place& kink, const Vector& tangent, double way, Place& side);
  Attempt take(double length, double next_ds, bool kink, const Correction& correction,
               const Corner* corner = nullptr);
  void predict(Vector& v) const;
  bool went_back(const Place& next) const;
  void measure(Place& place);
  bool resolved(const Place& from, const Place& to, double length);
  bool is_kink(double turn, const Place& next);
  bool accept(Place&& place, const Correction& correction, const Corner* corner = nullptr);
  bool report(std::vector<LocatedEvent>&& found);
  const Event* add(Event&& event);
  bool notify();
  double choose_step(double angle, const Correction& correction) const;
  double limited(double ds) const;
  bool to_boundary(Place& place, double bound);
  bool end(StopReason reason, double value, double limit, std::string message);

  std::shared_ptr<const Problem> problem_;
  Options options_;
  Observer observer_;
  Branch branch_;
  int n_, free_, direction_;
  Corrector main_;
  EventLocator events_;
  Place here_, next_, before_;
  bool has_before_ = false, factors_fit_ = false, ended_ = false, begun_ = false;
  bool evaluated_ = true;  // the last rejection came from the corrector, not from the problem
  double ds_ = 0, last_ds_ = 0;
  int rejections_ = 0;  // since here_.arclength passed trouble_end_
  double trouble_end_ = -1;
  double unresolved_end_ = -1, unresolved_step_ = 0;  // a stretch whose slopes did not tell its quantities
  struct Turn {  // a turn of the tangent that was rejected: how much, over which step, and where it is passed
    double angle = 0, step = 0, end = -1;
  } turn_;
  Vector row_, v_;
};

/// Steps until the branch ends.
Branch trace(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
             std::vector<Monitor> monitors = {}, Observer observer = {});

}  // namespace arcslip::continuation
