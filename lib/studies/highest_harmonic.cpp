#include <arcslip/studies/highest_harmonic.hpp>

#include <arcslip/results/text.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/study_type.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::scene {
namespace {

// Of its keys; a window is a list.
double highest_frequency(const Scene& scene, const Study& study) {
  if (study.type == nullptr) return 0;
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

// Of the matrices as they are given, or as they are reduced.
double limit_of_reduction(const Scene& scene) {
  double limit = HUGE_VAL;
  if (!scene.matrices) return limit;
  if (scene.matrices->highest_frequency > 0) limit = scene.matrices->highest_frequency;
  if (!scene.matrices->errors.empty()) limit = std::min(limit, scene.matrices->errors.back().frequency);
  return limit;
}

}  // namespace

double highest_harmonic(const Scene& scene, const Study& study) {
  if (scene.harmonics.accuracy != 0) return 0;
  return static_cast<double>(scene.harmonics.order) / scene.harmonics.period *
         highest_frequency(scene, study);
}

std::string beyond_reduction(const Scene& scene, const Study& study) {
  const double limit = limit_of_reduction(scene), frequency = highest_frequency(scene, study),
               order = static_cast<double>(scene.harmonics.order) / scene.harmonics.period;
  if (!(highest_harmonic(scene, study) > limit)) return {};
  const auto reported = [&](double value) {
    return results::quantity(value, unit_name(scene.frequency_unit));
  };
  return "harmonics beyond highest_frequency of the reduction: " + results::quantity(order, "") + " times " +
         reported(frequency) + " is " + reported(order * frequency) + ", above " + reported(limit);
}

}  // namespace arcslip::scene
