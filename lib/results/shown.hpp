#pragma once
// What output for people shows of results (Schema::shown), as texts.

#include <arcslip/results/result.hpp>

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace arcslip::results {

/// The value behind these keys; null: there is none.
const Value* find(const Object& object, std::span<const std::string> path);

/// The text of that key; "" where there is none.
std::string text_in(const Object& object, const std::string& key);

/// A text, or the number of a column with a unit, whose prefix depends on the other rows.
struct ShownCell {
  std::string text{};
  double value = std::numeric_limits<double>::quiet_NaN(), error = 0;  // NaN: the text stands
};

/// Returns a cell for each column that is shown, of an object or else of the facts of its result; "-" where
/// there is no value. Numbers have the digits that their estimated errors leave.
std::vector<ShownCell> shown_cells(const std::vector<Shown>& shown, const Object& object,
                                   const Object& facts);

/// Returns a text for each parameter of Schema::set.
std::vector<std::string> set_cells(const Schema& schema, const Object& set);

/// Returns the titles and the rows of a table: of set_cells(), of shown_cells(), and of the status.
std::vector<std::vector<std::string>> text_rows(const Schema& schema,
                                                const std::vector<std::vector<ShownCell>>& rows);

}  // namespace arcslip::results
