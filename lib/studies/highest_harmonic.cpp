#include <arcslip/studies/highest_harmonic.hpp>

#include <arcslip/results/text.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/study_type.hpp>

#include <algorithm>

namespace arcslip::scene {
namespace {

// Of its keys; a window is a list.
double highest_frequency(const Scene& scene, const Study& study) {
  file::Node::Object written;
  study.type->settings().write(study.settings, scene, written);
  double highest = 0;
  const auto take = [&](const file::Node& node) {
    if (const double* value = node.get<double>()) highest = std::max(highest, *value);
  };
  for (const Key& key : study.type->keys())
    for (const file::Member& member : written) {
      if (member.key != key.name || (key.type != KeyType::frequency && key.type != KeyType::window)) continue;
      take(member.value);
      if (const auto* window = member.value.get<file::Node::List>())
        std::for_each(window->begin(), window->end(), take);
    }
  return highest;
}

}  // namespace

std::string beyond_reduction(const Scene& scene, const Study& study) {
  const bool known = scene.harmonics.accuracy == 0;
  if (!known || !scene.matrices || scene.matrices->highest_frequency == 0) return {};
  const double order = static_cast<double>(scene.harmonics.order) / scene.harmonics.period,
               frequency = highest_frequency(scene, study), limit = scene.matrices->highest_frequency;
  if (!(order * frequency > limit)) return {};
  const auto reported = [&](double value) {
    return results::quantity(value, unit_name(scene.frequency_unit));
  };
  return "harmonics beyond highest_frequency of the reduction: " + results::quantity(order, "") + " times " +
         reported(frequency) + " is " + reported(order * frequency) + ", above " + reported(limit);
}

}  // namespace arcslip::scene
