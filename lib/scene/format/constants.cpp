#include <arcslip/scene/format/constants.hpp>

#include <arcslip/scene/formulas.hpp>
#include <arcslip/scene/unit.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

namespace arcslip::scene::file {
namespace {

constexpr int longest_chain = 100;  // of numbers that follow each other
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view wanted_constant =
    "a number, or an object with the keys \"value\", \"unit\", \"bounds\", \"help\"";

// Which unit a constant has, by its name or by that of its value: "0.2 mm" is in m.
std::string read_unit(const Keys& keys, const Location& value, Faults& faults) {
  const Location place = keys.find("unit");
  if (place.node == nullptr) {
    const auto* text = value.node != nullptr ? value.node->get<std::string>() : nullptr;
    const auto quantity = text != nullptr ? split_quantity(*text) : std::nullopt;
    const auto unit = quantity ? unit_of(quantity->unit) : std::nullopt;
    return unit ? coherent_text(*unit) : "";
  }
  const auto text = read_string(place, "a string, a unit as \"N/m\"", faults);
  if (!text) return "";
  check_coherent_unit(*text, place.pointer, faults);
  return *text;
}

void read_bounds(const Location& place, const Field& field, Constant& constant, Faults& faults) {
  const Node::List* list = read_list(place, "a pair [lower, upper]", faults);
  if (list == nullptr) return;
  if (list->size() != 2) {
    faults.add(place.pointer,
               "found a list of " + std::to_string(list->size()) + ", must be a pair [lower, upper]");
    return;
  }
  const auto lower = read_number({&list->front(), child(place.pointer, std::size_t{0})}, field, faults);
  const auto upper = read_number({&list->back(), child(place.pointer, std::size_t{1})}, field, faults);
  if (!lower || !upper) return;
  if (*lower < *upper) {
    constant.lower = *lower;
    constant.upper = *upper;
  } else {
    faults.add(place.pointer, "found " + number_text(*upper) + ", must be above the lower bound, which is " +
                                  number_text(*lower));
  }
}

Constant read_constant(const std::string& name, const Location& place, Faults& faults) {
  Constant constant{.name = name, .lower = -infinity, .upper = infinity};
  Location value = place;
  Field field{.name = "value", .unit = "-", .lower = -infinity, .upper = infinity};
  if (place.node->get<Node::Object>() != nullptr) {
    const Keys keys(place, {"value", "unit", "bounds", "help"}, faults);
    value = keys.require("value", "a finite number", faults);
    constant.unit = read_unit(keys, value, faults);
    field.unit = constant.unit.empty() ? "-" : std::string_view(constant.unit);
    if (keys.has("bounds")) read_bounds(keys.find("bounds"), field, constant, faults);
    constant.help = read_string(keys.find("help"), "a string, what it is", faults).value_or("");
  } else {
    Faults none;
    constant.unit = read_unit(Keys({}, {}, none), value, faults);
    field.unit = constant.unit.empty() ? "-" : std::string_view(constant.unit);
  }
  field.lower = constant.lower;
  field.upper = constant.upper;
  if (const auto given = read_given_number(value, field, faults)) {
    constant.value = given->follows ? unknown : given->value;
    constant.text.text = given->text;
  } else {
    constant.value = unknown;
  }
  return constant;
}

// How a formula writes the name of a parameter.
std::string in_formula(const std::string& parameter) {
  std::string text;
  for (std::size_t from = 0; from <= parameter.size();) {
    const std::size_t dot = std::min(parameter.find('.', from), parameter.size());
    const std::string part = parameter.substr(from, dot - from);
    const auto plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    const bool is_plain =
        std::all_of(part.begin(), part.end(), plain) && !(part.front() >= '0' && part.front() <= '9');
    text += (from > 0 ? "." : "") + (is_plain ? part : '\'' + part + '\'');
    from = dot + 1;
  }
  return text;
}

/// One number of a scene while it is read, and where it stands.
struct Place {
  Constant* constant = nullptr;
  Part* part = nullptr;
  std::size_t field = 0;
  std::string pointer{};

