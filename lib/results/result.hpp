#pragma once
// Results as generic data: tables of columns and rows, further facts, and how the computation ended. A
// computation describes its results by a Schema and passes them to a Sink; every output format is a sink that
// depends only on this file.
//
//   sink.begin(header, schemas)                   all schemas
//     sink.curve(head, 0)                         a branch, a motion, an optimum: of schemas[0]
//       sink.rows(0, rows) sink.rows(1, rows)     of its tables, in any order and any number of parts
//     sink.end(end)
//     sink.curve(head, 0) ...
//   sink.finish()

#include <arcslip/results/reason.hpp>
#include <arcslip/results/value.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace arcslip::results {

/// The type of the cells of a column: the alternatives of Cells::of, in their order.
enum class Type { number, whole, flag, text, value };

struct Column {
  std::vector<std::string> path;  // nested keys: {"elements", "damper", "theta_0"}
  Type type = Type::number;
  std::string unit{};      // "N/m"; "" if it has none
  std::string help{};      // one line of Markdown
  int spread = 0;          // of a list of pairs [re, im]: so many of them have columns of their own in CSV
  bool is_detail = false;  // CSV has it only where it is named
};

/// "elements.damper.theta_0"
std::string name(const Column& column);

struct Table {
  std::string key;  // "points"
  std::vector<Column> columns;
  std::vector<std::string> objects{};  // keys of objects that each row has, even those without members
  bool by_columns = false;             // JSON holds a list for each column, and not an object for each row
};

/// What stands in place of a flag that is true, where another column has one of some words.
struct Instead {
  std::string text;  // "limit"
  std::string of;    // "kind"
  std::vector<std::string> words;
};

/// A column of the output for people.
struct Shown {
  std::string title;                 // "A_max (m)"
  std::vector<std::string> path;     // of a column, or of a fact of the end
  std::string format = "%.8g";       // of a number, as printf has it
  std::string otherwise{};           // a flag whose name stands where there is no value and the flag is true
  std::vector<std::string> error{};  // a column with its estimated error: digits that it moves are not shown
  double error_unit = 1;             // of that column, in the unit of this one
  // Columns that tell whether that error may be too low, flags that are true and estimates that are null:
  // then three digits are shown at most, also without an estimate.
  std::vector<std::string> doubtful{};
  Instead instead{};
  std::string unit{};  // the column has one prefix that suits its numbers, in the title as well: "A_max (mm)"
};

/// The structure of all results of a study.
struct Schema {
  std::string format;  // of a document that holds nothing else: "arcslip-branches-1"
  std::string list;    // key of the list in which a document holds them: "branches"
  std::string noun;    // "branch"
  std::vector<Table> tables;
  std::vector<Column> set{};          // of Head::set, in any of them
  std::vector<Shown> shown{};         // to people; none: End::text
  std::string shown_table{};          // whose rows; empty: facts of the end
  std::vector<std::string> nearby{};  // keys of a single result that are also written next to its list
};

/// The cells of one column; absent ones and non-finite numbers are missing values.
struct Cells {
  std::variant<std::vector<double>, std::vector<long>, std::vector<bool>, std::vector<std::string>,
               std::vector<Value>>
      of;
  std::vector<bool> absent{};  // rows without the column; empty: none
};

/// Some rows of a table, by columns.
struct Rows {
  std::size_t count = 0;
  std::vector<Cells> columns;
};

struct Header {
  std::string program, scene_hash, title, frequency_unit;
  Object reduction{};                // of the structure; empty: none
  std::vector<std::string> notes{};  // sentences about what the scene leaves open; mostly none
};

/// Data of a result before it is computed.
struct Head {
  std::string study{}, kind{};  // may be empty
  Object set{};                 // parameters and values that distinguish it from others of its study
  Object facts{};
  int parent = 0;  // the result it continues, counted backwards in its list; 0: none
};

/// A table with its rows.
struct TableRows {
  Table table;
  Rows rows;
};

/// The motion over a period at a row of one of the tables of a result, with so many instants besides those at
/// which contacts change.
using MotionAt = std::function<TableRows(std::size_t table, std::size_t row, int steps)>;

/// How it ended, with its facts.
struct End {
  Status status = Status::complete;
  Object stop;  // "reason", "value", "limit", "message"
  Object facts{};
  std::string doubt{};   // why a complete result is less accurate than it seems; empty: it is not
  std::string text{};    // for people, lines
  std::string remark{};  // for people, about a result that stands in a table
  MotionAt motion{};     // if it was asked for, and motions have harmonics; no file has it
};

/// Receives results: begin, then curve, rows and end for each result, and finish. Belongs to one thread. An
/// exception of a sink ends the study and is passed on.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void begin(const Header& header, std::span<const Schema> schemas) = 0;
  /// schema: index of the schemas of begin().
  virtual void curve(const Head& head, std::size_t schema) = 0;
  virtual void rows(std::size_t table, const Rows& rows) = 0;
  virtual void end(const End& end) = 0;
  virtual void finish() = 0;
};

/// A complete result.
struct Result {
  std::size_t schema = 0;
  Head head;
  std::vector<Rows> tables;
  End end;
};

struct Results {
  Header header;
  std::vector<Schema> schemas;
  std::vector<Result> results;
};

/// "damper.normal_load = 3 N, c.value = 0.1 N s/m", of Head::set; "" for nothing. Escaped by visible().
std::string assignment(const Object& set);

/// A row as members within members.
Object object(std::span<const Column> columns, const Rows& rows, std::size_t row);

/// Passes a result to a sink, with this schema.
void hand(const Result& result, std::size_t schema, Sink& sink);

/// Passes all results to a sink, list by list.
void replay(const Results& results, Sink& sink);

/// A sink that stores everything.
class Collector : public Sink {
 public:
  void begin(const Header& header, std::span<const Schema> schemas) override;
  void curve(const Head& head, std::size_t schema) override;
  void rows(std::size_t table, const Rows& rows) override;
  void end(const End& end) override;
  void finish() override {}

  Results results;
};

}  // namespace arcslip::results
