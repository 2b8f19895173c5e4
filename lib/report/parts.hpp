#pragma once
// The parts of the page, each in a file of its name.

#include <arcslip/report/contents.hpp>
#include <arcslip/report/html.hpp>
#include <arcslip/results/figure.hpp>
#include <arcslip/results/figure_data.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::report {

void write_page(std::ostream& out, const Contents& contents);

/// A text that is embedded when the program is built (cmake/embed.cmake): its pieces, in their order, and its
/// hash for a Content-Security-Policy, "sha256-...". No pieces: it was not there.
struct Asset {
  std::span<const std::string_view> pieces{};
  std::string_view hash{};
};
Asset style();
Asset script();
Asset d3();
Asset d3_licence();

/// The id of the section of a study.
std::string study_id(std::size_t study);

/// What is incomplete or in doubt, and what to do about it.
void write_doubts(Html& html, const Contents& contents);

/// What to do about a reason for which computations end; "" where the message says all.
std::string_view advice(std::string_view reason);

/// The structure as a drawing: masses, springs, dampers, elements, forces. Of what it does not show, it says
/// why.
void write_drawing(Html& html, const scene::Scene& scene);

/// All parameters with their values, units and what they mean.
void write_parameters(Html& html, const Contents& contents);

/// The table of a study, whose rows have the ids "ROW_ID-0", "ROW_ID-1" ...
void write_results(Html& html, const StudyContents& study, const std::string& row_id);

/// The optimum in words: where it is, within which range, and what is known about it.
void write_optimum(Html& html, const Search& search);

/// A figure as a plain drawing, with a key.
void write_plain_curve(Html& html, const results::FigureData& data, const results::FigureView& view);

/// The outline of a mark around the origin, as a path, and whether it is filled.
struct Outline {
  std::string_view path;
  bool is_filled = false;
};
Outline outline(results::Shape shape);

/// The class of a line in a drawing, by which it has its colour.
std::string line_class(std::size_t line, std::size_t lines);

/// The class of an area in a drawing, by its rank: of a contact state, or of a class of values.
std::string area_class(const results::Figure& figure, std::size_t rank);

/// The same figure with fewer points: those whose absence moves no line by more than `tolerance` of its axes.
results::FigureData thinned(const results::FigureData& data, double tolerance);

/// How many points the lines have.
std::size_t points_of(const results::FigureData& data);

/// The figures of a study as JSON, with the rows of the table that their marks belong to.
std::string figures_json(const StudyContents& study, const std::vector<results::FigureData>& figures);

}  // namespace arcslip::report
