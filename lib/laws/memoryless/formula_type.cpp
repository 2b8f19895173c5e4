#include <arcslip/laws/memoryless/formula_type.hpp>

#include <arcslip/laws/memoryless/formula_law.hpp>
#include <arcslip/scene/formulas.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace arcslip::elements {
namespace {

using scene::file::Keys;
using scene::file::Location;
using scene::file::Node;
using scene::file::Reading;

constexpr std::string_view type_name = "formula",
                           type_help = "a force by a formula of displacements and velocities";
constexpr std::string_view wanted_force = "a string, the formula of the force",
                           wanted_forces = "a list of a formula for each of at least two displacements",
                           wanted_parameters =
                               "an object with a number, or \"value\" and \"unit\", for each name";
constexpr std::size_t most_displacements = 20, most_parameters = 200, longest_unit = 40;

/// The law of one element, with what it refers to.
struct OwnFormula {
  OwnFormula(std::vector<std::string> formulas, std::vector<FormulaParameter> all)
      : forces(std::move(formulas)), parameters(std::move(all)) {
    for (const FormulaParameter& parameter : parameters)
      places.push_back("/parameters/" + parameter.name + (parameter.unit == "-" ? "" : "/value"));
    for (std::size_t k = 0; k < parameters.size(); ++k)
      fields.push_back({.name = parameters[k].name,
                        .unit = parameters[k].unit,
                        .lower = -infinity,
                        .upper = infinity,
                        .help = "parameter of the formula",
                        .place = places[k]});
    law.emplace(type_name, type_help, forces, fields);
  }
  OwnFormula(const OwnFormula&) = delete;
  OwnFormula& operator=(const OwnFormula&) = delete;

