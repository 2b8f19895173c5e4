// Frequency responses, stick over frequency and the peaks over stick (Fig. 6).

#include "figures.hpp"
#include "studies.hpp"

namespace figures {

std::vector<DataFile> responses(const std::string& scenes) {
  const SceneFile file = read_scene(scenes, "scene.json");
  DataFile amplitudes{"figure_06a", "Frequency responses for several normal loads", file.name, {}, {}};
  DataFile sticking{"figure_06b", "Share of the period in stick for several normal loads", file.name, {}, {}};
  DataFile least{"figure_06c", "Amplitude of the resonance peaks over the share of stick", file.name, {}, {}};
  const std::vector<Column> over_frequency{frequency(file), amplitude};
  const std::vector<Column> stick_over_frequency{frequency(file), stick};
  const auto curves = branches(file, "peaks");
  const std::vector<Column> over_stick{stick, amplitude, over(file, curves.front()), frequency(file)};
  for (const ResponseBranch& curve : curves) {
    least.blocks.push_back(block("curve of peaks", curve, over_stick));
    for (const auto& event : curve.events)
      if (event.kind == "minimum") least.blocks.push_back({"least peak", {row(event.point, over_stick)}});
  }
  Block peaks{"peaks of the frequency responses", {}};
  for (const ResponseBranch& branch : branches(file, "frf")) {
    const std::string label = set_label(file, branch);
    amplitudes.blocks.push_back(block(label, branch, over_frequency));
    sticking.blocks.push_back(block(label, branch, stick_over_frequency));
    ResponsePoint highest = peak(branch);
    highest.over = set_value(branch);
    peaks.rows.push_back(row(highest, over_stick));
  }
  least.blocks.push_back(peaks);
  amplitudes.columns = names(over_frequency);
  sticking.columns = names(stick_over_frequency);
  least.columns = names(over_stick);
  return {amplitudes, sticking, least};
}

}  // namespace figures
