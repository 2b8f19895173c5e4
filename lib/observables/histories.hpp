#pragma once
// The motion and the forces over one period at a point of a branch.

#include <arcslip/fourier/harmonics.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <vector>

namespace arcslip::observables {

/// A further direction of an element.
struct DirectionHistory {
  std::vector<double> displacement, force;  // m; N, against the motion
};

/// One nonlinear element at the angles of a history, along its first direction.
struct ElementHistory {
  std::string name;
  std::vector<double> displacement;  // d . x, m
  std::vector<double> velocity;      // m/s
  std::vector<double> force;         // N, against the motion: the law's force for this displacement
  std::vector<double> series;        // N, its Fourier series up to N, as in harmonic balance
  std::vector<double> cosine, sine;  // N, parts of the series (Al Sayed et al. 2011, Eq. 17); the mean is in
                                     // the first
  std::vector<DirectionHistory> further;  // directions after the first
};

struct History {
  double base_frequency = 0;         // rad/s; time = angle/base_frequency
  std::vector<double> angle;         // theta, rad
  std::vector<double> displacement;  // of the response, m; of its largest place
  std::vector<double> velocity;      // m/s
  std::vector<ElementHistory> elements;
};

/// The history at a point or an event of a branch of this scene, or at a point of its own with an empty
/// branch, at the given angles. `force` is that of the exact law even if the scene samples it. Throws
/// std::invalid_argument if the point is unbounded, has no unknowns or does not belong to that scene.
History history(const scene::Scene& scene, const ResponseBranch& branch, const ResponsePoint& point,
                std::span<const double> angles);

/// The harmonics of a branch that has some.
elements::Harmonics harmonics_of(const ResponseBranch& branch);

/// `count` equally spaced angles from 0, without 2 pi.
std::vector<double> even_angles(int count);

/// The same with 2 pi and all onsets and ends of slip: a loop drawn through them is closed and has
/// its corners.
std::vector<double> loop_angles(const ResponsePoint& point, int count);

/// The point of a branch nearest in frequency to omega (rad/s); null if there is none. On a branch with folds
/// there may be several.
const ResponsePoint* point_at_frequency(const ResponseBranch& branch, double omega);

/// Deviation of a force from a reference at the same equally spaced angles, relative to the maximum of the
/// reference or, for `rms`, its root mean square.
struct ForceDifference {
  double amplitude = 0;  // | max |f| - max |g| | / max |g|
  double maximum = 0;    // max |f - g| / max |g|
  double rms = 0;        // |f - g|_2 / |g|_2
};
/// Throws std::invalid_argument if the sizes differ or are zero.
ForceDifference force_difference(std::span<const double> force, std::span<const double> reference);

}  // namespace arcslip::observables
