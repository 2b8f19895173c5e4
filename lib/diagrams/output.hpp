#pragma once
// Branches and diagrams of the engine as results, which the writers of JSON and CSV take, and as figures.
//
//   const auto columns = diagrams::columns_of(*problem, 0, {"w", "v"});
//   const auto results = diagrams::results_of(diagram, columns);
//   results::write_json(json, results);
//   results::write_csv(csv, results, "points");  // or "events", "stability", "half_branches"
//   output::draw_figures(diagrams::figure_data_of(diagram, columns), "folder", "truss");
//
// In the figures the parts of a branch with unstable eigenvalues are dashed, and special points have their
// names next to them. A part begins and ends at the event at which its stability changes, if it is monitored.

#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/result.hpp>

#include <functional>
#include <string>
#include <vector>

namespace arcslip::diagrams {

/// A number of every point and event, as an unknown or a norm.
struct Quantity {
  std::string name;    // "w": a column of tables, and the axis of a figure of this name
  std::string unit{};  // "m"; empty: none
  std::function<double(const continuation::Point&)> value;
};

/// What the columns are, besides what every branch has.
struct Columns {
  std::string title{};               // of the results and figures
  std::string parameter = "p";       // the free one
  std::string parameter_unit{};      // empty: none
  std::vector<Quantity> quantities;  // each with a figure over the parameter
};

/// The most unknowns that have columns of their own without being named.
inline constexpr int most_unknowns = 12;

/// The free parameter and the unknowns of a problem, u_1 to u_n where they have no names. Of more than
/// most_unknowns without names their Euclidean norm, "norm". Throws std::invalid_argument for an index that
/// is no parameter, or for another number of names.
Columns columns_of(const continuation::Problem& problem, int free, std::vector<std::string> names = {});

/// A list "branches", of format "arcslip-diagram-1", of results with tables "points", "events" and
/// "stability", and of a diagram a list "branch_points" with tables "half_branches". docs/continuation.md
/// lists their columns. Branches and branch points are counted from 1, as CSV counts results, points from 0.
/// Cells of quantities are empty where points keep no unknowns (Options::keep_points).
results::Results results_of(const continuation::Branch& branch, const Columns& columns);
results::Results results_of(const continuation::WholeBranch& branch, const Columns& columns);
results::Results results_of(const continuation::Diagram& diagram, const Columns& columns);

/// A line for each branch. The events are marked by their kind, those of one's own monitors by a star.
results::FigureData figure_data_of(const continuation::Branch& branch, const Columns& columns);
results::FigureData figure_data_of(const continuation::WholeBranch& branch, const Columns& columns);
results::FigureData figure_data_of(const continuation::Diagram& diagram, const Columns& columns);

}  // namespace arcslip::diagrams
