#include "verbs.hpp"

#include "interrupt.hpp"
#include "message.hpp"
#include "progress.hpp"
#include "resolve.hpp"
#include "results.hpp"
#include "standard_output.hpp"
#include "study_result.hpp"

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/output/atomic_file.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {
namespace {

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

/// Throws where one table would have to hold results of different kinds.
void check_one_table(const Options& options, const std::vector<scene::Study>& studies) {
  for (const scene::Study& study : studies) {
    if (!options.csv.empty() && no_result(study).index() != no_result(studies.front()).index()) {
      throw UsageError("--csv holds one table, but the results of the studies \"" + studies.front().name +
                       "\" and \"" + study.name +
                       "\" have different columns: use --out, where each study has its own");
    }
  }
}

StudyResult compute_visibly(const scene::Scene& scene, const scene::Study& study, bool quiet) {
  ProgressLine line(quiet, std::string(scene::unit_name(scene.frequency_unit)));
  bool told = false;
  return compute(scene, study, [&](const observables::Progress& progress) {
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
  check_one_table(options, studies);
  const std::vector<StudyFiles> files = study_files(options.out, studies);
  const std::optional<ResultsFolder> held = prepare_places(options, files);

  StandardOutput screen;
  ExitCode code = ExitCode::done;
  std::vector<StudyResult> all;
  std::string places;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    if (interrupted()) {
      code = ExitCode::stopped_early;
      tell("the study \"" + studies[i].name + "\" was not begun");
      continue;
    }
    StudyResult result = compute_visibly(scene, studies[i], options.quiet);
    for (const std::string& sentence : early_ends(scene, result)) {
      code = ExitCode::stopped_early;
      tell(sentence);
    }
    if (!options.out.empty()) {
      for (const std::string& path :
           write_study(files[i], scene, studies[i].kind, result, options.coefficients)) {
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
        write_table(out, scene, result);
      });
    }
    append(std::move(result), all);
  }
  if (all.empty()) {  // nothing was begun
    all.push_back(no_result(studies.front()));
  }
  write_to(options.json, screen,
           [&](std::ostream& out) { write_json(out, scene, all, options.coefficients); });
  write_to(options.csv, screen, [&](std::ostream& out) { write_csv(out, scene, all.front()); });
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

ExitCode optimize(const Options& options) {
  scene::Scene scene = resolve(options);
  const scene::Study study = optimum_of_verb(scene, options);
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
    case Verb::time:
      return one_study(scene::StudyKind::time, options);
    case Verb::optimize:
      return optimize(options);
    case Verb::check:
      break;
  }
  return check(options);
}

}  // namespace arcslip::app
