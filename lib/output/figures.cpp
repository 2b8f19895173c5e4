#include <arcslip/output/figures.hpp>

#include <arcslip/output/atomic_file.hpp>
#include <arcslip/output/gnuplot_script.hpp>
#include <arcslip/output/process.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string_view>

#include <unistd.h>

namespace arcslip::output {
namespace {

using results::FigureData;
using results::FigureLine;

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

/// Time limit of gnuplot, which draws tens of thousands of points per second.
std::chrono::milliseconds time_for(const FigureData& data, std::size_t figures) {
  std::size_t points = 0;
  for (const FigureLine& line : data.lines)
    for (const auto& part : line.parts) points += part.size();
  return least_time + std::chrono::duration_cast<std::chrono::milliseconds>(points * figures * time_of_point);
}

std::vector<std::string> images_of(const FigureData& data, const std::string& stem) {
  return data.lines.empty() ? std::vector<std::string>() : image_names(data, stem);
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

std::vector<std::string> figure_files(const FigureData& data, const std::string& name) {
  const std::string stem = file_name(name);
  std::vector<std::string> files = {stem + ".dat", stem + ".gp"};
  for (const std::string& image : images_of(data, stem))
    for (const char* extension : {".svg", ".png"})
      files.insert(files.end(), {image + extension, image + extension + temporary_suffix()});
  return files;
}

Figures draw_figures(const FigureData& data, const std::string& folder, const std::string& name,
                     const control::Control& control) {
  const std::string stem = file_name(name);
  const std::string base = folder_prefix(folder);
  const std::vector<std::string> images = images_of(data, stem);

  Figures result;
  result.sources = {base + stem + ".dat", base + stem + ".gp"};
  write_file(result.sources[0], [&](std::ostream& out) { write_figure_data(out, data); });
  write_file(result.sources[1], [&](std::ostream& out) { write_gnuplot_script(out, data, stem, images); });
  if (images.empty()) {
    result.problem = "no figure was drawn: there are no points";
    return result;
  }
  const std::string interrupted =
      "interrupted before the figures were drawn; the data and the script were "
      "written: run gnuplot -d " +
      stem + ".gp in " + folder;
  if (!control.keep_going()) {
    result.problem = interrupted;
    return result;
  }

  // gnuplot writes to temporary names; complete images are renamed.
  const std::string suffix = temporary_suffix();
  const auto time = time_for(data, images.size());
  const ProcessResult run =
      run_program("gnuplot", {"-d", "-e", "suffix='" + suffix + "'", stem + ".gp"}, folder, {control, time});
  bool all_whole = run.end == ProcessEnd::by_itself && run.exit_code == 0;
  for (const std::string& image : images) {
    for (const auto& [extension, ending] : {std::pair{".svg", "</svg>"}, std::pair{".png", "IEND"}}) {
      const std::string path = base + image + extension;
      const std::string temporary = path + suffix;
      if (run.exit_code == 0 && is_whole(temporary, ending) &&
          std::rename(temporary.c_str(), path.c_str()) == 0) {
        result.images.push_back(path);
      } else {
        std::remove(temporary.c_str());
        all_whole = false;
      }
    }
  }
  if (!all_whole)
    result.problem =
        run.end == ProcessEnd::stopped ? interrupted : problem_of(run, folder, stem + ".gp", time);
  return result;
}

}  // namespace arcslip::output
