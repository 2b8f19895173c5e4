#pragma once
// A SQLite database and its statements, whose failures are exceptions.

#include <arcslip/ensemble/ensemble.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

struct sqlite3;
struct sqlite3_stmt;

namespace arcslip::ensemble {

/// A value of a row; std::monostate is NULL.
using Cell = std::variant<std::monostate, double, long, std::string>;

/// A name as SQL has it: "peak.amplitude", in quotes.
std::string quoted_name(std::string_view name);

class Database {
 public:
  enum class Access { read, write, create };

  /// Throws FileFault.
  Database(const std::string& path, Access access);

  void execute(const std::string& sql);
  /// Returns the first cell of the first row; NULL where there is no row.
  Cell value(const std::string& sql);
  const std::string& path() const { return path_; }

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* database) const;
  };
  [[noreturn]] void fail() const;

  std::string path_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// A prepared statement. Its database outlives it.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  /// Sets a parameter, numbered from 0. Texts are copied.
  void bind(std::size_t parameter, const Cell& value);
  /// Goes to the next row; returns false behind the last one.
  bool step();
  /// Runs it to its end, and makes it ready for other parameters.
  void run();

  Cell cell(std::size_t column) const;
  bool is_null(std::size_t column) const;
  double number(std::size_t column) const;
  long whole(std::size_t column) const;
  std::string text(std::size_t column) const;
  std::size_t columns() const;
  std::string name(std::size_t column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };

  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace arcslip::ensemble
