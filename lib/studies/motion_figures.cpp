#include <arcslip/studies/figures.hpp>

namespace arcslip::studies {
namespace {

using observables::Motion;
using results::FigureData;
using results::Record;

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

void set_figures(const std::vector<std::string>& friction, FigureData& data) {
  const auto& columns = data.columns;
  data.figures = {{"displacement", 0, 1, columns[0].label, columns[1].label}};
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const std::size_t q = 2 + 2 * i;
    const std::string of = friction.size() > 1 ? "_" + std::to_string(i + 1) + "_" + friction[i] : "";
    data.figures.push_back({"hysteresis" + of, q, q + 1, columns[q].label, columns[q + 1].label});
    data.figures.push_back({"force" + of, 0, q + 1, columns[0].label, columns[q + 1].label});
  }
}

}  // namespace

FigureData figures_of(const scene::Scene& scene, std::span<const Motion> motions) {
  FigureData data;
  data.title = scene.title;
  const std::vector<std::string> friction = friction_of(motions);
  data.columns = {{"time (s)"}, {"displacement (m)"}};
  for (const std::string& element : friction) {
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
    data.lines.push_back(line_of(scene, motion.set));
    data.lines.back().parts = {records(motion.history)};
  }
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    data.columns[i].range = results::full_range(data, i);
  }
  set_figures(friction, data);
  return data;
}

}  // namespace arcslip::studies
