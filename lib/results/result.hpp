#pragma once
// Results as data, whatever they are of: tables of columns and rows, what is known beside them, how the
// computation ended. Who computes describes its results by a Schema and hands them to a Sink; each way to
// show them is a sink and knows nothing but this file.
//
//   sink.begin(header, schemas)                   what is to come
//     sink.curve(head, 0)                         a branch, a motion, an optimum: of schemas[0]
//       sink.rows(0, rows) sink.rows(1, rows)     of its tables, in any order, in as many parts as one likes
//     sink.end(end)
//     sink.curve(head, 0) ...
//   sink.finish()

#include <arcslip/results/reason.hpp>
#include <arcslip/results/value.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace arcslip::results {

/// What the cells of a column hold; the alternatives of Cells::of, in their order.
enum class Type { number, whole, flag, text, value };

struct Column {
  std::vector<std::string> path;  // keys within keys: {"elements", "damper", "theta_0"}
  Type type = Type::number;
  std::string unit{};  // "N/m"; "" of what has none
  std::string help{};  // one line of Markdown
};

/// "elements.damper.theta_0"
std::string name(const Column& column);

struct Table {
  std::string key;  // "points"
  std::vector<Column> columns;
  std::vector<std::string> objects{};  // keys of objects that each row has, even those without members
  bool by_columns = false;             // JSON holds a list for each column, and not an object for each row
};

/// What people are shown.
struct Shown {
  std::string title;              // "A_max (m)"
  std::vector<std::string> path;  // of a column, or of a fact of the end
  std::string format = "%.8g";    // of a number, as printf has it
  std::string otherwise{};        // a flag whose name stands where there is no value and the flag is true
};

/// What all results of one study look like.
struct Schema {
  std::string format;  // of a document that holds nothing else: "arcslip-branches-1"
  std::string list;    // key of the list in which a document holds them: "branches"
  std::string noun;    // "branch"
  std::vector<Table> tables;
  std::vector<Column> set{};          // of Head::set, in any of them
  std::vector<Shown> shown{};         // to people; none: End::text
  std::string shown_table{};          // whose rows; empty: facts of the end
  std::vector<std::string> beside{};  // keys of the one result of a document that stand beside its list, too
};

/// The cells of one column, each where the row has it; a number that is not finite is no value.
struct Cells {
  std::variant<std::vector<double>, std::vector<long>, std::vector<bool>, std::vector<std::string>,
               std::vector<Value>>
      of;
  std::vector<bool> absent{};  // rows without the column; empty: there is none
};

/// Some rows of a table, by columns.
struct Rows {
  std::size_t count = 0;
  std::vector<Cells> columns;
};

struct Header {
  std::string program, scene_hash, title, frequency_unit;
};

/// What is known of a result before it is computed.
struct Head {
  std::string study{}, kind{};  // empty where nobody said so
  Object set{};                 // parameters and their values, which tell it from others of its study
  Object facts{};
  int parent = 0;  // the result that it goes on from, so many before it in its list; 0: none
};

/// How it ended, and what is known of it then.
struct End {
  Status status = Status::complete;
  Object stop;  // "reason", "value", "limit", "message"
  Object facts{};
  std::string doubt{};  // why what is complete has fewer digits than it seems; empty: it has not
  std::string text{};   // for people, lines
};

class Sink {
 public:
  virtual ~Sink() = default;
  virtual void begin(const Header& header, std::span<const Schema> schemas) = 0;
  /// schema: which of those at the beginning.
  virtual void curve(const Head& head, std::size_t schema) = 0;
  virtual void rows(std::size_t table, const Rows& rows) = 0;
  virtual void end(const End& end) = 0;
  virtual void finish() = 0;
};

/// All of a result.
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

/// Hands one of them to a sink, as of this schema.
void hand(const Result& result, std::size_t schema, Sink& sink);

/// Hands all of it to a sink: those of one list after the other.
void replay(const Results& results, Sink& sink);

/// A sink that keeps all that it is given.
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
