#include <arcslip/studies/figures.hpp>

namespace arcslip::studies {
namespace {

using observables::Motion;
using results::FigureData;
using results::Record;

constexpr std::size_t most_instants = 20'000;

/// The indices of the friction elements.
std::vector<std::size_t> friction_of(const scene::Scene& scene) {
  std::vector<std::size_t> indices;
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    if (scene.elements[e].type == &scene::jenkins_type) {
      indices.push_back(e);
    }
  }
  return indices;
}

Record record(const time::History& history, const std::vector<std::size_t>& friction, std::size_t i) {
  Record values{history.time[i], history.displacement[i]};
  for (const std::size_t e : friction) {
    const bool is_there = e < history.elements.size();  // not in a motion that could not be integrated
    values.push_back(is_there ? history.elements[e].displacement[i] : observables::no_value);
    values.push_back(is_there ? history.elements[e].force[i] : observables::no_value);
  }
  return values;
}

std::vector<Record> records(const time::History& history, const std::vector<std::size_t>& friction) {
  std::vector<Record> all;
  const std::size_t count = history.time.size();
  const std::size_t stride = (count + most_instants - 1) / most_instants;
  for (std::size_t i = 0; i < count; i += stride) {
    all.push_back(record(history, friction, i));
  }
  if (count > 0 && (count - 1) % stride != 0) {
    all.push_back(record(history, friction, count - 1));
  }
  return all;
}

void set_figures(const scene::Scene& scene, const std::vector<std::size_t>& friction, FigureData& data) {
  const auto& columns = data.columns;
  data.figures = {{"displacement", 0, 1, columns[0].label, columns[1].label}};
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const std::size_t q = 2 + 2 * i;
    const std::string of =
        friction.size() > 1 ? "_" + std::to_string(i + 1) + "_" + scene.elements[friction[i]].name : "";
    data.figures.push_back({"hysteresis" + of, q, q + 1, columns[q].label, columns[q + 1].label});
    data.figures.push_back({"force" + of, 0, q + 1, columns[0].label, columns[q + 1].label});
  }
}

}  // namespace

FigureData figures_of(const scene::Scene& scene, std::span<const Motion> motions) {
  FigureData data;
  data.title = scene.title;
  const std::vector<std::size_t> friction = friction_of(scene);
  data.columns = {{"time (s)"}, {"displacement (m)"}};
  for (const std::size_t e : friction) {
    data.columns.push_back({scene.elements[e].name + " displacement (m)"});
    data.columns.push_back({scene.elements[e].name + " force (N)"});
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
    data.lines.back().parts = {records(motion.history, friction)};
  }
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    data.columns[i].range = results::full_range(data, i);
  }
  set_figures(scene, friction, data);
  return data;
}

}  // namespace arcslip::studies
