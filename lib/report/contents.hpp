#pragma once
// What a page shows, as data.

#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/results/shown.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace arcslip::report {

/// A result that ended early, or that is in doubt.
struct Doubt {
  std::string which, why;   // "branch 3 (k.value = 2 N/m)", a sentence
  std::string reason{};     // code of the reason for which it ended
  bool is_complete = true;  // only in doubt
};

/// A row of the table of a study.
struct TableRow {
  std::vector<results::ShownCell> cells;
  std::string kind{};             // of an event
  std::vector<double> numbers{};  // of an event, by which its mark in a figure is found
};

/// The results of a search.
struct Search {
  std::string set;  // "k.value = 2 N/m"; empty: the only one
  results::Status status = results::Status::complete;
  results::Object facts;
  std::string text;  // for people, lines
};

struct StudyContents {
  std::string name, kind, help;
  results::Schema schema{};
  std::vector<TableRow> rows{};
  std::vector<Search> searches{};
  std::vector<std::string> remarks{};
  std::vector<Doubt> doubts{};
  std::vector<results::FigureData> figures{};
  std::size_t results = 0;   // all of them
  std::size_t left_out = 0;  // beyond what the page shows
  std::size_t doubts_left_out = 0;
};

struct Contents {
  const scene::Scene& scene;
  results::Header header{};
  std::vector<StudyContents> studies{};
  // The result that is open.
  results::Head head{};
  std::size_t study = 0;
  std::vector<TableRow> rows{};
};

}  // namespace arcslip::report
