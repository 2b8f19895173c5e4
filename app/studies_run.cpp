#include "verbs.hpp"

#include "interrupt.hpp"
#include "output/message.hpp"
#include "output/progress.hpp"
#include "output/results.hpp"
#include "output/results_folder.hpp"
#include "output/sinks.hpp"
#include "output/standard_output.hpp"

#include <arcslip/control/progress.hpp>
#include <arcslip/output/atomic_file.hpp>
#include <arcslip/report/report.hpp>
#include <arcslip/results/table_writer.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/presentation/selection.hpp>
#include <arcslip/studies/presentation/units.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace arcslip::app {
namespace {

constexpr const char *own_report = "report.html", *set_of_report = "the report";

bool takes_standard_output(const CommandOptions& options) {
  return options.json == "-" || options.csv == "-";
}

/// Whether the report goes to the folder of results.
bool has_own_report(const CommandOptions& options) {
  return options.verb == "run" && options.report.empty();
}

/// Where the report goes; "": there is none.
std::string report_path(const CommandOptions& options) {
  return has_own_report(options) ? (std::filesystem::path(options.out) / own_report).string()
                                 : options.report;
}

/// Checks that all results can be written, before anything is computed. Returns the locked output folder.
std::optional<ResultsFolder> prepare_places(const CommandOptions& options, const scene::Scene& scene,
                                            const std::vector<scene::Study>& studies,
                                            const std::vector<StudyFiles>& files) {
  const std::vector<std::string> sources = sources_of(scene, options.scene);
  std::optional<ResultsFolder> folder;
  std::vector<OutputPath> places;
  if (!options.out.empty()) {
    folder.emplace(options.out, sources);
    places.push_back({"the manifest of the folder", folder->manifest_path()});
    for (std::size_t i = 0; i < studies.size(); ++i) add_places(files[i], studies[i].name, places);
  }
  if (!options.json.empty() && options.json != "-") places.push_back({"--json", options.json});
  if (!options.csv.empty()) add_csv_places("--csv", options.csv, places);
  if (const std::string report = report_path(options); !report.empty())
    places.push_back({set_of_report, report});
  check_places(places, sources);
  return folder;
}

/// Throws if one table would have to hold results of different kinds.
void check_one_table(const CommandOptions& options, const scene::Scene& scene,
                     const std::vector<scene::Study>& studies) {
  const auto list = [&](const scene::Study& study) {
    return studies::kind_of(*study.type).schema(scene, study, {}).list;
  };
  for (const scene::Study& study : studies) {
    if (!options.csv.empty() && list(study) != list(studies.front())) {
      throw UsageError("--csv holds one table, but the results of the studies \"" + studies.front().name +
                       "\" and \"" + study.name +
                       "\" have different columns: use --out, where each study has its own");
    }
  }
}

/// "1000000000"; with an exponent beyond 15 digits.
std::string whole(double count) {
  return results::to_digits(count, 15);
}

/// Throws if for_each has more combinations than allowed: rows, or lists, whose lengths multiply.
void check_combinations(const CommandOptions& options, const std::vector<scene::Study>& studies) {
  const int most = options.combinations.value_or(scene::usual_combinations);
  for (const scene::Study& study : studies) {
    const double count = scene::Combinations(study).count();
    if (count > most) {
      std::string product;
      for (const auto& [parameter, values] : study.for_each)
        product += std::to_string(values.size()) + (&values == &study.for_each.back().second ? "" : " x ");
      throw UsageError("the " + std::string(study.in_rows ? "rows" : "lists") +
                       " of for_each in the study \"" + study.name + "\" have " +
                       (study.for_each.size() > 1 && !study.in_rows ? product + " = " : "") + whole(count) +
                       " combinations, must be at most " + std::to_string(most) +
                       ": give fewer values, or allow more with --combinations N");
    }
  }
}

/// Throws where amplitudes cannot be divided by a force.
void check_receptance(const CommandOptions& options, const scene::Scene& scene) {
  if (options.receptance && !(studies::force_amplitude(scene, {}) >= 0))
    throw UsageError(
        "--receptance divides amplitudes by the force of the scene, which has to have a single excitation: a "
        "force of the first harmonic");
}

void tell_partial(Interruption& interruption) {
  if (interruption.is_new())
    tell("interrupted; the results so far will be written (press Ctrl-C again to quit at once)");
}

/// Where a study has too many combinations for figures.
void tell_not_drawn(const scene::Study& study, const std::vector<results::FigureData>& figures) {
  const double count = scene::Combinations(study).count();
  if (figures.empty() && count > scene::most_drawn)
    tell("no figure of the study \"" + study.name + "\" is drawn: it has " + whole(count) +
         " combinations, and figures show at most " + std::to_string(scene::most_drawn));
}

/// Runs a study into a sink with a progress line. Returns its figures.
std::vector<results::FigureData> compute_visibly(const scene::Scene& scene, const scene::Study& study,
                                                 studies::RunOptions how, const CommandOptions& options,
                                                 results::Sink& sink, Interruption& interruption) {
  ProgressLine line(options.quiet, std::string(scene::unit_name(scene.frequency_unit)));
  how.control = by_signal().child({.report = [&](const control::Progress& now) { line.show(now); }});
  std::vector<results::FigureData> figures = studies::kind_of(*study.type).run(scene, study, how, 0, sink);
  line.clear();
  tell_partial(interruption);
  return figures;
}

/// CSV files of the columns and events that the user asks for.
std::vector<File> selected_csv(const std::string& path, std::span<const results::Schema> schemas,
                               const studies::Selection& selection) {
  std::vector<File> files = csv_files(path, schemas);
  for (File& file : files)
    file.sink = [whole = std::move(file.sink), selection](std::ostream& out) {
      return std::make_unique<studies::Selected>(whole(out), selection, true);
    };
  return files;
}

/// The files for the results of all studies together.
std::vector<File> common_files(const CommandOptions& options, std::span<const results::Schema> schemas) {
  std::vector<File> files;
  if (!options.json.empty()) files.push_back(json_file(options.json));
  if (!options.csv.empty()) {
    std::vector<File> csv = selected_csv(options.csv, schemas, {options.columns, options.events});
    std::move(csv.begin(), csv.end(), std::back_inserter(files));
  }
  return files;
}

std::vector<File> own_files(const StudyFiles& files, const results::Schema& schema) {
  std::vector<File> all = selected_csv(files.path(".csv"), std::span(&schema, 1), {});
  all.insert(all.begin(), json_file(files.path(".json")));
  return all;
}

/// The files of a study in its folder: those that were open, the scene and the figures, which are drawn while
/// the next study is computed.
class SetOfFiles {
 public:
  SetOfFiles(ResultsFolder& folder, const StudyFiles& files, const scene::Scene& scene,
             const results::Header& header, OpenFiles& open, const std::vector<results::FigureData>& figures,
             const output::FigureOptions& options, Writing& writing)
      : folder_(folder), name_(files.name) {
    std::vector<std::string> names = figure_names(files, figures, options);
    const auto taken =
        std::find_if(names.begin(), names.end(), [&](const auto& name) { return folder.is_source(name); });
    const bool may_draw = taken == names.end();
    const std::string what = "the figures of " + results::visible(files.path(""));
    if (!may_draw) {
      tell(what + " were not drawn: " + results::visible(*taken) + " is a file that the scene reads");
      writing.misses(what);
      names.clear();
    }
    const std::size_t missing = writing.failures();
    if (!begin(files, header, open, std::move(names), writing)) return;
    written_ = write_scene(files, scene, writing);
    for (std::string& table : open.commit(writing)) written_.push_back(std::move(table));
    figures_.emplace(files, may_draw ? figures : std::vector<results::FigureData>(), options, writing);
    is_complete_ = writing.failures() == missing;
  }

