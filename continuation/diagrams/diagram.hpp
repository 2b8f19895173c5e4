#pragma once
// A bifurcation diagram of F(u, p) = 0 in one free parameter: the branch through a start, the branches that
// cross it, those that cross these, and so on to a wanted depth.
//
//   Diagram diagram = trace_diagram(rod, {.u = u0, .p = p0}, {.lower = 0, .upper = 100}, {.depth = 1});
//   for (const DiagramBranch& each : diagram.branches) plot(each.branch.points);
//
// From a simple branch point four half-branches leave, along +-t_1 and +-t_2 (branch_point.hpp). Each is
// entered at x + h t, corrected across t, with h so small that the correction is a small part of the distance
// to the other branch. A trace that comes to a branch point on one half-branch leaves it on the opposite one:
// both have then been traced. So a branch that meets others in several places, or itself, is there once.

#include <arcslip/continuation/tracing/tracer.hpp>

#include <memory>
#include <string>
#include <vector>

namespace arcslip::continuation {

struct DiagramOptions {
  int depth = 1;             // the first branch has depth 0, those that cross it 1, ...
  int branches = 100;        // at most
  double same_place = 1e-6;  // distance of branch points that are one, in scales, relative to 1 + |u|
};

/// One way to leave a branch point.
struct HalfBranch {
  Vector direction;      // n + 1, |.| = 1 in scales, away from the branch point
  int branch = -1;       // index of the branch that it is part of; -1: none
  std::string untraced;  // why there is none
};

/// A place where branches cross, as it was first met, with two half-branches of each: four at simple ones.
/// Where pieces of F meet, those beside the branch traced are looked for, and followed if there are two. Of
/// others, only the half-branches of the branch traced are known.
struct Junction {
  Vector u;  // n
  double parameter = 0;
  int depth = 0;                // of the branch that met it
  int branch = -1, event = -1;  // that branch, and the event on it
  std::vector<HalfBranch> half_branches;
};

/// A branch through its origin in both directions, as one: arclength is 0 at the origin and negative
/// backward, where the tangents of the trace are turned. The origin is the start of the diagram or a branch
/// point, which is then a point and an event of the branch (of a loop, the last one). A monitor's `falling`
/// and `rising` refer to the direction of the trace, away from the origin.
struct DiagramBranch {
  Branch branch;  // branch.stop: how it ended forward; closed: a loop, from its origin to it
  Stop begin;     // how it ended backward; where there is no way backward, as `stop`
  int depth = 0;
  int origin = -1;  // index of the branch point; -1: the start
};

struct Diagram {
  std::vector<DiagramBranch> branches;
  std::vector<Junction> branch_points;
  bool complete = true;  // every half-branch of the branch points found within the depth was followed, and
                         // the modes that passed zero on the way are those of these branch points
  std::string message;   // what is missing, and why
};

/// `start.direction` is that of the first branch. branch_point_monitor() is added to the monitors where it
/// is missing. Throws std::invalid_argument as Tracer, and where points are not to be kept. The observer sees
/// every trace; where it says stop, the diagram ends.
Diagram trace_diagram(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                      const DiagramOptions& diagram = {}, std::vector<Monitor> monitors = {},
                      Observer observer = {});

}  // namespace arcslip::continuation
