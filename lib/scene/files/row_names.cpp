#include <arcslip/scene/files/row_names.hpp>

#include <arcslip/scene/files/csv_pairs.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <optional>
#include <string_view>
#include <unordered_map>

namespace arcslip::scene::file {
namespace {

constexpr std::size_t most_names = 1'000'000;  // of all copies

// What is wrong with a name, or with the names of its copies; empty if nothing is. The names are added.
std::string add_name(const std::string& name, int copies, Dofs& dofs) {
  const auto add = [&](const std::string& numbered) {
    std::string objection = objection_of_dof(numbered, dofs);
    if (!objection.empty()) return objection;
    dofs.index.emplace(numbered, static_cast<int>(dofs.names.size()));
    dofs.names.push_back(numbered);
    return objection;
  };
  if (copies == 1) return add(name);
  if (std::string objection = objection_of_dof(name, {}); !objection.empty()) return objection;
  for (int copy = 1; copy <= copies; ++copy) {
    const std::string numbered = name + std::to_string(copy);
    if (const std::string objection = add(numbered); !objection.empty())
      return "of which copy " + std::to_string(copy) + " is " + shown(numbered) + ", " + objection;
  }
  return {};
}

}  // namespace

void read_row_names(const Location& at, const NamedFile& file, Matrices& matrices, Dofs& dofs,
                    Faults& faults) {
  const std::size_t before = faults.count();
  std::unordered_map<int, std::size_t> lines;
  std::unordered_map<int, int> beyond;
  for (const FacePair& pair : matrices.faces) beyond.emplace(pair.beyond + 1, pair.own + 1);
  CsvPairs pairs(at, file, "name", "row", "a name and a row", faults);
  pairs.read([&](std::string_view text, std::string_view digits) {
    if (matrices.copies > 1 && dofs.names.size() + static_cast<std::size_t>(matrices.copies) > most_names) {
      pairs.fault("found more than " + std::to_string(most_names) + " names in all " +
                  std::to_string(matrices.copies) +
                  " copies together, must be at most as many: leave out those that the scene does not use");
      return false;
    }
    const std::string name(text);
    const auto row = pairs.row(digits, matrices.size());
    if (!row) return true;
    const auto first = lines.find(*row);
    if (const auto own = beyond.find(*row); own != beyond.end()) {
      pairs.fault(
          "found the row " + std::to_string(*row) + ", which is row " + std::to_string(own->second) +
          " of the next sector by \"faces\", must be a row of this one: name that row, and say {\"next\": "
          "name}");
    } else if (first != lines.end()) {
      pairs.fault("found the row " + std::to_string(*row) + " again, which has a name in line " +
                  std::to_string(first->second) + "; a row must have one name");
    } else if (const std::string objection = add_name(name, matrices.copies, dofs); !objection.empty()) {
      pairs.fault("found the name " + shown(name) + ", " + objection);
    } else {
      lines.emplace(*row, pairs.number());
      matrices.rows.push_back(*row - 1);
    }
    return true;
  });
  if (dofs.names.empty() && faults.count() == before)
    faults.add(at.pointer, "found no names in " + shown(file.path) + ", must have at least one row name,row");
}

std::vector<std::string> row_names(const Location& path, const FileSource& source) {
  Faults reported_later;
  const Dofs no_dofs;
  const Keys keys({}, {}, reported_later);
  const Reading reading{keys, any_number, no_parameters(), no_dofs, reported_later, source};
  std::vector<std::string> names;
  const auto file = path.node != nullptr ? read_file_of(path, "", reading) : std::nullopt;
  if (!file || !file->text) return names;
  bool header = true;
  for_each_line(*file->text, [&](std::size_t, const auto& cells, std::string_view) {
    if (!header) names.emplace_back(trimmed(cells[0]));
    header = false;
    return true;
  });
  return names;
}

}  // namespace arcslip::scene::file
