#pragma once
// What an ensemble keeps of the results of a sample: quantities, each a column, and whole tables.
//
// A quantity is named as the columns of results are, "amplitude" or "elements.damper.stick_percent", with or
// without "elements", and is that of the event with the largest amplitude; "fold.frequency" of the fold with
// the largest one. Where a study has no events, it is that of the result with the largest amplitude.

#include <arcslip/ensemble/database.hpp>
#include <arcslip/results/result.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::ensemble {

struct Quantity {
  std::string name, unit{}, help{};
  std::string kind{};                   // of the event; empty: of any
  std::vector<std::string> path{};      // in the columns, or in the facts of a result
  std::optional<std::size_t> column{};  // of the events; none: a fact
};

struct Kept {
  std::vector<Quantity> quantities;
  std::vector<std::size_t> tables;  // of the schema
  bool by_default = false;          // nothing was asked for
};

/// Reads a list of names, which commas part: quantities, and keys of tables. Empty: the numbers that the
/// command shows. Throws UnknownQuantity for a name that there is not, with the nearest one. Names of
/// facts are only known with a result.
Kept read_kept(const std::string& list, const results::Schema& schema);

/// Returns the value of each quantity.
std::vector<Cell> quantities_of(const Kept& kept, const results::Schema& schema,
                                std::span<const results::Result> results);

/// Throws UnknownQuantity where a fact is none of a complete result, and fills in the units.
void check_facts(Kept& kept, const results::Result& result);

/// Returns whether rows of a table hold a column: all but lists.
bool is_scalar(const results::Column& column);
/// Returns a cell of a table.
Cell cell_of(const results::Cells& cells, std::size_t row);

}  // namespace arcslip::ensemble