  std::vector<std::string> forces;
  std::vector<FormulaParameter> parameters;
  std::vector<std::string> places;
  std::vector<scene::Field> fields;
  std::optional<FormulaLaw> law;
};

struct FormulaOptions {
  std::shared_ptr<const OwnFormula> own =
      std::make_shared<const OwnFormula>(std::vector<std::string>{"0"}, std::vector<FormulaParameter>());
  friend bool operator==(const FormulaOptions& a, const FormulaOptions& b) {
    return a.own->forces == b.own->forces && a.own->parameters == b.own->parameters;
  }
};

bool is_name(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

// Why no parameter may have this name; empty: it may.
std::string objection(const std::string& name, int displacements) {
  if (!is_name(name)) return "must have letters, digits and _ alone, and no digit first";
  std::vector<std::string> taken = motion_names(displacements);
  taken.emplace_back("pi");
  if (std::find(taken.begin(), taken.end(), name) != taken.end())
    return "which is a name of the motion or pi, must be another name";
  return {};
}

std::vector<std::string> read_forces(const Reading& reading) {
  if (!reading.keys.has("forces")) {
    const auto place = reading.keys.require("force", std::string(wanted_force), reading.faults);
    const auto text = scene::file::read_string(place, wanted_force, reading.faults);
    return text ? std::vector{*text} : std::vector<std::string>();
  }
  const Location place = reading.keys.find("forces");
  if (reading.keys.has("force"))
    reading.faults.add(reading.keys.find("force").pointer,
                       "found \"force\" next to \"forces\", must be one of them");
  std::vector<std::string> forces;
  const Node::List* list = scene::file::read_list(place, wanted_forces, reading.faults);
  if (list == nullptr) return forces;
  if (list->size() < 2 || list->size() > most_displacements)
    reading.faults.add(place.pointer, "found a list of " + std::to_string(list->size()) + ", must be " +
                                          std::string(wanted_forces) + " and at most " +
                                          std::to_string(most_displacements));
  for (std::size_t i = 0; i < list->size(); ++i)
    forces.push_back(scene::file::read_string({&(*list)[i], scene::file::child(place.pointer, i)},
                                              wanted_force, reading.faults)
                         .value_or(""));
  return forces;
}

std::vector<FormulaParameter> read_parameters(const Reading& reading, int displacements) {
  std::vector<FormulaParameter> parameters;
  const Location place = reading.keys.find("parameters");
  if (place.node == nullptr) return parameters;
  if (place.node->get<Node::Object>() == nullptr) {
    scene::file::add_wrong_type(place, wanted_parameters, reading.faults);
    return parameters;
  }
  for (const auto* member : scene::file::members(place, reading.faults)) {
    const Location item{&member->value, scene::file::child(place.pointer, member->key)};
    if (const std::string why = objection(member->key, displacements); !why.empty()) {
      reading.faults.add(item.pointer, "found the parameter " + scene::file::shown(member->key) + ", " + why);
      continue;
    }
    FormulaParameter parameter{member->key};
    if (member->value.get<Node::Object>() != nullptr) {
      const Keys keys(item, {"value", "unit"}, reading.faults);
      keys.require("value", "a finite number", reading.faults);
      const auto unit = scene::file::read_string(keys.require("unit", "a string, as \"N/m\"", reading.faults),
                                                 "a string, as \"N/m\"", reading.faults);
      if (unit && (unit->empty() || *unit == "-" || unit->size() > longest_unit ||
                   std::any_of(unit->begin(), unit->end(), [](char c) { return c >= 0 && c < ' '; })))
        reading.faults.add(keys.find("unit").pointer,
                           "found the unit " + scene::file::shown(*unit) + ", must be a text of 1 to " +
                               std::to_string(longest_unit) + " characters; a pure number stands alone: " +
                               scene::file::quoted(member->key) + ": 0.1");
      else if (unit)
        scene::file::check_coherent_unit(*unit, keys.find("unit").pointer, reading.faults);
      parameter.unit = unit.value_or("?");
    }
    parameters.push_back(std::move(parameter));
  }
  if (parameters.size() > most_parameters)
    reading.faults.add(place.pointer, "found " + std::to_string(parameters.size()) +
                                          " parameters, must be at most " + std::to_string(most_parameters));
  return parameters;
}

// What a formula may name, as in messages.
std::vector<std::string> known_names(int displacements, const std::vector<FormulaParameter>& parameters) {
  std::vector<std::string> known = motion_names(displacements);
  for (const FormulaParameter& parameter : parameters) known.push_back(parameter.name);
  known.emplace_back("pi");
  return known;
}

void add_fault(const formula::FormulaError& error, const Reading& reading, int displacements,
               const std::vector<FormulaParameter>& parameters) {
  const formula::FormulaFault& fault = error.fault();
  std::vector<std::string> known;
  std::string message = error.what();
  if (fault.kind == formula::FormulaFault::Kind::unknown_name) known = known_names(displacements, parameters);
  if (fault.kind == formula::FormulaFault::Kind::unknown_function)
    for (const formula::Function& function : formula::functions()) known.emplace_back(function.name);
  if (!known.empty())
    message += ", must be one of " + scene::file::listed(known) + scene::file::hint(fault.name, known);
  const Location place = displacements == 1 ? reading.keys.find("force") : reading.keys.find("forces");
  reading.faults.add(displacements == 1 ? place.pointer : scene::file::child(place.pointer, fault.expression),
                     message);
}

// Of what is added; displacements may be angles, so that any force is right.
void check_dimensions(const Reading& reading, const OwnFormula& own, const FormulaInputs& inputs) {
  std::vector<std::string> units(static_cast<std::size_t>(inputs.count()));
  for (std::size_t k = 0; k < own.parameters.size(); ++k)
    if (own.parameters[k].unit != "-")
      units[static_cast<std::size_t>(inputs.field(static_cast<int>(k)))] = own.parameters[k].unit;
  const std::string fault = scene::dimension_fault(own.law->formula(), units, "");
  if (fault.empty()) return;
  const bool one = own.forces.size() == 1;
  reading.faults.add(reading.keys.find(one ? "force" : "forces").pointer,
                     "found " + (one ? scene::file::shown(own.forces.front()) : "formulas") + ", " + fault);
}

void read_formula(const Reading& reading, FormulaOptions& options) {
  const std::size_t before = reading.faults.count();
  std::vector<std::string> forces = read_forces(reading);
  const int displacements = static_cast<int>(forces.size());
  std::vector<FormulaParameter> parameters = read_parameters(reading, std::max(displacements, 1));
  if (forces.empty()) return;
  if (displacements > 1)  // which places it has does not depend on its faults
    options.own = std::make_shared<const OwnFormula>(std::vector<std::string>(forces.size(), "0"),
                                                     std::vector<FormulaParameter>());
  if (reading.faults.count() > before) return;
  try {
    options.own = std::make_shared<const OwnFormula>(forces, parameters);
  } catch (const formula::FormulaError& error) {
    return add_fault(error, reading, displacements, parameters);
  }
  const FormulaInputs inputs{displacements, static_cast<int>(parameters.size())};
  check_dimensions(reading, *options.own, inputs);
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (!options.own->law->formula().uses(inputs.field(static_cast<int>(k))))
      reading.faults.add(scene::file::child(reading.keys.find("parameters").pointer, parameters[k].name),
                         "found a parameter that no force uses, must be in a formula");
}

// The writer puts the values of the parameters there.
void write_formula(const FormulaOptions& options, const scene::Scene&, Node::Object& to) {
  const auto& forces = options.own->forces;
  if (forces.size() == 1) {
    to.push_back({"force", scene::file::node(forces.front())});
  } else {
    to.push_back({"forces", scene::file::node(forces)});
  }
  if (options.own->parameters.empty()) return;
  Node::Object parameters;
  for (const FormulaParameter& parameter : options.own->parameters)
    if (parameter.unit == "-")
      parameters.push_back({parameter.name, scene::file::node(0.0)});
    else
      parameters.push_back(
          {parameter.name,
           {Node::Object{{"value", scene::file::node(0.0)}, {"unit", scene::file::node(parameter.unit)}}}});
  to.push_back({"parameters", {std::move(parameters)}});
}

scene::file::KeysOf<FormulaOptions> formula_keys() {
  scene::Key force, forces, parameters;
  force.name = "force";
  force.allowed = wanted_force;
  force.help =
      "against the motion, N: of the displacement q (m), the velocity v (m/s), the phase of the excitation "
      "(rad), and the parameters";
  force.schema = R"({"type": "string"})";
  forces.name = "forces";
  forces.allowed = wanted_forces;
  forces.help =
      "in place of \"force\", over several displacements q1, q2 ... with velocities v1, v2 ...; q1, q2: "
      "degrees of freedom, or places in the element";
  forces.schema = R"({"type": "array", "minItems": 2, "maxItems": 20, "items": {"type": "string"}})";
  parameters.name = "parameters";
  parameters.allowed = wanted_parameters;
  parameters.help =
      "{\"k\": {\"value\": 4, \"unit\": \"N\"}, \"c\": 0.1}: what the formula names, a parameter of the "
      "scene each";
  parameters.schema = R"({"type": "object", "additionalProperties": {"oneOf": [{"type": ["number", "string"]},
    {"type": "object", "required": ["value", "unit"], "additionalProperties": false,
     "properties": {"value": {"type": ["number", "string"]}, "unit": {"type": "string"}}}]}})";
  scene::file::KeysOf<FormulaOptions> keys;
  keys.add({{force, forces, parameters}, read_formula, write_formula});
  return keys;
}

