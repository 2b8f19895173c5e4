#include <arcslip/output/figures.hpp>

#include <arcslip/output/atomic_file.hpp>
#include <arcslip/output/draw_figures.hpp>
#include <arcslip/output/gnuplot_script.hpp>
#include <arcslip/output/process.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string_view>

#include <unistd.h>

namespace arcslip::output {
namespace {

/// Whether an image is whole: it ends as its format must.
bool is_whole(const std::string& path, std::string_view ending) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
  const std::streamoff tail_size = std::min<std::streamoff>(size, 32);
  std::string tail(static_cast<std::size_t>(tail_size), '\0');
  file.seekg(size - tail_size);
  file.read(tail.data(), tail_size);
  return file && tail.find(ending) != std::string::npos;
}

std::string problem_of(const ProcessResult& result, const std::string& folder, const std::string& script) {
  if (!result.found) {
    return "figures need gnuplot (Debian package gnuplot-nox); the data and the script are there: "
           "after installing it, run gnuplot -d " +
           script + " in " + folder;
  }
  std::string problem =
      "gnuplot could not draw the figures (exit code " + std::to_string(result.exit_code) + ")";
  if (result.signal != 0) {
    problem = "gnuplot was ended by signal " + std::to_string(result.signal);
  } else if (result.exit_code == 0) {
    problem = "gnuplot left a figure incomplete, or it could not be put in its place (is the disk full?)";
  }
  problem += "; to see why, run gnuplot -d " + script + " in " + folder;
  std::string said = result.text;
  said.erase(std::unique(said.begin(), said.end(), [](char a, char b) { return a == '\n' && b == '\n'; }),
             said.end());
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) {
    said.pop_back();
  }
  return said.empty() ? problem : problem + "\n" + said;
}

}  // namespace

std::string file_name(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '-' || (c == '.' && !result.empty());
    result += plain ? c : '_';
    if (result.size() == 100) {
      break;
    }
  }
  return result.empty() || result.front() == '-' ? "_" + result : result;
}

Figures write_figures(const scene::Scene& scene, scene::StudyKind kind,
                      std::span<const observables::ResponseBranch> branches, const std::string& folder,
                      const std::string& name) {
  return draw_figures(scene, figure_data(scene, kind, branches), folder, name);
}

Figures draw_figures(const scene::Scene& scene, const FigureData& data, const std::string& folder,
                     const std::string& name) {
  const std::string stem = file_name(name);
  const std::string base = folder + (folder.empty() || folder.back() != '/' ? "/" : "");
  const std::vector<GnuplotFigure> figures = gnuplot_figures(data, stem);

  Figures result;
  result.sources = {base + stem + ".dat", base + stem + ".gp"};
  write_file(result.sources[0], [&](std::ostream& out) { write_figure_data(out, scene, data); });
  write_file(result.sources[1], [&](std::ostream& out) { write_gnuplot_script(out, data, stem, figures); });
  if (figures.empty()) {
    result.problem = "there is no point to draw, so there is no figure";
    return result;
  }

  // gnuplot writes under a temporary name; what is whole gets its own.
  const std::string suffix = "." + std::to_string(::getpid()) + ".tmp";
  const ProcessResult run =
      run_program("gnuplot", {"-d", "-e", "suffix='" + suffix + "'", stem + ".gp"}, folder);
  bool all_whole = run.found && run.exit_code == 0;
  for (const GnuplotFigure& figure : figures) {
    for (const auto& [extension, ending] : {std::pair{".svg", "</svg>"}, std::pair{".png", "IEND"}}) {
      const std::string path = base + figure.name + extension;
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
  if (!all_whole) {
    result.problem = problem_of(run, folder, stem + ".gp");
  }
  return result;
}

}  // namespace arcslip::output
