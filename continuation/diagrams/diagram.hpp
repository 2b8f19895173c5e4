#pragma once
// A bifurcation diagram of F(u, p) = 0 in one free parameter: the branch through a start, the branches that
// cross it, those that cross these, and so on to a given depth.
//
//   Diagram diagram = trace_diagram(rod, {.u = u0, .p = p0}, {.lower = 0, .upper = 100}, {.depth = 1});
//   for (const DiagramBranch& each : diagram.branches) plot(each.branch.points);
//
// Four half-branches leave a simple branch point, along +-t_1 and +-t_2 (branch_point.hpp). Each is entered
// at x + h t, corrected normal to t, with h so small that the correction is a small part of the distance to
// the other branch. A trace that reaches a branch point on one half-branch leaves it on the opposite one, and
// both count as traced. So a branch that meets others, or itself, at several points is traced once.
//
// Branches that cross none of these are looked for by deflation (deflation.hpp) where
// DiagramOptions::searches asks for it: from the solutions that the branches have at a parameter, and again
// with each one that is found, until there is no other.

#include <arcslip/continuation/tracing/tracer.hpp>

#include <memory>
#include <string>
#include <vector>

namespace arcslip::continuation {

/// The first solution on a half-branch is sought at x + h t, normal to t, first with the longest h, then with
/// shorter ones, until it is certain that no other half-branch is meant.
struct EntryOptions {
  double longest = 1e-3;    // h, relative to 1 + |u|, in scales: well above what branch points are located to
  double shortest = 1e-6;   // below, corrections are no longer large next to the tolerance of Newton's method
  double reduction = 0.25;  // of h from one attempt to the next: five of them
  double error = 0.25;      // of the distance from x + h t to the nearest other half-branch: the largest
                            // correction. What is nearer to t than to the other, with as much again to spare
  double turn = 0.3;        // of the angle to it: the largest turn of the tangent, for the same reason
};

/// Whether a solution lies on a branch that is known: between two of its points, on their cubic.
struct NearbyOptions {
  double segment =
      0.05;  // of a segment: beyond its ends, and off its cubic, from where its solution is sought
  double same_point =
      1e-2;  // of h: solutions that are closer are one. They agree to rounding, or are h apart
};

struct DiagramOptions {
  int depth = 1;             // maximum; the first branch has depth 0, those that cross it 1, ...
  int branches = 100;        // maximum
  double same_place = 1e-6;  // closer branch points are the same, in scales, relative to 1 + |u|: some
                             // hundred times what they are located to
  double same_direction =
      0.95;  // cosine of the angle (18 degrees) up to which half-branches of one point are
             // one. Wide, since tangents at arrival are less accurate where branches cross flat
  EntryOptions entry{};
  NearbyOptions nearby{};
  std::vector<double>
      searches{};          // values of the free parameter at which other branches are looked for; each
                           // takes some hundred iterations of Newton's method for every solution there
  int oblique_probes = 8;  // where pieces meet: directions in which they are searched for, besides the
                           // tangents and the parameter, each with two linearizations
};

/// Throws std::invalid_argument, with the value and its bound, for an option that is not valid.
void check(const DiagramOptions& options);

/// One way to leave a branch point.
struct HalfBranch {
  Vector direction;      // n + 1, |.| = 1 in scales, away from the branch point
  int branch = -1;       // index of the branch it belongs to; -1: not traced
  std::string untraced;  // why it was not traced
};

/// A branch point as first met, with two half-branches of each branch: four at a simple one. Where pieces of
/// F meet, the half-branches next to the branch traced are searched for, and traced if there are two. Of
/// others, only the half-branches of the branch traced are known.
struct Junction {
  std::shared_ptr<const Problem> problem;  // of which it is a solution
  Vector u;                                // n
  double parameter = 0;
  int depth = 0;                // of the branch that met it
  int branch = -1, event = -1;  // that branch, and the event on it
  std::vector<HalfBranch> half_branches{};
  bool images = false;  // the opposite of the only half-branch is its image by a symmetry, so that branches
                        // arrive on it from both sides: where a problem widens (widening.hpp)
};

/// A branch through its origin, traced in both directions and joined: arclength is 0 at the origin and
/// negative backward, where the tangents of the trace are reversed. The origin is the start of the diagram or
/// a branch point, which is then also a point and an event of the branch (of a loop, the last one). The
/// `falling` and `rising` of a monitor refer to the direction of the trace, away from the origin.
struct DiagramBranch {
  Branch branch;     // branch.stop: how it ended forward; closed: a loop, from its origin to it
  BranchStop begin;  // how it ended backward; equal to `stop` if it was not traced backward
  int depth = 0;
  int origin = -1;  // index of the branch point; -1: the start, or a solution that was found by a search
  std::vector<StabilityRange> stability{};  // ranges of its points, with Options::stability
};

struct Diagram {
  std::vector<DiagramBranch> branches;
  std::vector<Junction> branch_points;
  bool complete = true;  // every half-branch of the branch points found within the depth was traced, and
                         // these branch points account for all modes that crossed zero
  std::string message;   // what is missing, and why
};

/// start.direction: of the first branch. branch_point_monitor() is added to the monitors if missing. The
/// observer sees every trace; if it returns false, the diagram ends. Throws std::invalid_argument as Tracer
/// does, and for options without keep_points.
Diagram trace_diagram(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                      const DiagramOptions& diagram = {}, std::vector<Monitor> monitors = {},
                      Observer observer = {});

/// A branch through its start, in both directions. No branch points are looked for but those that are
/// monitored.
struct WholeBranch {
  Branch branch;     // in the start's direction; arclength is 0 at the start and negative before it
  BranchStop begin;  // how it ended backward; equal to branch.stop if it is closed, or the start failed
};

/// Options and observer serve each trace; the observer sees the way forward first, and if it returns false,
/// the way backward is not traced. Tangents before the start are reversed, so that they go with the branch;
/// `falling` and `rising` of a monitor refer to the direction away from the start. Throws as Tracer does.
WholeBranch trace_both(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                       std::vector<Monitor> monitors = {}, Observer observer = {});

}  // namespace arcslip::continuation
