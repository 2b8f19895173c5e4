// Friction force in phase and out of phase with the displacement: over a period (Fig. 14) and at the
// resonance peaks over stick (Figs. 15 to 19), of the fundamental and by the paper's largest values over the
// period.

#include "figures.hpp"
#include "studies.hpp"

#include <arcslip/observables/histories.hpp>

#include <cmath>

namespace figures {
namespace {

using namespace arcslip;

DataFile parts_over_period(const SceneFile& file) {
  DataFile figure{
      "figure_14", "Cosine and sine parts of the friction force over a period", file.name, {}, {}};
  figure.columns = {"angle (rad)", "displacement (m)", "force (N)", "cosine part (N)", "sine part (N)"};
  const auto branch = response_at(file.scene, time_settings(file, "phases").frequency);
  const auto& point = branch.points.front();
  const auto history = observables::history(file.scene, branch, point, observables::loop_angles(point, 720));
  const auto& damper = history.elements.front();
  Block period{"one period", {}};
  for (std::size_t k = 0; k < history.angle.size(); ++k)
    period.rows.push_back(
        {history.angle[k], history.displacement[k], damper.series[k], damper.cosine[k], damper.sine[k]});
  Block turns{"theta_0 and theta*", {}};
  const auto& element = point.elements.front();
  for (const double theta : {element.theta_0, element.theta_star}) {
    if (!std::isfinite(theta)) continue;
    const auto at = observables::history(file.scene, branch, point, std::vector<double>{theta});
    const auto& there = at.elements.front();
    turns.rows.push_back({theta, at.displacement[0], there.series[0], there.cosine[0], there.sine[0]});
  }
  figure.blocks = {period, turns};
  return figure;
}

const Column in_phase{"in phase, fundamental (N)",
                      [](const ResponsePoint& p) { return p.elements.front().fundamental.in_phase; }};
const Column out_of_phase{"out of phase, fundamental (N)",
                          [](const ResponsePoint& p) { return p.elements.front().fundamental.out_of_phase; }};
const Column force{"force, fundamental (N)",
                   [](const ResponsePoint& p) { return std::hypot(in_phase.of(p), out_of_phase.of(p)); }};
const Column sine_maximum{"sine part, largest (N)",
                          [](const ResponsePoint& p) { return p.elements.front().maxima.sine; }};
const Column cosine_maximum{"cosine part, largest (N)",
                            [](const ResponsePoint& p) { return p.elements.front().maxima.cosine; }};
const Column force_maximum{"force, largest (N)",
                           [](const ResponsePoint& p) { return p.elements.front().maxima.force; }};

const Column per_displacement_in{"F_p/x, fundamental (N/m)",
                                 [](const ResponsePoint& p) { return p.forces.total().in_phase; }};
const Column per_displacement_out{"F_o/x, fundamental (N/m)",
                                  [](const ResponsePoint& p) { return p.forces.total().out_of_phase; }};
const Column per_displacement_in_maxima{"F_p/x, largest values (N/m)", [](const ResponsePoint& p) {
                                          return p.maxima.force_per_displacement.in_phase;
                                        }};
const Column per_displacement_out_maxima{"F_o/x, largest values (N/m)", [](const ResponsePoint& p) {
                                           return p.maxima.force_per_displacement.out_of_phase;
                                         }};

const Column contact_part{"contact, fundamental (N/m)",
                          [](const ResponsePoint& p) { return p.forces.contact.out_of_phase; }};
const Column viscous_part{"viscous, fundamental (N/m)",
                          [](const ResponsePoint& p) { return p.forces.viscous; }};
const Column contact_part_maxima{"contact, largest values (N/m)", [](const ResponsePoint& p) {
                                   return p.elements.front().maxima.cosine / p.amplitude;
                                 }};
const Column viscous_part_maxima{"viscous, largest values (N/m)", [](const ResponsePoint& p) {
                                   return p.maxima.force_per_displacement.out_of_phase -
                                          contact_part_maxima.of(p);
                                 }};

}  // namespace

std::vector<DataFile> components(const std::string& scenes) {
  const SceneFile file = read_scene(scenes, "components.scene.json");
  const auto curves = branches(file, "peaks");
  const Column load = over(file, curves.front());
  const auto over_stick = [&](const std::string& name, const std::string& title, std::vector<Column> columns,
                              const std::string& special) {
    columns.insert(columns.begin(), stick);
    columns.push_back(load);
    DataFile figure{name, title, file.name, names(columns), {}};
    for (const ResponseBranch& curve : curves)
      figure.blocks.push_back(block("c = " + set_label(file, curve), curve, columns));
    if (special.empty()) return figure;
    for (const ResponseBranch& curve : curves)
      for (const auto& event : curve.events)
        if (event.kind == special)
          figure.blocks.push_back({"least peak, c = " + set_label(file, curve), {row(event.point, columns)}});
    return figure;
  };
  return {
      parts_over_period(file),
      over_stick("figure_15", "Friction force in phase and out of phase at the peaks",
                 {in_phase, out_of_phase, force, sine_maximum, cosine_maximum, force_maximum}, ""),
      over_stick("figure_16", "Amplitude of the peaks with and without viscous damping", {amplitude},
                 "minimum"),
      over_stick("figure_17", "Forces per displacement at the peaks, in phase and out of phase",
                 {per_displacement_in, per_displacement_out, per_displacement_in_maxima,
                  per_displacement_out_maxima},
                 ""),
      over_stick("figure_18", "Parts of the out-of-phase force per displacement at the peaks",
                 {contact_part, viscous_part, contact_part_maxima, viscous_part_maxima}, ""),
      over_stick("figure_19", "Amplitude, energy of friction and out-of-phase force at the peaks",
                 {amplitude, friction_energy, per_displacement_out, per_displacement_out_maxima}, "minimum")};
}

}  // namespace figures
