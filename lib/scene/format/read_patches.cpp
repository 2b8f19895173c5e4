// Patches of contacts, and the CSV files of their rows.
#include <arcslip/scene/keys/csv_text.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/study_keys.hpp>
#include <arcslip/scene/patch.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
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

using Axis = std::array<double, 3>;

constexpr std::array<const char*, 3> components = {".x", ".y", ".z"};  // of a node

double dot(const Axis& a, const Axis& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Axis cross(const Axis& a, const Axis& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
// Components next to rounding are 0, so that a plane model needs no third one.
std::optional<Axis> of_length_one(Axis a) {
  constexpr double rounding = 1e-15;
  const double length = std::hypot(a[0], a[1], a[2]);
  if (!(length > 0) || !std::isfinite(length)) return {};
  for (double& of : a) of = std::abs(of) > rounding * length ? of / length : 0;
  return a;
}
// The part of an axis across a normal; without an axis that of the first of x, y, z that is farthest from it.
std::optional<Axis> tangent_to(const Axis& normal, std::optional<Axis> along) {
  constexpr double least = 1e-6;  // of an axis of length 1: less is none
  if (!along) {
    const auto farthest = std::min_element(normal.begin(), normal.end(),
                                           [](double a, double b) { return std::abs(a) < std::abs(b); });
    along = Axis{};
    (*along)[static_cast<std::size_t>(farthest - normal.begin())] = 1;
  }
  const double share = dot(*along, normal);
  Axis across;
  for (std::size_t c = 0; c < 3; ++c) across[c] = (*along)[c] - share * normal[c];
  if (dot(across, across) < least * least) return {};
  return of_length_one(across);
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
  // Of the displacements of a row: places, or nodes and the axes at their contact.
  std::vector<std::string> columns_of_places() const {
    if (!by_nodes_) return places_;
    return {"nodes", "against", "normal", "tangent"};
  }

  bool header(const std::vector<std::string_view>& cells) {
    by_nodes_ = std::find(cells.begin(), cells.end(), "nodes") != cells.end();
    std::vector<std::string> known = columns_of_places();
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
    std::vector<std::string> needed =
        by_nodes_ ? std::vector<std::string>{"nodes", "normal"} : std::vector<std::string>(places_);
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
    if (by_nodes_)
      row.directions = directions_of_nodes(cells);
    else
      for (const std::string& place : places_) row.directions.push_back(direction(*cell(cells, place)));
    row.area = number(cells, area_field);
    row.gap = number(cells, gap_field);
    row.pressure = number(cells, pressure_field);
    return row;
  }

  // "0 0 1", of length 1.
  std::optional<Axis> axis(const std::vector<std::string_view>& cells, std::string_view column) {
    const auto text = cell(cells, column);
    if (!text || text->empty()) return {};
    Axis found{};
    std::size_t count = 0;
    bool numbers = true;
    for (const std::string_view word : split(*text, ' ')) {
      if (word.empty()) continue;
      const auto value = parsed_number(word);
      if (value && count < 3) found[count] = *value;
      numbers = numbers && value;
      ++count;
    }
    auto axis = numbers && count == 3 ? of_length_one(found) : std::nullopt;
    if (!axis)
      fault("found the " + std::string(column) + " " + shown(*text) +
            ", must be three numbers that are not all 0, as in 0 0.6 0.8");
    return axis;
  }

  struct WeightedNode {
    std::string name;
    double weight;
  };

  // The component of a node is one of its degrees of freedom.
  bool is_node(const std::string& name) const {
    return std::any_of(components.begin(), components.end(),
                       [&](const char* component) { return dofs_.index.contains(name + component); });
  }

  // "a1", "0.25*a1".
  WeightedNode weighted_node(std::string_view word) const {
    const auto star = word.find('*');
    if (star == std::string_view::npos || is_node(std::string(word))) return {std::string(word), 1};
    return {std::string(word.substr(star + 1)),
            parsed_number(word.substr(0, star)).value_or(std::numeric_limits<double>::quiet_NaN())};
  }

  // What is wrong with a word among the nodes; empty if nothing is.
  std::string objection_to_node(std::string_view word, const WeightedNode& node) const {
    constexpr const char* wanted =
        "names of nodes with spaces between them, each with a weight if needed, as in "
        "0.25*a1 0.75*a2";
    if (!(node.weight > 0)) {
      const std::string found =
          std::isnan(node.weight) ? shown(word.substr(0, word.find('*'))) : number_text(node.weight);
      return "found the weight " + found + " of the node " + shown(node.name) + ", must be a number above 0";
    }
    if (node.name == ground || !dofs_.complete || is_node(node.name)) return {};
    if (dofs_.index.contains(node.name)) {
      const std::string of = node.name.substr(0, node.name.rfind('.'));
      return "found " + shown(node.name) + ", a degree of freedom, among the nodes, must be a node" +
             (is_node(of) ? ", as " + shown(of) : "") +
             ": its degrees of freedom are those of its name with .x, .y, .z";
    }
    if (node.name.empty() || node.name.front() == '+' || node.name.front() == '-')
      return "found " + shown(word) + " among the nodes, must be " + wanted;
    return {};
  }

  // "a1 a2", "0.25*a1 0.5*a2 0.25*a3": their mean.
  std::vector<WeightedNode> nodes(std::string_view text) {
    std::vector<WeightedNode> all;
    double sum = 0;
    for (const std::string_view word : split(text, ' ')) {
      if (word.empty()) continue;
      WeightedNode node = weighted_node(word);
      if (const std::string objection = objection_to_node(word, node); !objection.empty()) {
        fault(objection);
        return {};
      }
      sum += node.weight;
      all.push_back(std::move(node));
    }
    if (all.size() > 1 &&
        std::any_of(all.begin(), all.end(), [](const auto& node) { return node.name == ground; }))
      fault("found \"ground\" among other nodes, must be alone");
    for (WeightedNode& node : all) node.weight /= sum;
    return all;
  }

  void check_sides(const std::vector<WeightedNode>& own, const std::vector<WeightedNode>& against) {
    for (const WeightedNode& node : own)
      if (std::any_of(against.begin(), against.end(),
                      [&](const WeightedNode& other) { return other.name == node.name; }))
        return fault("found " + shown(node.name) + " on both sides, must be on one of them");
  }

  // Of the mean displacement of the nodes, less that of those against them, along an axis.
  Direction direction_along(const Axis& axis, const std::vector<WeightedNode>& own,
                            const std::vector<WeightedNode>& against) {
    Direction direction;
    const auto add_all = [&](const std::vector<WeightedNode>& nodes, double sign) {
      for (const WeightedNode& node : nodes)
        for (std::size_t c = 0; c < 3; ++c)
          if (node.name != ground && axis[c] != 0 &&
              !add_displacement(node.name + components[c], sign * node.weight * axis[c], direction))
            return false;
      return true;
    };
    if (!add_all(own, 1) || !add_all(against, -1)) return {};
    return direction;
  }

  std::vector<Direction> directions_of_nodes(const std::vector<std::string_view>& cells) {
    const std::size_t before = faults_.count();
    const std::vector<WeightedNode> own = nodes(*cell(cells, "nodes")),
                                    against = nodes(cell(cells, "against").value_or(ground));
    if (own.empty() && faults_.count() == before) fault("found no nodes, must have at least one");
    if (faults_.count() == before) check_sides(own, against);
    const auto normal = axis(cells, "normal"), along = axis(cells, "tangent");
    if (!normal && faults_.count() == before) fault("found no normal, must be three numbers");
    if (faults_.count() > before) return {};
    const auto tangent = tangent_to(*normal, along);
    if (!tangent) {
      fault("found the tangent " + shown(*cell(cells, "tangent")) + ", must not be along the normal");
      return {};
    }
    std::vector<Direction> all;
    for (const std::string& place : places_) {
      const Axis of = place == "normal"         ? *normal
                      : place == "tangential_2" ? cross(*normal, *tangent)
                                                : *tangent;
      all.push_back(direction_along(of, own, against));
      if (faults_.count() > before) break;
    }
    return all;
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
    return add_displacement(name, weight, direction);
  }

  // False: there is none of this name.
  bool add_displacement(const std::string& name, double weight, Direction& direction) {
    const auto found = dofs_.index.find(name);
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
  bool by_nodes_ = false;
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
