#pragma once
// The laws of force and the kinds of studies of responses, and running them: from a scene to its results.
//
//   const auto scene = scene::read_file("scene.json", studies::catalogue());
//   results::write_json(out, studies::run(scene));

#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_type.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <vector>

namespace arcslip::elements {

/// All laws of Arcslip, for the catalogue of a reader.
std::vector<const scene::PartType*> laws();

}  // namespace arcslip::elements

namespace arcslip::studies {

const StudyKind& frf();           // frequency responses; settings: observables::FrequencyRange
const StudyKind& trace();         // responses over a parameter; observables::ParameterRange
const StudyKind& peaks();         // resonance peaks over a parameter; observables::CurveRange
const StudyKind& folds();         // folds over a parameter; observables::CurveRange
const StudyKind& bifurcations();  // others over a parameter; observables::BifurcationRange
const StudyKind& time();          // time integration; observables::TimeSettings
const StudyKind& point();         // responses at one frequency; observables::PointSettings
const StudyKind& modes();         // nonlinear modes over the amplitude; observables::ModeRange
const StudyKind& sweep();         // a slow sweep of the frequency; observables::SweepSettings
const StudyKind& accuracy();      // time and error of methods; observables::AccuracySettings

/// All of them.
scene::Catalogue catalogue();

/// The results of every study of a scene, which threads may share. A study that ends early is reported with
/// its reason; exceptions of the callback and of the sink are passed on.
results::Results run(const scene::Scene& scene, const RunOptions& options = {});
/// The same, each passed to the sink as soon as it is computed, and not kept; studies with results in the
/// same list of a document are run consecutively.
void run(const scene::Scene& scene, const RunOptions& options, results::Sink& sink);

}  // namespace arcslip::studies
