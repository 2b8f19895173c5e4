#pragma once
// Parts of a response that need more harmonics than the rest, and how they take their place in it.
//
// A point needs more if its truncation estimate exceeds e max A, or is flagged as perhaps too low; with it
// the neighbours, so that a part begins and ends where the estimates are small. No event lies next to its
// ends, so that none is lost or found twice, and it passes the frequency of its last point, or the value of
// ResponseBranch::over, only there, so that a trace from the first point is that part, with folds as well, up
// to where it reaches this value.

#include <arcslip/results/response.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace arcslip::observables {

/// The points from `first` to `last` of a branch.
struct Part {
  std::size_t first = 0, last = 0;
  friend bool operator==(const Part&, const Part&) = default;
};

/// The parts of a branch that need more harmonics, in its order and apart from each other.
/// allowed: e max A, m.
std::vector<Part> parts_to_refine(const ResponseBranch& branch, double allowed);

/// The branch with refined[k] in place of the points and events of part k, and its coefficients and unknowns
/// in the harmonics of the refined ones. Adds up the work of the solver.
ResponseBranch with_parts(const ResponseBranch& branch, const std::vector<Part>& parts,
                          std::vector<ResponseBranch> refined);

/// A branch of which parts have more harmonics than others (Solution::order).
struct RefinedBranch {
  ResponseBranch branch;
  double change = 0;  // of the amplitude by the harmonics added, at the ends of the parts and where it is
                      // largest in them, relative to the largest amplitude of all
};

/// The branch where only parts are traced anew: those in which the truncation estimate exceeds accuracy times
/// the largest amplitude, or is flagged. trace(part): that part with more harmonics; nothing if it does not
/// reach its end. Nothing where all has to be traced anew: for a branch that does not reach the end of its
/// range, where these parts are most of it, and where another response is found at the end of a part.
std::optional<RefinedBranch> refined_branch(
    const ResponseBranch& branch, double accuracy,
    const std::function<std::optional<ResponseBranch>(const Part&)>& trace);

/// What a branch goes over, at a point of it: the parameter `over`, or the frequency, rad/s.
double place_of(const ResponseBranch& branch, const Solution& point);

/// The coefficients and unknowns of a point in the harmonics of another branch, which has those of `from`.
ResponsePoint in_harmonics(ResponsePoint point, const ResponseBranch& from, const ResponseBranch& to);

}  // namespace arcslip::observables
