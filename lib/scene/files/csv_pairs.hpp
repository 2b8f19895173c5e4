#pragma once
// CSV files of pairs: a header of two words, then two values on each line.

#include <arcslip/scene/keys/csv_text.hpp>
#include <arcslip/scene/keys/read_values.hpp>
#include <arcslip/scene/named_file.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace arcslip::scene::file {

/// The file that a key names. Its faults stand at that key, with the number of the line.
class CsvPairs {
 public:
  /// of: what the two values of a line are, "a name and a row".
  CsvPairs(const Location& at, const NamedFile& file, std::string first, std::string second, std::string of,
           Faults& faults);

  /// Calls line(first, second) for each line of two values, until it returns false. Other lines are faults.
  void read(const std::function<bool(std::string_view first, std::string_view second)>& line);

  /// Of the current line.
  std::size_t number() const { return number_; }
  void fault(const std::string& what);
  /// A row of matrices of this size, from 1 on; nothing, with a fault, if it is none.
  std::optional<int> row(std::string_view digits, int size);

 private:
  const Location& at_;
  const NamedFile& file_;
  const std::string first_, second_, of_;
  Faults& faults_;
  std::size_t number_ = 0;
};

}  // namespace arcslip::scene::file
