#include <arcslip/scene/files/face_rows.hpp>

#include <arcslip/scene/files/csv_pairs.hpp>

#include <string>
#include <string_view>
#include <unordered_map>

namespace arcslip::scene::file {
namespace {

// The line on which a row stands first, on one of the faces.
using Lines = std::unordered_map<int, std::size_t>;

}  // namespace

void read_face_rows(const Location& at, const NamedFile& file, Matrices& matrices, Faults& faults) {
  Lines own, beyond;
  const std::size_t before = faults.count();
  CsvPairs pairs(at, file, "own", "next", "a row of each face", faults);
  pairs.read([&](std::string_view of_own, std::string_view of_next) {
    const auto first = pairs.row(of_own, matrices.size()), second = pairs.row(of_next, matrices.size());
    if (!first || !second) return true;
    const auto again = [&](int which, const Lines& lines, const char* why) {
      const auto known = lines.find(which);
      if (known != lines.end())
        pairs.fault("found the row " + std::to_string(which) + " again, which stands in line " +
                    std::to_string(known->second) + "; " + why);
      return known != lines.end();
    };
    constexpr const char* once = "a row must stand once";
    constexpr const char* one_face = "a row must be of one face";
    if (*first == *second)
      pairs.fault(
          "found the row " + std::to_string(*first) +
          " on both faces, must be two rows; rows on the axis of the ring, which belong to all sectors, must "
          "be left out of the matrices");
    else if (!again(*first, own, once) && !again(*first, beyond, one_face) && !again(*second, beyond, once) &&
             !again(*second, own, one_face))
      matrices.faces.push_back({*first - 1, *second - 1});
    own.emplace(*first, pairs.number());
    beyond.emplace(*second, pairs.number());
    return true;
  });
  if (matrices.faces.empty() && faults.count() == before)
    faults.add(at.pointer, "found no rows in " + shown(file.path) + ", must have at least one line own,next");
}

}  // namespace arcslip::scene::file
