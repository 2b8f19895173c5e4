#pragma once
// The harmonics that come in where a branch of periodic responses loses a symmetry: at a break of symmetry
// the even ones, at a period doubling the odd orders of half the base frequency. The problem widens by them
// (continuation/diagrams/widening.hpp): the equations keep the symmetry of the motion, a shift in time.

#include <arcslip/continuation/diagrams/widening.hpp>
#include <arcslip/hbm/problem.hpp>

#include <memory>

namespace arcslip::observables {

/// What the symmetry is that a motion loses: to be its own mirror image after half a period, or to repeat
/// after a period.
enum class BrokenSymmetry { mirror_image, period };

/// The harmonics of the motions that have lost it, up to the same frequency.
elements::Harmonics without(const elements::Harmonics& harmonics, BrokenSymmetry symmetry);

/// The same problem in other harmonics of the same excitation. about: as of HbmProblem.
std::shared_ptr<const hbm::HbmProblem> in_harmonics(const hbm::HbmProblem& problem,
                                                    const elements::Harmonics& harmonics, double about);

/// Whether a motion of a wider set has none of the harmonics that a narrower one lacks, to a part of 1e-6.
bool within(const hbm::HbmProblem& problem, const continuation::Vector& u, const elements::Harmonics& narrow);

/// Over the frequency. wide: in_harmonics() of `narrow`.
continuation::Widening widening(const std::shared_ptr<const hbm::HbmProblem>& narrow,
                                const std::shared_ptr<const hbm::HbmProblem>& wide);

}  // namespace arcslip::observables
