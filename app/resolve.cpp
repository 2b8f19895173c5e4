#include "resolve.hpp"

#include "interrupt.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/scene/scene_file.hpp>
#include <arcslip/studies/units.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <vector>

namespace arcslip::app {
namespace {

void apply(scene::Scene& scene, const Options& options) {
  for (const auto& [name, value] : options.set) {
    try {
      scene::set(scene, name, value);
    } catch (const scene::ParameterError& error) {
      throw UsageError("--set " + name + "=" + results::shortest(value) + ": " + error.what());
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
      message += "\n  " + results::visible(fault.pointer) + ": " + fault.message;
    }
    throw UsageError(message);
  }
}

std::string range_unit(const scene::Scene& scene, const scene::Study& study) {
  if (study.kind == scene::StudyKind::frf) {
    return std::string(scene::unit_name(scene.frequency_unit));
  }
  return study.over == "frequency" ? "" : studies::parameter_unit(scene, study.over);
}

/// Throws where an option names no parameter at all; what else may be wrong with it is told by check_study().
void check_parameter(const scene::Scene& scene, const std::string& option, const std::string& parameter) {
  if (parameter.empty() || parameter == "frequency") {
    return;
  }
  try {
    scene::parameter_fields(scene, parameter);
  } catch (const scene::ParameterError& error) {
    throw UsageError(option + " " + parameter + ": " + error.what());
  }
}

/// "--from, --to and --frequency"
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text.append(i == 0 ? "" : i + 1 == words.size() ? " and " : ", ").append(words[i]);
  }
  return text;
}

/// The option and its value where it gave this key of a study, or "".
std::string option_of(const std::string& key, const Options& options) {
  if (!options.design.empty() && (key.starts_with("over") || key.starts_with("bounds"))) {
    const auto slash = key.find('/');
    const std::string place = slash == std::string::npos ? "" : key.substr(slash + 1);
    std::size_t index = 0;
    std::from_chars(place.data(), place.data() + place.size(), index);
    return "--over " + options.design[std::min(index, options.design.size() - 1)].parameter;
  }
  if (options.along && (key == "along" || key == "from" || key == "to")) {
    return "--along " + options.along->parameter;
  }
  if (key == "criterion" && options.criterion) {
    return "--criterion " + std::string(scene::criterion_name(*options.criterion));
  }
  if (key == "over" && !options.over.empty()) {
    return "--over " + options.over;
  }
  if (key == "from" && options.from) {
    return "--from " + results::shortest(*options.from);
  }
  if (key == "to" && options.to) {
    return "--to " + results::shortest(*options.to);
  }
  for (const auto& [name, value] :
       {std::pair{"steps", options.steps}, std::pair{"periods", options.periods},
        std::pair{"recorded", options.recorded}, std::pair{"evaluations", options.evaluations}}) {
    if (key == name && value) {
      return std::string("--") + name + " " + std::to_string(*value);
    }
  }
  for (const auto& [name, value] :
       {std::pair{"tolerance", options.tolerance}, std::pair{"seconds", options.seconds}}) {
    if (key == name && value) {
      return std::string("--") + name + " " + results::shortest(*value);
    }
  }
  return "";
}

/// The study that says what the command line does not. A name that no other study has, where there is none.
std::size_t study_to_follow(scene::Scene& scene, scene::StudyKind kind, const Options& options) {
  const auto find = [&](bool over_the_same) {
    return std::find_if(scene.studies.begin(), scene.studies.end(), [&](const scene::Study& study) {
      return study.kind == kind && (!over_the_same || study.over == options.over);
    });
  };
  auto study = options.over.empty() ? find(false) : find(true);
  study = study == scene.studies.end() ? find(false) : study;
  if (study == scene.studies.end()) {
    std::string free_name = name(options.verb);
    while (std::any_of(scene.studies.begin(), scene.studies.end(),
                       [&](const scene::Study& other) { return other.name == free_name; })) {
      free_name += "_2";
    }
    study = scene.studies.insert(study, scene::Study{free_name, kind, 0, 0, {}});
  }
  return static_cast<std::size_t>(study - scene.studies.begin());
}

/// What the options say of a search.
void set_search(scene::SearchSettings& search, const Options& options) {
  search.algorithm = options.algorithm.empty() ? search.algorithm : options.algorithm;
  search.local = options.local.empty() ? search.local : options.local;
  search.evaluations = options.evaluations.value_or(search.evaluations);
  search.seconds = options.seconds.value_or(search.seconds);
}

/// The parameter over which the optimum is to be followed, in place of the study's own.
void set_along(scene::Study& study, const scene::Scene& scene, const Options& options) {
  if (options.along) {
    const auto& [parameter, range] = *options.along;
    check_parameter(scene, "--along", parameter);
    if (!range) {
      throw UsageError("--along " + parameter + ": its range is not known; give it as --along " + parameter +
                       "=from:to");
    }
    scene::drop(study, parameter);
    study.along = {parameter, range->first, range->second};
  }
  for (const auto& [parameter, value] : options.set) {
    if (study.along && study.along->name == parameter) {
      throw UsageError("--set " + parameter + "=" + results::shortest(value) +
                       ": the study goes along this parameter; give --along for its range");
    }
  }
}

/// What the options say of a study in time.
void set_time(scene::TimeSettings& time, const Options& options) {
  time.method = options.method.value_or(time.method);
  time.steps = options.steps.value_or(time.steps);
  time.periods = options.periods.value_or(time.periods);
  time.recorded = options.recorded.value_or(time.recorded);
  time.tolerance = options.tolerance.value_or(time.tolerance);
}

}  // namespace

