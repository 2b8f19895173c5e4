// Curves of resonance peaks, of folds and of other bifurcations, which differ only in the points they
// continue.
#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/studies/branch_keys.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/stability_keys.hpp>

#include <array>

namespace arcslip::studies {
namespace {

using observables::BifurcationRange;
using observables::BifurcationsOf;
using observables::CurveRange;
using observables::Resonance;

constexpr std::array<scene::file::Word<BifurcationsOf>, 4> bifurcations_of = {
    {{"all", BifurcationsOf::all},
     {observables::event_kinds::period_doubling.name, BifurcationsOf::period_doubling},
     {observables::event_kinds::neimark_sacker.name, BifurcationsOf::neimark_sacker},
     {observables::event_kinds::symmetry_breaking.name, BifurcationsOf::symmetry_breaking}}};

scene::file::KeysOf<BifurcationRange> keys_of_bifurcations() {
  scene::file::KeysOf<BifurcationRange> keys;
  keys.add(scene::file::word("of", &BifurcationRange::of, bifurcations_of, "the kind of bifurcation"));
  keys.add(scene::file::range_over(&BifurcationRange::over, &BifurcationRange::from, &BifurcationRange::to));
  keys.add(scene::file::window(&BifurcationRange::frequency_from, &BifurcationRange::frequency_to));
  add_branch_keys(keys,
                  "bifurcations of the branch that begins at the lower end of the window, or also of all "
                  "that leave it, as for a frequency response");
  return keys;
}

constexpr std::array<scene::file::Word<Resonance>, 2> resonances = {
    {{"amplitude", Resonance::amplitude}, {"phase", Resonance::phase}}};

scene::file::KeysOf<CurveRange> keys_of_curves() {
  scene::file::KeysOf<CurveRange> keys;
  keys.add(scene::file::range_over(&CurveRange::over, &CurveRange::from, &CurveRange::to));
  keys.add(scene::file::window(&CurveRange::frequency_from, &CurveRange::frequency_to));
  add_stability_keys(keys, stability_of_points_help);
  return keys;
}

scene::file::KeysOf<CurveRange> keys_of_peaks() {
  scene::file::KeysOf<CurveRange> all = keys_of_curves();
  all.add(
      scene::file::word("resonance", &CurveRange::resonance, resonances,
                        "what counts as a resonance: the largest amplitude, or a phase lag of 90 degrees"));
  return all;
}

}  // namespace

const StudyKind& peaks() {
  static const StudyKind kind(
      {.name = "peaks", .help = "resonance peaks over a parameter, with their minima and maxima"},
      keys_of_peaks(), computed_branches<observables::resonance_peaks, BranchKind::peaks, CurveRange>);
  return kind;
}

const StudyKind& folds() {
  static const StudyKind kind(
      {.name = "folds", .help = "folds of the frequency response over a parameter, with their cusps"},
      keys_of_curves(), computed_branches<observables::fold_curves, BranchKind::folds, CurveRange>);
  return kind;
}

const StudyKind& bifurcations() {
  static const StudyKind kind(
      {.name = "bifurcations",
       .help = "period doublings, Neimark-Sacker points and symmetry breaking over a parameter, with their "
               "resonances"},
      keys_of_bifurcations(),
      computed_branches<observables::bifurcation_curves, BranchKind::bifurcations, BifurcationRange>);
  return kind;
}

}  // namespace arcslip::studies
