#include <arcslip/scene/format/patch_rows.hpp>

#include <arcslip/scene/keys/csv_text.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace arcslip::scene::file {
namespace {

constexpr Field area_field{.name = "area",
                           .unit = "m^2",
                           .lower = 0,
                           .upper = std::numeric_limits<double>::infinity(),
                           .lower_open = true};
constexpr Field gap_field{.name = "gap",
                          .unit = "m",
                          .lower = -std::numeric_limits<double>::infinity(),
                          .upper = std::numeric_limits<double>::infinity()};
constexpr double farthest_place = 1e6;
constexpr Field place_fields[] = {
    {.name = "x", .unit = "m", .lower = -farthest_place, .upper = farthest_place},
    {.name = "y", .unit = "m", .lower = -farthest_place, .upper = farthest_place}};
constexpr Field pressure_field{
    .name = "pressure", .unit = "Pa", .lower = 0, .upper = std::numeric_limits<double>::infinity()};

class PatchRows {
 public:
  PatchRows(const PatchOptions& patch, const std::string& name, const Dofs& dofs, std::string pointer,
            Faults& faults)
      : patch_(patch), name_(name), dofs_(dofs), pointer_(std::move(pointer)), faults_(faults) {
    const auto slots = patch.law->slots_with(patch.law_options);
    places_.assign(slots.begin(), slots.end());
    if (places_.empty()) places_.emplace_back("at");
  }

  std::vector<PatchRow> read(std::string_view text) {
    std::vector<PatchRow> rows;
    const std::size_t before = faults_.count();
    for_each_line(text, [&](std::size_t number, std::vector<std::string_view> cells, std::string_view) {
      line_ = number;
      for (std::string_view& cell : cells) cell = trimmed(cell);
      if (columns_.empty()) return header(cells);
      if (cells.size() != columns_.size()) {
        fault("found " + std::to_string(cells.size()) + " values, must be " +
              std::to_string(columns_.size()) + " as in the header");
      } else {
        rows.push_back(row(cells, rows.size() + 1));
        lines_.push_back(line_);
      }
      return true;
    });
    if (rows.empty() && faults_.count() == before) {
      line_ = 0;
      fault("found no rows, must have a header and at least one row");
    }
    return rows;
  }

  // Whether the element of a row has values that the law allows.
  void check(std::size_t row, const Part& element) {
    line_ = lines_[row];
    const auto fields = element.fields();
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (!within(fields[k], element.values[k]))
        fault("gives " + std::string(fields[k].name) + " = " + number_text(element.values[k]) + ", must be " +
              allowed_text(fields[k]));
  }

 private:
  void fault(const std::string& what) {
    if (faults_.full()) return faults_.add({}, {});
    faults_.add(pointer_, (line_ > 0 ? "line " + std::to_string(line_) + " of " : "in ") +
                              shown(patch_.file.path) + ": " + what);
  }

  // Of the displacements of a row: places, or nodes and the axes at their contact.
  std::vector<std::string> columns_of_places() const {
    if (!by_nodes_) return places_;
    return {"nodes", "against", "normal", "tangent"};
  }

  bool header(const std::vector<std::string_view>& cells) {
    by_nodes_ = std::find(cells.begin(), cells.end(), "nodes") != cells.end();
    std::vector<std::string> known = columns_of_places();
    known.insert(known.end(), {"area", "pressure", "name", "x", "y"});
    const auto of_law = patch_.law->fields(patch_.law_options);
    if (std::any_of(of_law.begin(), of_law.end(),
                    [](const Field& field) { return field.name == "normal_stiffness"; }))
      known.emplace_back("gap");
    const std::size_t before = faults_.count();
    for (const std::string_view cell : cells) {
      const std::string column(cell);
      if (std::find(known.begin(), known.end(), column) == known.end())
        fault("found the column " + shown(cell) + ", must be one of " + listed(known) + hint(cell, known));
      else if (std::find(columns_.begin(), columns_.end(), column) != columns_.end())
        fault("found the column " + shown(cell) + " again");
      columns_.push_back(column);
    }
    std::vector<std::string> needed =
        by_nodes_ ? std::vector<std::string>{"nodes", "normal"} : std::vector<std::string>(places_);
    needed.emplace_back("area");
    for (const char* place : {"x", "y"})
      if (std::find(cells.begin(), cells.end(), place) != cells.end())
        needed.insert(needed.end(), {"x", "y"});
    for (const std::string& column : needed)
      if (std::find(columns_.begin(), columns_.end(), column) == columns_.end())
        fault("found no column " + shown(column) + ", which is required");
    return faults_.count() == before;
  }

  std::optional<std::string_view> cell(const std::vector<std::string_view>& cells,
                                       std::string_view column) const {
    const auto at = std::find(columns_.begin(), columns_.end(), column);
    if (at == columns_.end()) return {};
    return cells[static_cast<std::size_t>(at - columns_.begin())];
  }

  double number(const std::vector<std::string_view>& cells, const Field& field) {
    const auto text = cell(cells, field.name);
    if (!text) return 0;
    const auto value = number_in(*text);
    if (!value || !within(field, *value))
      fault("found the " + std::string(field.name) + " " + shown(*text) + ", must be a number, " +
            allowed_text(field));
    return value.value_or(0);
  }

  PatchRow row(const std::vector<std::string_view>& cells, std::size_t count) {
    PatchRow row;
    const std::string own(cell(cells, "name").value_or(std::to_string(count)));
    if (const std::string reason = objection(own); !reason.empty())
      fault("found the name " + shown(own) + ", " + reason);
    else if (!names_.insert(own).second)
      fault("found the name " + shown(own) + " again; the contacts of a patch must have different names");
    row.name = name_ + '.' + own;
    const Report report = [this](const std::string& what) { fault(what); };
    if (by_nodes_)
      row.directions = displacements({*cell(cells, "nodes"), cell(cells, "against").value_or(ground),
                                      *cell(cells, "normal"), cell(cells, "tangent").value_or("")},
                                     places_, dofs_, report);
    else
      for (const std::string& place : places_)
        row.directions.push_back(displacement(*cell(cells, place), dofs_, report));
    row.area = number(cells, area_field);
    row.gap = number(cells, gap_field);
    row.pressure = number(cells, pressure_field);
    if (cell(cells, "x")) row.place = {number(cells, place_fields[0]), number(cells, place_fields[1])};
    return row;
  }

  const PatchOptions& patch_;
  const std::string& name_;
  const Dofs& dofs_;
  std::string pointer_;
  Faults& faults_;
  std::vector<std::string> places_, columns_;
  bool by_nodes_ = false;
  std::set<std::string> names_;
  std::size_t line_ = 0;            // being read; 0: none
  std::vector<std::size_t> lines_;  // of the rows
};

}  // namespace

std::vector<PatchRow> read_patch_rows(const Part& patch, bool has_values, const Dofs& dofs,
                                      const std::string& pointer, Faults& faults) {
  const auto& options = patch.options.as<PatchOptions>();
  const std::size_t before = faults.count();
  PatchRows file(options, patch.name, dofs, pointer, faults);
  std::vector<PatchRow> rows = file.read(*options.file.text);
  if (has_values && faults.count() == before)
    for (std::size_t i = 0; i < rows.size(); ++i) file.check(i, patch_element(patch, rows[i]));
  return rows;
}

}  // namespace arcslip::scene::file
