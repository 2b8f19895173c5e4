#pragma once
// Parts of a response that need more harmonics than the rest, and how they take their place in it.
//
// A point needs more if its truncation estimate exceeds e max A, or is flagged as perhaps too low; with it
// the neighbours, so that a part begins and ends where the estimates are small. No event lies next to its
// ends, so that none is lost or found twice, and it passes the frequency of its last point only there, so
// that a trace from the first point is that part, with folds as well, up to where it reaches this frequency.

#include <arcslip/observables/response.hpp>

#include <cstddef>
#include <vector>

namespace arcslip::observables {

/// The points from `first` to `last` of a branch over the frequency.
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

/// The coefficients and unknowns of a point in the harmonics of another branch, which has those of `from`.
ResponsePoint in_harmonics(ResponsePoint point, const ResponseBranch& from, const ResponseBranch& to);

}  // namespace arcslip::observables