  double& value() const { return constant != nullptr ? constant->value : part->values[field]; }
  NumberText& text() const {
    if (constant != nullptr) return constant->text;
    part->texts.resize(part->values.size());
    return part->texts[field];
  }
};

using Section = std::pair<std::string, std::vector<Part>*>;
std::vector<Section> sections(Scene& scene) {
  return {{"/structure/masses", &scene.masses},
          {"/structure/springs", &scene.springs},
          {"/structure/dampers", &scene.dampers},
          {"/structure/damping", &scene.damping},
          {"/structure/rotation", &scene.rotation},
          {"/elements", &scene.elements},
          {"/patches", &scene.patches},
          {"/excitation", &scene.excitation}};
}

// All numbers by their names.
std::unordered_map<std::string, Place> places(Scene& scene) {
  std::unordered_map<std::string, Place> all;
  for (Constant& constant : scene.constants)
    all.emplace(constant.name, Place{&constant, nullptr, 0, child("/constants", constant.name)});
  for (const auto& [pointer, parts] : sections(scene))
    for (std::size_t i = 0; i < parts->size(); ++i) {
      Part& part = (*parts)[i];
      if (part.type == nullptr || part.name.empty()) continue;
      const std::string own = parts == &scene.rotation ? pointer : child(pointer, i);
      const auto fields = part.fields();
      for (std::size_t k = 0; k < std::min(fields.size(), part.values.size()); ++k)
        all.emplace(
            part.name + '.' + std::string(fields[k].name),
            Place{nullptr, &part, k,
                  fields[k].place.empty() ? child(own, fields[k].name) : own + std::string(fields[k].place)});
    }
  return all;
}

class Resolver {
 public:
  Resolver(Scene& scene, const Names& names, Faults* faults)
      : scene_(scene), names_(names), faults_(faults), places_(places(scene)) {
    for (const auto& [name, place] : places_)
      if (std::isnan(place.value()) && !place.text().text.empty()) states_.emplace(name, State::waiting);
  }

  void resolve_all() {
    for (const std::string& name : parameter_names(scene_))  // in the order of the file
      if (states_.contains(name)) resolve(name);
  }

 private:
  enum class State { waiting, active, done, failed };

  void fault(const Place& place, const std::string& message) {
    if (faults_ != nullptr) faults_->add(place.pointer, message);
  }

  // How many formulas stand behind a number that is known, its own included.
  int chain_of(const std::string& name) {
    if (const auto known = chains_.find(name); known != chains_.end()) return known->second;
    int chain = 0;
    if (const NumberText* formula = parameter_formula(scene_, name))
      for (const std::string& parameter : formula->parameters)
        chain = std::max(chain, 1 + chain_of(parameter));
    chains_.emplace(name, chain);
    return chain;
  }

  bool add_chain_fault(const Place& place) {
    fault(place, "found " + shown(place.text().text) + ", which ends a chain of more than " +
                     std::to_string(longest_chain) +
                     " formulas that follow each other, must be a shorter one");
    return false;
  }

  bool resolve(const std::string& name) {
    State& state = states_.at(name);
    const Place& place = places_.at(name);
    if (state == State::active) {
      std::string circle;
      for (auto at = std::find(path_.begin(), path_.end(), name); at != path_.end(); ++at)
        circle += shown(*at) + " -> ";
      fault(place, "found " + shown(place.text().text) + ", which follows itself: " + circle + shown(name));
      return false;
    }
    if (state != State::waiting) return state == State::done;
    state = State::active;
    path_.push_back(name);
    const bool done = set(name, place);
    path_.pop_back();
    states_.at(name) = done ? State::done : State::failed;
    return done;
  }

  bool set(const std::string& name, const Place& place) {
    const std::string text = place.text().text;
    NumberText read;
    try {
      read = read_formula(scene_, text);
    } catch (const formula::FormulaError& error) {
      const bool may_exist = error.fault().kind == formula::FormulaFault::Kind::unknown_name &&
                             names_.may_exist(error.fault().name);
      if (!may_exist && faults_ != nullptr)
        add_formula_fault(error, place.pointer, parameter_names(scene_), *faults_);
      return false;
    }
    if (path_.size() > longest_chain) return add_chain_fault(place);
    int chain = 0;
    for (const std::string& parameter : read.parameters) {
      if (states_.contains(parameter) && !resolve(parameter)) return false;
      chain = std::max(chain, chain_of(parameter));
      if (std::isnan(scene::value(scene_, parameter))) return false;  // which has a fault of its own
    }
    if (const std::string why = objection_to(scene_, parameter_field(scene_, name), read); !why.empty()) {
      fault(place, why);
      return false;
    }
    if (chain >= longest_chain) return add_chain_fault(place);
    place.value() = scene::value(scene_, read);
    place.text() = std::move(read);
    return true;
  }

