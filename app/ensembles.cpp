#include "ensembles.hpp"

#include "command_line/option_values.hpp"
#include "interrupt.hpp"
#include "output/message.hpp"
#include "output/progress.hpp"
#include "output/results.hpp"
#include "output/results_folder.hpp"
#include "output/standard_output.hpp"

#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/output/atomic_file.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/report/report.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/study_type.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <ostream>
#include <thread>

namespace arcslip::app {
namespace {

constexpr double large_file = 1e9;  // bytes, above which a warning comes

/// --part 3/20
ensemble::Part part_of(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t slash = text.find('/');
  const std::string option = "--part " + text;
  const std::string wanted = "a part and the number of parts, as 3/20";
  if (slash == std::string::npos) throw UsageError(option + ": must be " + wanted);
  const auto number = whole_number(option, text.substr(0, slash), wanted);
  const auto count = whole_number(option, text.substr(slash + 1), wanted);
  if (!number || !count || *number < 1 || *count < *number)
    throw UsageError(option + ": must be " + wanted + ", of parts from 1 to their number");
  return {*number, *count};
}

/// Returns the study of that name, or the first one that has samples.
const scene::Study& study_of(const scene::Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const scene::Study& study : scene.studies) {
    if (name.empty() ? !scene::varied_parameters(study).empty() : study.name == name) return study;
    names.push_back(study.name);
  }
  if (name.empty())
    throw UsageError(
        "the scene has no study with \"for_each\", which gives the samples: add \"for_each\": "
        "{\"distributions\": {\"part.field\": {\"normal\": [mean, deviation]}}, \"count\": 1000} to one");
  const std::string near = scene::nearest(name, names);
  throw UsageError("--study " + results::visible(name) + ": the scene has no study of this name" +
                   (near.empty() ? "" : "; did you mean " + near + "?"));
}

/// Returns the path of --out, or else one by the names of the scene and the study.
std::string path_of(const CommandOptions& options, const scene::Study& study, const ensemble::Part& part) {
  if (!options.out.empty()) return options.out;
  std::string name =
      std::filesystem::path(options.scene).stem().string() + "." + output::file_name(study.name);
  if (part.count > 1) name += ".part-" + std::to_string(part.number) + "-of-" + std::to_string(part.count);
  return (std::filesystem::path("out") / (name + ".sqlite")).string();
}

void make_folder(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw output::WriteError(folder.string(), error.value());
}

/// "sample 5120/100000  5 %  1312/s  3 not complete  72 s left"
std::string text_of(const ensemble::Progress& now, double seconds) {
  const auto computed = static_cast<double>(now.done - now.before);
  const double share = computed / static_cast<double>(std::max(now.all - now.before, 1L));
  const double rate = seconds > 0 ? computed / seconds : 0;
  std::array<char, 120> text{};
  std::snprintf(
      text.data(), text.size(), "sample %ld/%ld  %.0f %%  %.3g/s", now.done, now.all,
      std::floor(100.0 * static_cast<double>(now.done) / static_cast<double>(std::max(now.all, 1L))), rate);
  std::string line = text.data();
  if (now.failed > 0) line += "  " + std::to_string(now.failed) + " not complete";
  return line + time_left(share, seconds);
}

/// Reports progress, and once a file that becomes large.
class Reports {
 public:
  Reports(const CommandOptions& options) : line_(options.quiet, "") {}

  void show(const ensemble::Progress& now) {
    const double size =
        now.bytes / static_cast<double>(std::max(now.done, 1L)) * static_cast<double>(now.all);
    if (size > large_file && !is_reported_) {
      is_reported_ = true;
      line_.clear();
      tell("the file will have about " + results::to_digits(size / 1e9, 2) +
           " GB: Ctrl-C ends it; keep less with --keep, or fewer samples");
    }
    line_.show([&](double seconds) { return text_of(now, seconds); });
  }
  void clear() { line_.clear(); }

 private:
  ProgressLine line_;
  bool is_reported_ = false;
};

/// Checks that all files can be written, and that none is read or written by another name.
void check_files(const std::string& path, const scene::Scene& scene, const CommandOptions& options) {
  std::vector<OutputPath> places = {{"the samples", path}};
  if (!options.csv.empty() && options.csv != "-") places.push_back({"--csv", options.csv});
  if (!options.report.empty()) places.push_back({"--report", options.report});
  check_places(places, sources_of(scene, options.scene));
}

/// Throws UsageError if the table would take the place of a part.
void check_table(const std::vector<std::string>& parts, const std::string& csv) {
  std::error_code error;
  for (const std::string& part : parts)
    if (std::filesystem::equivalent(part, csv, error))
      throw UsageError("--csv " + results::visible(csv) + " is one of the parts: choose another path");
}

std::string failed_text(const ensemble::Progress& progress) {
  if (progress.failed == 0) return {};
  return std::to_string(progress.failed) + " of " + std::to_string(progress.all) +
         " samples are not complete: their rows have status and reason, and the statistics are of the others";
}

/// Writes a page with the scene, the statistics as a text, and the histograms.
void write_report(const scene::Scene& scene, const scene::Study& study, const std::string& path,
                  const std::string& statistics, const ensemble::Progress& progress, std::ostream& out) {
  const results::Schema schema{.format = "", .list = "ensembles", .noun = "ensemble", .tables = {}};
  report::Report page(scene, {&study, 1});
  page.begin(studies::header(scene), {&schema, 1});
  page.curve({.study = study.name, .kind = std::string(study.type->name())}, 0);
  page.end({.stop = {}, .doubt = failed_text(progress), .text = statistics});
  page.add_figures(0, ensemble::histograms(path));
  page.write(out);
}

/// Writes the table of samples where --csv asks for it, and the statistics to standard output.
ExitCode write_ensemble(const std::string& path, const std::string& statistics, const CommandOptions& options,
                        const std::function<void(std::ostream&)>& report = {}) {
  Writing writing;
  if (!options.report.empty() && report)
    writing.attempt(results::visible(options.report),
                    [&] { output::write_file(options.report, report, by_signal()); });
  StandardOutput screen;
  const auto write = [&](std::ostream& out) { ensemble::write_csv(path, out); };
  if (options.csv == "-")
    screen.write(write);
  else if (!options.csv.empty())
    writing.attempt(results::visible(options.csv),
                    [&] { output::write_file(options.csv, write, by_signal()); });
  if (options.csv != "-")
    screen.write_lines([&](std::ostream& out) {
      out << statistics;
      if (!options.quiet) out << (statistics.empty() ? "" : "\n") << results::visible(path) << '\n';
    });
  writing.attempt("standard output", [&] { screen.finish(); });
  return writing.code(ExitCode::done);
}

}  // namespace

