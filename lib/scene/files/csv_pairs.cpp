#include <arcslip/scene/files/csv_pairs.hpp>

#include <utility>

namespace arcslip::scene::file {

CsvPairs::CsvPairs(const Location& at, const NamedFile& file, std::string first, std::string second,
                   std::string of, Faults& faults)
    : at_(at),
      file_(file),
      first_(std::move(first)),
      second_(std::move(second)),
      of_(std::move(of)),
      faults_(faults) {}

void CsvPairs::read(const std::function<bool(std::string_view, std::string_view)>& line) {
  bool header = false;
  for_each_line(*file_.text, [&](std::size_t number, const auto& cells, std::string_view whole) {
    number_ = number;
    if (!header) {
      header = cells.size() == 2 && trimmed(cells[0]) == first_ && trimmed(cells[1]) == second_;
      if (!header) fault("found " + shown(whole) + ", must be the header " + first_ + ',' + second_);
      return header;
    }
    if (cells.size() == 2) return line(trimmed(cells[0]), trimmed(cells[1]));
    fault("found " + std::to_string(cells.size()) + " values, must be 2: " + of_);
    return true;
  });
}

void CsvPairs::fault(const std::string& what) {
  if (faults_.full()) return faults_.add({}, {});
  faults_.add(at_.pointer, "line " + std::to_string(number_) + " of " + shown(file_.path) + ": " + what);
}

std::optional<int> CsvPairs::row(std::string_view digits, int size) {
  const auto found = row_in(digits, size);
  if (!found)
    fault("found the row " + shown(digits) + ", must be an integer from 1 to " + std::to_string(size));
  return found;
}

}  // namespace arcslip::scene::file
