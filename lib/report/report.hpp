#pragma once
// The results of a run as one page for people, in HTML: doubts first, the scene, tables, curves. It needs no
// network, and shows its tables and plain curves without scripts.

#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace arcslip::report {

/// Of a study the page shows so many results at most, and says so.
inline constexpr std::size_t most_results = 1000;

/// Points of the curves of a page, at most: of more it shows thinned curves, and says so.
inline constexpr std::size_t most_points = 50'000;

struct Contents;

/// Collects what the page shows, in memory that these limits bound. The schemas of begin() are those of the
/// studies, in their order.
class Report : public results::Sink {
 public:
  /// The scene outlives this.
  Report(const scene::Scene& scene, std::span<const scene::Study> studies);
  Report(const Report&) = delete;
  Report& operator=(const Report&) = delete;
  ~Report() override;

  void begin(const results::Header& header, std::span<const results::Schema> schemas) override;
  void curve(const results::Head& head, std::size_t schema) override;
  void rows(std::size_t table, const results::Rows& rows) override;
  void end(const results::End& end) override;
  void finish() override {}

  /// The figures of a study.
  void add_figures(std::size_t study, std::vector<results::FigureData> figures);

  /// Writes the page: the same text for the same results.
  void write(std::ostream& out) const;

 private:
  std::unique_ptr<Contents> contents_;
};

}  // namespace arcslip::report
