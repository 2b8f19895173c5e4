// The structures "beam" and "rod".
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_studies.hpp>

#include <cmath>

namespace arcslip::scene::file {
namespace {

constexpr int largest_elements = 100'000;
constexpr double at_node = 1e-9;  // of the length of an element

constexpr Field positive(std::string_view name, std::string_view unit) {
  return {.name = name,
          .unit = unit,
          .lower = 0,
          .upper = std::numeric_limits<double>::infinity(),
          .lower_open = true};
}

double number(const Keys& keys, std::string_view name, std::string_view unit, Faults& faults) {
  const Field field = positive(name, unit);
  return read_number(keys.require(name, allowed_text(field), faults), field, faults).value_or(1);
}

void read_section(const Keys& keys, Bar& bar, Faults& faults) {
  if (keys.has("width") || keys.has("height")) {
    for (const std::string_view other : {"area", "inertia"})
      if (const Location place = keys.find(other); place.node != nullptr)
        faults.add(place.pointer, "found the key " + shown(other) +
                                      R"( next to "width" and "height", which stand in its place)");
    const double width = number(keys, "width", "m", faults), height = number(keys, "height", "m", faults);
    bar.area = width * height;
    bar.inertia = bar.bends ? width * height * height * height / 12 : 0;
    return;
  }
  bar.area = number(keys, "area", "m^2", faults);
  if (bar.bends) bar.inertia = number(keys, "inertia", "m^4", faults);
}

void read_ends(const Location& place, Bar& bar, Faults& faults) {
  const std::string wanted =
      bar.bends ? R"(a list of two of "clamped", "pinned", "free")" : R"(a list of two of "clamped", "free")";
  if (place.node == nullptr) return;
  const Node::List* list = read_list(place, wanted, faults);
  if (list == nullptr) return;
  if (list->size() != 2) {
    faults.add(place.pointer, "found " + std::to_string(list->size()) + " ends, must be " + wanted);
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const Location end{&(*list)[i], child(place.pointer, i)};
    bar.ends[i] = read_choice(end, bar_ends, bar.ends[i], faults);
    if (!bar.bends && bar.ends[i] == BarEnd::pinned)
      faults.add(end.pointer, R"(found "pinned", must be one of "clamped", "free" for a rod)");
  }
}

void read_points(const Location& place, Bar& bar, Dofs& dofs, Faults& faults) {
  if (place.node == nullptr) return;
  const auto* object = place.node->get<Node::Object>();
  if (object == nullptr)
    return add_wrong_type(place, "an object of names and places along the length, in m", faults);
  for (const Member& member : *object) {
    const std::string pointer = child(place.pointer, member.key);
    const Field along{.name = "place", .unit = "m", .lower = 0, .upper = bar.length};
    const auto at = read_number({&member.value, pointer}, along, faults);
    std::vector<std::string> names = {member.key};
    if (bar.bends) names.push_back(member.key + ".slope");
    for (const std::string& name : names)
      if (const std::string reason = objection_of_dof(name, dofs); !reason.empty())
        return faults.add(pointer, "found the name " + shown(name) + ", " + reason);
    if (!at) continue;
    const double element = *at / bar.length * bar.elements;
    if (std::abs(element - std::round(element)) > at_node) {
      faults.add(pointer, "found " + number_text(*at) +
                              " m, must be at a node, a multiple of length/elements, which is " +
                              number_text(bar.length / bar.elements) + " m");
      continue;
    }
    bar.points.emplace_back(member.key, *at);
    for (const std::string& name : names) {
      dofs.index.emplace(name, static_cast<int>(dofs.names.size()));
      dofs.names.push_back(name);
    }
  }
}

}  // namespace

std::optional<Matrices> read_bar(const Location& place, bool bends, FrequencyUnit unit,
                                 const FileSource& source, Dofs& dofs, Faults& faults) {
  std::vector<std::string> allowed = {"elements", "length", "young", "density", "area",
                                      "width",    "height", "ends",  "points",  "highest_frequency"};
  if (bends) allowed.emplace_back("inertia");
  const std::size_t before = faults.count();
  const Keys keys(place, allowed, faults);
  if (!keys.is_object()) return {};
  Bar bar;
  bar.bends = bends;
  bar.elements =
      read_integer(keys.require("elements", "an integer", faults), 1, largest_elements, faults).value_or(1);
  bar.length = number(keys, "length", "m", faults);
  bar.young = number(keys, "young", "Pa", faults);
  bar.density = number(keys, "density", "kg/m^3", faults);
  read_section(keys, bar, faults);
  read_ends(keys.find("ends"), bar, faults);
  Dofs names = dofs;
  read_points(keys.require("points", "an object of names and places", faults), bar, names, faults);
  Matrices made;
  if (const Location highest = keys.find("highest_frequency"); highest.node != nullptr)
    made.highest_frequency = read_number(highest, frequency_field(unit), faults).value_or(0);
  if (faults.count() > before) return {};

  const BarMatrices of = matrices(bar);
  if (of.mass.rows == 0) {
    faults.add(place.pointer, "found no node that moves, must have more elements or a free end");
    return {};
  }
  if (!std::isfinite(value_at(of.stiffness, 0, 0)) || !std::isfinite(value_at(of.mass, 0, 0))) {
    faults.add(place.pointer, "found numbers whose products overflow");
    return {};
  }
  for (std::size_t i = 0; i < of.rows.size(); ++i) {  // those that an end holds have no motion
    if (of.rows[i] < 0) continue;
    dofs.index.emplace(names.names[i], static_cast<int>(dofs.names.size()));
    dofs.names.push_back(names.names[i]);
    made.rows.push_back(of.rows[i]);
  }
  if (made.rows.empty()) {
    faults.add(child(place.pointer, "points"), "found no point that moves, must have at least one");
    return {};
  }
  if (source.derived) made.derived = source.derived;
  made.mass.matrix = std::make_shared<const SparseMatrix>(of.mass);
  made.stiffness.matrix = std::make_shared<const SparseMatrix>(of.stiffness);
  made.bar = std::move(bar);
  return made;
}

}  // namespace arcslip::scene::file
