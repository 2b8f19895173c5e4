// Patches of contacts, and the CSV files of their rows.
#include <arcslip/scene/keys/csv_text.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/study_keys.hpp>
#include <arcslip/scene/patch.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

namespace arcslip::scene::file {
namespace {

constexpr std::string_view wanted_place = "degrees of freedom, as in a, a - b or 0.6*a + 0.8*b - c";

constexpr Field area_field{.name = "area",
                           .unit = "m^2",
                           .lower = 0,
                           .upper = std::numeric_limits<double>::infinity(),
                           .lower_open = true};
constexpr Field gap_field{.name = "gap",
                          .unit = "m",
                          .lower = -std::numeric_limits<double>::infinity(),
                          .upper = std::numeric_limits<double>::infinity()};
constexpr Field pressure_field{
    .name = "pressure", .unit = "Pa", .lower = 0, .upper = std::numeric_limits<double>::infinity()};

std::optional<double> parsed_number(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return {};
  return value;
}

// The rows of one file. Faults are at the key of the file, and say the line.
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
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
    std::vector<PatchRow> rows;
    const std::size_t before = faults_.count();
    for (const std::string_view line : split(text, '\n')) {
      ++line_;
      if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
      std::vector<std::string_view> cells = split(line, ',');
      for (std::string_view& cell : cells) cell = trimmed(cell);
      if (columns_.empty()) {
        if (!header(cells)) return {};
      } else if (cells.size() != columns_.size()) {
        fault("found " + std::to_string(cells.size()) + " values, must be " +
              std::to_string(columns_.size()) + " as in the header");
      } else {
        rows.push_back(row(cells, rows.size() + 1));
        lines_.push_back(line_);
      }
    }
    if (rows.empty() && faults_.count() == before) {
      line_ = 0;
      fault("found no rows, must have a header and at least one row");
    }
    return rows;
  }

