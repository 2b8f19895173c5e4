#include "verbs.hpp"

#include "ensembles.hpp"
#include "interrupt.hpp"
#include "new_scene.hpp"
#include "output/message.hpp"
#include "output/results.hpp"
#include "output/results_folder.hpp"
#include "output/standard_output.hpp"
#include "result_file.hpp"

#include <arcslip/analyses/branches/model_description.hpp>
#include <arcslip/model/reduced_scene.hpp>
#include <arcslip/model/reduction_report.hpp>
#include <arcslip/output/atomic_file.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/results/version.hpp>
#include <arcslip/scene/files/manifest.hpp>
#include <arcslip/studies/highest_harmonic.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/windows.hpp>

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {
namespace {

void tell_beyond_reduction(const scene::Scene& scene, const std::vector<scene::Study>& studies) {
  for (const scene::Study& study : studies)
    if (const std::string doubt = scene::beyond_reduction(scene, study); !doubt.empty())
      tell("the study \"" + study.name + "\" has " + doubt);
}

void tell_rough_reduction(const scene::Scene& scene) {
  if (scene.studies.empty())
    if (const std::string doubt = studies::doubt_of_reduction(scene, 0, by_signal()); !doubt.empty())
      tell(doubt);
  for (const scene::Study& study : scene.studies)
    if (const std::string doubt =
            studies::doubt_of_reduction(scene, scene::highest_harmonic(scene, study), by_signal());
        !doubt.empty())
      tell("for the study \"" + study.name + "\" " + doubt);
}

/// Proposes the windows that studies from `first` to `last` leave out. Returns a sentence for each.
std::vector<std::string> propose_windows(scene::Scene& scene, std::size_t first, std::size_t last,
                                         const CommandOptions& options) {
  std::vector<std::string> notes;
  for (std::size_t i = first; i < last; ++i)
    if (std::string note = studies::propose_window(scene, i, by_signal()); !note.empty()) {
      if (!options.quiet) tell(note);
      notes.push_back(std::move(note));
    }
  return notes;
}

ExitCode check(scene::Scene& scene, const CommandOptions& options) {
  propose_windows(scene, 0, scene.studies.size(), options);
  tell_beyond_reduction(scene, scene.studies);
  tell_rough_reduction(scene);
  if (!options.quiet) {
    const auto windows = studies::windows_of(scene);
    const auto model = observables::describe_model(scene, windows, by_signal());
    for (const std::string& fact : model.facts) tell(fact);
    for (const std::string& doubt : model.doubts) tell("check this: " + doubt);
    StandardOutput screen;
    screen.write_lines([&](std::ostream& out) { out << scene::write(scene); });
    screen.finish();
  }
  return ExitCode::done;
}

/// The reduced structure as files, and the scene with it.
ExitCode reduce(const scene::Scene& scene, const CommandOptions& options) {
  tell_beyond_reduction(scene, scene.studies);
  const std::filesystem::path folder =
      options.out.empty()
          ? std::filesystem::path("out") / (std::filesystem::path(options.scene).stem().string() + "_reduced")
          : std::filesystem::path(options.out);
  std::vector<double> frequencies;
  for (const scene::Study& study : scene.studies)
    frequencies.push_back(scene::highest_harmonic(scene, study));
  model::ReducedScene reduced = model::reduced_scene(scene, folder.string(), by_signal(), frequencies);
  tell_rough_reduction(scene);
  reduced.files.emplace_back("reduced.json", std::move(reduced.scene));
  const std::vector<std::string> sources = sources_of(scene, options.scene);
  ResultsFolder held(folder.string(), sources);
  std::vector<OutputPath> places = {{"the manifest of the folder", held.manifest_path()}};
  scene::FileSet set{
      "the reduced structure", "arcslip " + std::string(results::version()), scene::hash(scene), false, {}};
  for (const auto& [name, text] : reduced.files) {
    places.push_back({"the reduced structure", (folder / name).string()});
    set.files.push_back({name});
  }
  check_places(places, sources);
  places.erase(places.begin());
  Writing writing;
  std::ostringstream written;
  std::vector<std::string> paths;
  if (!writing.attempt("the manifest", [&] { held.begin_set(set); })) return writing.code(ExitCode::done);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (writing.attempt(results::visible(places[i].path), [&] {
          output::write_file(
              places[i].path, [&](std::ostream& out) { out << reduced.files[i].second; }, by_signal());
        })) {
      paths.push_back(places[i].path);
      written << results::visible(places[i].path) << '\n';
    }
  writing.attempt("the manifest", [&] { held.end_set(set.name, paths, paths.size() == places.size()); });
  if (!options.quiet) {
    StandardOutput screen;
    screen.write_lines([&](std::ostream& out) { out << written.str(); });
    writing.attempt("standard output", [&] { screen.finish(); });
  }
  return writing.code(ExitCode::done);
}

/// Runs studies of the scene from `first` to `last`.
ExitCode compute(scene::Scene& scene, std::size_t first, std::size_t last, const CommandOptions& options) {
  const std::vector<std::string> notes = propose_windows(scene, first, last, options);
  const std::vector<scene::Study> studies(scene.studies.begin() + static_cast<std::ptrdiff_t>(first),
                                          scene.studies.begin() + static_cast<std::ptrdiff_t>(last));
  tell_beyond_reduction(scene, studies);
  return run_studies(scene, studies, options, notes);
}

/// A scene to begin with, on standard output or in a file that does not exist yet.
ExitCode write_new(const CommandOptions& options, const scene::Catalogue& catalogue) {
  NewScene made = new_scene(options, catalogue, by_signal());
  if (options.out.empty()) {
    StandardOutput screen;
    screen.write_lines([&](std::ostream& out) { out << made.text; });
    screen.finish();
    return ExitCode::done;
  }
  made.files.emplace_back(options.out, made.text);
  for (const auto& [path, text] : made.files)
    if (std::filesystem::exists(path))
      throw UsageError(results::visible(path) + " exists: choose another name for the scene, or remove it");
  Writing writing;
  for (const auto& [path, text] : made.files)
    writing.attempt(results::visible(path),
                    [&] { output::write_file(path, [&](std::ostream& out) { out << text; }, by_signal()); });
  return writing.code(ExitCode::done);
}

ExitCode run_scene(scene::Scene scene, CommandOptions options) {
  if (scene.studies.empty()) {
    throw UsageError(
        "the scene has no studies, so there is nothing to run: add one to \"studies\", or use "
        "arcslip frf");
  }
  bool any = options.keys.empty();
  for (std::size_t i = 0; i < scene.studies.size() && !options.keys.empty(); ++i) {
    if (takes_keys(scene.studies[i], options)) {
      scene = with_options(scene, i, options);
      any = true;
    }
  }
  if (!any) {
    throw UsageError(
        "with run, --from and --to apply to frequency responses, but the scene has none: use the verb of the "
        "study's kind");
  }
  if (options.out.empty())
    options.out = (std::filesystem::path("out") / std::filesystem::path(options.scene).stem()).string();
  return compute(scene, 0, scene.studies.size(), options);
}

}  // namespace

ExitCode execute(const CommandOptions& options, const scene::Catalogue& catalogue) {
  if (options.verb == merge_verb) return merge_ensemble(options);
  if (options.verb == "new") return write_new(options, catalogue);
  if (options.verb == "show") return show_results(options);
  if (options.verb == "plot") return plot_results(options);
  if (options.verb == "compare") return compare_results(options);
  scene::Scene scene = resolve(options, catalogue);
  for (const std::string& doubt : scene::manifest_doubts(scene, options.scene).changed) tell(doubt);
  if (const std::string done = observables::prepare(scene, by_signal()); !done.empty() && !options.quiet)
    tell(done);
  if (options.verb == "run") return run_scene(std::move(scene), options);
  if (options.verb == ensemble_verb) {
    propose_windows(scene, 0, scene.studies.size(), options);
    return compute_ensemble(scene, options);
  }
  if (options.verb == "reduce") return reduce(scene, options);
  if (options.type == nullptr) return check(scene, options);
  const std::size_t study = study_of_verb(scene, options);
  return compute(scene, study, study + 1, options);
}

}  // namespace arcslip::app
