#include <arcslip/report/parts.hpp>

#include <algorithm>

namespace arcslip::report {
namespace {

/// With a capital letter and a full stop.
std::string sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  if (!text.empty() && text.back() != '.' && text.back() != '!' && text.back() != '?') text += '.';
  return text;
}

void write_one(Html& html, const StudyContents& study, const std::string& id, const Doubt& doubt) {
  html.open("li", {{"class", doubt.is_complete ? "doubt" : "stop"}});
  html.element("strong", doubt.is_complete ? "In doubt: " : "Not complete: ");
  html.write("study ").element("a", study.name, {{"href", "#" + id}});
  html.write(", " + doubt.which + ". " + sentence(doubt.why));
  if (const std::string_view what = doubt.is_complete ? "" : advice(doubt.reason); !what.empty())
    html.raw(" ").element("span", "What to do: " + std::string(what), {{"class", "advice"}});
  html.close();
}

void write_not_started(Html& html, const StudyContents& study) {
  html.open("li", {{"class", "stop"}}).element("strong", "Not started: ");
  html.write("study \"" + study.name + "\". ");
  html.element("span", "What to do: Run the command again to get its results.", {{"class", "advice"}});
  html.close();
}

}  // namespace

void write_doubts(Html& html, const Contents& contents) {
  const bool any =
      std::any_of(contents.studies.begin(), contents.studies.end(),
                  [](const StudyContents& study) { return study.results == 0 || !study.doubts.empty(); });
  html.open("section", {{"id", "doubts"}, {"class", any ? "warn" : "fine"}});
  html.element("h2", any ? "Before you use these results" : "No doubts");
  if (!any) {
    html.element("p", "Each result is complete, and the program has no reason to doubt any of them.").close();
    return;
  }
  html.open("ul");
  for (const bool complete : {false, true}) {
    for (std::size_t i = 0; i < contents.studies.size(); ++i) {
      const StudyContents& study = contents.studies[i];
      if (!complete && study.results == 0) write_not_started(html, study);
      for (const Doubt& doubt : study.doubts)
        if (doubt.is_complete == complete) write_one(html, study, study_id(i), doubt);
    }
  }
  for (const StudyContents& study : contents.studies)
    if (study.doubts_left_out > 0)
      html.element("li", "And " + std::to_string(study.doubts_left_out) + " more of the study \"" +
                             study.name + "\": its files have them all.");
  html.close().close();
}

}  // namespace arcslip::report
