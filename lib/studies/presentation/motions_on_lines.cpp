#include <arcslip/studies/presentation/figure_parts.hpp>

#include <arcslip/observables/histories.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace arcslip::studies {
namespace {

using observables::ResponseBranch;
using observables::ResponsePoint;
using results::FigureMotion;

constexpr int instants_of_motion = 40;  // of a motion
constexpr std::size_t most_of_a_line = 12;
constexpr std::size_t most_loops = 4;  // of a motion

struct Chosen {
  const ResponseBranch* branch;
  const ResponsePoint* point;
  std::string words;
};

/// Peaks and other events that figures mark, then points in equal shares of each branch.
std::vector<Chosen> chosen_points(const std::vector<const ResponseBranch*>& branches, std::size_t most) {
  std::vector<Chosen> all;
  for (const ResponseBranch* branch : branches)
    for (const observables::ResponseEvent& event : branch->events) {
      const results::EventKind kind = observables::event_kinds::kind_named(event.kind);
      if (all.size() < most && kind.mark.shape != results::Shape::none && !event.point.unbounded)
        all.push_back({branch, &event.point, std::string(kind.words)});
    }
  std::size_t count = 0;
  for (const ResponseBranch* branch : branches) count += branch->points.size();
  const std::size_t left = most - all.size(), step = left > 0 ? std::max<std::size_t>(1, count / left) : 0;
  std::size_t place = 0;
  for (const ResponseBranch* branch : branches)
    for (const ResponsePoint& point : branch->points)
      if (step > 0 && place++ % step == step / 2 && all.size() < most && !point.unbounded)
        all.push_back({branch, &point, ""});
  return all;
}

}  // namespace

std::vector<FigureMotion> motions_on(const scene::Scene& scene,
                                     const std::vector<const ResponseBranch*>& branches, std::size_t most,
                                     const std::function<results::Record(const ResponsePoint&)>& record) {
  std::vector<double> angles = observables::even_angles(instants_of_motion);
  angles.push_back(2 * std::numbers::pi);
  const std::vector<scene::Part> elements = scene::all_elements(scene);
  std::vector<FigureMotion> motions;
  for (const Chosen& each : chosen_points(branches, std::min(most, most_of_a_line))) {
    try {
      const observables::History history = observables::history(scene, *each.branch, *each.point, angles);
      FigureMotion motion{.record = record(*each.point),
                          .words = each.words,
                          .period = 2 * std::numbers::pi / history.base_frequency,
                          .displacement = history.displacement};
      for (std::size_t e = 0; e < elements.size() && e < history.elements.size(); ++e)
        if (elements[e].detailed && observables::is_friction_part(elements[e]) &&
            motion.loops.size() < most_loops)
          motion.loops.push_back(
              {elements[e].name, history.elements[e].displacement, history.elements[e].force});
      motions.push_back(std::move(motion));
    } catch (const std::invalid_argument&) {  // shooting has no series
    }
  }
  return motions;
}

}  // namespace arcslip::studies