  void fault(const std::string& what) {
    if (faults_.full()) return faults_.add({}, {});
    faults_.add(pointer_, (line_ > 0 ? "line " + std::to_string(line_) + " of " : "in ") +
                              shown(patch_.file.path) + ": " + what);
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
  bool header(const std::vector<std::string_view>& cells) {
    std::vector<std::string> known = places_;
    known.insert(known.end(), {"area", "pressure", "name"});
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
    std::vector<std::string> needed = places_;
    needed.emplace_back("area");
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
    const auto value = parsed_number(*text);
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
    for (const std::string& place : places_) row.directions.push_back(direction(*cell(cells, place)));
    row.area = number(cells, area_field);
    row.gap = number(cells, gap_field);
    row.pressure = number(cells, pressure_field);
    return row;
  }

  // "a", "-a", "a - b", "0.6*a.x + 0.8*a.z": terms between signs that stand alone.
  Direction direction(std::string_view text) {
    Direction direction;
    double sign = 1;
    bool is_term = true;
    for (const std::string_view word : split(text, ' ')) {
      if (word.empty()) continue;
      if (is_term ? !add(word, sign, direction) : word != "+" && word != "-") {
        if (!is_term) fault("found " + shown(text) + ", must be a sum of " + std::string(wanted_place));
        return {};
      }
      if (!is_term) sign = word == "+" ? 1 : -1;
      is_term = !is_term;
    }
    std::erase_if(direction, [](const Term& term) { return term.weight == 0; });
    if (is_term || direction.empty())
      fault("found the place " + shown(text) + ", must be a sum of " + std::string(wanted_place) +
            ", that is not zero");
    return direction;
  }

  bool add(std::string_view word, double weight, Direction& direction) {
    std::string name(word);
    auto found = dofs_.index.find(name);
    if (const auto star = word.find('*'); found == dofs_.index.end() && star != std::string_view::npos)
      if (const auto factor = parsed_number(word.substr(0, star))) {
        weight *= *factor;
        name = word.substr(star + 1);
        found = dofs_.index.find(name);
      }
    if (found == dofs_.index.end() && name.starts_with('-')) {
      weight = -weight;
      name.erase(0, 1);
      found = dofs_.index.find(name);
    }
    if (name == ground) return true;
    if (found == dofs_.index.end()) {
      if (dofs_.complete)
        fault("found " + shown(name) + ", must be one of the degrees of freedom " + listed(dofs_.names) +
              " or \"ground\"" + hint(name, dofs_.names));
      return false;
    }
    const auto term = std::find_if(direction.begin(), direction.end(),
                                   [&](const Term& t) { return t.dof == found->second; });
    if (term == direction.end())
      direction.push_back({found->second, weight});
    else
      term->weight += weight;
    return true;
  }

  const PatchOptions& patch_;
  const std::string& name_;
  const Dofs& dofs_;
  std::string pointer_;
  Faults& faults_;
  std::vector<std::string> places_, columns_;
  std::set<std::string> names_;
  std::size_t line_ = 0;            // being read; 0: none
  std::vector<std::size_t> lines_;  // of the rows
};

const PartType* read_law(const Keys& keys, std::span<const PartType* const> laws, Faults& faults) {
  std::vector<std::string> known;
  for (const PartType* law : laws)
    if (!patch_fields(*law, {}).empty()) known.emplace_back(law->name());
  const std::string wanted = "one of " + listed(known);
  const Location place = keys.require("law", wanted, faults);
  const auto text = read_string(place, wanted, faults);
  if (!text) return nullptr;
  for (const PartType* law : laws)
    if (law->name() == *text && std::find(known.begin(), known.end(), *text) != known.end()) return law;
  faults.add(place.pointer, "found " + shown(*text) + ", must be " + wanted + hint(*text, known));
  return nullptr;
}

void read_patch_values(const Keys& keys, Part& patch, Faults& faults) {
  for (const Field& field : patch.fields()) {
    const Location value =
        field.default_value ? keys.find(field.name) : keys.require(field.name, allowed_text(field), faults);
    read_value(value, field, patch, faults);
  }
  patch.wear_coefficient =
      read_number(keys.find(wear_coefficient.name), wear_coefficient, faults).value_or(0);
}

Part read_patch(const Location& place, std::span<const PartType* const> laws, const Dofs& dofs,
                const FileSource& source, Names& names, Faults& faults) {
  Part patch;
  patch.type = &patch_type();
  PatchOptions options;
  if (place.node->get<Node::Object>() != nullptr) {
    Faults others;  // reported below, with the keys that the law has
    options.law = read_law(Keys(place, {}, others), laws, faults);
  }
  std::vector<std::string> known;  // none: every key
  if (options.law != nullptr) {
    options.law_options = read_options(*options.law, place, dofs, source, faults);
    options.fields = patch_fields(*options.law, options.law_options);
    known = {"name", "law", "file", "details", std::string(wear_coefficient.name)};
    for (const Key& option : options.law->options()) known.push_back(option.name);
    for (const Field& field : options.fields) known.emplace_back(field.name);
  }
  const Keys keys(place, known, faults);
  const Location name = keys.require("name", "a string, the name of the patch", faults);
  const auto text = read_string(name, "a string, the name of the patch", faults);
  const bool named = text && names.add(*text, name.pointer, faults);
  if (named) patch.name = *text;
  if (options.law == nullptr || !keys.is_object()) {
    if (named) names.set_unknown(patch.name);
    if (!named) names.set_incomplete();
    return patch;
  }
  const Reading reading{keys, any_number, no_parameters(), dofs, faults, source};
  constexpr const char* wanted = "a string, the path of a CSV file of contacts";
  const Location file = keys.require("file", wanted, faults);
  options.file = read_file_of(file, wanted, reading).value_or(NamedFile{});
  if (const Location details = keys.find("details"); details.node != nullptr) {
    if (const bool* is = details.node->get<bool>())
      options.details = *is;
    else
      add_wrong_type(details, "true or false", faults);
  }
  patch.options = Settings::of(options);
  if (named) names.set_fields(patch.name, patch.options.as<PatchOptions>().fields);
  const std::size_t before = faults.count();
  read_patch_values(keys, patch, faults);
  if (!options.file.text) return patch;
  auto& own = patch.options.as<PatchOptions>();
  PatchRows rows(own, patch.name, dofs, file.pointer, faults);
  own.rows = rows.read(*options.file.text);
  if (faults.count() == before)
    for (std::size_t i = 0; i < own.rows.size(); ++i) rows.check(i, patch_element(patch, own.rows[i]));
  return patch;
}

}  // namespace

std::vector<Part> read_patches(const Location& place, std::span<const PartType* const> laws, const Dofs& dofs,
                               const FileSource& source, Names& names, Faults& faults) {
  std::vector<Part> patches;
  const Node::List* list = read_list(place, "a list of objects", faults);
  if (place.node != nullptr && list == nullptr) names.set_incomplete();
  if (list != nullptr) patches.reserve(list->size());
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
    patches.push_back(read_patch({&(*list)[i], child(place.pointer, i)}, laws, dofs, source, names, faults));
  return patches;
}

}  // namespace arcslip::scene::file
