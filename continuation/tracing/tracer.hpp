#pragma once
// Traces a solution branch of F(u, p) = 0 by pseudo-arclength continuation (Keller 1977), with events.
//
//   Branch branch = trace(problem, {.u = u0, .p = p0, .free = 0}, {.lower = -1, .upper = 1},
//   {fold_monitor()});
//
// Each accepted point is linearized once. The factors give its tangent, serve its monitors, and correct the
// next point by chord steps as long as these contract.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/state.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace arcslip::continuation {

/// The end of the message of a stop where Newton's method hardly converges at a start without a tangent.
inline constexpr const char* needs_tangent =
    ": at a fold p does not determine the direction, and a start needs a tangent (Start::tangent); at a "
    "branch point start next to it";

/// A parameter of a problem by its index, or by its name.
class WhichParameter {
 public:
  WhichParameter(int index) : index_or_name_(index) {}
  WhichParameter(const char* name) : index_or_name_(std::string(name)) {}
  WhichParameter(std::string name) : index_or_name_(std::move(name)) {}

  /// Throws std::out_of_range for a name that there is none of, with those that there are. An index is
  /// returned as it is.
  int in(const Problem& problem) const {
    const auto* name = std::get_if<std::string>(&index_or_name_);
    return name ? parameter_index(problem, *name) : std::get<int>(index_or_name_);
  }

 private:
  std::variant<int, std::string> index_or_name_;
};

/// The start of a branch: an approximate solution u at the parameters p.
struct Start {
  Vector u;                 // n
  Vector p;                 // all parameters
  WhichParameter free = 0;  // the free one: its index, or its name
  int direction = 1;        // +1: towards larger values of the free parameter, -1: towards smaller ones
  Vector tangent{};  // n + 1, or none: the initial direction, in place of `direction`; the solution is then
                     // sought in the plane normal to it, and not at p[free]
  Vector state{};    // of a problem with a state, such as Branch::state; none: Problem::initial_state()
};

/// Called at each accepted point and, with the event, at each event, as soon as it is certain. Returns false
/// to stop. Exceptions are passed on by step() and trace().
using Observer = std::function<bool(const Accepted&, const Event*)>;

class Tracer {
 public:
  /// Throws std::invalid_argument for invalid options, sizes or start, std::out_of_range for a free parameter
  /// of an unknown name.
  Tracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
         std::vector<Monitor> monitors = {}, Observer observer = {});

  /// Resumes a saved trace of the same problem with the same options and monitors.
  Tracer(std::shared_ptr<const Problem> problem, State state, const Options& options,
         std::vector<Monitor> monitors = {}, Observer observer = {});

  /// A moved-from tracer may only be assigned to or destroyed.
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;
  ~Tracer();

  /// Adds a point (the first call corrects the start). False if the branch has ended: see branch().stop.
  bool step();

  /// The current state. Saving does not affect this trace.
  State save() const;

  const Branch& branch() const;
  Branch take();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Traces the branch until it ends.
Branch trace(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
             std::vector<Monitor> monitors = {}, Observer observer = {});

}  // namespace arcslip::continuation
