#include "verbs.hpp"

#include "interrupt.hpp"
#include "message.hpp"
#include "progress.hpp"
#include "resolve.hpp"
#include "results.hpp"
#include "standard_output.hpp"
#include "table.hpp"

#include <arcslip/observables/curves.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/output/atomic_file.hpp>
#include <arcslip/output/csv.hpp>
#include <arcslip/output/json.hpp>
#include <arcslip/output/units.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {
namespace {

using observables::ResponseBranch;

bool takes_standard_output(const Options& options) {
  return options.json == "-" || options.csv == "-";
}

/// Meets what writing the results would meet at its beginning. Returns the folder, held for this run.
std::optional<ResultsFolder> prepare_places(const Options& options, const std::vector<StudyFiles>& files) {
  std::optional<ResultsFolder> folder;
  if (!options.out.empty()) {
    folder.emplace(options.out);
    for (const StudyFiles& study : files) {
      check_writable(study, options.scene);
    }
  }
  for (const std::string& file : {options.json, options.csv}) {
    if (!file.empty() && file != "-") {
      check_writable(file, options.scene);
    }
  }
  return folder;
}

/// What computes studies of this kind.
auto computation(scene::StudyKind kind) {
  switch (kind) {
    case scene::StudyKind::trace:
      return observables::parameter_response;
    case scene::StudyKind::peaks:
      return observables::resonance_peaks;
    case scene::StudyKind::folds:
      return observables::fold_curves;
    case scene::StudyKind::frf:
      break;
  }
  return observables::frequency_response;
}

std::vector<ResponseBranch> compute(const scene::Scene& scene, const scene::Study& study, bool quiet) {
  ProgressLine line(quiet, std::string(scene::unit_name(scene.frequency_unit)));
  bool told = false;
  return computation(study.kind)(scene, study, [&](const observables::Progress& progress) {
    if (!interrupted()) {
      line.show(progress);
      return true;
    }
    if (!std::exchange(told, true)) {
      line.clear();
      tell("stopping; what is computed so far will be written (Ctrl-C again: end at once)");
    }
    return false;
  });
}

/// Tells which branches ended early and why.
ExitCode report_ends(const scene::Scene& scene, const std::vector<ResponseBranch>& branches) {
  ExitCode code = ExitCode::done;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const ResponseBranch& branch = branches[i];
    if (branch.status == observables::Status::complete) {
      continue;
    }
    code = ExitCode::stopped_early;
    const std::string set = output::assignment(scene, branch.set);
    tell("branch " + std::to_string(i + 1) + (set.empty() ? "" : " (" + set + ")") + " " +
         observables::name(branch.status) + ": " + branch.stop.message);
  }
  return code;
}

/// Into a file, to standard output for "-", nowhere for "".
void write_to(const std::string& place, StandardOutput& screen,
              const std::function<void(std::ostream&)>& writer) {
  if (place == "-") {
    screen.write(writer);
  } else if (!place.empty()) {
    output::write_file(place, writer);
  }
}

ExitCode run_studies(const scene::Scene& scene, const std::vector<scene::Study>& studies,
                     const Options& options) {
  const std::vector<StudyFiles> files = study_files(options.out, studies);
  const std::optional<ResultsFolder> held = prepare_places(options, files);

  StandardOutput screen;
  ExitCode code = ExitCode::done;
  std::vector<ResponseBranch> all;
  std::string places;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    if (interrupted()) {
      code = ExitCode::stopped_early;
      tell("the study \"" + studies[i].name + "\" was not begun");
      continue;
    }
    std::vector<ResponseBranch> branches = compute(scene, studies[i], options.quiet);
    if (report_ends(scene, branches) != ExitCode::done) {
      code = ExitCode::stopped_early;
    }
    if (!options.out.empty()) {
      for (const std::string& path :
           write_study(files[i], scene, studies[i].kind, branches, options.coefficients)) {
        places += path + "\n";
      }
    }
    if (interrupted()) {  // while figures were drawn, too
      code = ExitCode::stopped_early;
    }
    if (!takes_standard_output(options)) {
      screen.write([&](std::ostream& out) {
        if (studies.size() > 1) {
          out << (i > 0 ? "\n" : "") << studies[i].name << '\n';
        }
        write_table(out, scene, branches);
      });
    }
    std::move(branches.begin(), branches.end(), std::back_inserter(all));
  }
  write_to(options.json, screen,
           [&](std::ostream& out) { output::write_json(out, scene, all, {options.coefficients}); });
  write_to(options.csv, screen, [&](std::ostream& out) { output::write_csv(out, scene, all); });
  if (!places.empty() && !options.quiet && !takes_standard_output(options)) {
    screen.write([&](std::ostream& out) { out << '\n' << places; });
  }
  screen.finish();
  return code;
}

ExitCode check(const Options& options) {
  const scene::Scene scene = resolve(options);
  if (!options.quiet) {
    StandardOutput screen;
    screen.write([&](std::ostream& out) { out << scene::write(scene); });
    screen.finish();
  }
  return ExitCode::done;
}

ExitCode one_study(scene::StudyKind kind, const Options& options) {
  scene::Scene scene = resolve(options);
  const scene::Study study = study_of_verb(scene, kind, options);
  return run_studies(scene, {study}, options);
}

ExitCode run(Options options) {
  scene::Scene scene = resolve(options);
  if (scene.studies.empty()) {
    throw UsageError(
        "the scene has no studies, so there is nothing to run: add one to \"studies\", or use "
        "arcslip frf with --from and --to");
  }
  bool any_frf = false;
  for (scene::Study& study : scene.studies) {
    if (study.kind == scene::StudyKind::frf) {
      set_range(study, scene, options);
      any_frf = true;
    }
  }
  if (!any_frf && (options.from || options.to)) {
    throw UsageError(
        "--from and --to of run are those of frequency responses, of which the scene has none: use the verb "
        "of the study's kind");
  }
  if (options.out.empty()) {
    options.out = (std::filesystem::path("out") / std::filesystem::path(options.scene).stem()).string();
  }
  return run_studies(scene, scene.studies, options);
}

}  // namespace

ExitCode execute(const Options& options) {
  switch (options.verb) {
    case Verb::run:
      return run(options);
    case Verb::frf:
      return one_study(scene::StudyKind::frf, options);
    case Verb::trace:
      return one_study(scene::StudyKind::trace, options);
    case Verb::peaks:
      return one_study(scene::StudyKind::peaks, options);
    case Verb::folds:
      return one_study(scene::StudyKind::folds, options);
    case Verb::check:
      break;
  }
  return check(options);
}

}  // namespace arcslip::app
