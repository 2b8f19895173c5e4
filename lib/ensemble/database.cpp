#include <arcslip/ensemble/database.hpp>

#include <arcslip/results/text.hpp>

#include <sqlite3.h>

namespace arcslip::ensemble {
namespace {

int flags_of(Database::Access access) {
  switch (access) {
    case Database::Access::read:
      return SQLITE_OPEN_READONLY;
    case Database::Access::write:
      return SQLITE_OPEN_READWRITE;
    default:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  }
}

std::string message_of(const std::string& path, sqlite3* database) {
  const int code = database != nullptr ? sqlite3_errcode(database) & 0xff : SQLITE_NOMEM;
  std::string text = results::visible(path) + ": ";
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) return text + "another run writes this file";
  if (code == SQLITE_NOTADB) return text + "found a file that is no SQLite database";
  return text + (database != nullptr ? sqlite3_errmsg(database) : "out of memory");
}

}  // namespace

std::string quoted_name(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

void Database::Close::operator()(sqlite3* database) const {
  sqlite3_close_v2(database);
}

Database::Database(const std::string& path, Access access) : path_(path) {
  sqlite3* opened = nullptr;
  // A path that begins with "file:" is a path, too.
  const std::string name = path.starts_with('/') ? path : "./" + path;
  const int code = sqlite3_open_v2(name.c_str(), &opened, flags_of(access) | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) fail();
  sqlite3_busy_timeout(opened, 1000);
}

void Database::fail() const {
  throw FileFault(message_of(path_, database_.get()));
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

Cell Database::value(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.cell(0) : Cell();
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  sqlite3_stmt* made = nullptr;
  const int code = sqlite3_prepare_v2(database.database_.get(), sql.c_str(), static_cast<int>(sql.size() + 1),
                                      &made, nullptr);
  statement_.reset(made);
  if (code != SQLITE_OK) database_.fail();
}

void Statement::bind(std::size_t parameter, const Cell& value) {
  sqlite3_stmt* to = statement_.get();
  const int at = static_cast<int>(parameter) + 1;
  int code = SQLITE_OK;
  if (const auto* number = std::get_if<double>(&value))
    code = sqlite3_bind_double(to, at, *number);
  else if (const auto* whole = std::get_if<long>(&value))
    code = sqlite3_bind_int64(to, at, *whole);
  else if (const auto* text = std::get_if<std::string>(&value))
    code = sqlite3_bind_text64(to, at, text->data(), text->size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  else
    code = sqlite3_bind_null(to, at);
  if (code != SQLITE_OK) database_.fail();
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.fail();
  return code == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {
  }
  sqlite3_reset(statement_.get());
}

bool Statement::is_null(std::size_t column) const {
  return sqlite3_column_type(statement_.get(), static_cast<int>(column)) == SQLITE_NULL;
}

double Statement::number(std::size_t column) const {
  return sqlite3_column_double(statement_.get(), static_cast<int>(column));
}

long Statement::whole(std::size_t column) const {
  return static_cast<long>(sqlite3_column_int64(statement_.get(), static_cast<int>(column)));
}

std::string Statement::text(std::size_t column) const {
  const auto* text = sqlite3_column_text(statement_.get(), static_cast<int>(column));
  const int size = sqlite3_column_bytes(statement_.get(), static_cast<int>(column));
  return text != nullptr ? std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(size))
                         : std::string();
}

Cell Statement::cell(std::size_t column) const {
  switch (sqlite3_column_type(statement_.get(), static_cast<int>(column))) {
    case SQLITE_INTEGER:
      return whole(column);
    case SQLITE_FLOAT:
      return number(column);
    case SQLITE_NULL:
      return {};
    default:
      return text(column);
  }
}

std::size_t Statement::columns() const {
  return static_cast<std::size_t>(sqlite3_column_count(statement_.get()));
}

std::string Statement::name(std::size_t column) const {
  const char* name = sqlite3_column_name(statement_.get(), static_cast<int>(column));
  return name != nullptr ? name : "";
}

}  // namespace arcslip::ensemble
