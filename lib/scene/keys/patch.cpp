#include <arcslip/scene/patch.hpp>

#include <arcslip/scene/keys/write_values.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace arcslip::scene {
namespace {

constexpr std::string_view load_name = "normal_load", stiffness_name = "normal_stiffness";

constexpr Field pressure_factor{.name = "pressure_factor",
                                .unit = "-",
                                .lower = 0,
                                .upper = std::numeric_limits<double>::infinity(),
                                .default_value = 1.0,
                                .help = "multiplies every pressure"};

// A unit, and that of the same per area.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> per_area = {
    {{"N/m", "N/m^3"}, {"N s/m", "N s/m^3"}, {"N", "Pa"}}};

std::optional<std::string_view> unit_per_area(std::string_view unit) {
  for (const auto& [own, area] : per_area)
    if (unit == own) return area;
  return {};
}

class Patch final : public PartType {
 public:
  std::string_view name() const override { return "patch"; }
  std::span<const Field> fields(const Settings& options) const override {
    return options.empty() ? std::span<const Field>() : options.as<PatchOptions>().fields;
  }
  std::vector<NamedFile*> files(Settings& options) const override {
    if (options.empty()) return {};
    auto& own = options.as<PatchOptions>();
    std::vector<NamedFile*> all = {&own.file};
    const auto of_law = own.law->files(own.law_options);
    all.insert(all.end(), of_law.begin(), of_law.end());
    return all;
  }
  void write_options(const Settings& options, const Scene& scene, file::Node::Object& to) const override {
    if (options.empty()) return;
    const auto& own = options.as<PatchOptions>();
    to.push_back({"law", file::node(own.law->name())});
    to.push_back({"file", file::node(own.file.path)});
    to.push_back({"details", file::Node{own.details}});
    own.law->write_options(own.law_options, scene, to);
  }
  bool names_directions() const override { return true; }  // each row has its own
};

}  // namespace

const PartType& patch_type() {
  static const Patch type;
  return type;
}

std::vector<Field> patch_fields(const PartType& law, const Settings& options) {
  const auto of_law = law.fields(options);
  if (std::none_of(of_law.begin(), of_law.end(), [](const Field& f) { return f.name == load_name; }))
    return {};
  std::vector<Field> fields(of_law.begin(), of_law.end());
  for (Field& field : fields) {
    if (field.name == load_name)
      field = pressure_factor;
    else if (const auto unit = unit_per_area(field.unit))
      field.unit = *unit;
    else if (field.unit.starts_with('N'))
      return {};  // a force whose growth with the area is not known
  }
  return fields;
}

std::vector<PatchShare> PatchOptions::shares(const PatchRow& row) const {
  std::vector<PatchShare> all;
  const auto of_law = law->fields(law_options);
  for (std::size_t k = 0; k < of_law.size(); ++k) {
    if (of_law[k].name != load_name) {
      all.push_back({k, k, unit_per_area(of_law[k].unit) ? row.area : 1});
      continue;
    }
    all.push_back({k, k, row.area * row.pressure});
    for (std::size_t j = 0; row.gap != 0 && j < of_law.size(); ++j)
      if (of_law[j].name == stiffness_name) all.push_back({k, j, -row.area * row.gap});
  }
  return all;
}

Part patch_element(const Part& patch, const PatchRow& row) {
  const auto& options = patch.options.as<PatchOptions>();
  Part part{row.name, options.law, row.directions, {}};
  part.options = options.law_options;
  part.wear_coefficient = patch.wear_coefficient;
  part.detailed = options.details;
  part.values.assign(options.fields.size(), 0.0);
  for (const PatchShare& share : options.shares(row))
    part.values[share.field] += share.factor * patch.values[share.from];
  return part;
}

std::vector<Part> all_elements(const Scene& scene) {
  std::vector<Part> all = scene.elements;
  for (const Part& patch : scene.patches)
    for (const PatchRow& row : patch.options.as<PatchOptions>().rows)
      all.push_back(patch_element(patch, row));
  return all;
}

}  // namespace arcslip::scene
