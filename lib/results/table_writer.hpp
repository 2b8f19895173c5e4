#pragma once
// Text output of results: aligned columns, or the text of a result.

#include <arcslip/results/result.hpp>
#include <arcslip/results/shown.hpp>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace arcslip::results {

/// Writes End::text of each result or, if its schema has shown columns, one table for all consecutive results
/// of a schema, with a row for each row of the shown table or for each result; set parameters come first, the
/// status last. Characters unsafe for a terminal are escaped.
class TableWriter : public Sink {
 public:
  explicit TableWriter(std::ostream& out);

  void begin(const Header& header, std::span<const Schema> schemas) override;
  void curve(const Head& head, std::size_t schema) override;
  void rows(std::size_t table, const Rows& rows) override;
  void end(const End& end) override;
  void finish() override;

 private:
  void separate();

  using Cells = std::vector<ShownCell>;

  std::ostream& out_;
  std::vector<Schema> schemas_;
  std::size_t schema_ = 0;    // of the result that is open, and of the lines
  bool any_ = false;          // of what is written
  bool is_apart_ = false;     // what comes next is of another kind
  Head head_;                 // of that result; its facts have its number as "id"
  long count_ = 0;            // of the results of its schema
  std::vector<Cells> of_it_;  // its rows so far
  std::vector<Cells> lines_;  // those of all results since the last table
};

void write_table(std::ostream& out, const Results& results);

/// Remarks on results: for each incomplete result, which and why; for each complete one, reasons for doubt;
/// and what else is said of them.
class Remarks : public Sink {
 public:
  void begin(const Header& header, std::span<const Schema> schemas) override;
  void curve(const Head& head, std::size_t schema) override;
  void rows(std::size_t /*table*/, const Rows& /*rows*/) override {}
  void end(const End& end) override;
  void finish() override {}

  std::vector<std::string> early_ends, doubts, others;

 private:
  std::vector<std::string> nouns_;  // of the schemas
  std::size_t count_ = 0;           // of results so far
  std::string which_, from_;        // the result that is open, and the one it continues
};

}  // namespace arcslip::results