  /// Waits for the figures. Returns the paths of all files.
  std::vector<std::string> finish(Writing& writing) {
    if (!figures_) return {};
    const DrawnFigures drawn = figures_->finish(writing);
    written_.insert(written_.end(), drawn.paths.begin(), drawn.paths.end());
    std::vector<std::string> removed;
    writing.attempt("the manifest", [&] { removed = folder_.end_set(name_, written_, is_complete_); });
    const bool images = std::any_of(removed.begin(), removed.end(), [](const std::string& name) {
      return name.ends_with(".svg") || name.ends_with(".png") || name.ends_with(".pdf");
    });
    if (!drawn.problem.empty())
      tell(drawn.problem +
           (images ? "; those of an earlier run were removed, since they show other data" : ""));
    return std::move(written_);
  }

 private:
  /// Records the set in the manifest. figures: the names of their files. Returns success.
  bool begin(const StudyFiles& files, const results::Header& header, const OpenFiles& open,
             std::vector<std::string> names, Writing& writing) {
    scene::FileSet set{files.name, header.program, header.scene_hash, false, {}};
    for (const std::string& path : open.paths())
      names.push_back(std::filesystem::path(path).filename().string());
    names.push_back(std::filesystem::path(files.path(".scene.json")).filename().string());
    for (std::string& name : names) set.files.push_back({std::move(name)});
    if (writing.attempt("the manifest", [&] { folder_.begin_set(set); })) return true;
    writing.misses("all files of " + results::visible(files.path("")));
    return false;
  }

