#pragma once
// Common parts of all branches of responses: their description, and how they end.

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

inline constexpr double same_solution = 1e-6;   // solutions that differ by less, relatively, are one
inline constexpr double points_in_range = 150;  // at least, from end to end
inline constexpr double smallest_step = 1e-2;   // of the largest at the low end of the window or the range
/// |u| over that at the start: beyond, rounding leaves less than 8 digits.
inline constexpr double resolvable = 1e8;

/// An empty branch of a model: its parameters and harmonics. over: the free parameter, if it is not
/// the frequency.
ResponseBranch described(const model::Model& model, const std::string& over = {});

/// Whether an extremum of the amplitude at an arclength exceeds rounding on both sides: it does not if the
/// free parameter has no influence, as when all friction elements it acts on stick, or slip. course:
/// arclength and amplitude of the points of the branch.
bool departs(const std::vector<std::pair<double, double>>& course, double arclength, double amplitude);

/// Without the maxima and minima that do not depart, or that a neighbouring point or event is beyond. at: the
/// arclengths of the events.
void drop_extrema_of_rounding(const std::vector<std::pair<double, double>>& course,
                              const std::vector<double>& at, ResponseBranch& result);

/// Whether the amplitude is that of a place that does not move, but for rounding.
bool is_rounding(const Solution& point);

/// Without the peaks of such places.
void drop_peaks_of_rounding(ResponseBranch& branch);

/// Flat peaks: of three neighbouring points or more, not flagged, which differ by less than twice the
/// truncation estimates of both, the peak may be anywhere among these. They get the largest estimate there,
/// and what a point there is higher. A truncated response has its peaks where the harmonics left out would
/// lower it least, so that their own estimate alone is too low.
void estimate_flat_peaks(ResponseBranch& branch);

/// An event at a point, whose stability leaves out the multipliers that make it one (set_apart()).
ResponseEvent event_of(const continuation::Event& event, ResponsePoint point);

/// Adds the work of a trace, or of a part, with the name of its linear solver if it is not there yet.
void add(const continuation::Branch& traced, SolverSummary& to);
void add(const SolverSummary& part, SolverSummary& to);  // with its time
void add(const continuation::Counts& counts, SolverSummary& to);

Status status_of(continuation::StopReason reason);

using results::to_digits;

/// omega (rad/s) in the scene's unit, with its name.
std::string frequency_text(double omega, scene::FrequencyUnit unit);

}  // namespace arcslip::observables
