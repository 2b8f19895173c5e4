#include <arcslip/report/html.hpp>
#include <arcslip/report/parts.hpp>
#include <arcslip/report/report.hpp>

#include <algorithm>
#include <utility>

namespace arcslip::report {
namespace {

constexpr std::size_t most_figures = 24;  // of a study

/// A tolerance that nobody sees at any zoom, and how much larger the next one is where points are too many.
constexpr double finest = 1e-5, coarser = 4;

/// The figures of all studies, thinned alike.
struct Figures {
  std::vector<std::vector<results::FigureData>> of_studies{};
  std::size_t points = 0, all_points = 0;
  bool visibly = false;  // points that a zoom may miss are left out
};

Figures figures_of(const Contents& contents) {
  Figures figures;
  for (const StudyContents& study : contents.studies)
    for (const results::FigureData& data : study.figures) figures.all_points += points_of(data);
  for (double tolerance = finest;; tolerance *= coarser) {
    figures.of_studies.clear();
    figures.points = 0;
    for (const StudyContents& study : contents.studies) {
      auto& own = figures.of_studies.emplace_back();
      for (const results::FigureData& data : study.figures) own.push_back(thinned(data, tolerance));
      for (const results::FigureData& data : own) figures.points += points_of(data);
    }
    figures.visibly = tolerance > finest;
    if (figures.points <= most_points || tolerance > 1e-2) return figures;
  }
}

void write_asset(Html& html, std::string_view element, const Asset& asset) {
  html.raw("<").raw(element).raw(">");
  for (const std::string_view piece : asset.pieces) html.raw(piece);
  html.raw("</").raw(element).raw(">\n");
}

std::string source(const Asset& asset) {
  return asset.pieces.empty() ? "" : " '" + std::string(asset.hash) + "'";
}

std::string title_of(const Contents& contents) {
  return contents.header.title.empty() ? "Results" : contents.header.title;
}

void write_head(Html& html, const Contents& contents) {
  html.raw("<!DOCTYPE html>\n").open("html", {{"lang", "en"}}).open("head");
  html.raw("<meta charset=\"utf-8\">\n");
  html.raw("<meta http-equiv=\"Content-Security-Policy\" content=\"")
      .write("default-src 'none'; script-src" + source(d3()) + source(script()) + "; style-src" +
             source(style()) + "; base-uri 'none'; form-action 'none'")
      .raw("\">\n");
  html.raw(
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta name=\"referrer\" content=\"no-referrer\">\n");
  html.element("title", title_of(contents));
  write_asset(html, "style", style());
  html.close();
}

void write_overview(Html& html, const Contents& contents) {
  html.open("nav", {{"aria-label", "Studies"}}).open("ul");
  html.open("li").element("a", "Scene", {{"href", "#scene"}}).close();
  for (std::size_t i = 0; i < contents.studies.size(); ++i) {
    const StudyContents& study = contents.studies[i];
    const auto stopped = std::count_if(study.doubts.begin(), study.doubts.end(),
                                       [](const Doubt& doubt) { return !doubt.is_complete; });
    html.open("li").element("a", study.name, {{"href", "#" + study_id(i)}});
    html.write(" (" + study.kind + ", " + std::to_string(study.results) + " " +
               (study.results == 1 ? "result" : "results") +
               (stopped > 0 ? ", " + std::to_string(stopped) + " not complete" : "") + ")");
    html.close();
  }
  html.close().close();
}

void write_scene(Html& html, const Contents& contents) {
  html.open("section", {{"id", "scene"}}).element("h2", "Scene");
  for (const std::string& note : contents.header.notes)
    html.element("p", "Note: " + note + ".", {{"class", "note"}});
  write_drawing(html, contents.scene);
  write_parameters(html, contents);
  html.close();
}

void write_figures(Html& html, std::size_t study, const std::vector<results::FigureData>& all) {
  std::size_t shown = 0, left_out = 0;
  html.open("div", {{"class", "figures"}});
  for (std::size_t d = 0; d < all.size(); ++d)
    for (std::size_t f = 0; f < all[d].figures.size(); ++f) {
      if (!results::is_drawn(all[d], all[d].figures[f])) continue;
      if (shown == most_figures) {
        ++left_out;
        continue;
      }
      ++shown;
      const results::FigureView& figure = all[d].figures[f];
      html.open("figure", {{"class", "curve"},
                           {"data-study", std::to_string(study)},
                           {"data-data", std::to_string(d)},
                           {"data-figure", std::to_string(f)}});
      html.element("figcaption", results::caption(all[d], figure));
      write_plain_curve(html, all[d], figure);
      html.close();
    }
  html.close();
  if (left_out > 0)
    html.element("p", "The page shows the first " + std::to_string(most_figures) + " of " +
                          std::to_string(shown + left_out) + " figures; the folder has them all.");
}

void write_study(Html& html, const Contents& contents, std::size_t i,
                 const std::vector<results::FigureData>& figures) {
  const StudyContents& study = contents.studies[i];
  html.open("section", {{"class", "study"}, {"id", study_id(i)}}).element("h2", study.name);
  html.element("p", study.help, {{"class", "help"}});
  for (const Search& search : study.searches) write_optimum(html, search);
  write_figures(html, i, figures);
  if (figures.empty() && study.left_out > 0)
    html.element("p", "No curves are drawn: the study has more than " + std::to_string(most_results) +
                          " combinations of values.");
  write_results(html, study, study_id(i));
  if (!study.remarks.empty()) {
    html.open("details", {{"class", "remarks"}}).element("summary", "Remarks").open("ul");
    for (const std::string& remark : study.remarks) html.element("li", remark);
    html.close().close();
  }
  html.close();
}

void write_scripts(Html& html, const Contents& contents, const Figures& figures) {
  std::string json = "{\"studies\":[";
  for (std::size_t i = 0; i < contents.studies.size(); ++i)
    (json += i > 0 ? "," : "") += figures_json(contents.studies[i], figures.of_studies[i]);
  html.raw("<script type=\"application/json\" id=\"data\">")
      .raw(json_for_script(json + "]}"))
      .raw("</script>\n");
  if (!d3().pieces.empty()) write_asset(html, "script", d3());
  write_asset(html, "script", script());
}

void write_footer(Html& html, const Contents& contents) {
  html.open("footer");
  html.element("p", "Made by " + contents.header.program + " from the scene with the hash " +
                        contents.header.scene_hash + ".");
  if (const Asset licence = d3_licence(); !d3().pieces.empty()) {
    html.open("details").element("summary", "The curves are drawn by D3, whose licence is this").open("pre");
    for (const std::string_view piece : licence.pieces) html.write(piece);
    html.close().close();
  }
  html.close();
}

}  // namespace

std::string study_id(std::size_t study) {
  return "s" + std::to_string(study);
}

void write_page(std::ostream& out, const Contents& contents) {
  Html html(out);
  const Figures figures = figures_of(contents);
  write_head(html, contents);
  html.open("body").open("header").element("h1", title_of(contents));
  write_overview(html, contents);
  html.close().open("main");
  write_doubts(html, contents);
  write_scene(html, contents);
  for (std::size_t i = 0; i < contents.studies.size(); ++i)
    write_study(html, contents, i, figures.of_studies[i]);
  html.close();
  if (figures.visibly)
    html.element("p", "The curves show " + std::to_string(figures.points) + " of " +
                          std::to_string(figures.all_points) + " points; the files have them all.");
  write_footer(html, contents);
  write_scripts(html, contents, figures);
  html.close().close();
}

}  // namespace arcslip::report