  ResultsFolder& folder_;
  std::string name_;
  std::vector<std::string> written_{};  // paths
  bool is_complete_ = false;
  std::optional<FiguresOfStudy> figures_{};  // none: nothing was written
};

bool are_of_one_list(std::span<const results::Schema> schemas) {
  return std::all_of(schemas.begin(), schemas.end(),
                     [&](const results::Schema& schema) { return schema.list == schemas.front().list; });
}

/// The results of all studies together. Files are written as results arrive; outputs that may block on a
/// reader, or that have to sort several lists, at the end.
class CommonResults {
 public:
  CommonResults(const CommandOptions& options, const results::Header& header,
                const std::vector<results::Schema>& schemas)
      : in_the_end_(some_of(common_files(options, schemas), schemas, false)),
        open_(some_of(common_files(options, schemas), schemas, true)),
        all_(in_the_end_.empty() ? std::vector<results::Sink*>{&open_}
                                 : std::vector<results::Sink*>{&open_, &kept_}) {
    all_.begin(header, schemas);
  }
  CommonResults(const CommonResults&) = delete;
  CommonResults& operator=(const CommonResults&) = delete;

  results::Sink& sink() { return all_; }

  void finish(Writing& writing, StandardOutput& screen) {
    all_.finish();
    open_.commit(writing);
    for (const File& each : in_the_end_) {
      const auto writer = [&](std::ostream& out) { write(each, kept_.results, out); };
      if (each.path == "-")
        screen.write(writer);
      else
        writing.attempt(results::visible(each.path),
                        [&] { output::write_file(each.path, writer, by_signal()); });
    }
  }

 private:
  static std::vector<File> some_of(std::vector<File> files, std::span<const results::Schema> schemas,
                                   bool at_once) {
    std::erase_if(files, [&](const File& file) {
      return (!may_wait(file.path) && are_of_one_list(schemas)) != at_once;
    });
    return files;
  }

  std::vector<File> in_the_end_;
  OpenFiles open_;
  results::Collector kept_;
  Tee all_;
};

/// The studies of a scene, one after the other, with their files, tables and remarks.
class StudiesRun {
 public:
  StudiesRun(const scene::Scene& scene, const std::vector<scene::Study>& studies,
             const CommandOptions& options, const std::vector<std::string>& notes)
      : scene_(scene),
        studies_(studies),
        options_(options),
        how_(run_options(options)),
        files_(study_files(options.out, studies)),
        held_(prepare_places(options, scene, studies, files_)),
        header_(header_of(scene, notes)),
        schemas_(schemas_of(scene, studies, how_)),
        common_(checked(options, schemas_), header_, schemas_) {
    if (report_path(options).empty()) return;
    report_.emplace(scene, studies);
    report_->begin(header_, schemas_);
  }

  ExitCode run() {
    for (std::size_t i = 0; i < studies_.size(); ++i)
      if (interrupted())
        tell("the study \"" + studies_[i].name + "\" was not started: its files are unchanged");
      else
        run_study(i);
    finish();
    if (interrupted()) tell_interruption();
    return writing_.code(interrupted() ? ExitCode::stopped_early : code_);
  }

 private:
  static studies::RunOptions run_options(const CommandOptions& options) {
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const bool reads_all_points =
        !options.out.empty() || !options.json.empty() || !report_path(options).empty();
    return {.points = !options.out.empty() || !options.json.empty() || !options.csv.empty(),
            .point_columns = reads_all_points ? std::vector<std::string>() : options.columns,
            .coefficients = options.coefficients,
            .figures = !options.out.empty() || !report_path(options).empty(),
            .receptance = options.receptance,
            .threads = options.threads.value_or(processors)};
  }

  static const CommandOptions& checked(const CommandOptions& options,
                                       const std::vector<results::Schema>& schemas) {
    studies::check_selection({options.columns, options.events}, schemas, "--");
    return options;
  }

  static std::vector<results::Schema> schemas_of(const scene::Scene& scene,
                                                 const std::vector<scene::Study>& studies,
                                                 const studies::RunOptions& how) {
    std::vector<results::Schema> schemas;
    for (const scene::Study& study : studies)
      schemas.push_back(studies::kind_of(*study.type).schema(scene, study, how));
    return schemas;
  }

  static results::Header header_of(const scene::Scene& scene, const std::vector<std::string>& notes) {
    results::Header header = studies::header(scene);
    header.notes = notes;
    return header;
  }

