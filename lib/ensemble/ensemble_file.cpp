#include <arcslip/ensemble/ensemble_file.hpp>

#include <arcslip/ensemble/difference.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>

namespace arcslip::ensemble {
namespace {

constexpr std::chrono::seconds commit_every{1};

// The columns of the table of samples that each ensemble has.
const std::array<TableColumn, 4> own_columns = {
    {{"status", "TEXT", "", "complete, stopped or failed"},
     {"reason", "TEXT", "", "why it is not complete"},
     {"doubt", "TEXT", "", "why a complete result is less accurate than it seems"},
     {"results", "INTEGER", "", "number of results, such as branches"}}};

std::string column_list(const std::vector<TableColumn>& columns) {
  std::string text;
  for (const TableColumn& column : columns) text += ", " + quoted_name(column.name) + " " + column.type;
  return text;
}

std::string parameters(std::size_t count) {
  std::string text = "(?";
  for (std::size_t i = 1; i < count; ++i) text += ", ?";
  return text + ")";
}

void add_columns(Database& database, const std::string& table, const std::vector<TableColumn>& columns) {
  Statement insert(database, "INSERT INTO columns VALUES (?, ?, ?, ?, ?)");
  for (const TableColumn& column : columns) {
    insert.bind(0, table);
    insert.bind(1, column.name);
    insert.bind(2, column.type);
    insert.bind(3, column.unit);
    insert.bind(4, column.help);
    insert.run();
  }
}

bool has_tables(Database& database) {
  return std::get<long>(database.value("SELECT count(*) FROM sqlite_master")) > 0;
}

}  // namespace

void make_tables(Database& database, const Contents& contents) {
  database.execute("CREATE TABLE ensemble(key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID");
  database.execute("CREATE TABLE columns(of TEXT, name TEXT, type TEXT, unit TEXT, help TEXT)");
  database.execute("CREATE TABLE samples(sample INTEGER PRIMARY KEY" + column_list(contents.columns) + ")");
  add_columns(database, "samples", contents.columns);
  for (const auto& [name, columns] : contents.tables) {
    database.execute("CREATE TABLE " + quoted_name(name) + "(sample INTEGER, result INTEGER" +
                     column_list(columns) + ")");
    add_columns(database, name, columns);
  }
  Statement insert(database, "INSERT INTO ensemble VALUES (?, ?)");
  const auto add = [&](const std::string& key, const std::string& value) {
    insert.bind(0, key);
    insert.bind(1, value);
    insert.run();
  };
  for (const auto& [key, value] : contents.facts) add(key, value);
  add("first", std::to_string(contents.samples.begin));
  add("end", std::to_string(contents.samples.end));
}

std::vector<std::pair<std::string, std::string>> facts_of(Database& database) {
  if (!has_tables(database)) throw FileFault(results::visible(database.path()) + ": found an empty file");
  if (std::get<long>(database.value("SELECT count(*) FROM sqlite_master WHERE name = 'ensemble'")) == 0)
    throw FileFault(results::visible(database.path()) + ": found a database that is no ensemble");
  std::vector<std::pair<std::string, std::string>> facts;
  Statement select(database, "SELECT key, value FROM ensemble ORDER BY key");
  while (select.step()) facts.emplace_back(select.text(0), select.text(1));
  if (fact_in(facts, "format") != file_format)
    throw FileFault(results::visible(database.path()) + ": found the format \"" +
                    results::visible(fact_in(facts, "format")) + "\", must be \"" + std::string(file_format) +
                    "\"");
  return facts;
}

std::string fact_in(const std::vector<std::pair<std::string, std::string>>& facts, std::string_view key) {
  const auto at =
      std::find_if(facts.begin(), facts.end(), [&](const auto& fact) { return fact.first == key; });
  return at != facts.end() ? at->second : "";
}

Contents contents_of(Database& database) {
  Contents contents;
  for (auto& fact : facts_of(database)) {
    if (fact.first == "first")
      contents.samples.begin = std::stol(fact.second);
    else if (fact.first == "end")
      contents.samples.end = std::stol(fact.second);
    else
      contents.facts.push_back(std::move(fact));
  }
  Statement select(database, "SELECT of, name, type, unit, help FROM columns ORDER BY rowid");
  while (select.step()) {
    const std::string of = select.text(0);
    std::vector<TableColumn>* columns = &contents.columns;
    if (of != "samples") {
      if (contents.tables.empty() || contents.tables.back().first != of) contents.tables.push_back({of, {}});
      columns = &contents.tables.back().second;
    }
    columns->push_back({select.text(1), select.text(2), select.text(3), select.text(4)});
  }
  return contents;
}

std::vector<Range> missing_in(Database& database, Range samples) {
  std::vector<Range> missing;
  Statement select(database, "SELECT sample FROM samples ORDER BY sample");
  long next = samples.begin;
  while (select.step()) {
    const long sample = select.whole(0);
    if (sample > next) missing.push_back({next, sample});
    next = sample + 1;
  }
  if (next < samples.end) missing.push_back({next, samples.end});
  return missing;
}

EnsembleFile::EnsembleFile(const std::string& path, const Contents& contents)
    : database_(path, Database::Access::create), samples_(contents.samples) {
  // One run writes a file, also on file systems of clusters without memory that processes share.
  database_.execute("PRAGMA locking_mode = EXCLUSIVE");
  database_.execute("BEGIN EXCLUSIVE");
  const bool is_new = !has_tables(database_);
  if (is_new)
    make_tables(database_, contents);
  else
    compare(contents);
  database_.execute("COMMIT");
  database_.execute("PRAGMA journal_mode = WAL");
  database_.execute("PRAGMA synchronous = NORMAL");
  prepare(contents);
}

void EnsembleFile::compare(const Contents& contents) {
  const Contents found = contents_of(database_);
  const std::string here = results::visible(database_.path()) + ": ";
  for (const auto& [key, value] : contents.facts) {
    const std::string other = fact_in(found.facts, key);
    if (other == value) continue;
    if (key == "scene")
      throw OtherEnsemble(here +
                          "the scene has changed since, or an option that stands for one of its keys: " +
                          first_difference(other, value) + "; give another --out, or remove the file");
    const std::string shown = key == "scene_hash" ? " (a file that it names has changed)" : "";
    throw OtherEnsemble(here + "found samples with " + key + " \"" + results::visible(other) +
                        "\", must be \"" + results::visible(value) + "\"" + shown +
                        ": give another --out, or remove the file");
  }
  if (found.samples.begin != contents.samples.begin || found.samples.end != contents.samples.end)
    throw OtherEnsemble(here + "found the samples " + std::to_string(found.samples.begin) + " to " +
                        std::to_string(found.samples.end - 1) + ", must be " +
                        std::to_string(contents.samples.begin) + " to " +
                        std::to_string(contents.samples.end - 1) + ": give another --out");
}

void EnsembleFile::prepare(const Contents& contents) {
  insert_.emplace(database_, "INSERT INTO samples VALUES " + parameters(contents.columns.size() + 1));
  for (const auto& [name, columns] : contents.tables)
    insert_rows_.emplace_back(
        database_, "INSERT INTO " + quoted_name(name) + " VALUES " + parameters(columns.size() + 2));
}

std::vector<Range> EnsembleFile::missing() {
  return missing_in(database_, samples_);
}

long EnsembleFile::count() {
  return std::get<long>(database_.value("SELECT count(*) FROM samples"));
}

long EnsembleFile::failed() {
  return std::get<long>(database_.value("SELECT count(*) FROM samples WHERE status != 'complete'"));
}

double EnsembleFile::bytes() {
  return static_cast<double>(std::get<long>(database_.value("PRAGMA page_count"))) *
         static_cast<double>(std::get<long>(database_.value("PRAGMA page_size")));
}

void EnsembleFile::add(const Sample& sample) {
  if (!in_transaction_) database_.execute("BEGIN");
  in_transaction_ = true;
  std::size_t at = 0;
  const auto put = [&](const Cell& cell) { insert_->bind(at++, cell); };
  const auto text = [](const std::string& words) { return words.empty() ? Cell() : Cell(words); };
  put(sample.index);
  for (const auto& [parameter, value] : sample.set) put(value);
  put(sample.status);
  put(text(sample.reason));
  put(text(sample.doubt));
  put(sample.results);
  for (const Cell& cell : sample.quantities) put(cell);
  insert_->run();
  for (const std::vector<Cell>& row : sample.rows) {
    Statement& insert = insert_rows_[static_cast<std::size_t>(std::get<long>(row.front()))];
    insert.bind(0, sample.index);
    for (std::size_t i = 1; i < row.size(); ++i) insert.bind(i, row[i]);
    insert.run();
  }
  if (Clock::now() - committed_ >= commit_every) commit();
}

void EnsembleFile::commit() {
  if (in_transaction_) database_.execute("COMMIT");
  in_transaction_ = false;
  committed_ = Clock::now();
}

void EnsembleFile::finish() {
  commit();
  insert_.reset();
  insert_rows_.clear();
  database_.execute("PRAGMA journal_mode = DELETE");
}

void EnsembleFile::set_units(const std::vector<Quantity>& quantities) {
  Statement update(database_, "UPDATE columns SET unit = ? WHERE of = 'samples' AND name = ? AND unit = ''");
  for (const Quantity& quantity : quantities) {
    if (quantity.unit.empty()) continue;
    update.bind(0, quantity.unit);
    update.bind(1, quantity.name);
    update.run();
  }
}

std::span<const TableColumn> sample_columns() {
  return own_columns;
}

}  // namespace arcslip::ensemble
