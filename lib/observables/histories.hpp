#pragma once
// The motion and the forces over one period at a point of a branch.

#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <vector>

namespace arcslip::observables {

/// One nonlinear element at the angles of a history.
struct ElementHistory {
  std::string name;
  std::vector<double> displacement;  // d . x, m
  std::vector<double> velocity;      // m/s
  std::vector<double> force;         // N, against the motion: the law's own force on that displacement
  std::vector<double> series;        // N, the same as harmonic balance has it: its harmonics up to N
  std::vector<double> cosine, sine;  // N, parts of the series (Al Sayed et al. 2011, Eq. 17); the mean is in
                                     // the first
};

struct History {
  double base_frequency = 0;         // rad/s; time = angle/base_frequency
  std::vector<double> angle;         // theta, rad
  std::vector<double> displacement;  // of the response, m
  std::vector<double> velocity;      // m/s
  std::vector<ElementHistory> elements;
};

/// The history at a point or an event of a branch of this scene, at the given angles. `force` is that of the
/// exact law even where the scene samples it. Throws std::invalid_argument where the point is unbounded or
/// not one of that scene.
History history(const scene::Scene& scene, const ResponseBranch& branch, const ResponsePoint& point,
                std::span<const double> angles);

/// `count` angles from 0 on, at equal intervals of a period; 2 pi is not among them.
std::vector<double> even_angles(int count);

/// The same with 2 pi and all the angles where slip begins or ends: a loop drawn through them is closed and
/// has its corners.
std::vector<double> loop_angles(const ResponsePoint& point, int count);

/// The point of a branch nearest in frequency to omega (rad/s); null where there is none. On a branch with
/// folds it is one of several.
const ResponsePoint* point_at_frequency(const ResponseBranch& branch, double omega);

/// How far a force lies from a reference at the same even angles, relative to the reference's largest value
/// or, for `rms`, its root mean square.
struct ForceDifference {
  double amplitude = 0;  // | max |f| - max |g| | / max |g|
  double maximum = 0;    // max |f - g| / max |g|
  double rms = 0;        // |f - g|_2 / |g|_2
};
/// Throws std::invalid_argument where the two have not the same number of values, or none.
ForceDifference force_difference(std::span<const double> force, std::span<const double> reference);

}  // namespace arcslip::observables