void check_study(const scene::Scene& scene, std::size_t index, const Options& options) {
  try {
    scene::check(scene);
  } catch (const scene::SceneError& error) {
    const std::string place = "/studies/" + std::to_string(index) + "/";
    std::string message;
    for (const scene::Fault& fault : error.faults()) {
      const std::string key = fault.pointer.starts_with(place) ? fault.pointer.substr(place.size()) : "";
      const std::string option = option_of(key, options);
      message += (message.empty() ? "" : "\n  ") +
                 (option.empty() ? results::visible(fault.pointer) : option) + ": " + fault.message;
    }
    throw UsageError(message);
  }
}

scene::Scene resolve(const Options& options) {
  scene::Scene scene = scene::read_file(options.scene, interrupted);
  apply(scene, options);
  return scene;
}

void set_range(scene::Study& study, const scene::Scene& scene, const Options& options) {
  study.from = options.from.value_or(study.from);
  study.to = options.to.value_or(study.to);
  if (!(study.from < study.to)) {
    const std::string unit = range_unit(scene, study);
    throw UsageError(
        (options.from ? "--from must be below " : "--to must be above ") +
        (options.from
             ? results::quantity(study.to, unit) + ", where the study \"" + study.name + "\" ends"
             : results::quantity(study.from, unit) + ", where the study \"" + study.name + "\" begins") +
        "; found " + results::quantity(options.from ? study.from : study.to, unit));
  }
}

scene::Study study_of_verb(scene::Scene& scene, scene::StudyKind kind, const Options& options) {
  check_parameter(scene, "--over", options.over);
  const bool is_frf = kind == scene::StudyKind::frf, is_time = kind == scene::StudyKind::time;
  const std::size_t studies_before = scene.studies.size();
  const std::size_t index = study_to_follow(scene, kind, options);
  const bool is_new = scene.studies.size() > studies_before;
  scene::Study& study = scene.studies[index];
  const bool is_over_another = !is_new && !options.over.empty() && options.over != study.over;

  std::vector<std::string> missing;
  if (is_new && !is_frf && !is_time && options.over.empty()) {
    missing.emplace_back("--over");
  }
  if ((is_new || is_over_another) && !is_time && !options.from) {
    missing.emplace_back("--from");
  }
  if ((is_new || is_over_another) && !is_time && !options.to) {
    missing.emplace_back("--to");
  }
  if (is_new && !is_frf && options.frequency.empty()) {
    missing.emplace_back("--frequency");
  }
  if (!missing.empty()) {
    const std::string kind_name = name(options.verb);
    throw UsageError("the scene has no study of kind " + kind_name +
                     (is_over_another ? " over " + options.over : "") + ", so not all is known: give " +
                     listed(missing) + ", or add such a study to the scene");
  }

  if (!options.over.empty()) {
    study.over = options.over;
    std::erase_if(study.for_each, [&](const auto& list) { return list.first == study.over; });
  }
  if (!options.frequency.empty()) {
    study.frequency_from = options.frequency.front();
    study.frequency_to = options.frequency.back();
  }
  set_time(study.time, options);
  if ((is_new || is_over_another) && !is_time) {
    study.from = *options.from;
    study.to = *options.to;
  }
  for (const auto& [parameter, value] : options.set) {
    if (parameter == study.over) {
      throw UsageError("--set " + parameter + "=" + results::shortest(value) +
                       ": the study is over this parameter; give --from and --to for its range");
    }
  }
  if (!is_time) {
    set_range(study, scene, options);
  }
  check_study(scene, index, options);
  return study;
}

scene::Study optimum_of_verb(scene::Scene& scene, const Options& options) {
  const std::size_t studies_before = scene.studies.size();
  const std::size_t index = study_to_follow(scene, scene::StudyKind::optimum, options);
  const bool is_new = scene.studies.size() > studies_before;
  scene::Study& study = scene.studies[index];
  if (is_new && (options.design.empty() || options.frequency.empty())) {
    throw UsageError(
        "the scene has no study of kind optimum, so not all is known: give --over, with bounds, and "
        "--frequency, or add such a study to the scene");
  }
  std::vector<scene::DesignVariable> design;
  for (const DesignRange& range : options.design) {
    check_parameter(scene, "--over", range.parameter);
    const auto known = std::find_if(study.design.begin(), study.design.end(),
                                    [&](const auto& v) { return v.name == range.parameter; });
    if (!range.bounds && known == study.design.end()) {
      throw UsageError("--over " + range.parameter + ": its bounds are not known; give them as --over " +
                       range.parameter + "=lower:upper");
    }
    design.push_back(range.bounds
                         ? scene::DesignVariable{range.parameter, range.bounds->first, range.bounds->second}
                         : *known);
  }
  if (!design.empty()) {
    study.design = std::move(design);
  }
  for (const DesignRange& range : options.design) {
    scene::drop(study, range.parameter);
    if (study.along && study.along->name == range.parameter) {
      study.along.reset();
    }
  }
  if (!options.frequency.empty()) {
    study.frequency_from = options.frequency.front();
    study.frequency_to = options.frequency.back();
  }
  set_search(study.search, options);
  set_along(study, scene, options);
  study.criterion = options.criterion.value_or(study.criterion);
  check_study(scene, index, options);
  return study;
}

}  // namespace arcslip::app