class FormulaType final : public scene::file::KeyedPart<FormulaOptions, LawType> {
 public:
  FormulaType() : KeyedPart(formula_keys()) {}
  std::string_view name() const override { return type_name; }
  std::string_view help() const override { return type_help; }
  std::span<const scene::Field> fields(const scene::Settings& options) const override {
    return options.empty() ? std::span<const scene::Field>() : options.as<FormulaOptions>().own->fields;
  }
  bool names_directions() const override { return true; }
  bool has_one_direction(const scene::Settings& options) const override {
    return slots_with(options).empty();
  }
  std::span<const std::string_view> slots_with(const scene::Settings& options) const override {
    return options.empty() ? std::span<const std::string_view>()
                           : options.as<FormulaOptions>().own->law->slots();
  }
  std::vector<std::string> formulas(const scene::Settings& options) const override {
    return options.empty() ? std::vector<std::string>() : options.as<FormulaOptions>().own->forces;
  }
  bool depends_on_phase(const scene::Settings& options) const override {
    return law(options)->phase_dependent();
  }
  std::shared_ptr<const Law> law(const scene::Settings& options) const override {
    const auto own = options.empty() ? FormulaOptions{}.own : options.as<FormulaOptions>().own;
    return {own, &*own->law};
  }
};

}  // namespace

const LawType& formula_type() {
  static const FormulaType type;
  return type;
}

scene::Settings formula_options(std::vector<std::string> forces, std::vector<FormulaParameter> parameters) {
  for (const FormulaParameter& parameter : parameters)
    if (const std::string why = objection(parameter.name, static_cast<int>(forces.size())); !why.empty())
      throw std::invalid_argument("parameter \"" + parameter.name + "\": " + why);
  return scene::Settings::of(
      FormulaOptions{std::make_shared<const OwnFormula>(std::move(forces), std::move(parameters))});
}

}  // namespace arcslip::elements
