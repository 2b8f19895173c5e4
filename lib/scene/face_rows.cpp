#include <arcslip/scene/face_rows.hpp>

#include <arcslip/scene/csv_text.hpp>

#include <string>
#include <unordered_map>

namespace arcslip::scene::file {
namespace {

// The line on which a row stands first, on one of the faces.
using Lines = std::unordered_map<int, std::size_t>;

}  // namespace

void read_face_rows(const Location& at, const NamedFile& file, Matrices& matrices, Faults& faults) {
  Lines own, beyond;
  bool header = false;
  const std::size_t before = faults.count();
  for_each_line(*file.text, [&](std::size_t line, const auto& cells, std::string_view whole) {
    const auto fault = [&](const std::string& what) {
      if (faults.full()) return faults.add({}, {});
      faults.add(at.pointer, "line " + std::to_string(line) + " of " + shown(file.path) + ": " + what);
    };
    if (!header) {
      header = cells.size() == 2 && trimmed(cells[0]) == "own" && trimmed(cells[1]) == "next";
      if (!header) fault("found " + shown(whole) + ", must be the header own,next");
      return header;
    }
    if (cells.size() != 2) {
      fault("found " + std::to_string(cells.size()) + " values, must be 2: a row of each face");
      return true;
    }
    const auto row = [&](std::string_view digits) {
      const auto found = row_in(trimmed(digits), matrices.size());
      if (!found)
        fault("found the row " + shown(trimmed(digits)) + ", must be an integer from 1 to " +
              std::to_string(matrices.size()));
      return found;
    };
    const auto first = row(cells[0]), second = row(cells[1]);
    if (!first || !second) return true;
    const auto again = [&](int which, const Lines& lines, const char* why) {
      const auto known = lines.find(which);
      if (known != lines.end())
        fault("found the row " + std::to_string(which) + " again, which stands in line " +
              std::to_string(known->second) + "; " + why);
      return known != lines.end();
    };
    constexpr const char* once = "a row must stand once";
    constexpr const char* one_face = "a row must be of one face";
    if (*first == *second)
      fault(
          "found the row " + std::to_string(*first) +
          " on both faces, must be two rows; rows on the axis of the ring, which belong to all sectors, must "
          "be left out of the matrices");
    else if (!again(*first, own, once) && !again(*first, beyond, one_face) && !again(*second, beyond, once) &&
             !again(*second, own, one_face))
      matrices.faces.push_back({*first - 1, *second - 1});
    own.emplace(*first, line);
    beyond.emplace(*second, line);
    return true;
  });
  if (matrices.faces.empty() && faults.count() == before)
    faults.add(at.pointer, "found no rows in " + shown(file.path) + ", must have at least one line own,next");
}

}  // namespace arcslip::scene::file
