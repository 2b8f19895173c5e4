#include "studies.hpp"

#include <arcslip/output/event_places.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace figures {

using namespace arcslip;

const Column amplitude{"amplitude (m)", [](const ResponsePoint& p) { return p.amplitude; }};
const Column stick{"stick (%)", [](const ResponsePoint& p) { return p.elements.front().stick_percent; }};
const Column friction_energy{"energy of friction (J)",
                             [](const ResponsePoint& p) { return p.energy_friction; }};
const Column viscous_energy{"energy of viscous damping (J)",
                            [](const ResponsePoint& p) { return p.energy_viscous; }};
const Column total_energy{"total energy (J)", [](const ResponsePoint& p) { return p.energy_total(); }};
const Column friction_share{"share of friction (%)",
                            [](const ResponsePoint& p) { return p.friction_percent(); }};

const scene::Study& SceneFile::study(const std::string& study_name) const {
  const auto found = std::find_if(scene.studies.begin(), scene.studies.end(),
                                  [&](const scene::Study& study) { return study.name == study_name; });
  if (found == scene.studies.end())
    throw std::runtime_error(name + " has no study " + study_name + ", which a figure is made of");
  return *found;
}

SceneFile read_scene(const std::string& folder, const std::string& name) {
  SceneFile file{name, scene::read_file(folder + "/" + name)};
  if (file.scene.elements.empty() || file.scene.elements.front().type != &scene::jenkins_type)
    throw std::runtime_error(name + ": the figures are of a friction element, which has to be the first");
  return file;
}

std::vector<ResponseBranch> branches(const SceneFile& file, const std::string& name) {
  const scene::Study& study = file.study(name);
  const bool is_peaks = study.kind == scene::StudyKind::peaks;
  if (!is_peaks && study.kind != scene::StudyKind::frf)
    throw std::runtime_error(file.name + ": study " + name + " has to be of kind frf or peaks");
  auto found = is_peaks ? observables::resonance_peaks(file.scene, study)
                        : observables::frequency_response(file.scene, study);
  if (found.empty()) throw std::runtime_error(file.name + ": study " + name + " has no branch");
  for (const ResponseBranch& branch : found)
    if (branch.status == observables::Status::failed)
      throw std::runtime_error(file.name + ": study " + name + ": " + branch.stop.message);
  return found;
}

namespace {

constexpr double coarse = 1;  // % of the period in stick
constexpr int passes = 2;

bool is_coarse(const ResponsePoint& a, const ResponsePoint& b) {
  return !a.unbounded && !b.unbounded && std::abs(stick.of(a) - stick.of(b)) > coarse;
}

/// Points between two of a curve, by the same study over that range alone, whose steps are shorter.
std::vector<ResponsePoint> between(const SceneFile& file, scene::Study study, const ResponseBranch& curve,
                                   const ResponsePoint& begin, const ResponsePoint& end) {
  scene::Scene scene = file.scene;
  for (const auto& [name, value] : curve.set) scene::set(scene, name, value);
  study.for_each.clear();
  study.from = std::min(begin.over, end.over);
  study.to = std::max(begin.over, end.over);
  const auto found = observables::resonance_peaks(scene, study);
  if (found.size() != 1 || found.front().status != observables::Status::complete) return {};
  std::vector<ResponsePoint> points = found.front().points;
  if (points.size() < 2) return {};
  const bool falls = begin.over > end.over;
  std::sort(points.begin(), points.end(), [falls](const ResponsePoint& a, const ResponsePoint& b) {
    return falls ? a.over > b.over : a.over < b.over;
  });
  return {points.begin() + 1, points.end() - 1};  // without the two that are there
}

void refine(const SceneFile& file, const scene::Study& study, ResponseBranch& curve) {
  std::vector<ResponsePoint> points;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    points.push_back(curve.points[i]);
    std::size_t end = i;
    while (end + 1 < curve.points.size() && is_coarse(curve.points[end], curve.points[end + 1])) ++end;
    if (end == i) continue;
    const auto more = between(file, study, curve, curve.points[i], curve.points[end]);
    points.insert(points.end(), more.begin(), more.end());
    if (!more.empty()) i = end - 1;
  }
  curve.points = std::move(points);
}

}  // namespace

std::vector<ResponseBranch> smooth_curves(const SceneFile& file, const std::string& study) {
  auto curves = branches(file, study);
  for (ResponseBranch& curve : curves)
    for (int pass = 0; pass < passes; ++pass) refine(file, file.study(study), curve);
  return curves;
}

const ResponsePoint& peak(const ResponseBranch& branch) {
  const ResponsePoint* found = nullptr;
  for (const auto& event : branch.events) {
    if (event.kind != "peak") continue;
    if (found) throw std::runtime_error("a frequency response has more than one peak");
    found = &event.point;
  }
  if (!found) throw std::runtime_error("a frequency response has no peak in its window");
  return *found;
}

ResponseBranch response_at(const scene::Scene& scene, double frequency) {
  scene::Study study;
  study.kind = scene::StudyKind::frf;
  study.from = frequency;
  study.to = frequency * 1.001;
  const auto found = observables::frequency_response(scene, study);
  if (found.empty() || found.front().points.empty())
    throw std::runtime_error("no response was found at " + output::shortest(frequency) + " " +
                             std::string(scene::unit_name(scene.frequency_unit)));
  return found.front();
}

double set_value(const ResponseBranch& branch) {
  if (branch.set.size() != 1) throw std::runtime_error("a study of a figure has a for_each of one parameter");
  return branch.set.front().second;
}

std::string set_label(const SceneFile& file, const ResponseBranch& branch) {
  const double value = set_value(branch);
  return output::quantity(value, output::parameter_unit(file.scene, branch.set.front().first));
}

Column frequency(const SceneFile& file) {
  return {"frequency (" + std::string(scene::unit_name(file.scene.frequency_unit)) + ")",
          [&scene = file.scene](const ResponsePoint& p) { return output::in_scene_unit(scene, p.omega); }};
}

Column over(const SceneFile& file, const ResponseBranch& branch) {
  return {output::with_unit(branch.over, output::parameter_unit(file.scene, branch.over)),
          [](const ResponsePoint& p) { return p.over; }};
}

std::vector<std::string> names(const std::vector<Column>& columns) {
  std::vector<std::string> result;
  for (const Column& column : columns) result.push_back(column.name);
  return result;
}

std::vector<double> row(const ResponsePoint& point, const std::vector<Column>& columns) {
  std::vector<double> result;
  for (const Column& column : columns) result.push_back(column.of(point));
  return result;
}

Block block(const std::string& label, const ResponseBranch& branch, const std::vector<Column>& columns) {
  const auto before = output::points_before_events(branch);
  Block result{label, {}};
  const auto add = [&](const ResponsePoint& point) {
    if (!point.unbounded) result.rows.push_back(row(point, columns));
  };
  std::size_t event = 0;
  for (std::size_t i = 0; i <= branch.points.size(); ++i) {
    for (; event < branch.events.size() && before[event] <= i; ++event) add(branch.events[event].point);
    if (i < branch.points.size()) add(branch.points[i]);
  }
  return result;
}

}  // namespace figures
