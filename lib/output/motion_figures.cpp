#include <arcslip/output/draw_figures.hpp>
#include <arcslip/output/gnuplot_script.hpp>
#include <arcslip/output/motion.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>

namespace arcslip::output {
namespace {

using observables::Motion;

constexpr std::size_t most_instants = 20'000;

/// The names of the friction elements, in the order of the first history that has any.
std::vector<std::string> friction_of(std::span<const Motion> motions) {
  std::vector<std::string> names;
  for (const Motion& motion : motions) {
    for (const time::ElementHistory& element : motion.history.elements) {
      if (!element.slider.empty()) {
        names.push_back(element.name);
      }
    }
    if (!names.empty()) {
      break;
    }
  }
  return names;
}

Record record(const time::History& history, std::size_t i) {
  Record values{history.time[i], history.displacement[i]};
  for (const time::ElementHistory& element : history.elements) {
    if (!element.slider.empty()) {
      values.insert(values.end(), {element.displacement[i], element.force[i]});
    }
  }
  return values;
}

std::vector<Record> records(const time::History& history) {
  std::vector<Record> all;
  const std::size_t count = history.time.size();
  const std::size_t stride = (count + most_instants - 1) / most_instants;
  for (std::size_t i = 0; i < count; i += stride) {
    all.push_back(record(history, i));
  }
  if (count > 0 && (count - 1) % stride != 0) {
    all.push_back(record(history, count - 1));
  }
  return all;
}

}  // namespace

FigureData figure_data(const scene::Scene& scene, std::span<const Motion> motions) {
  FigureData data;
  data.kind = scene::StudyKind::time;
  data.title = scene.title;
  data.friction = friction_of(motions);
  data.columns = {{"time (s)"}, {"displacement (m)"}};
  for (const std::string& element : data.friction) {
    data.columns.push_back({element + " displacement (m)"});
    data.columns.push_back({element + " force (N)"});
  }
  for (const Motion& motion : motions) {
    if (motion.history.time.empty()) {
      continue;
    }
    if (data.parameters.empty()) {
      for (const auto& [name, value] : motion.set) {
        data.parameters.push_back(name);
      }
    }
    data.lines.push_back({set_label(scene, motion.set), motion.set, {records(motion.history)}, {}});
  }
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    data.columns[i].range = full_range(data, i);
  }
  return data;
}

Figures write_figures(const scene::Scene& scene, scene::StudyKind /*time*/, std::span<const Motion> motions,
                      const std::string& folder, const std::string& name, const scene::StopRequest& stop) {
  return draw_figures(scene, figure_data(scene, motions), folder, name, stop);
}

}  // namespace arcslip::output
