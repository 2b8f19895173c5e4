// The structures "beam" and "rod".
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/section_keys.hpp>

#include <cmath>

namespace arcslip::scene {
namespace file {
namespace {

constexpr int largest_elements = 100'000;
constexpr double at_node = 1e-9;  // of the length of an element

// A structure "beam" or "rod".
struct BarSection {
  Bar bar{};
  double highest_frequency = 0;
  friend bool operator==(const BarSection&, const BarSection&) = default;
};

constexpr Field positive(std::string_view name, std::string_view unit) {
  return {.name = name, .unit = unit, .lower = 0, .upper = infinity, .lower_open = true};
}

KeyGroup<BarSection> of_bar(double Bar::*value, const Field& field, std::string help) {
  return within(&BarSection::bar, required(number(value, field, std::move(help))));
}

// "width" and "height", or "area" and, of a beam, "inertia".
KeyGroup<BarSection> cross_section(bool bends) {
  auto group = of_bar(&Bar::area, positive("area", "m^2"), "of the section"),
       inertia = of_bar(&Bar::inertia, positive("inertia", "m^4"), "of the section, next to `area`"),
       width = of_bar(&Bar::area, positive("width", "m"), "of a rectangular section, in place of `area`"),
       height = of_bar(&Bar::inertia, positive("height", "m"), "next to `width`: the section bends along it");
  const auto area = group;
  group.keys.insert(group.keys.end(), {width.keys.front(), height.keys.front()});
  if (bends) group.keys.push_back(inertia.keys.front());
  for (Key& key : group.keys) key.required = false;
  group.read = [=](const Reading& reading, BarSection& of) {
    const bool has_sides = reading.keys.has("width") || reading.keys.has("height");
    (has_sides ? width : area).read(reading, of);
    if (has_sides || bends) (has_sides ? height : inertia).read(reading, of);
    if (!has_sides) return;
    for (const std::string_view other : {"area", "inertia"})
      if (const Location place = reading.keys.find(other); place.node != nullptr)
        reading.faults.add(place.pointer, "found the key " + shown(other) +
                                              R"( next to "width" and "height", which stand in its place)");
    const double w = of.bar.area, h = of.bar.inertia;
    of.bar.area = w * h;
    of.bar.inertia = bends ? w * h * h * h / 12 : 0;
  };
  group.write = [=](const BarSection& of, const Scene& scene, Node::Object& to) {
    area.write(of, scene, to);
    if (bends) inertia.write(of, scene, to);
  };
  return group;
}

KeyGroup<BarSection> ends(bool bends) {
  const std::string wanted =
      bends ? R"(a list of two of "clamped", "pinned", "free")" : R"(a list of two of "clamped", "free")";
  Key key = key_of("ends", "", wanted, "at its first and its last node",
                   R"({"type": "array", "items": {"enum": ["clamped", "pinned", "free"]}})");
  key.otherwise = R"(["clamped", "free"])";
  return {{key},
          [=](const Reading& reading, BarSection& of) {
            Faults& faults = reading.faults;
            const Location place = reading.keys.find("ends");
            const Node::List* list = read_list(place, wanted, faults);
            if (list != nullptr && list->size() != 2)
              faults.add(place.pointer, "found " + std::to_string(list->size()) + " ends, must be " + wanted);
            for (std::size_t i = 0; list != nullptr && list->size() == 2 && i < 2; ++i) {
              const Location end{&(*list)[i], child(place.pointer, i)};
              BarEnd& own = of.bar.ends[i];
              own = read_choice(end, bar_ends, own, faults);
              if (!bends && own == BarEnd::pinned)
                faults.add(end.pointer, R"(found "pinned", must be one of "clamped", "free" for a rod)");
            }
          },
          [](const BarSection& of, const Scene&, Node::Object& to) {
            Node::List list;
            for (const BarEnd end : of.bar.ends) list.push_back(node(word_of(bar_ends, end)));
            to.push_back({"ends", {std::move(list)}});
          }};
}

// Of the degrees of freedom of a point.
std::vector<std::string> names_at(const std::string& point, bool bends) {
  return bends ? std::vector{point, point + ".slope"} : std::vector{point};
}

void read_points(const Reading& reading, bool bends, Bar& bar) {
  Faults& faults = reading.faults;
  const Location place = reading.keys.find("points");
  if (place.node == nullptr) return;
  const auto* object = place.node->get<Node::Object>();
  if (object == nullptr)
    return add_wrong_type(place, "an object of names and places along the length, in m", faults);
  const double length = bar.length > 0 ? bar.length : 1;  // after a fault
  Dofs dofs = reading.dofs;
  for (const Member& member : *object) {
    const std::string pointer = child(place.pointer, member.key);
    const Field along{.name = "place", .unit = "m", .lower = 0, .upper = length};
    const auto at = read_number({&member.value, pointer}, along, faults);
    for (const std::string& name : names_at(member.key, bends)) {
      if (const std::string reason = objection_of_dof(name, dofs); !reason.empty())
        return faults.add(pointer, "found the name " + shown(name) + ", " + reason);
      dofs.index.emplace(name, 0);
    }
    if (!at) continue;
    const double element = *at / length * bar.elements;
    if (std::abs(element - std::round(element)) > at_node)
      faults.add(pointer, "found " + number_text(*at) +
                              " m, must be at a node, a multiple of length/elements, which is " +
                              number_text(length / bar.elements) + " m");
    else
      bar.points.emplace_back(member.key, *at);
  }
}

KeyGroup<BarSection> points(bool bends) {
  const std::string help = "names of nodes and their positions along the length: degrees of freedom `mid`" +
                           std::string(bends ? " and `mid.slope`" : "") + "; a fixed node has none";
  return required<BarSection>(
      {{key_of("points", "m", "an object of names and places", help,
               R"({"type": "object", "additionalProperties": {"type": ["number", "string"]}})")},
       [=](const Reading& reading, BarSection& of) { read_points(reading, bends, of.bar); },
       [](const BarSection& of, const Scene&, Node::Object& to) {
         Node::Object all;
         for (const auto& [name, place] : of.bar.points) all.push_back({name, node(place)});
         to.push_back({"points", {std::move(all)}});
       }});
}

KeysOf<BarSection> keys_of_bar(bool bends) {
  KeysOf<BarSection> all;
  all.add(within(&BarSection::bar,
                 required(whole("elements", &Bar::elements, 1, largest_elements, "of equal length"))));
  all.add(of_bar(&Bar::length, positive("length", "m"), "of the bar"));
  all.add(of_bar(&Bar::young, positive("young", "Pa"), "Young's modulus"));
  all.add(of_bar(&Bar::density, positive("density", "kg/m^3"), "of the material"));
  all.add(cross_section(bends));
  all.add(ends(bends));
  all.add(points(bends));
  all.add(within(&BarSection::highest_frequency,
                 optional_frequency("highest_frequency", "as for matrices; required above 500 rows")));
  all.check([=](const Reading&, BarSection& of) { of.bar.bends = bends; });
  return all;
}

}  // namespace

std::optional<Matrices> read_bar(const Location& place, bool bends, FrequencyUnit unit,
                                 const FileSource& source, Dofs& dofs, Faults& faults) {
  const std::size_t before = faults.count();
  auto section =
      read_section(place, bar_keys(bends), frequency_field(unit), source, dofs, faults).as<BarSection>();
  if (faults.count() > before) return {};

  Bar& bar = section.bar;
  const BarMatrices of = matrices(bar);
  if (of.mass.rows == 0) {
    faults.add(place.pointer, "found no node that moves, must have more elements or a free end");
    return {};
  }
  if (!std::isfinite(value_at(of.stiffness, 0, 0)) || !std::isfinite(value_at(of.mass, 0, 0))) {
    faults.add(place.pointer, "found numbers whose products overflow");
    return {};
  }
  Matrices made;
  made.highest_frequency = section.highest_frequency;
  std::size_t i = 0;
  for (const auto& [point, along] : bar.points)
    for (const std::string& name : names_at(point, bends))
      if (const int row = of.rows[i++]; row >= 0) {  // those that an end holds have no motion
        dofs.index.emplace(name, static_cast<int>(dofs.names.size()));
        dofs.names.push_back(name);
        made.rows.push_back(row);
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

void write_bar(const Matrices& matrices, const Scene& scene, Node::Object& structure) {
  Node::Object own;
  bar_keys(matrices.bar->bends)
      .write(Settings::of(BarSection{*matrices.bar, matrices.highest_frequency}), scene, own);
  structure.push_back({matrices.bar->bends ? "beam" : "rod", {std::move(own)}});
}

}  // namespace file

const SettingsKeys& bar_keys(bool bends) {
  static const file::KeysOf<file::BarSection> beam = file::keys_of_bar(true), rod = file::keys_of_bar(false);
  return bends ? beam : rod;
}

}  // namespace arcslip::scene