  void run_study(std::size_t i) {
    any_begun_ = true;
    if (studies_.size() > 1) tables_ << (i > 0 ? "\n" : "") << studies_[i].name << '\n';
    studies::Selected table(std::make_unique<results::TableWriter>(tables_),
                            {options_.columns, options_.events}, false);
    results::Remarks remarks;
    OpenFiles own(options_.out.empty() ? std::vector<File>() : own_files(files_[i], schemas_[i]));
    OneOfSeveral among(common_.sink(), i);
    std::vector<results::Sink*> all{&table, &remarks, &own, &among};
    std::optional<OneOfSeveral> of_report;
    if (report_) all.push_back(&of_report.emplace(*report_, i));
    Tee sinks(std::move(all));
    sinks.begin(header_, std::span(&schemas_[i], 1));
    std::vector<results::FigureData> figures =
        compute_visibly(scene_, studies_[i], how_, options_, sinks, interruption_);
    sinks.finish();
    if (how_.figures && !options_.quiet) tell_not_drawn(studies_[i], figures);
    tell_remarks(remarks);
    finish_set();
    if (held_) set_.emplace(*held_, files_[i], scene_, header_, own, figures, options_.figures, writing_);
    if (report_) report_->add_figures(i, std::move(figures));
  }

  /// Waits for the figures of the last study.
  void finish_set() {
    if (!set_) return;
    for (const std::string& path : set_->finish(writing_)) places_ += results::visible(path) + "\n";
    set_.reset();
  }

  /// Returns whether the page was written.
  bool write_page(const std::string& path) {
    return writing_.attempt(results::visible(path), [&] {
      output::write_file(path, [&](std::ostream& out) { report_->write(out); }, by_signal());
    });
  }

  /// In the folder of results the page is a set of its own, which is dropped where the page goes elsewhere.
  void write_report() {
    const std::string path = report_path(options_);
    const bool is_own = has_own_report(options_);
    const bool is_set = held_ && options_.verb == "run" &&
                        (is_own || std::filesystem::exists(std::filesystem::path(options_.out) / own_report));
    scene::FileSet set{set_of_report, header_.program, header_.scene_hash, false, {}};
    if (is_own) set.files.push_back({own_report});
    if (is_set && !writing_.attempt("the manifest", [&] { held_->begin_set(set); })) {
      writing_.misses(results::visible(path));
      return;
    }
    const bool is_written = write_page(path);
    finish_set();
    if (is_written) places_ += results::visible(path) + "\n";
    if (is_set)
      writing_.attempt("the manifest", [&] {
        const std::vector<std::string> written(is_own && is_written ? 1 : 0, path);
        held_->end_set(set.name, written, is_written);
      });
  }

  void tell_remarks(const results::Remarks& remarks) {
    if (!remarks.early_ends.empty()) code_ = ExitCode::stopped_early;
    for (const std::string& sentence : remarks.early_ends) tell(sentence);
    for (const std::string& sentence : remarks.doubts) tell(sentence);
    if (options_.quiet) return;
    for (const std::string& sentence : remarks.others) tell(sentence);
  }

  /// Writes what all studies share, and the tables for people.
  void finish() {
    StandardOutput screen;
    if (any_begun_) {
      if (!options_.csv.empty() && options_.csv != "-")
        for (const std::string& path : older_tables(options_.csv, schemas_))
          tell(results::visible(path) + " is left from earlier results: these have no such table");
      common_.finish(writing_, screen);
      if (report_) write_report();
      finish_set();
    }
    if (!takes_standard_output(options_)) {
      if (!places_.empty() && !options_.quiet) tables_ << '\n' << places_;
      screen.write_lines([&](std::ostream& out) { out << tables_.str(); });
    }
    writing_.attempt("standard output", [&] { screen.finish(); });
  }

  void tell_interruption() {
    if (!interruption_.is_new()) return;
    tell(!any_begun_ ? "interrupted before any study was started: nothing was computed or written"
                     : "interrupted while writing results; " + writing_.missing());
  }

  const scene::Scene& scene_;
  const std::vector<scene::Study>& studies_;
  const CommandOptions& options_;
  const studies::RunOptions how_;
  const std::vector<StudyFiles> files_;
  std::optional<ResultsFolder> held_;
  const results::Header header_;
  const std::vector<results::Schema> schemas_;
  CommonResults common_;
  std::optional<report::Report> report_;
  Interruption interruption_;
  Writing writing_;
  std::optional<SetOfFiles> set_;  // of the last study
  ExitCode code_ = ExitCode::done;
  bool any_begun_ = false;
  std::string places_;  // of the files that were written
  std::ostringstream tables_;
};

}  // namespace

ExitCode run_studies(const scene::Scene& scene, const std::vector<scene::Study>& studies,
                     const CommandOptions& options, const std::vector<std::string>& notes) {
  check_one_table(options, scene, studies);
  check_combinations(options, studies);
  check_receptance(options, scene);
  return StudiesRun(scene, studies, options, notes).run();
}

}  // namespace arcslip::app
