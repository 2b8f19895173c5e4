#pragma once
// The file of an ensemble, or of a part of one: a SQLite database with the tables
//
//   ensemble(key, value)                  what is computed: program, scene, study, samples, part
//   columns(of, name, type, unit, help)   the columns of the other tables
//   samples(sample, PARAMETER..., status, reason, doubt, results, QUANTITY...)   a row for each sample
//   events, points, ...(sample, result, COLUMN...)                               where they are kept

#include <arcslip/ensemble/database.hpp>
#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/ensemble/kept.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/combinations.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::ensemble {

inline constexpr std::string_view file_format = "arcslip-ensemble-1";

struct TableColumn {
  std::string name, type, unit, help;  // type: of SQL
};

/// What a file holds: facts that decide its rows, and its tables.
struct Contents {
  std::vector<std::pair<std::string, std::string>> facts;
  Range samples;
  std::vector<TableColumn> columns;  // of the table of samples, without its key
  std::vector<std::pair<std::string, std::vector<TableColumn>>> tables;
};

struct Sample {
  long index = 0;
  scene::Setting set{};
  std::string status{}, reason{}, doubt{};
  long results = 0;
  std::vector<Cell> quantities{};
  std::vector<std::vector<Cell>>
      rows{};  // of all tables that are kept, each with the index of its table first
};

class EnsembleFile {
 public:
  /// Opens a file, or makes it. Throws OtherEnsemble where it holds others than `contents`, and
  /// FileFault.
  EnsembleFile(const std::string& path, const Contents& contents);

  /// Returns the samples that are not there.
  std::vector<Range> missing();
  long count();
  long failed();
  double bytes();
  /// Adds a row. A transaction ends a second after the one before.
  void add(const Sample& sample);
  void commit();
  /// Writes all to the file itself.
  void finish();
  /// Sets the units of columns that were not known.
  void set_units(const std::vector<Quantity>& quantities);
  Database& database() { return database_; }

 private:
  using Clock = std::chrono::steady_clock;

  void compare(const Contents& contents);
  void prepare(const Contents& contents);

  Database database_;
  Range samples_;
  std::optional<Statement> insert_;
  std::vector<Statement> insert_rows_;
  bool in_transaction_ = false;
  Clock::time_point committed_ = Clock::now();
};

/// Returns the facts of a file. Throws FileFault where it is no file of an ensemble.
std::vector<std::pair<std::string, std::string>> facts_of(Database& database);
/// Returns a fact; "" where there is none.
std::string fact_in(const std::vector<std::pair<std::string, std::string>>& facts, std::string_view key);

/// Makes the tables of a file, and describes their columns.
void make_tables(Database& database, const Contents& contents);
/// Returns the contents of a file, as make_tables() takes them.
Contents contents_of(Database& database);
/// Returns the columns that each table of samples has, next to its parameters and quantities.
std::span<const TableColumn> sample_columns();
/// Returns the samples of a range that a file does not have.
std::vector<Range> missing_in(Database& database, Range samples);

}  // namespace arcslip::ensemble
