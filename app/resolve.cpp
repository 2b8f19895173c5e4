#include "resolve.hpp"

#include <arcslip/output/units.hpp>

#include <algorithm>

namespace arcslip::app {
namespace {

void apply(scene::Scene& scene, const Options& options) {
  for (const auto& [name, value] : options.set) {
    try {
      scene::set(scene, name, value);
    } catch (const scene::ParameterError& error) {
      throw UsageError("--set " + name + "=" + output::shortest(value) + ": " + error.what());
    }
  }
  scene.harmonics.order = options.harmonics.value_or(scene.harmonics.order);
  if (options.set.empty() && !options.harmonics) {
    return;
  }
  try {
    scene::check(scene);
  } catch (const scene::SceneError& error) {
    std::string message = "the options make the scene invalid:";
    for (const scene::Fault& fault : error.faults()) {
      message += "\n  " + fault.pointer + ": " + fault.message;
    }
    throw UsageError(message);
  }
}

}  // namespace

scene::Scene resolve(const Options& options) {
  scene::Scene scene = scene::read_file(options.scene);
  apply(scene, options);
  return scene;
}

void set_range(scene::Study& study, const scene::Scene& scene, const Options& options) {
  study.from = options.from.value_or(study.from);
  study.to = options.to.value_or(study.to);
  if (!(study.from < study.to)) {
    const std::string unit(scene::unit_name(scene.frequency_unit));
    throw UsageError(
        (options.from ? "--from must be below " : "--to must be above ") +
        (options.from
             ? output::quantity(study.to, unit) + ", where the study \"" + study.name + "\" ends"
             : output::quantity(study.from, unit) + ", where the study \"" + study.name + "\" begins") +
        "; found " + output::quantity(options.from ? study.from : study.to, unit));
  }
}

scene::Study frequency_study(scene::Scene& scene, const Options& options) {
  auto study = std::find_if(scene.studies.begin(), scene.studies.end(), [](const scene::Study& candidate) {
    return candidate.kind == scene::StudyKind::frf;
  });
  if (study == scene.studies.end()) {
    if (!options.from || !options.to) {
      throw UsageError(
          "the scene has no study of kind frf, so the range of frequencies is not known: give --from and "
          "--to, or add such a study to the scene");
    }
    study = scene.studies.insert(study,
                                 scene::Study{"frf", scene::StudyKind::frf, *options.from, *options.to, {}});
  }
  set_range(*study, scene, options);
  return *study;
}

}  // namespace arcslip::app
