#include <arcslip/laws/memoryless/polynomial_coupling.hpp>

#include <arcslip/laws/memoryless/formula_law.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace arcslip::elements {
namespace {

using scene::file::Keys;
using scene::file::Location;
using scene::file::Reading;

constexpr std::string_view coupling_name = "polynomial_coupling",
                           coupling_help = "springs that couple displacements by a polynomial energy";
constexpr int least_degree = 2, largest_degree = 10;
constexpr std::size_t most_terms = 1000, most_names = 20;
constexpr std::string_view allowed_potential = "a list of at least one term with \"powers\" and \"value\"";
constexpr std::string_view potential_help =
    "[{\"powers\": {\"a\": 2, \"b\": 2}, \"value\": v1}]: a term v1 a^2 b^2 of the energy, whose gradient is "
    "the "
    "force; a, b: degrees of freedom, or places in the element";
constexpr std::string_view energy_units[] = {"J/m^2", "J/m^3", "J/m^4", "J/m^5", "J/m^6",
                                             "J/m^7", "J/m^8", "J/m^9", "J/m^10"};

/// The powers of the names in each term, in their order.
struct Terms {
  std::vector<std::string> names;
  std::vector<std::vector<int>> powers;
  friend bool operator==(const Terms&, const Terms&) = default;
};

/// Traits and bounds of stiffnesses follow from the terms and their values.
class CouplingLaw final : public FormulaLaw {
 public:
  CouplingLaw(const Terms& terms, const std::vector<std::string>& forces,
              std::span<const scene::Field> fields, const std::vector<std::string>& names)
      : FormulaLaw(coupling_name, coupling_help, forces, fields, Work::stored, names), terms_(terms) {}

  Traits traits(Fields fields, int direction) const override {
    Traits traits;
    traits.stiffness = stiffness(fields, direction, 0);
    for (std::size_t t = 0; t < terms_.powers.size(); ++t) {
      const int own = terms_.powers[t][static_cast<std::size_t>(direction)], degree = degree_of(t);
      if (fields[t] == 0 || own == 0) continue;
      traits.holds_mean = traits.holds_mean || own % 2 == 0;
      traits.far_power = std::max(traits.far_power, degree - 1.0);
      if (degree == 2) continue;
      traits.stiffness = infinity;
      traits.several_responses = true;
    }
    return traits;
  }
  // The sum of a row of the Hessian, which bounds its eigenvalues.
  double stiffness(Fields fields, int direction, double reach) const override {
    double sum = 0;
    for (std::size_t t = 0; t < terms_.powers.size(); ++t)
      if (const int own = terms_.powers[t][static_cast<std::size_t>(direction)]; fields[t] != 0 && own > 0)
        sum += std::abs(fields[t]) * own * (degree_of(t) - 1) * std::pow(reach, degree_of(t) - 2);
    return sum;
  }

 private:
  int degree_of(std::size_t t) const {
    return std::accumulate(terms_.powers[t].begin(), terms_.powers[t].end(), 0);
  }
  const Terms& terms_;
};

/// The law of one element, with what it refers to.
class PolynomialCoupling {
 public:
  explicit PolynomialCoupling(Terms terms) : terms_(std::move(terms)) {
    slots_.assign(terms_.names.begin(), terms_.names.end());
    for (std::size_t t = 0; t < terms_.powers.size(); ++t) {
      factors_.push_back("factor" + std::to_string(t + 1));
      names_.push_back("v" + std::to_string(t + 1));
      places_.push_back("/potential/" + std::to_string(t) + "/value");
    }
    for (std::size_t t = 0; t < terms_.powers.size(); ++t) {
      const int degree = std::accumulate(terms_.powers[t].begin(), terms_.powers[t].end(), 0);
      fields_.push_back({.name = names_[t],
                         .unit = energy_units[degree - least_degree],
                         .lower = -infinity,
                         .upper = infinity,
                         .help = "factor of this term of the energy",
                         .place = places_[t]});
    }
    std::vector<std::string> forces;
    for (std::size_t i = 0; i < slots_.size(); ++i) forces.push_back(force_along(i));
    law_.emplace(terms_, forces, fields_, factors_);
  }
  PolynomialCoupling(const PolynomialCoupling&) = delete;
  PolynomialCoupling& operator=(const PolynomialCoupling&) = delete;

  const Terms& terms() const { return terms_; }
  std::span<const std::string_view> slots() const { return slots_; }
  std::span<const scene::Field> fields() const { return fields_; }
  const CouplingLaw& law() const { return *law_; }

 private:
  // The derivative of the energy by one displacement.
  std::string force_along(std::size_t i) const {
    std::string sum;
    for (std::size_t t = 0; t < terms_.powers.size(); ++t) {
      const std::vector<int>& powers = terms_.powers[t];
      if (powers[i] == 0) continue;
      sum += (sum.empty() ? "" : " + ") + factors_[t] + "*" + std::to_string(powers[i]);
      for (std::size_t j = 0; j < powers.size(); ++j)
        if (const int n = i == j ? powers[j] - 1 : powers[j]; n > 0)
          sum += "*q" + (powers.size() > 1 ? std::to_string(j + 1) : "") + "^" + std::to_string(n);
    }
    return sum;
  }

