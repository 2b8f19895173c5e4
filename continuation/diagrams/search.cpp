// Branches of a diagram that cross no other, from solutions that are found by deflation.

#include <arcslip/continuation/diagrams/branch_parts.hpp>
#include <arcslip/continuation/diagrams/deflation.hpp>
#include <arcslip/continuation/diagrams/diagram_tracer.hpp>

#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace arcslip::continuation {

// What the branches have at a value of the free parameter, but for folds between two points.
std::vector<Vector> DiagramTracer::solutions_at(double at) {
  std::vector<Vector> all;
  const Eigen::Index n = problem_->size();
  const Vector row = with_->border_row(Vector::Unit(n + 1, n) * with_->parameter_scale());
  for (const DiagramBranch& each : diagram_.branches) {
    const auto& points = each.branch.points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double a = points[i].parameter - at, b = points[i + 1].parameter - at;
      if (a * b > 0 || a == b) continue;
      Vector v = joined(points[i].u + a / (a - b) * (points[i + 1].u - points[i].u), at);
      with_->correct(v, row, false);
      if (v.allFinite()) all.push_back(v.head(n));
    }
  }
  return all;
}

void DiagramTracer::search(double at) {
  Start start = start_;
  start.p[free_] = at;
  start.tangent.resize(0);
  const Eigen::Index n = problem_->size();
  const Vector row = with_->border_row(Vector::Unit(n + 1, n) * with_->parameter_scale());
  DeflationOptions deflation;
  deflation.solutions = 1;
  deflation.linear_solver = options_.linear_solver;
  deflation.control = options_.control;
  std::vector<Vector> tried;
  while (!stopped_ && options_.control.keep_going()) {
    std::vector<Vector> known = solutions_at(at);
    known.insert(known.end(), tried.begin(), tried.end());
    const std::vector<Vector> found =
        deflate(*problem_, start.p, known, known.empty() ? std::vector{start_.u} : known, deflation);
    if (found.empty()) break;
    tried.push_back(found.front());
    Entry entry{joined(found.front(), at), Vector(n + 1),
                limits_.entry.longest * (1 + with_->norm_u(joined(found.front(), at)))};
    if (with_->correct(entry.v, row, false).converged && with_->tangent(entry.tangent) &&
        known_branch(entry, std::numbers::pi / 2) >= 0)
      continue;  // between two points around a fold
    if (static_cast<int>(diagram_.branches.size()) >= limits_.branches) {
      incomplete("reached the maximum number of branches, " + std::to_string(limits_.branches));
      return;
    }
    start.u = found.front();
    if (add_branch_through(start) < 0) {
      std::ostringstream text;
      text << "a solution that was found at " << at << " could not be followed";
      incomplete(text.str());
    }
    follow_half_branches();
  }
  if (!options_.control.keep_going()) incomplete("stopped by the caller");
}

}  // namespace arcslip::continuation
