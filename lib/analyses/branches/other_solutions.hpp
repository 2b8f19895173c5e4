#pragma once
// Solutions of harmonic balance next to those that are known, at one frequency, which may miss some: a
// search by deflation (continuation/diagrams/deflation.hpp), and on branches over the excitation.

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::observables {

inline constexpr const char* stopped_in_search =
    "stopped by the caller, while responses next to those traced were looked for";

/// Whether further_responses() are looked for without being asked for by `"branches": "all"`: where laws may
/// have several responses at one frequency, and no more than `most_searched_elements` have such a law. With
/// more the search takes longer than the branch.
enum class EndSearch { needless, made, left_out };
EndSearch end_search(const model::Model& model);
inline constexpr int most_searched_elements = 20;

/// The end of the message of a branch or response next to which none was looked for; empty if needless or
/// made.
std::string without_search(const model::Model& model);

/// A solution u and its images, which are solutions as well: later by periods of the excitation, where the
/// motion takes several to repeat, or mirrored where the equations have this symmetry.
std::vector<continuation::Vector> images(const hbm::HbmProblem& problem, const continuation::Vector& u);

/// The one of `all` that is u or an image of it. all.size(): none is.
std::size_t index_of(const hbm::HbmProblem& problem, const continuation::Vector& u,
                     const std::vector<continuation::Vector>& all);

/// Of a branch of `problem`: at omega, rad/s.
std::vector<continuation::Vector> solutions_at(const hbm::HbmProblem& problem,
                                               std::span<const ResponsePoint> branch, double omega);

/// By deflation: a solution at parameters p that is none of those known, which stand for all of their images.
std::optional<continuation::Vector> solution_nearby(const hbm::HbmProblem& problem,
                                                    const continuation::Vector& p,
                                                    const std::vector<continuation::Vector>& known,
                                                    const control::Control& control);

/// Responses at p that are none of those known, nor images of them, proposed with three times the harmonics
/// of the excitation: where the branches over the excitation factor, from 1/1000 to 1000, through those known
/// pass 1, so through the folds of a hysteresis; by deflation; and where the branches through those found do.
std::vector<continuation::Vector> further_responses(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                                    const continuation::Vector& p,
                                                    const std::vector<continuation::Vector>& known,
                                                    const control::Control& control);

}  // namespace arcslip::observables
