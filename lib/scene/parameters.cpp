// The parameters of a scene by their names.
#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/formulas.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_type.hpp>
#include <arcslip/scene/unit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

namespace arcslip::scene {
namespace {

template <class AnyScene>
auto sections(AnyScene& scene) {
  return std::array{&scene.masses,   &scene.springs,  &scene.dampers, &scene.damping,
                    &scene.rotation, &scene.elements, &scene.patches, &scene.excitation};
}

// One number of a scene: a constant, or a field of a part.
struct Slot {
  const Constant* constant = nullptr;
  const Part* part = nullptr;
  std::size_t field = 0;

  double value() const { return constant != nullptr ? constant->value : part->values[field]; }
  const NumberText* text() const {
    if (constant != nullptr) return &constant->text;
    return field < part->texts.size() ? &part->texts[field] : nullptr;
  }
  // Without the bounds of what follows it.
  Field own_field() const {
    if (part != nullptr) return part->fields()[field];
    return {.name = constant->name,
            .unit = constant->unit,
            .lower = constant->lower,
            .upper = constant->upper,
            .help = constant->help};
  }
  std::string name() const {
    return constant != nullptr ? constant->name : part->name + '.' + std::string(part->fields()[field].name);
  }
};

// Of a part that was read without a fault.
std::span<const Field> known_fields(const Part& part) {
  const auto fields = part.type != nullptr ? part.fields() : std::span<const Field>();
  return fields.size() == part.values.size() ? fields : std::span<const Field>();
}

std::optional<Slot> find_field(const Scene& scene, std::string_view part_name, std::string_view field) {
  for (const auto* section : sections(scene))
    for (const Part& part : *section) {
      if (part.name != part_name) continue;
      const std::span<const Field> fields = known_fields(part);
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].name == field) return Slot{nullptr, &part, i};
    }
  return {};
}

std::optional<Slot> find(const Scene& scene, std::string_view name) {
  for (const Constant& constant : scene.constants)
    if (constant.name == name) return Slot{&constant};
  const std::size_t dot = name.find('.');
  for (const Constant& constant : scene.constants)  // "part.value" of all sectors of a ring
    if (dot == std::string_view::npos && constant.name == std::string(name) + ".value")
      return Slot{&constant};
  return dot == std::string_view::npos ? find_field(scene, name, "value")
                                       : find_field(scene, name.substr(0, dot), name.substr(dot + 1));
}

Slot slot_of(const Scene& scene, std::string_view name) {
  if (const auto slot = find(scene, name)) return *slot;
  const std::vector<std::string> known = parameter_names(scene);
  throw ParameterError("unknown parameter " + file::shown(name) + ", must be one of " + file::listed(known) +
                       file::hint(name, known));
}

// All slots with a formula.
std::vector<Slot> followers(const Scene& scene) {
  std::vector<Slot> all;
  for (const Constant& constant : scene.constants)
    if (constant.text.follows()) all.push_back({&constant});
  for (const auto* section : sections(scene))
    for (const Part& part : *section)
      for (std::size_t i = 0; i < part.texts.size(); ++i)
        if (part.texts[i].follows()) all.push_back({nullptr, &part, i});
  return all;
}

// What becomes of the numbers of a scene where one of them changes. Formulas have no cycles.
class Change {
 public:
  Change(const Scene& scene, std::string_view name, double value) : scene_(scene) {
    known_.emplace(name, value);
  }

  double value(const std::string& name) {
    const Slot slot = slot_of(scene_, name);
    const auto known = known_.find(slot.name());
    return known != known_.end() ? known->second : value(slot);
  }
  double value(const Slot& slot) {
    const NumberText* text = slot.text();
    if (text == nullptr || !text->follows()) return slot.value();
    std::vector<double> inputs;
    for (const std::string& each : text->parameters) inputs.push_back(value(each));
    const double value = text->formula->value(inputs);
    known_.insert_or_assign(slot.name(), value);
    return value;
  }

 private:
  const Scene& scene_;
  std::unordered_map<std::string, double> known_;
};

