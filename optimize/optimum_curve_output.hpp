#pragma once
// Curves of optima as JSON (format "arcslip-optimum-curves-1"), CSV and figures.

#include <arcslip/optimize/optimum_curve.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/output/json_document.hpp>

#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

struct OptimumCurveResult {
  std::string study, kind;                          // told by who runs the study
  std::vector<std::pair<std::string, double>> set;  // what for_each gave
  OptimumProblem problem;
  OptimumCurve curve;
};

/// The key "optimum_curves" of a document: a list of
///   {"study", "kind", "status", "stop", "set", "along": the name of s,
///    "points": [{s and each parameter by its name, "amplitude" (m), "frequency" (scene's unit), "omega"
///                (rad/s), "stick_percent" where there is one friction element, "energy_friction" (J),
///                "peaks": [{"kind", "frequency", "omega", "weight"}, ...],
///                "at_bound": {each parameter: "lower", "inside", "upper"}, "minimum"}, ...],
///    "events": [{"kind", "parameter", "frequency", "omega" where they have one, "nonsmooth", "after": index
///    of
///                the point before it, "point"}, ...],
///    "notes", "pieces", "evaluations", "hessians", "responses", "followed", "factorizations", "seconds"}
/// Refers to its arguments.
output::JsonSection json_section(const scene::Scene& scene, std::span<const OptimumCurveResult> results);

/// A row for each point and each event, named by its kind, in the order of the curve.
void write_csv(std::ostream& out, const scene::Scene& scene, std::span<const OptimumCurveResult> results);

/// Over s, with a line for each result: each parameter of the design (NAME_PARAMETER), the amplitude
/// (NAME_amplitude) and the stick share of each friction element (NAME_stick).
output::Figures write_figures(const scene::Scene& scene, std::span<const OptimumCurveResult> results,
                              const std::string& folder, const std::string& name,
                              const scene::StopRequest& stop = {});

}  // namespace arcslip::optimize
