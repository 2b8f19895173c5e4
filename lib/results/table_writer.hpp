#pragma once
// Results for people: aligned columns, or the lines that a result says of itself.

#include <arcslip/results/result.hpp>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace arcslip::results {

/// Writes End::text of each result or, where its schema says what is shown, a row for each row of that table,
/// or for the result itself, of all results of a schema that come one after the other; what they set comes
/// first, how each ended last. What a terminal must not get is escaped.
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

  using Cells = std::vector<std::string>;

  std::ostream& out_;
  std::vector<Schema> schemas_;
  std::size_t schema_ = 0;    // of the result that is open, and of the lines
  bool any_ = false;          // of what is written
  bool is_apart_ = false;     // what comes next is of another kind
  Head head_;                 // of that result
  std::vector<Cells> of_it_;  // its rows so far
  std::vector<Cells> lines_;  // those of all results since the last table
};

void write_table(std::ostream& out, const Results& results);

/// What people are told of results: for each that is not complete, which and why; for each that is, what
/// makes it doubtful, if anything.
class Remarks : public Sink {
 public:
  void begin(const Header& header, std::span<const Schema> schemas) override;
  void curve(const Head& head, std::size_t schema) override;
  void rows(std::size_t /*table*/, const Rows& /*rows*/) override {}
  void end(const End& end) override;
  void finish() override {}

  std::vector<std::string> early_ends, doubts;

 private:
  std::vector<std::string> nouns_;  // of the schemas
  std::size_t count_ = 0;           // of results so far
  std::string which_;               // the result that is open
};

}  // namespace arcslip::results
