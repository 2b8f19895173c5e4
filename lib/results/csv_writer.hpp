#pragma once
// Results as comma-separated values (RFC 4180), a file for each table and a summary file with a row for each
// result, format "arcslip-csv-2".
//
// Columns: "study"; the parameters set by for_each; the number of the result, from 1, titled by the noun of
// its schema; then those of the table: a column's path joined by dots, without "elements", and its unit,
// "damper.stick_percent (%)". A missing value is an empty cell, a flag true or false, a list or an object
// its JSON. Next to a list of pairs the first ones have columns of their own: "multipliers.1.re".

#include <arcslip/results/result.hpp>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace arcslip::results {

/// Writes the tables of one key as they arrive. Results whose schema has no such table are skipped.
class CsvWriter : public Sink {
 public:
  CsvWriter(std::ostream& out, std::string table);

  void begin(const Header& header, std::span<const Schema> schemas) override;
  void curve(const Head& head, std::size_t schema) override;
  void rows(std::size_t table, const Rows& rows) override;
  void end(const End& /*end*/) override {}
  void finish() override {}

 private:
  std::ostream& out_;
  std::string key_;
  void put_pairs(const Column& column, const Value& list, std::vector<std::string>& cells) const;

  std::vector<Schema> schemas_;
  std::vector<std::string> set_, columns_;   // titles
  std::size_t schema_ = 0;                   // of the current result
  std::map<std::string, long> count_;        // results so far, by noun
  std::map<std::string, std::string> head_;  // what the result sets, by titles
  std::string first_;                        // cells of each row of the result
};

/// Writes a row for each result: status, reason and message of its end, and all facts that are numbers, flags
/// or texts, titled by their paths. Keeps the rows until finish().
class CsvSummary : public Sink {
 public:
  explicit CsvSummary(std::ostream& out);

  void begin(const Header& header, std::span<const Schema> schemas) override;
  void curve(const Head& head, std::size_t schema) override;
  void rows(std::size_t /*table*/, const Rows& /*rows*/) override {}
  void end(const End& end) override;
  void finish() override;

 private:
  void put(const std::string& title, std::string cell);
  void put(const std::string& prefix, const Object& facts);

  std::ostream& out_;
  std::vector<Schema> schemas_;
  std::map<std::string, long> count_;
  std::vector<std::string> titles_;  // in the order in which they came
  std::vector<std::string> row_;     // of the result that is open, by titles
  struct Line {
    std::string text;  // of the cells whose titles had come
    std::size_t cells;
  };
  std::vector<Line> lines_;
};

/// Of all tables, each once.
std::vector<std::string> table_keys(std::span<const Schema> schemas);

/// Throws std::invalid_argument where no schema has the table, with those that they have.
void write_csv(std::ostream& out, const Results& results, const std::string& table);
void write_csv_summary(std::ostream& out, const Results& results);

}  // namespace arcslip::results
