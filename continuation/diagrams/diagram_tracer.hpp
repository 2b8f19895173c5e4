#pragma once
// Construction of a diagram: the branches to trace, and the branch points with their half-branches.

#include <arcslip/continuation/diagrams/agenda.hpp>
#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/tracing/start.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::continuation {

/// How a branch reaches a branch point: on a new half-branch, on one traced before, or on the opposite of the
/// one on which it left.
enum class Arrival { first, repeated, home };

/// See trace_diagram().
class DiagramTracer {
 public:
  DiagramTracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                const DiagramOptions& limits, std::vector<Monitor> monitors, Observer observer)
      : free_(start.free.in(*problem)),
        problem_(scaled_to_window(std::move(problem), free_, options.lower, options.upper)),
        start_(start),
        options_(options),
        limits_(limits),
        monitors_(std::move(monitors)),
        observer_(std::move(observer)),
        agenda_(limits) {
    const bool has_monitor = std::any_of(monitors_.begin(), monitors_.end(), [](const Monitor& monitor) {
      return monitor.kind == MonitorKind::branch_point;
    });
    if (!has_monitor) monitors_.push_back(branch_point_monitor());
  }

  Diagram run();

 private:
  // Where a branch begins: at the start of the diagram, or on a half-branch of a branch point.
  struct Beginning {
    Start start;
    double step = 0;
    std::optional<std::size_t> origin{};  // index of the branch point
  };

  int add_branch_through(const Start& start);
  void follow_half_branches();
  void search(double at);
  std::vector<Vector> solutions_at(double at);
  void leave(const Agenda::Place& place);
  bool may_trace(const Junction& junction, HalfBranch& half);
  double way_from(const Junction& origin, const Branch& branch) const;
  Event as_event_of(const Junction& origin, const Vector& direction) const;
  Branch follow(const Beginning& from, int branch, int depth);
  Arrival pass(const Event& event, const Beginning& from, int branch, int depth);
  std::size_t meet(const Event& event, int depth);
  void look_for_others(Junction& junction, const Vector& x, const BranchPoint& known);
  std::optional<Beginning> enter(const Agenda::Place& place);
  int known_branch(const Entry& entry, double angle);
  std::size_t half_towards(Junction& junction, const Vector& direction);
  void name_events(int branch);
  void incomplete(const std::string& why);

  int free_;  // index of the free parameter
  std::shared_ptr<const Problem> problem_;
  Start start_;
  Options options_;
  DiagramOptions limits_;
  std::vector<Monitor> monitors_;
  Observer observer_;
  Agenda agenda_;
  Diagram diagram_;  // without its branch points, until it is complete
  Counts counts_;    // of entries
  std::unique_ptr<Corrector> with_;
  bool stopped_ = false;
};

}  // namespace arcslip::continuation