// Whether a formula has a parameter, itself or by the formulas of its own parameters.
bool follows(const Scene& scene, const NumberText& formula, const std::string& name) {
  return std::any_of(formula.parameters.begin(), formula.parameters.end(), [&](const std::string& each) {
    const NumberText* next = parameter_formula(scene, each);
    return each == name || (next != nullptr && follows(scene, *next, name));
  });
}

// text: null where it stays.
void assign(Scene& scene, const Slot& slot, double value, const NumberText* text) {
  for (Constant& constant : scene.constants)
    if (&constant == slot.constant) {
      constant.value = value;
      if (text != nullptr) constant.text = *text;
    }
  for (auto* section : sections(scene))
    for (Part& part : *section) {
      if (&part != slot.part) continue;
      part.values[slot.field] = value;
      if (text == nullptr || (part.texts.empty() && text->text.empty())) continue;
      part.texts.resize(part.values.size());
      part.texts[slot.field] = *text;
      if (std::all_of(part.texts.begin(), part.texts.end(),
                      [](const NumberText& t) { return t.text.empty(); }))
        part.texts.clear();
    }
}

// Sets a number, and all that follow it.
void change(Scene& scene, const Slot& slot, double value, const NumberText& text) {
  const std::string name = slot.name();
  const Field own = parameter_field(scene, name);
  if (!file::within(own, value))
    throw ParameterError("parameter " + file::quoted(name) + ": " + file::bound_fault(own, value));
  Change change(scene, name, value);
  std::vector<std::pair<Slot, double>> values;
  for (const Slot& follower : followers(scene)) {
    if (follower.name() == name) continue;
    values.emplace_back(follower, change.value(follower));
    const Field field = follower.own_field();
    if (!file::within(field, values.back().second))
      throw ParameterError("parameter " + file::quoted(name) + " = " + file::number_text(value) + ": " +
                           file::quoted(follower.name()) + ", which is " +
                           file::shown(follower.text()->text) +
                           ", would be out of its bounds: " + file::bound_fault(field, values.back().second));
  }
  assign(scene, slot, value, &text);
  for (const auto& [follower, number] : values) assign(scene, follower, number, nullptr);
  for (Study& study : scene.studies) {
    drop(study, name);
    for (const auto& [pointer, formula] : study.texts)
      study.type->settings().visit_numbers(study.settings, [&](const std::string& at, double& number) {
        if (at == pointer) number = scene::value(scene, formula);
      });
  }
}

// "0.2 mm" in the unit of a field; none: it is no number with a unit.
std::optional<double> quantity_in(const Field& field, const std::string& text) {
  const auto quantity = split_quantity(text);
  const auto unit = quantity ? unit_of(quantity->unit) : std::nullopt;
  if (!unit) return {};
  const auto wanted = unit_of(field.unit);
  const auto number = wanted ? value_in(quantity->number, *unit, *wanted) : std::nullopt;
  if (!number)
    throw ParameterError("found " + file::shown(text) + ", must be in a unit of the same dimension as " +
                         std::string(field.unit));
  return number;
}

}  // namespace

std::vector<std::string> parameter_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Constant& constant : scene.constants) names.push_back(constant.name);
  for (const auto* section : sections(scene)) {
    for (const Part& part : *section)
      for (const Field& field : known_fields(part))
        names.push_back(part.name + '.' + std::string(field.name));
  }
  return names;
}

Field parameter_field(const Scene& scene, std::string_view parameter) {
  const Slot slot = slot_of(scene, parameter);
  Field all = slot.own_field();
  if (slot.part != nullptr) return all;
  for (const Slot& follower : followers(scene)) {
    const NumberText& text = *follower.text();
    if (!text.is_parameter() || text.parameters.front() != slot.constant->name) continue;
    const Field field =
        follower.part != nullptr ? follower.own_field() : parameter_field(scene, follower.constant->name);
    file::narrow(all, field);
    if (all.unit.empty()) all.unit = field.unit;
  }
  return all;
}

const NumberText* parameter_formula(const Scene& scene, std::string_view parameter) {
  const NumberText* text = slot_of(scene, parameter).text();
  return text != nullptr && text->follows() ? text : nullptr;
}

