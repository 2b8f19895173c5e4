#pragma once
// Histories over a period (observables/histories.hpp) as tables.

#include <arcslip/observables/histories.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/results/table_of.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace arcslip::studies {

/// One instant of a history.
struct Instant {
  const observables::History* history;
  std::size_t i;
};

/// The motion and the elements of a scene over a period.
results::TableOf<Instant> history_table(const scene::Scene& scene);
std::vector<Instant> instants(const observables::History& history);

/// The directions of an element, the first one included.
std::span<const std::string_view> direction_names(const scene::Part& element);

/// Computes the motion at a row of the points, table 0, or of the events, table 1, of a branch of the scene;
/// keeps what it needs of both. Throws what observables::history() does.
results::MotionAt motion_at(std::shared_ptr<const scene::Scene> scene,
                            const observables::ResponseBranch& branch);

}  // namespace arcslip::studies
