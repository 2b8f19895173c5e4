// The study "modes": nonlinear modes over the amplitude.
#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <limits>

namespace arcslip::studies {
namespace {

using observables::ModeRange;

constexpr int most_modes = 10'000;
constexpr int most_true_peaks = 1000;
constexpr double largest_amplitude = 1e100;

scene::file::KeysOf<ModeRange> keys_of_modes() {
  scene::file::KeysOf<ModeRange> keys;
  keys.add(scene::file::whole("mode", &ModeRange::mode, 1, most_modes,
                              "number of the mode, by ascending frequency of the structure at rest"));
  keys.add(scene::file::window_of(
      &ModeRange::from, &ModeRange::to, {"amplitude", "m", 0, largest_amplitude, true},
      "amplitudes of the response: half the difference of its extremes over the period"));
  keys.add(scene::file::whole("true_peaks", &ModeRange::true_peaks, 0, most_true_peaks,
                              "number of amplitudes, logarithmically spaced, at which to compute the true "
                              "peak of the frequency response, to compare with the predicted one"));
  return keys;
}

}  // namespace

const StudyKind& modes() {
  static const StudyKind kind(
      {.name = "modes", .help = "frequency and damping ratio of a nonlinear mode over its amplitude"},
      keys_of_modes(), computed_branches<observables::nonlinear_modes, BranchKind::modes, ModeRange>);
  return kind;
}

}  // namespace arcslip::studies
