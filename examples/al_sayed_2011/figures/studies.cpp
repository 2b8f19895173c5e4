#include "studies.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/optimize/studies.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/presentation/units.hpp>
#include <arcslip/studies/study_kind.hpp>

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
  scene::Catalogue catalogue = studies::catalogue();
  optimize::add_studies(catalogue);
  SceneFile file{name, scene::read_file(folder + "/" + name, catalogue)};
  if (file.scene.elements.empty() || file.scene.elements.front().type != &elements::jenkins())
    throw std::runtime_error(name + ": the figures are of a friction element, which has to be the first");
  return file;
}

namespace {

constexpr double coarse = 1;  // % of the period in stick
constexpr int passes = 2;

bool is_of_peaks(const scene::Study& study) {
  return study.type == &studies::peaks();
}

/// Of a scene as it is.
std::vector<ResponseBranch> run(const scene::Scene& scene, const scene::Study& study) {
  return is_of_peaks(study)
             ? observables::resonance_peaks(scene, study.settings.as<observables::CurveRange>())
             : observables::frequency_response(scene, study.settings.as<observables::FrequencyRange>());
}

std::vector<ResponseBranch> branches(const SceneFile& file, const scene::Study& study) {
  if (!is_of_peaks(study) && study.type != &studies::frf())
    throw std::runtime_error(file.name + ": study " + study.name + " has to be of kind frf or peaks");
  auto found = studies::for_each<ResponseBranch>(
      file.scene, study.for_each,
      [&](const studies::Case& at, const auto& /*progress*/) { return run(at.scene, study); });
  if (found.empty()) throw std::runtime_error(file.name + ": study " + study.name + " has no branch");
  for (const ResponseBranch& branch : found)
    if (branch.status == observables::Status::failed)
      throw std::runtime_error(file.name + ": study " + study.name + ": " + branch.stop.message);
  return found;
}

bool is_coarse(const ResponsePoint& a, const ResponsePoint& b) {
  return !a.unbounded && !b.unbounded && std::abs(stick.of(a) - stick.of(b)) > coarse;
}

bool is_same(const ResponsePoint& a, const ResponsePoint& b) {
  return std::abs(a.amplitude - b.amplitude) <= 1e-6 * a.amplitude;
}

/// Where a point lies in the range of its study.
double place_of(const SceneFile& file, const scene::Study& study, const ResponsePoint& point) {
  return is_of_peaks(study) ? point.over : studies::in_scene_unit(file.scene, point.omega);
}

/// Points between two of a branch, by the same study over that range alone, whose steps are shorter. None
/// where that leads to another branch.
std::vector<ResponsePoint> between(const SceneFile& file, scene::Study study, const ResponseBranch& branch,
                                   const ResponsePoint& begin, const ResponsePoint& end) {
  const auto place = [&](const ResponsePoint& point) { return place_of(file, study, point); };
  scene::Scene scene = file.scene;
  for (const auto& [name, value] : branch.set) scene::set(scene, name, value);
  const double from = std::min(place(begin), place(end)), to = std::max(place(begin), place(end));
  if (!(from < to)) return {};
  if (is_of_peaks(study)) {
    auto& range = study.settings.as<observables::CurveRange>();
    range.from = from;
    range.to = to;
  } else {
    study.settings = scene::Settings::of(observables::FrequencyRange{from, to});
  }
  const auto found = run(scene, study);
  if (found.size() != 1 || found.front().status != observables::Status::complete) return {};
  std::vector<ResponsePoint> points = found.front().points;
  if (points.size() < 3) return {};
  if ((place(points.front()) > place(points.back())) != (place(begin) > place(end)))
    std::reverse(points.begin(), points.end());
  if (!is_same(points.front(), begin) || !is_same(points.back(), end)) return {};
  return {points.begin() + 1, points.end() - 1};  // without the two that are there
}

void refine(const SceneFile& file, const scene::Study& study, ResponseBranch& branch) {
  std::vector<ResponsePoint> points;
  std::vector<std::size_t> kept, now;  // points of the branch, and where they are then
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    kept.push_back(i);
    now.push_back(points.size());
    points.push_back(branch.points[i]);
    std::size_t end = i;
    while (end + 1 < branch.points.size() && is_coarse(branch.points[end], branch.points[end + 1])) ++end;
    if (end == i) continue;
    const auto more = between(file, study, branch, branch.points[i], branch.points[end]);
    points.insert(points.end(), more.begin(), more.end());
    if (!more.empty()) i = end - 1;
  }
  branch.points = std::move(points);
  if (kept.empty()) return;
  for (auto& event : branch.events) {  // between the points that are nearer now
    const auto next = std::upper_bound(kept.begin(), kept.end(), event.after) - kept.begin();
    event.after = now[static_cast<std::size_t>(next) - 1];
    const std::size_t end = next < std::ssize(now) ? now[static_cast<std::size_t>(next)] : event.after;
    const double at = place_of(file, study, event.point);
    for (std::size_t k = event.after; k < end; ++k)
      if ((place_of(file, study, branch.points[k]) - at) *
              (place_of(file, study, branch.points[k + 1]) - at) <=
          0)
        event.after = k;
  }
}

}  // namespace

std::vector<ResponseBranch> branches(const SceneFile& file, const std::string& study) {
  auto found = branches(file, file.study(study));
  for (ResponseBranch& branch : found)
    for (int pass = 0; pass < passes; ++pass) refine(file, file.study(study), branch);
  return found;
}

observables::FrequencyRange window_of(const scene::Study& study) {
  if (!is_of_peaks(study)) return study.settings.as<observables::FrequencyRange>();
  const auto& range = study.settings.as<observables::CurveRange>();
  return {range.frequency_from, range.frequency_to};
}

const observables::TimeSettings& time_settings(const SceneFile& file, const std::string& name) {
  const scene::Study& study = file.study(name);
  if (study.type != &studies::time() || !study.for_each.empty())
    throw std::runtime_error(file.name + ": study " + name + " has to be of one motion in time");
  return study.settings.as<observables::TimeSettings>();
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
  const auto found = observables::frequency_response(scene, {frequency, frequency * 1.001});
  if (found.empty() || found.front().points.empty())
    throw std::runtime_error("no response was found at " + results::shortest(frequency) + " " +
                             std::string(scene::unit_name(scene.frequency_unit)));
  return found.front();
}

double set_value(const ResponseBranch& branch) {
  if (branch.set.size() != 1) throw std::runtime_error("a study of a figure has a for_each of one parameter");
  return branch.set.front().second;
}

std::string set_label(const SceneFile& file, const ResponseBranch& branch) {
  const double value = set_value(branch);
  return results::quantity(value, studies::parameter_unit(file.scene, branch.set.front().first));
}

Column frequency(const SceneFile& file) {
  return {"frequency (" + std::string(scene::unit_name(file.scene.frequency_unit)) + ")",
          [&scene = file.scene](const ResponsePoint& p) { return studies::in_scene_unit(scene, p.omega); }};
}

Column over(const SceneFile& file, const ResponseBranch& branch) {
  return {results::with_unit(branch.over, studies::parameter_unit(file.scene, branch.over)),
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
  Block result{label, {}};
  const auto add = [&](const ResponsePoint& point) {
    if (!point.unbounded) result.rows.push_back(row(point, columns));
  };
  std::size_t event = 0;
  for (std::size_t i = 0; i <= branch.points.size(); ++i) {
    for (; event < branch.events.size() && branch.events[event].after < i; ++event)
      add(branch.events[event].point);
    if (i < branch.points.size()) add(branch.points[i]);
  }
  return result;
}

}  // namespace figures
