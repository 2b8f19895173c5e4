#pragma once
// Traces a solution branch of F(u, p) = 0 by pseudo-arclength continuation (Keller 1977), with events.
//
//   Branch branch = trace(problem, {.u = u0, .p = p0, .free = 0}, {.lower = -1, .upper = 1},
//   {fold_monitor()});
//
// Each accepted point is linearized once. Those factors give its tangent, serve its monitors, and correct the
// next point by chord steps while these contract.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace arcslip::continuation {

/// Where a branch begins: u need only be near a solution at the parameters p.
struct Start {
  Vector u;           // n
  Vector p;           // all parameters
  int free = 0;       // index of the free one
  int direction = 1;  // +1: towards larger values of the free parameter, -1: smaller; no other number
  Vector tangent{};   // n + 1, or none: the way to go, in place of `direction`; the solution is then sought
                      // across it, and not at p[free]
};

/// Called at each accepted point and, with the event, at each event, as soon as it is certain. Returns false
/// to stop. What it throws is thrown on, by step() and trace().
using Observer = std::function<bool(const Accepted&, const Event*)>;

class Tracer {
 public:
  /// Throws std::invalid_argument where options, sizes or the start do not fit.
  Tracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
         std::vector<Monitor> monitors = {}, Observer observer = {});

  /// Goes on from where a trace of the same problem with the same options and monitors was saved.
  Tracer(std::shared_ptr<const Problem> problem, State state, const Options& options,
         std::vector<Monitor> monitors = {}, Observer observer = {});

  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;
  ~Tracer();

  /// One more point (the first call corrects the start). False once the branch has ended: see branch().stop.
  bool step();

  /// Where the trace stands. This one goes on as if it had not been saved.
  State save() const;

  const Branch& branch() const;
  Branch take();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Steps until the branch ends.
Branch trace(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
             std::vector<Monitor> monitors = {}, Observer observer = {});

}  // namespace arcslip::continuation