double value(const Scene& scene, std::string_view parameter) {
  return slot_of(scene, parameter).value();
}

void set(Scene& scene, std::string_view parameter, double value) {
  const Slot slot = slot_of(scene, parameter);
  if (const NumberText* text = slot.text(); text != nullptr && text->follows())
    throw ParameterError(
        "parameter " + file::quoted(slot.name()) + " is given by the formula " + file::shown(text->text) +
        ", must be set by what it follows: " + file::listed(independent_parameters(scene, *text)));
  change(scene, slot, value, {});
}

void set_text(Scene& scene, std::string_view parameter, const std::string& text) {
  const Slot slot = slot_of(scene, parameter);
  try {
    if (const auto number = quantity_in(slot.own_field(), text))
      return change(scene, slot, *number, {text, {}, {}});
    const NumberText given = read_formula(scene, text);
    if (follows(scene, given, slot.name()))
      throw ParameterError("found " + file::shown(text) + ", which follows itself");
    if (const std::string why = objection_to(scene, parameter_field(scene, slot.name()), given); !why.empty())
      throw ParameterError(why);
    change(scene, slot, scene::value(scene, given), given);
  } catch (const formula::FormulaError& error) {
    const std::string objection = objection_to_number(text);
    throw ParameterError("parameter " + file::quoted(slot.name()) + ": " +
                         (objection.empty() ? error.what() : objection));
  }
}

std::string parameter_of(const Scene& scene, std::string_view name) {
  const auto slot = find(scene, name);
  return slot ? slot->name() : "";
}

NumberText read_formula(const Scene& scene, const std::string& text) {
  NumberText read{text, {}, {}};
  const formula::InputOf input_of = [&](std::string_view name) -> std::optional<int> {
    const std::string parameter = name == "pi" ? "" : parameter_of(scene, name);
    if (parameter.empty()) return {};
    const auto known = std::find(read.parameters.begin(), read.parameters.end(), parameter);
    const auto index = static_cast<int>(known - read.parameters.begin());
    if (known == read.parameters.end()) read.parameters.push_back(parameter);
    return index;
  };
  read.formula = std::make_shared<const formula::Formula>(std::span(&text, 1), input_of);
  return read;
}

double value(const Scene& scene, const NumberText& formula) {
  std::vector<double> inputs;
  for (const std::string& parameter : formula.parameters) inputs.push_back(value(scene, parameter));
  return formula.formula->value(inputs);
}

std::vector<std::string> independent_parameters(const Scene& scene, const NumberText& formula) {
  std::vector<std::string> all;
  for (const std::string& each : formula.parameters) {
    const NumberText* next = parameter_formula(scene, each);
    const auto more = next != nullptr ? independent_parameters(scene, *next) : std::vector{each};
    for (const std::string& parameter : more)
      if (std::find(all.begin(), all.end(), parameter) == all.end()) all.push_back(parameter);
  }
  return all;
}

std::string objection_to(const Scene& scene, const Field& field, const NumberText& formula) {
  std::vector<std::string> units;
  for (const std::string& each : formula.parameters) units.emplace_back(parameter_field(scene, each).unit);
  const std::string shown = "found " + file::shown(formula.text) + ", ";
  if (const std::string why = dimension_fault(*formula.formula, units, field.unit); !why.empty())
    return shown + why;
  const double value = scene::value(scene, formula);
  if (std::isfinite(value) && file::within(field, value)) return {};
  return shown + "which is " + (std::isfinite(value) ? file::number_text(value) : "no finite number") +
         ", must be " + file::allowed_text(field);
}

void drop(Study& study, std::string_view parameter) {
  if (std::erase_if(study.for_each, [&](const auto& list) { return list.first == parameter; }) > 0)
    study.rows_file = {};  // which has other columns
  study.in_rows = study.in_rows && !study.for_each.empty();
  std::erase_if(study.samples.parameters, [&](const auto& sampled) { return sampled.first == parameter; });
  if (study.samples.parameters.empty()) study.samples = {};
  study.type->settings().drop(parameter, study.settings);
}

}  // namespace arcslip::scene