  Scene& scene_;
  const Names& names_;
  Faults* faults_;
  std::unordered_map<std::string, Place> places_;
  std::unordered_map<std::string, State> states_;
  std::unordered_map<std::string, int> chains_;
  std::vector<std::string> path_;
};

constexpr std::string_view members_wanted = "a list of at least one parameter \"part.field\"";

// The members of one tie. used: the fields already tied, and where.
std::vector<std::string> read_members(const Location& place, const Names& names,
                                      std::unordered_map<std::string, std::string>& used, Faults& faults) {
  std::vector<std::string> members;
  const Node::List* list = read_list(place, members_wanted, faults);
  if (list != nullptr && list->empty())
    faults.add(place.pointer, "found an empty list, must be " + std::string(members_wanted));
  std::string_view unit;
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const Location item{&(*list)[i], child(place.pointer, i)};
    const auto member = read_string(item, "a string, a parameter \"part.field\"", faults);
    const Field* field = member ? names.field(*member, item.pointer, faults) : nullptr;
    if (field == nullptr) continue;
    const auto [first, is_new] = used.emplace(*member, item.pointer);
    if (!is_new) {
      faults.add(item.pointer, "found " + shown(*member) + " again, which is also at " +
                                   faults.reported(first->second) + "; a field must be tied only once");
    } else if (!members.empty() && field->unit != unit) {
      faults.add(item.pointer, "found " + shown(*member) + " (" + std::string(field->unit) + ") tied to " +
                                   shown(members.front()) + " (" + std::string(unit) +
                                   "), must have the same unit");
    } else {
      unit = field->unit;
      members.push_back(*member);
    }
  }
  return members;
}

// Why fields may not follow one constant; empty: they may.
std::string objection_to_tie(const Scene& scene, const std::vector<std::string>& members) {
  const double common = value(scene, members.front());
  for (const std::string& member : members) {
    if (const NumberText* formula = parameter_formula(scene, member))
      return "found " + member + ", which is given by the formula " + shown(formula->text) +
             ", must not be tied as well";
    if (const double own = value(scene, member); own != common && !std::isnan(own) && !std::isnan(common))
      return "found " + member + " = " + number_text(own) + " and " + members.front() + " = " +
             number_text(common) + ", must have one common value";
  }
  return {};
}

// Whether a tie is that of a field in all sectors of a ring, as ring.hpp makes them: "part.field" of
// "part1.field", "part2.field" ...
bool is_of_ring(const Member& tie) {
  const std::size_t dot = tie.key.find('.');
  const auto* members = tie.value.get<Node::List>();
  if (dot == std::string::npos || members == nullptr || members->empty()) return false;
  for (std::size_t i = 0; i < members->size(); ++i) {
    const auto* member = (*members)[i].get<std::string>();
    if (member == nullptr || *member != tie.key.substr(0, dot) + std::to_string(i + 1) + tie.key.substr(dot))
      return false;
  }
  return true;
}

}  // namespace

std::vector<Constant> read_constants(const Location& place, Names& names, Faults& faults) {
  std::vector<Constant> constants;
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    if (item.node->get<Node::List>() != nullptr || item.node->get<bool>() != nullptr) {
      add_wrong_type(item, wanted_constant, faults);
      names.set_incomplete();
      continue;
    }
    if (names.add_constant(member->key, item.pointer, faults))
      constants.push_back(read_constant(member->key, item, faults));
  }
  return constants;
}

void tie_to_constant(Scene& scene, const std::string& name, const std::vector<std::string>& fields) {
  const Field field = parameter_field(scene, fields.front());
  Constant constant{.name = name, .lower = -infinity, .upper = infinity};
  constant.value = value(scene, fields.front());
  constant.unit = field.unit;
  constant.help = field.help;
  scene.constants.push_back(std::move(constant));
  const auto all = places(scene);
  for (const std::string& each : fields) all.at(each).text() = read_formula(scene, in_formula(name));
}

void read_ties(const Location& place, Names& names, Scene& scene, Faults& faults) {
  std::unordered_map<std::string, std::string> used;
  const std::size_t before = faults.count();
  std::vector<std::pair<std::string, std::vector<std::string>>> ties;
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    if (is_of_ring(*member))
      names.add_constant(member->key, item.pointer, faults);
    else
      names.add(member->key, item.pointer, faults);
    ties.emplace_back(member->key, read_members(item, names, used, faults));
  }
  if (faults.count() > before) names.set_incomplete();
  for (const auto& [name, fields] : ties) {
    const bool known = !fields.empty() && std::all_of(fields.begin(), fields.end(), [&](const auto& each) {
      return !parameter_of(scene, each).empty();
    });
    if (!known) continue;
    if (const std::string why = objection_to_tie(scene, fields); !why.empty())
      faults.add(child(place.pointer, name), why);
    else
      tie_to_constant(scene, name, fields);
  }
}

void resolve_formulas(Scene& scene, const Names& names, Faults* faults) {
  Resolver(scene, names, faults).resolve_all();
}

}  // namespace arcslip::scene::file
