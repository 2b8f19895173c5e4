#include "sinks.hpp"

#include "../interrupt.hpp"

#include <arcslip/results/text.hpp>

#include <utility>

namespace arcslip::app {

void Tee::begin(const results::Header& header, std::span<const results::Schema> schemas) {
  for (results::Sink* sink : sinks_) sink->begin(header, schemas);
}

void Tee::curve(const results::Head& head, std::size_t schema) {
  for (results::Sink* sink : sinks_) sink->curve(head, schema);
}

void Tee::rows(std::size_t table, const results::Rows& rows) {
  for (results::Sink* sink : sinks_) sink->rows(table, rows);
}

void Tee::end(const results::End& end) {
  for (results::Sink* sink : sinks_) sink->end(end);
}

void Tee::finish() {
  for (results::Sink* sink : sinks_) sink->finish();
}

OpenFiles::OpenFiles(std::vector<File> files) {
  for (File& file : files) files_.push_back({std::move(file)});
}

template <class Write>
void OpenFiles::each(const Write& write) {
  for (Open& open : files_) {
    if (open.failed) continue;
    try {
      write(open);
    } catch (const output::WriteError& error) {
      open.failed = error;
    }
  }
}

void OpenFiles::begin(const results::Header& header, std::span<const results::Schema> schemas) {
  each([&](Open& open) {
    open.target.emplace(open.file.path, by_signal());
    open.sink = open.file.sink(open.target->stream());
    open.sink->begin(header, schemas);
  });
}

void OpenFiles::curve(const results::Head& head, std::size_t schema) {
  each([&](Open& open) { open.sink->curve(head, schema); });
}

void OpenFiles::rows(std::size_t table, const results::Rows& rows) {
  each([&](Open& open) { open.sink->rows(table, rows); });
}

void OpenFiles::end(const results::End& end) {
  each([&](Open& open) { open.sink->end(end); });
}

void OpenFiles::finish() {
  each([&](Open& open) { open.sink->finish(); });
}

std::vector<std::string> OpenFiles::paths() const {
  std::vector<std::string> paths;
  for (const Open& open : files_) paths.push_back(open.file.path);
  return paths;
}

std::vector<std::string> OpenFiles::commit(Writing& writing) {
  std::vector<std::string> paths;
  for (Open& open : files_) {
    const bool is_written = writing.attempt(results::visible(open.file.path), [&] {
      if (open.failed) throw output::WriteError(*open.failed);
      open.target->commit();
    });
    if (is_written) paths.push_back(open.file.path);
  }
  files_.clear();
  return paths;
}

}  // namespace arcslip::app
