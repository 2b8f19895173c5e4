#pragma once
// Diagrams of one unknown, and what holds of every diagram.

#include <arcslip/continuation/diagrams/diagram.hpp>

#include "catch.hpp"

#include "continuation/problems.hpp"

namespace problems {

// One equation F(u, lambda) = 0, with dF/du and dF/dlambda.
using Scalar = double (*)(double u, double lambda);
inline std::shared_ptr<const Problem> scalar(Scalar F, Scalar F_u, Scalar F_lambda) {
  return from_functions({.size = 1,
                         .parameters = {parameter("lambda", 0)},
                         .residual = [=](In u, In p, Out out) { out[0] = F(u[0], p[0]); },
                         .jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = F_u(u[0], p[0]); },
                         .derivative = [=](In u, In p, int, Out out) { out[0] = F_lambda(u[0], p[0]); }});
}

inline std::shared_ptr<const Problem> pitchfork() {
  return scalar([](double u, double l) { return l * u - u * u * u; },
                [](double u, double l) { return l - 3 * u * u; }, [](double u, double) { return u; });
}

// The largest |g(u, lambda)| of the points of a branch.
template <class G>
double largest(const Branch& branch, const G& g) {
  double result = 0;
  for (const Point& point : branch.points)
    result = std::max(result, std::abs(g(point.u[0], point.parameter)));
  return result;
}

// What holds of every diagram: points in the order of arclength, without gaps, tangents that lead on; events
// between their points; half-branches that name their branches.
inline void check_order(const Diagram& diagram) {
  for (const DiagramBranch& each : diagram.branches) {
    const auto& points = each.branch.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      REQUIRE(points[i].arclength > points[i - 1].arclength);
      Vector way(points[i].u.size() + 1);
      way << points[i].u - points[i - 1].u, points[i].parameter - points[i - 1].parameter;
      REQUIRE(way.dot(points[i - 1].tangent) > 0);
      REQUIRE(way.dot(points[i].tangent) > 0);
    }
    for (const Event& event : each.branch.events) {
      REQUIRE(event.point.arclength >= points[event.after].arclength);
      if (const auto* crossing = std::get_if<BranchPoint>(&event.data)) {
        const std::size_t i = std::min(event.after, points.size() - 2);
        Vector way(points[i].u.size() + 1);
        way << points[i + 1].u - points[i].u, points[i + 1].parameter - points[i].parameter;
        REQUIRE(way.dot(event.point.tangent) > 0);
        REQUIRE(way.dot(crossing->tangents[0]) > 0);
      }
      if (event.after + 1 < points.size())
        REQUIRE(event.point.arclength <= points[event.after + 1].arclength);
    }
  }
  for (const Junction& junction : diagram.branch_points) {
    const auto& parent = diagram.branches[static_cast<std::size_t>(junction.branch)];
    const Event& event = parent.branch.events[static_cast<std::size_t>(junction.event)];
    REQUIRE((event.point.u - junction.u).norm() < 1e-9);
    REQUIRE(parent.depth == junction.depth);
  }
}

inline bool all_traced(const Junction& junction) {
  return std::all_of(junction.half_branches.begin(), junction.half_branches.end(),
                     [](const HalfBranch& half) { return half.branch >= 0; });
}

}  // namespace problems
