// Ensembles: files of samples.

#include "bindings.hpp"
#include "supervised.hpp"

#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/model/reduction_report.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/windows.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace arcslip::python {
namespace {

/// The scene with a window of its study, which is proposed where it has none.
scene::Scene with_window(scene::Scene scene, std::size_t study, const control::Control& control) {
  observables::prepare(scene, control);
  studies::propose_window(scene, study, control);
  return scene;
}

/// Computes samples begin to end - 1 of a study into a file. Returns how many are there, how many of them are
/// not complete, and what ended it: None, or the exception of a signal or of `report`.
nb::tuple run_ensemble(const scene::Scene& scene, std::size_t study, const std::string& keep,
                       const std::string& path, std::pair<long, long> samples, int threads,
                       const nb::object& report) {
  if (study >= scene.studies.size()) throw nb::index_error("no such study");
  ensemble::Outcome outcome;
  const auto ended_by = supervised(report, [&](const control::Control& control) {
    const scene::Scene whole = with_window(scene, study, control);
    const auto show = [&](const ensemble::Progress& now) {
      control::Progress progress;
      progress.branch = static_cast<int>(now.done);
      progress.branches = static_cast<int>(now.all);
      progress.points = now.failed;
      progress.item = "sample";
      progress.counted = "not complete";
      control.report(progress);
    };
    outcome = ensemble::run(whole, whole.studies[study],
                            {.path = path,
                             .keep = keep,
                             .samples = ensemble::Range{samples.first, samples.second},
                             .threads = threads,
                             .report = show,
                             .control = control});
  });
  const nb::object error = ended_by ? nb::borrow(ended_by->value()) : nb::none();
  return nb::make_tuple(outcome.progress.done, outcome.progress.failed, error);
}

/// The samples that the file of an ensemble does not have, as pairs of the first one and the one behind the
/// last.
std::vector<std::pair<long, long>> missing_samples(const scene::Scene& scene, std::size_t study,
                                                   const std::string& keep, const std::string& path) {
  std::vector<std::pair<long, long>> all;
  if (study >= scene.studies.size()) throw nb::index_error("no such study");
  const scene::Scene whole = with_window(scene, study, {});
  for (const ensemble::Range& range :
       ensemble::prepare_file(whole, whole.studies[study], {.path = path, .keep = keep}))
    all.emplace_back(range.begin, range.end);
  return all;
}

}  // namespace

void bind_ensembles(nb::module_& core) {
  core.def("run_ensemble", run_ensemble, nb::arg("scene"), nb::arg("study"), nb::arg("keep"), nb::arg("path"),
           nb::arg("samples"), nb::arg("threads"), nb::arg("report").none());
  core.def("missing_samples", missing_samples, nb::arg("scene"), nb::arg("study"), nb::arg("keep"),
           nb::arg("path"));
  core.def("add_statistics", ensemble::add_statistics, nb::arg("path"));
}

}  // namespace arcslip::python
