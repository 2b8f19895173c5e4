#include <arcslip/output/figures.hpp>

#include <arcslip/figures/layout.hpp>
#include <arcslip/output/atomic_file.hpp>
#include <arcslip/output/gnuplot_script.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <unistd.h>

namespace arcslip::output {
namespace {

using results::Figure;
using results::FigureData;

constexpr std::chrono::seconds least_time{60};           // for gnuplot
constexpr std::chrono::microseconds time_of_point{100};  // more for each point of each figure

std::string folder_prefix(const std::string& folder) {
  return folder + (folder.empty() || folder.back() != '/' ? "/" : "");
}

/// Whether an image is complete: it has the end marker of its format.
bool is_whole(const std::string& path, std::string_view ending) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
  const std::streamoff tail_size = std::min<std::streamoff>(size, 32);
  std::string tail(static_cast<std::size_t>(tail_size), '\0');
  file.seekg(size - tail_size);
  file.read(tail.data(), tail_size);
  return file && tail.find(ending) != std::string::npos;
}

/// The names of the images of each figure, without extension: NAME_FIGURE, shortened to a valid file name.
std::vector<std::string> images_of(const FigureData& data, const std::string& name) {
  std::vector<std::string> names;
  for (const results::FigureView& figure : data.figures) {
    if (!results::is_drawn(data, figure)) continue;
    std::string own = name + "_" + file_name(figure.name);
    if (std::find(names.begin(), names.end(), own) != names.end())  // differs only in what it cannot hold
      own += "_" + std::to_string(names.size());
    names.push_back(own);
  }
  return names;
}

/// How an image that is whole ends.
std::string_view ending_of(const std::string& format) {
  return format == "svg" ? "</svg>" : format == "png" ? "IEND" : "%%EOF";
}

/// Of the images while gnuplot draws them.
std::string temporary_suffix() {
  return "." + std::to_string(::getpid()) + ".tmp";
}

std::string problem_of(const ProcessResult& result, const std::string& folder, const std::string& script,
                       std::chrono::milliseconds time) {
  if (result.end == ProcessEnd::not_found) {
    return "figures need gnuplot (Debian package gnuplot-nox); the data and the script were written: "
           "after installing it, run gnuplot -d " +
           script + " in " + folder;
  }
  if (result.end == ProcessEnd::not_started)
    return "gnuplot cannot be started (" + result.text +
           "); the data and the script were written: run gnuplot -d " + script + " in " + folder;
  std::string problem =
      "gnuplot could not draw the figures (exit code " + std::to_string(result.exit_code) + ")";
  if (result.end == ProcessEnd::out_of_time) {
    problem = "gnuplot has not drawn the figures in " + std::to_string(time.count() / 1000) +
              " s and was terminated";
  } else if (result.signal != 0) {
    problem = "gnuplot was ended by signal " + std::to_string(result.signal);
  } else if (result.exit_code == 0) {
    problem = "gnuplot left a figure incomplete, or it could not be renamed (is the disk full?)";
  }
  problem += "; to see why, run gnuplot -d " + script + " in " + folder;
  std::string said = result.text;
  said.erase(std::unique(said.begin(), said.end(), [](char a, char b) { return a == '\n' && b == '\n'; }),
             said.end());
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) said.pop_back();
  return said.empty() ? problem : problem + "\n" + said;
}

}  // namespace

std::string file_name(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '-' || (c == '.' && !result.empty());
    result += plain ? c : '_';
    if (result.size() == 100) break;
  }
  return result.empty() || result.front() == '-' ? "_" + result : result;
}

std::vector<std::string> figure_files(const FigureData& data, const std::string& name,
                                      const FigureOptions& options) {
  const std::string stem = file_name(name);
  std::vector<std::string> files = {stem + ".dat", stem + ".gp"};
  for (const std::string& image : images_of(data, stem))
    for (const std::string& format : options.formats)
      files.insert(files.end(), {image + "." + format, image + "." + format + temporary_suffix()});
  return files;
}

