#pragma once
// Studies of a scene file by their names, and what the figures read off them. The scene has one friction
// element, the first.

#include "data_file.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <string>
#include <vector>

namespace figures {

using arcslip::observables::ResponseBranch;
using arcslip::observables::ResponsePoint;

struct SceneFile {
  std::string name;  // "contact.scene.json"
  arcslip::scene::Scene scene;

  /// Throws std::runtime_error where the scene has none of that name.
  const arcslip::scene::Study& study(const std::string& study_name) const;
};

SceneFile read_scene(const std::string& folder, const std::string& name);

/// The branches of a study of frequency responses or peaks, with more points where the share of stick changes
/// by more than 1 % of the period from one to the next. Throws std::runtime_error where one failed, or where
/// there is none.
std::vector<ResponseBranch> branches(const SceneFile& file, const std::string& study);

/// The frequencies in which it looks for responses or peaks.
arcslip::observables::FrequencyRange window_of(const arcslip::scene::Study& study);

/// Of a study in time of one motion. Throws std::runtime_error where it is not.
const arcslip::observables::TimeSettings& time_settings(const SceneFile& file, const std::string& study);

/// The only peak of a frequency response. Throws std::runtime_error where there is not one.
const ResponsePoint& peak(const ResponseBranch& branch);

/// The steady response at one frequency (in the scene's unit), first point of the branch.
ResponseBranch response_at(const arcslip::scene::Scene& scene, double frequency);

/// The value that for_each gave the branch.
double set_value(const ResponseBranch& branch);
/// "3 N", the same as people read it.
std::string set_label(const SceneFile& file, const ResponseBranch& branch);

/// A number of a point, and what it is called.
struct Column {
  std::string name;
  std::function<double(const ResponsePoint&)> of;
};

Column frequency(const SceneFile& file);
/// The parameter of a curve of peaks.
Column over(const SceneFile& file, const ResponseBranch& branch);
extern const Column amplitude, stick, friction_energy, viscous_energy, total_energy, friction_share;

std::vector<std::string> names(const std::vector<Column>& columns);
std::vector<double> row(const ResponsePoint& point, const std::vector<Column>& columns);
/// All points of a branch with its events among them, without those that are unbounded.
Block block(const std::string& label, const ResponseBranch& branch, const std::vector<Column>& columns);

}  // namespace figures