  Terms terms_;
  std::vector<std::string> factors_, names_, places_;
  std::vector<std::string_view> slots_;
  std::vector<scene::Field> fields_;
  std::optional<CouplingLaw> law_;
};

struct PolynomialCouplingOptions {
  std::shared_ptr<const PolynomialCoupling> coupling = std::make_shared<const PolynomialCoupling>(Terms());
  friend bool operator==(const PolynomialCouplingOptions& a, const PolynomialCouplingOptions& b) {
    return a.coupling->terms() == b.coupling->terms();
  }
};

// One term: its powers by name.
std::map<std::string, int> read_term(const Location& place, const Reading& reading) {
  constexpr std::string_view wanted = "an object with a power for each of some names";
  const Keys keys(place, {"powers", "value"}, reading.faults);
  std::map<std::string, int> powers;
  if (!keys.is_object()) return powers;
  keys.require("value", "a finite number", reading.faults);
  const Location at = keys.require("powers", std::string(wanted), reading.faults);
  int degree = 0;
  const std::size_t before = reading.faults.count();
  for (const auto* member : scene::file::members(at, reading.faults)) {
    const Location item{&member->value, scene::file::child(at.pointer, member->key)};
    const auto own = scene::file::read_integer(item, 1, largest_degree, reading.faults);
    const std::string& name = member->key;
    if (name == "name" || name == "type" || name == "potential")
      reading.faults.add(item.pointer, "found " + scene::file::shown(name) +
                                           ", which is a key of the element, must be another name");
    else if (!reading.keys.has(name) && reading.dofs.complete && !reading.dofs.index.contains(name))
      reading.faults.add(item.pointer, "found " + scene::file::shown(name) +
                                           ", must be one of the degrees of freedom " +
                                           scene::file::listed(reading.dofs.names) +
                                           ", or a place of that name in the element" +
                                           scene::file::hint(name, reading.dofs.names));
    powers.emplace(name, own.value_or(0));
    degree += own.value_or(0);
  }
  if (at.node != nullptr && reading.faults.count() == before &&
      (degree < least_degree || degree > largest_degree))
    reading.faults.add(
        at.pointer, "found powers of the sum " + std::to_string(degree) + ", must have a sum from 2 to 10");
  return powers;
}

void read_potential(const Reading& reading, PolynomialCouplingOptions& options) {
  const Location place = reading.keys.require("potential", std::string(allowed_potential), reading.faults);
  if (place.node == nullptr) return;
  const std::size_t before = reading.faults.count();
  const auto* list = scene::file::read_list(place, allowed_potential, reading.faults);
  if (list == nullptr) return;
  if (list->empty() || list->size() > most_terms)
    reading.faults.add(place.pointer, "found a list of " + std::to_string(list->size()) + " terms, must be " +
                                          std::string(allowed_potential) + " and at most " +
                                          std::to_string(most_terms));
  std::vector<std::map<std::string, int>> terms;
  Terms all;
  for (std::size_t t = 0; t < list->size(); ++t) {
    terms.push_back(read_term({&(*list)[t], scene::file::child(place.pointer, t)}, reading));
    for (const auto& [name, own] : terms.back())
      if (std::find(all.names.begin(), all.names.end(), name) == all.names.end()) all.names.push_back(name);
  }
  if (all.names.size() > most_names)
    reading.faults.add(place.pointer, "found " + std::to_string(all.names.size()) +
                                          " names in the powers, must be at most " +
                                          std::to_string(most_names));
  if (reading.faults.count() > before) return;
  for (auto& term : terms) {
    all.powers.emplace_back();
    for (const std::string& name : all.names) all.powers.back().push_back(term[name]);
  }
  options.coupling = std::make_shared<const PolynomialCoupling>(std::move(all));
}

// The powers: the writer puts the values next to them with the fields.
void write_potential(const PolynomialCouplingOptions& options, const scene::Scene&,
                     scene::file::Node::Object& to) {
  using scene::file::Node;
  const Terms& terms = options.coupling->terms();
  Node::List list;
  for (const auto& powers : terms.powers) {
    Node::Object of;
    for (std::size_t i = 0; i < powers.size(); ++i)
      if (powers[i] > 0) of.push_back({terms.names[i], scene::file::node(powers[i])});
    list.push_back({Node::Object{{"powers", {std::move(of)}}}});
  }
  to.push_back({"potential", {std::move(list)}});
}

scene::file::KeysOf<PolynomialCouplingOptions> potential_keys() {
  scene::Key key;
  key.name = "potential";
  key.allowed = allowed_potential;
  key.required = true;
  key.help = potential_help;
  key.schema =
      R"({"type": "array", "minItems": 1, "items": {"type": "object", "required": ["powers", "value"],
    "additionalProperties": false, "properties": {"value": {"type": "number"}, "powers": {"type": "object",
    "minProperties": 1, "additionalProperties": {"type": "integer", "minimum": 1, "maximum": 10}}}}})";
  scene::file::KeysOf<PolynomialCouplingOptions> keys;
  keys.add({{key}, read_potential, write_potential});
  return keys;
}

class PolynomialCouplingType final : public scene::file::KeyedPart<PolynomialCouplingOptions, LawType> {
 public:
  PolynomialCouplingType() : KeyedPart(potential_keys()) {}
  std::string_view name() const override { return coupling_name; }
  std::string_view help() const override { return coupling_help; }
  std::span<const scene::Field> fields(const scene::Settings& options) const override {
    return options.empty() ? std::span<const scene::Field>() : of(options)->fields();
  }
  bool names_directions() const override { return true; }
  std::span<const std::string_view> slots_with(const scene::Settings& options) const override {
    return options.empty() ? std::span<const std::string_view>() : of(options)->slots();
  }
  std::shared_ptr<const Law> law(const scene::Settings& options) const override {
    const auto coupling = of(options);
    return {coupling, &coupling->law()};
  }

 private:
  static std::shared_ptr<const PolynomialCoupling> of(const scene::Settings& options) {
    return options.empty() ? PolynomialCouplingOptions{}.coupling
                           : options.as<PolynomialCouplingOptions>().coupling;
  }
};

}  // namespace

const LawType& polynomial_coupling() {
  static const PolynomialCouplingType type;
  return type;
}

}  // namespace arcslip::elements
