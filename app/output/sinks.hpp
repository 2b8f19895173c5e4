#pragma once
// Sinks for results during the computation.

#include "results.hpp"

#include <arcslip/output/atomic_file.hpp>
#include <arcslip/results/result.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::app {

/// Forwards everything to several sinks, which must outlive it.
class Tee : public results::Sink {
 public:
  explicit Tee(std::vector<results::Sink*> sinks) : sinks_(std::move(sinks)) {}

  void begin(const results::Header& header, std::span<const results::Schema> schemas) override;
  void curve(const results::Head& head, std::size_t schema) override;
  void rows(std::size_t table, const results::Rows& rows) override;
  void end(const results::End& end) override;
  void finish() override;

 private:
  std::vector<results::Sink*> sinks_;
};

/// Forwards the results of one study to one schema of a sink shared by several studies. The owner of that
/// sink begins and finishes it.
class OneOfSeveral : public results::Sink {
 public:
  OneOfSeveral(results::Sink& all, std::size_t schema) : all_(all), schema_(schema) {}

  void begin(const results::Header& /*header*/, std::span<const results::Schema> /*schemas*/) override {}
  void curve(const results::Head& head, std::size_t /*schema*/) override { all_.curve(head, schema_); }
  void rows(std::size_t table, const results::Rows& rows) override { all_.rows(table, rows); }
  void end(const results::End& end) override { all_.end(end); }
  void finish() override {}

 private:
  results::Sink& all_;
  std::size_t schema_;
};

/// Files written as results arrive, so that no results are kept in memory. The files appear under their
/// names, complete, with commit(). A failure to write one does not affect the others.
class OpenFiles : public results::Sink {
 public:
  explicit OpenFiles(std::vector<File> files);

  void begin(const results::Header& header, std::span<const results::Schema> schemas) override;
  void curve(const results::Head& head, std::size_t schema) override;
  void rows(std::size_t table, const results::Rows& rows) override;
  void end(const results::End& end) override;
  void finish() override;

  std::vector<std::string> paths() const;
  /// Returns the paths of the files written; `writing` reports the others.
  std::vector<std::string> commit(Writing& writing);

 private:
  struct Open {
    File file;
    std::optional<output::AtomicFile> target{};
    std::unique_ptr<results::Sink> sink{};
    std::optional<output::WriteError> failed{};
  };
  template <class Write>
  void each(const Write& write);

  std::vector<Open> files_;
};

}  // namespace arcslip::app