void add_ensemble_options(CLI::App& verb, CommandOptions& options) {
  verb.add_option("--study", options.ensemble.study,
                  "name of the study (default: the first one with \"for_each\", which gives the samples)")
      ->type_name("NAME");
  verb.add_option(
          "--keep", options.ensemble.keep,
          "quantities of the largest peak or other event, and tables, parted by commas: "
          "peak.amplitude,damper.stick_percent,events,points (default: what tables of the study show)")
      ->type_name("LIST");
  verb.add_option("--part", options.ensemble.part, "compute one of several parts, which arcslip merge joins")
      ->type_name("I/N");
  verb.add_option("--out", options.out,
                  "file of the samples, a database of SQLite; where it is there, its ensemble goes on "
                  "(default: out/<name of the scene file>.<study>.sqlite)")
      ->type_name("FILE");
  verb.add_option("--csv", options.csv, "write the samples as CSV to a file, or - for standard output")
      ->type_name("FILE|-");
  verb.add_option("--report", options.report,
                  "write statistics and histograms as a page for a browser, in one file (default: none)")
      ->type_name("FILE");
}

void add_merge_options(CLI::App& verb, CommandOptions& options) {
  verb.add_option("PART", options.ensemble.parts, "files of all parts of an ensemble")
      ->required()
      ->type_name("");
  verb.add_option("--out", options.out, "new file for the samples of all parts")
      ->required()
      ->type_name("FILE");
  verb.add_option("--csv", options.csv, "write the samples as CSV to a file, or - for standard output")
      ->type_name("FILE|-");
  verb.add_flag("--quiet", options.quiet, "print only statistics and errors");
}

ExitCode compute_ensemble(const scene::Scene& scene, const CommandOptions& options) {
  const scene::Study& study = study_of(scene, options.ensemble.study);
  const ensemble::Part part = part_of(options.ensemble.part);
  if (part.count > 1 && !options.report.empty())
    throw UsageError("--report " + results::visible(options.report) +
                     ": a part has no statistics; arcslip merge joins all parts, arcslip plot draws them");
  const std::string path = path_of(options, study, part);
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  make_folder(path);
  check_files(path, scene, options);
  Reports reports(options);
  ensemble::Settings settings{.path = path,
                              .keep = options.ensemble.keep,
                              .part = part,
                              .threads = options.threads.value_or(processors),
                              .report = [&](const ensemble::Progress& now) { reports.show(now); },
                              .control = by_signal()};
  ensemble::Outcome outcome;
  try {
    outcome = ensemble::run(scene, study, settings);
  } catch (const ensemble::UnknownQuantity& error) {
    throw UsageError("--keep: " + std::string(error.what()));
  }
  reports.clear();
  const ensemble::Progress& progress = outcome.progress;
  if (const std::string failed = failed_text(progress); !failed.empty()) tell(failed);
  if (outcome.stopped) {
    tell("interrupted: " + std::to_string(progress.done) + " of " + std::to_string(progress.all) +
         " samples are in " + path + "; run the same command to go on");
    return ExitCode::stopped_early;
  }
  if (part.count > 1 && !options.quiet)
    tell("part " + options.ensemble.part + " is done: join all parts with arcslip merge PART... --out FILE");
  if (part.count > 1) return write_ensemble(path, "", options);
  const std::string statistics = ensemble::add_statistics(path);
  return write_ensemble(path, statistics, options, [&](std::ostream& out) {
    write_report(scene, study, path, statistics, progress, out);
  });
}

ExitCode merge_ensemble(const CommandOptions& options) {
  check_table(options.ensemble.parts, options.csv);
  if (!options.csv.empty() && options.csv != "-")
    check_places({{"--out", options.out}, {"--csv", options.csv}}, {});
  make_folder(options.out);
  const ensemble::Progress progress = ensemble::merge(options.ensemble.parts, options.out, by_signal());
  if (const std::string failed = failed_text(progress); !failed.empty()) tell(failed);
  return write_ensemble(options.out, ensemble::add_statistics(options.out), options);
}

}  // namespace arcslip::app
