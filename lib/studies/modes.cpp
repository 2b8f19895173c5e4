// The study "modes": nonlinear modes over the amplitude.
#include <arcslip/observables/nonlinear_modes.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <limits>

namespace arcslip::studies {
namespace {

using observables::ModeRange;

constexpr int most_modes = 10'000;
constexpr double largest_amplitude = 1e100;

scene::file::KeysOf<ModeRange> keys() {
  scene::file::KeysOf<ModeRange> keys;
  keys.add(scene::file::whole("mode", &ModeRange::mode, 1, most_modes,
                              "the number of the mode, by the frequency of the structure at rest"));
  keys.add(scene::file::window_of(&ModeRange::from, &ModeRange::to,
                                  {"amplitude", "m", 0, largest_amplitude, true},
                                  "amplitudes of the response: half the way between its extremes over the "
                                  "period"));
  return keys;
}

}  // namespace

const scene::StudyType& modes() {
  static const StudyOf<ModeRange, observables::ResponseBranch> type(
      branch_kind<observables::nonlinear_modes, BranchKind::modes>(
          "modes", "frequency and damping ratio of a nonlinear mode over its amplitude", keys()));
  return type;
}

}  // namespace arcslip::studies
