// Two bars that meet at a hinge (von Mises 1923), at the height h over supports 2 l apart. Pressed down by w
// under the load P, with bars of the axial stiffness EA that are stretched by the measure of Green, (L^2 -
// L_0^2) / 2 L_0^2,
//
//   P = EA / L_0^3 w (h - w) (2 h - w),   L_0^2 = l^2 + h^2,
//
// the truss snaps through at h - w = h / sqrt(3), P = 2 EA h^3 / (3 sqrt(3) L_0^3). A steep one, h^2 > 3 l^2,
// buckles sideways before, where (h - w)^2 = h^2 - 2 l^2, at a subcritical pitchfork: its load falls on the
// way out.
//
//   snapping_truss [FOLDER]: with a folder also writes the diagram there, as truss.json, truss.csv with
//   truss.events.csv, and figures truss-w and truss-v, in which what is unstable is dashed.

#include <arcslip/structures.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>

using namespace arcslip::continuation;
namespace diagrams = arcslip::diagrams;
namespace results = arcslip::results;

namespace {

constexpr double EA = 1, l = 1, h = 2;
const double L0 = std::sqrt(l * l + h * h);

void write(const Diagram& diagram, const Problem& problem, const std::string& folder) {
  diagrams::Columns columns = diagrams::columns_of(problem, 0, {"w", "v"});
  columns.title = "Snapping and buckling of a steep truss";
  const results::Results all = diagrams::results_of(diagram, columns);
  std::ofstream json(folder + "/truss.json"), points(folder + "/truss.csv"),
      events(folder + "/truss.events.csv");
  results::write_json(json, all);
  results::write_csv(points, all, "points");
  results::write_csv(events, all, "events");
  const auto drawn =
      arcslip::output::draw_figures(diagrams::figure_data_of(diagram, columns), folder, "truss");
  if (!drawn.problem.empty()) std::fprintf(stderr, "%s\n", drawn.problem.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Functions truss;  // unknowns: the way down w, and sideways v; the load P
  truss.size = 2;
  truss.parameters = {{"P", ""}};
  truss.residual = [](In u, In p, Out F) {
    const double w = u[0], v = u[1], z = h - w;
    // The forces of both bars over their lengths.
    const double left = EA / (2 * L0 * L0 * L0) * ((l + v) * (l + v) + z * z - L0 * L0);
    const double right = EA / (2 * L0 * L0 * L0) * ((l - v) * (l - v) + z * z - L0 * L0);
    F << p[0] + (left + right) * z, right * (l - v) - left * (l + v);
  };
  const auto problem = from_functions(std::move(truss));

  Options options{.lower = -0.5, .upper = 0.5};
  options.stability.emplace();  // of the forces that are left over: down the energy
  const Diagram diagram = trace_diagram(problem, {.u = Vector::Zero(2), .p = Vector{{0.0}}}, options,
                                        {.depth = 1}, {fold_monitor()});
  const DiagramBranch& upright = diagram.branches.front();
  for (const Event& event : upright.branch.events) {
    if (const auto* fold = std::get_if<Fold>(&event.data))
      std::printf("fold at P = %.9f, w = %.9f, curvature = %.4f\n", event.point.parameter, event.point.u[0],
                  fold->curvature);
    if (const auto* point = std::get_if<BranchPoint>(&event.data))
      std::printf("buckling at P = %.9f, w = %.9f, %s\n", event.point.parameter, event.point.u[0],
                  name(point->criticality));
  }
  for (const StabilityRange& range : upright.stability)
    std::printf("upright from w = %.3f to %.3f: unstable = %d\n", upright.branch.points[range.first].u[0],
                upright.branch.points[range.last].u[0], range.unstable);
  std::printf("diagram of %zu branches; %s\n", diagram.branches.size(),
              diagram.complete ? "complete" : diagram.message.c_str());
  if (argc > 1) write(diagram, *problem, argv[1]);
}
