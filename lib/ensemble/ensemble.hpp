#pragma once
// Ensembles: a study for many samples of parameters, each a row of a file that grows while they are computed.
//
//   ensemble::Outcome now = ensemble::run(scene, scene.studies[0], {.path = "blade.sqlite", .threads = 8});
//
// A run that ended early, by whatever cause, continues where it was: the same call computes what is missing.

#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/figure_data.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::ensemble {

/// A quantity that results do not have. what() names the nearest one.
class UnknownQuantity : public Error {
  using Error::Error;
};

/// A file that holds other samples than those asked for. what() names the difference.
class OtherEnsemble : public Error {
  using Error::Error;
};

/// A file of an ensemble that cannot be read or written, or holds something else. what() names it.
class FileFault : public Error {
  using Error::Error;
};

/// One of several parts with as many samples each as the others, or one more.
struct Part {
  int number = 1, count = 1;
};

/// Samples begin to end - 1.
struct Range {
  long begin = 0, end = 0;
};

/// How far a run is.
struct Progress {
  long all = 0;      // samples of the part
  long done = 0;     // of them
  long before = 0;   // of those, computed by earlier runs
  long failed = 0;   // not complete
  double bytes = 0;  // of the file; 0: not asked
};

struct Settings {
  std::string path{};  // of the file
  std::string keep{};  // quantities and tables (ensemble/kept.hpp); empty: what the command shows
  Part part{};
  std::optional<Range> samples{};  // in place of a part
  int threads = 1;
  std::function<void(const Progress&)> report{};  // after each sample
  control::Control control{};
};

struct Outcome {
  Progress progress;
  bool stopped = false;  // by the control
};

/// Whether ensembles are there: they need SQLite when the library is built.
bool is_available();

/// Computes the samples of a study that the file does not have. A sample that fails is a row with its reason.
/// Throws OtherEnsemble where the file holds others, UnknownQuantity, FileFault.
Outcome run(const scene::Scene& scene, const scene::Study& study, const Settings& settings);

/// Makes the file of run() without computing anything. Returns the samples that it does not have.
std::vector<Range> prepare_file(const scene::Scene& scene, const scene::Study& study,
                                const Settings& settings);

/// Joins the files of all parts of an ensemble. Throws OtherEnsemble where they are of different ones, and
/// where samples are missing or in several parts; then there is no new file.
Progress merge(const std::vector<std::string>& parts, const std::string& path,
               const control::Control& control);

/// Computes the statistics of the quantities, as tables of the file: `statistics`, `histograms`,
/// `correlations`. Returns them as a text.
std::string add_statistics(const std::string& path);

/// Returns the histograms of the quantities that vary, made by add_statistics(), as figures, with bands that
/// have 90 and 50 % of the samples. Throws FileFault where there are none.
std::vector<results::FigureData> histograms(const std::string& path);

/// Writes the table of samples as CSV.
void write_csv(const std::string& path, std::ostream& out);

}  // namespace arcslip::ensemble
