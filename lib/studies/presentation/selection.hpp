#pragma once
// The columns and kinds of events that a user asks for.

#include <arcslip/results/result.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace arcslip::studies {

/// Names of columns, "damper.stick_percent" or "frequency", and kinds of events; of each, none: all of them.
struct Selection {
  std::vector<std::string> columns, events;

  bool empty() const { return columns.empty() && events.empty(); }
};

/// The name of a column as in CSV, without "elements".
std::string name_in_tables(const results::Column& column);

/// Throws std::invalid_argument for a column that no table of the studies has, and for an unknown kind of
/// events, with the nearest one. prefix: of the words "columns" and "events" in the message.
void check_selection(const Selection& selection, std::span<const results::Schema> schemas,
                     const std::string& prefix = {});

/// Passes on to another sink what is selected: rows of events of these kinds, and of the columns those that
/// are shown to people or, with of_tables, all that tables have. Without names of columns tables have all but
/// details.
class Selected : public results::Sink {
 public:
  Selected(std::unique_ptr<results::Sink> to, Selection selection, bool of_tables);

  void begin(const results::Header& header, std::span<const results::Schema> schemas) override;
  void curve(const results::Head& head, std::size_t schema) override;
  void rows(std::size_t table, const results::Rows& rows) override;
  void end(const results::End& end) override { to_->end(end); }
  void finish() override { to_->finish(); }

 private:
  std::unique_ptr<results::Sink> to_;
  Selection selection_;
  bool of_tables_;
  std::vector<results::Schema> all_;  // as they come
  std::size_t schema_ = 0;
};

}  // namespace arcslip::studies
