#pragma once
// Figures, drawn by gnuplot.

#include <arcslip/control/run_control.hpp>
#include <arcslip/output/process.hpp>
#include <arcslip/results/figure.hpp>
#include <arcslip/results/figure_data.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <future>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::output {

/// How figures are drawn.
struct FigureOptions {
  std::vector<std::string> formats{"svg", "png"};  // of figure_formats; none: the data and the script alone
  results::FigureStyle style{};
};
inline constexpr std::array<std::string_view, 3> figure_formats = {"svg", "png", "pdf"};

/// Curves and the name of their files, of letters, digits, '.', '_' and '-' after file_name().
struct NamedFigures {
  std::string name;
  const results::FigureData& data;
};

struct Figures {
  std::vector<std::string> sources{};  // data and gnuplot scripts, paths starting with `folder`
  std::vector<std::string> images{};
  std::string problem{};  // why images are missing, one sentence for the user; empty: none are
};

/// Figures that a gnuplot draws while the caller goes on.
class DrawingFigures {
 public:
  /// Writes NAME.dat and NAME.gp to `folder` for each of `all`, and starts one gnuplot to draw their figures.
  /// It ends with `control`, or at its time: a minute, plus 0.1 ms for each point of each figure. Throws
  /// WriteError if the sources cannot be written.
  DrawingFigures(std::span<const NamedFigures> all, std::string folder, FigureOptions options = {},
                 const control::Control& control = {});

  /// Waits for gnuplot. If it is missing, fails, exceeds its time or was stopped, `problem` reports it, and
  /// images of these names that are there stay where they cannot be drawn.
  Figures finish();

 private:
  void write_sources(const NamedFigures& of);
  bool take_images(bool has_drawn);

  std::string folder_;
  FigureOptions options_;
  control::Control control_;
  Figures result_{};
  std::string scripts_{};  // "a.gp b.gp"
  std::vector<std::string> images_{};
  std::size_t points_ = 0;  // of all figures
  std::chrono::milliseconds time_{};
  std::future<ProcessResult> run_{};  // not valid: nothing is drawn
};

/// Draws the figures of some curves, and waits.
Figures draw_figures(const results::FigureData& data, const std::string& folder, const std::string& name,
                     const FigureOptions& options = {}, const control::Control& control = {});

/// Returns the names of all files that draw_figures() may write to its folder, temporary ones among them.
std::vector<std::string> figure_files(const results::FigureData& data, const std::string& name,
                                      const FigureOptions& options = {});

/// A file name for any name: characters other than letters, digits, '_', '-' and an inner '.' become '_'.
std::string file_name(const std::string& name);

}  // namespace arcslip::output
