#pragma once
// The keys of studies that tell the stability of their responses.

#include <arcslip/scene/keys/study_keys.hpp>
#include <arcslip/stability/stability_request.hpp>

#include <string>
#include <utility>

namespace arcslip::studies {

inline constexpr const char* stability_help =
    "whether to compute the Floquet multipliers of each response and locate the loss of stability";
inline constexpr const char* stability_of_points_help =
    "whether to compute the Floquet multipliers of each response";

/// "stability" and "multipliers".
std::vector<scene::file::KeyGroup<observables::StabilityRequest>> stability_keys(const std::string& help);

template <class S>
void add_stability_keys(scene::file::KeysOf<S>& keys, const std::string& help) {
  for (auto& group : stability_keys(help)) keys.add(scene::file::within(&S::stability, std::move(group)));
}

}  // namespace arcslip::studies