DrawingFigures::DrawingFigures(std::span<const NamedFigures> all, std::string folder, FigureOptions options,
                               const control::Control& control)
    : folder_(std::move(folder)), options_(std::move(options)), control_(control) {
  for (const NamedFigures& of : all) write_sources(of);
  if (images_.empty() || options_.formats.empty() || !control_.keep_going()) return;
  time_ = least_time + std::chrono::duration_cast<std::chrono::milliseconds>(points_ * time_of_point);
  // gnuplot writes to temporary names; complete images are renamed.
  std::vector<std::string> arguments = {"-d", "-e", "suffix='" + temporary_suffix() + "'"};
  for (std::size_t i = 1; i < result_.sources.size(); i += 2)
    arguments.push_back(std::filesystem::path(result_.sources[i]).filename().string());
  run_ = std::async(std::launch::async, [arguments = std::move(arguments), where = folder_,
                                         limits = ProcessLimits{control_, time_}] {
    return run_program("gnuplot", arguments, where, limits);
  });
}

/// Writes the data and the script of some curves, and adds what they draw.
void DrawingFigures::write_sources(const NamedFigures& of) {
  const std::string stem = file_name(of.name), base = folder_prefix(folder_);
  const std::vector<Figure> figures = figures::figures_of(of.data, options_.style);
  const std::vector<std::string> images = images_of(of.data, stem);
  const std::string data = base + stem + ".dat", script = base + stem + ".gp";
  write_file(data, [&](std::ostream& out) { write_figure_data(out, figures); });
  result_.sources.push_back(data);
  write_file(script, [&](std::ostream& out) {
    write_gnuplot_script(out, figures, stem, images, options_.formats, options_.style);
  });
  result_.sources.push_back(script);
  if (images.empty()) result_.problem = "no figure was drawn: there are no points";
  for (const Figure& figure : figures)
    for (const results::FigureCurve& curve : figure.curves) points_ += curve.x.size();
  images_.insert(images_.end(), images.begin(), images.end());
  scripts_ += (scripts_.empty() ? "" : " ") + stem + ".gp";
}

/// Renames the images of gnuplot that are whole, and removes others. Returns whether all are.
bool DrawingFigures::take_images(bool has_drawn) {
  bool all_whole = has_drawn;
  for (const std::string& image : images_)
    for (const std::string& format : options_.formats) {
      const std::string path = folder_prefix(folder_) + image + "." + format,
                        temporary = path + temporary_suffix();
      if (has_drawn && is_whole(temporary, ending_of(format)) &&
          std::rename(temporary.c_str(), path.c_str()) == 0) {
        result_.images.push_back(path);
      } else {
        std::remove(temporary.c_str());
        all_whole = false;
      }
    }
  return all_whole;
}

Figures DrawingFigures::finish() {
  if (images_.empty() || options_.formats.empty()) return std::move(result_);
  const std::string interrupted =
      "interrupted before the figures were drawn; the data and the script were "
      "written: run gnuplot -d " +
      scripts_ + " in " + folder_;
  if (!run_.valid()) {
    result_.problem = interrupted;
    return std::move(result_);
  }
  const ProcessResult run = run_.get();
  const bool has_ended = run.end == ProcessEnd::by_itself && run.exit_code == 0;
  const bool all_whole = take_images(run.exit_code == 0);
  if (!has_ended || !all_whole)
    result_.problem =
        run.end == ProcessEnd::stopped ? interrupted : problem_of(run, folder_, scripts_, time_);
  return std::move(result_);
}

Figures draw_figures(const FigureData& data, const std::string& folder, const std::string& name,
                     const FigureOptions& options, const control::Control& control) {
  const NamedFigures one{name, data};
  return DrawingFigures({&one, 1}, folder, options, control).finish();
}

}  // namespace arcslip::output
