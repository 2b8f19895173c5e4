#pragma once
// Results as JSON.

#include <arcslip/results/result.hpp>

#include <iosfwd>
#include <memory>

namespace arcslip::results {

/// Writes one object: {"format", "program", "scene_hash", "title", "frequency_unit", "notes", "units",
/// "reduction", LIST: [R, ...]}, and so for each list; "units" are those of columns, by list, table and name;
/// its format is that of the schemas if they agree, else "arcslip-results-1". The results of a list must be
/// consecutive. A list with one result is followed by its Schema::next to. Here
///   R = {"study", "kind", facts of the head, "set", a key for each table, "status", "stop",
///        "doubt", facts of the end}
/// without "notes", "units", "reduction", "study", "kind" and "doubt" if they are empty. A table is a list of
/// objects, one row per line, or an object of lists. Numbers have the fewest digits that read back exactly;
/// non-finite ones are null. Rows of the first table are written as they arrive, those of others are kept
/// until the result ends.
class JsonWriter : public Sink {
 public:
  /// The stream outlives this; its state says whether writing succeeded.
  explicit JsonWriter(std::ostream& out);
  ~JsonWriter() override;

  void begin(const Header& header, std::span<const Schema> schemas) override;
  void curve(const Head& head, std::size_t schema) override;
  void rows(std::size_t table, const Rows& rows) override;
  void end(const End& end) override;
  void finish() override;

 private:
  class TableText;
  struct BesideText;

  void open(const std::string& list);
  void close();

  std::ostream& out_;
  std::vector<Schema> schemas_;
  std::vector<std::string> written_;  // lists
  std::string list_;                  // that is open; empty: none
  std::size_t in_list_ = 0;           // results so far
  const Schema* schema_ = nullptr;    // of the result that is open
  std::vector<std::unique_ptr<TableText>> tables_;
  std::string nearby_;  // of the first result of a list
};

/// A value as JSON.
std::string json(const Value& value);

void write_json(std::ostream& out, const Results& results);

}  // namespace arcslip::results
