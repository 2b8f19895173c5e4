#pragma once
// The agenda of a diagram: the half-branches that are known, each of which is traced once.
//
// A half-branch is a problem, a branch point x = (u, p) of it, and a direction away from x. It is added where
// a branch is met, visited in the order in which it was added, and counts as traced as soon as a branch
// begins on it or arrives on it. So a trace ends at the known branch points, and what lies beyond is not
// traced twice.
//
//   Agenda agenda(options);
//   agenda.points.push_back(agenda.met(problem, event));  // and whose half-branches are traced already
//   while (const auto way = agenda.next())
//     if (const auto entry = agenda.enter(*way, with, lower, upper))
//       branch = trace_until(problem, start_at(*entry, p, free), options, monitors, observer,
//                            [&](const Event& e) {
//                              return agenda.arrival(problem, e, with).has_value();
//                            });
//
// trace_diagram() is its use with one problem. Where the problem widens along a branch (widening.hpp), as
// where a period doubles, points of several problems are on one agenda.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/diagrams/diagram.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace arcslip::continuation {

/// A first solution on a half-branch.
struct Entry {
  Vector v, tangent;  // (u, p), and its derivative by the arclength, away from the branch point
  double step = 0;    // from it to the prediction of v
};

/// p: of which the free one is that of the entry.
Start start_at(const Entry& entry, Vector p, int free);

class Agenda {
 public:
  /// A half-branch: of points[point].half_branches.
  struct Place {
    std::size_t point = 0, half = 0;
  };
  /// Whether two problems have the same unknowns; without it, only one and the same has.
  using Alike = std::function<bool(const Problem&, const Problem&)>;

  explicit Agenda(const DiagramOptions& options, Alike alike = {});

  std::vector<Junction> points;

  HalfBranch& at(const Place& place) { return points[place.point].half_branches[place.half]; }

  /// A simple branch point of a trace, with its four half-branches, none traced: first those of the trace.
  static Junction met(const std::shared_ptr<const Problem>& problem, const Event& event);

  /// The point that a branch point of a trace is: there, and with the same branches, as two may lie closely
  /// together. points.size(): none.
  std::size_t index_of(const std::shared_ptr<const Problem>& problem, const Event& event,
                       const Corrector& in) const;

  /// The half-branch of a known point on which a trace arrives there.
  std::optional<Place> arrival(const std::shared_ptr<const Problem>& problem, const Event& event,
                               const Corrector& in) const;

  /// The half-branch of a point in a direction.
  std::optional<std::size_t> nearest(const Junction& junction, const Vector& direction,
                                     const Corrector& in) const;

  /// The angle to the nearest other half-branch, at most a right one, which a single one has.
  static double angle_to_others(const Junction& junction, const HalfBranch& half, const Corrector& in);

  /// The first solution on a half-branch, so near that no other is meant. Nothing: HalfBranch::untraced says
  /// why.
  std::optional<Entry> enter(const Place& place, Corrector& with, double lower, double upper);

  /// The next half-branch that no branch has, each once.
  std::optional<Place> next();

 private:
  bool is_at(const Junction& junction, const std::shared_ptr<const Problem>& problem, const Vector& x,
             const Corrector& in) const;

  DiagramOptions options_;
  Alike alike_;
  Place next_;
};

/// Traces until it ends, or until `arrives`, which is asked at each of its branch points as soon as it is
/// certain, says so.
Branch trace_until(const std::shared_ptr<const Problem>& problem, const Start& start, const Options& options,
                   std::vector<Monitor> monitors, Observer observer,
                   const std::function<bool(const Event&)>& arrives);

}  // namespace arcslip::continuation
