// Friction force over a period: histories and loops of one harmonic, of all and of the motion in time (Figs.
// 3 and 4), the error of one harmonic over the load (Fig. 5), loops of the three states of contact (Fig. 7).

#include "figures.hpp"
#include "studies.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/observables/histories.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <cmath>
#include <stdexcept>

namespace figures {
namespace {

using namespace arcslip;

constexpr int angles_of_errors = 1440;

scene::Scene with_order(scene::Scene scene, int order) {
  scene.harmonics.order = order;
  return scene;
}

std::string order_label(const scene::Scene& scene) {
  return "N = " + std::to_string(scene.harmonics.order);
}

/// angle, time, displacement, force.
using Rows = std::vector<std::vector<double>>;

Rows balanced(const scene::Scene& scene, double frequency, const time::TimeHistory& nearby) {
  std::vector<double> angles;
  const double omega = frequency * scene::to_rad_per_s(scene.frequency_unit);
  for (const double t : nearby.time) angles.push_back(omega * t);
  const auto branch = response_at(scene, frequency);
  const auto history = observables::history(scene, branch, branch.points.front(), angles);
  Rows rows;
  for (std::size_t k = 0; k < angles.size(); ++k)
    rows.push_back({angles[k], nearby.time[k], history.displacement[k], history.elements.front().series[k]});
  return rows;
}

void add_histories(const SceneFile& file, std::vector<DataFile>& figures) {
  const auto& settings = time_settings(file, "history");
  const auto motion = observables::motion_in_time(file.scene, settings);
  if (motion.status != observables::Status::complete)
    throw std::runtime_error(file.name + ": study history is no steady motion in time");
  const scene::Scene one = with_order(file.scene, 1);
  Rows in_time;
  for (std::size_t k = 0; k < motion.history.time.size(); ++k)
    in_time.push_back({motion.omega * motion.history.time[k], motion.history.time[k],
                       motion.history.displacement[k], motion.history.elements.front().force[k]});
  DataFile forces{"figure_03", "Friction force over a period", file.name, {}, {}};
  forces.columns = {"angle (rad)", "time (s)", "force (N)", "next to the force in time (N)"};
  DataFile loops{"figure_04", "Friction force over the displacement", file.name, {}, {}};
  loops.columns = {"displacement (m)", "force (N)"};
  const auto& element = motion.history.elements.front();
  const auto add = [&](const std::string& label, const Rows& rows) {
    Block force{label, {}}, loop{label, {}};
    for (std::size_t k = 0; k < rows.size(); ++k) {
      force.rows.push_back({rows[k][0], rows[k][1], rows[k][3], rows[k][3] - element.force[k]});
      loop.rows.push_back({rows[k][2], rows[k][3]});
    }
    forces.blocks.push_back(force);
    loops.blocks.push_back(loop);
  };
  add("time solution", in_time);
  add(order_label(file.scene), balanced(file.scene, settings.frequency, motion.history));
  add(order_label(one), balanced(one, settings.frequency, motion.history));
  figures.push_back(forces);
  figures.push_back(loops);
}

/// Of the force with one harmonic, at its own peak, from that of all harmonics at theirs.
observables::ForceDifference error_of_one(const scene::Scene& scene,
                                          const observables::FrequencyRange& window,
                                          const std::vector<double>& force) {
  const scene::Scene one = with_order(scene, 1);
  const auto found = observables::frequency_response(one, window);
  if (found.empty()) throw std::runtime_error("no response with one harmonic");
  const auto history = observables::history(one, found.front(), peak(found.front()),
                                            observables::even_angles(angles_of_errors));
  return observables::force_difference(history.elements.front().series, force);
}

DataFile errors_over_load(const SceneFile& file) {
  DataFile figure{
      "figure_05", "Error of the force of one harmonic at the resonance peaks", file.name, {}, {}};
  const auto add = [&](const ResponseBranch& branch, const ResponsePoint& point,
                       const observables::FrequencyRange& window, double load, Block& block) {
    scene::Scene scene = file.scene;
    scene::set(scene, branch.over.empty() ? branch.set.front().first : branch.over, load);
    const auto history =
        observables::history(file.scene, branch, point, observables::even_angles(angles_of_errors));
    const auto error = error_of_one(scene, window, history.elements.front().series);
    block.rows.push_back(
        {load, stick.of(point), 100 * error.amplitude, 100 * error.rms, 100 * error.maximum});
  };
  Block curve{"curve of peaks", {}}, chosen{"chosen loads", {}};
  const auto curves = branches(file, "error");
  const auto window = window_of(file.study("error")), window_at = window_of(file.study("error_at"));
  for (const auto& branch : curves)
    for (const auto& point : branch.points)
      if (!point.unbounded) add(branch, point, window, point.over, curve);
  for (const auto& branch : branches(file, "error_at"))
    add(branch, peak(branch), window_at, set_value(branch), chosen);
  figure.columns = {over(file, curves.front()).name, stick.name, "error of the largest force (%)",
                    "error in the root mean square (%)", "largest error (%)"};
  figure.blocks = {curve, chosen};
  return figure;
}

DataFile loop_shapes(const SceneFile& file) {
  DataFile figure{
      "figure_07", "Loops of the three states of contact, at the resonance peaks", file.name, {}, {}};
  figure.columns = {"displacement over its largest (-)",
                    "force over the slip limit (-)",
                    "displacement (m)",
                    "force (N)",
                    stick.name,
                    "slope of stick (-)"};
  for (const auto& branch : branches(file, "loops")) {
    const ResponsePoint& point = peak(branch);
    const auto history =
        observables::history(file.scene, branch, point, observables::loop_angles(point, 720));
    const auto& damper = history.elements.front();
    scene::Scene scene = file.scene;
    scene::set(scene, branch.set.front().first, set_value(branch));
    const auto& values = scene.elements.front().values;  // k_d, mu, Fn
    const double limit = values[1] * values[2], slope = values[0] * point.amplitude / limit;
    Block block{
        set_label(file, branch) + ", τ = " + results::shortest(std::round(10 * stick.of(point)) / 10) + " %",
        {}};
    for (std::size_t k = 0; k < history.angle.size(); ++k)
      block.rows.push_back({damper.displacement[k] / point.amplitude, damper.force[k] / limit,
                            damper.displacement[k], damper.force[k], stick.of(point), slope});
    figure.blocks.push_back(block);
  }
  return figure;
}

}  // namespace

std::vector<DataFile> contact(const std::string& scenes) {
  const SceneFile file = read_scene(scenes, "contact.scene.json");
  std::vector<DataFile> figures;
  add_histories(file, figures);
  figures.push_back(errors_over_load(file));
  figures.push_back(loop_shapes(file));
  return figures;
}

}  // namespace figures
