// Energies dissipated in a period, over frequency (Figs. 8 to 11 and 13) and at the peaks over stick (Fig.
// 12).

#include "figures.hpp"
#include "studies.hpp"

namespace figures {
namespace {

DataFile over_frequency(const std::string& name, const std::string& title, const SceneFile& file,
                        const std::vector<ResponseBranch>& branches, const Column& quantity) {
  const std::vector<Column> columns{frequency(file), quantity};
  DataFile figure{name, title, file.name, names(columns), {}};
  for (const ResponseBranch& branch : branches)
    figure.blocks.push_back(block(set_label(file, branch), branch, columns));
  return figure;
}

DataFile over_stick(const SceneFile& file) {
  const auto curves = branches(file, "peaks");
  const std::vector<Column> columns{stick,          friction_energy, viscous_energy,
                                    total_energy,   friction_share,  over(file, curves.front()),
                                    frequency(file)};
  DataFile figure{
      "figure_12", "Energies at the resonance peaks over the share of stick", file.name, names(columns), {}};
  for (const ResponseBranch& curve : curves) figure.blocks.push_back(block("curve of peaks", curve, columns));
  return figure;
}

}  // namespace

std::vector<DataFile> energies(const std::string& scenes) {
  const SceneFile file = read_scene(scenes, "energies.scene.json");
  const auto three = branches(file, "three_states"), loads = branches(file, "loads"),
             high = branches(file, "high_loads");
  return {
      over_frequency("figure_08", "Energy of friction in the three states of contact", file, three,
                     friction_energy),
      over_frequency("figure_09", "Amplitude in the three states of contact", file, three, amplitude),
      over_frequency("figure_10a", "Energy of friction", file, loads, friction_energy),
      over_frequency("figure_10b", "Energy of friction near full stick", file, high, friction_energy),
      over_frequency("figure_11", "Total energy dissipated", file, loads, total_energy),
      over_stick(file),
      over_frequency("figure_13", "Share of friction in the energy dissipated", file, loads, friction_share)};
}

}  // namespace figures
