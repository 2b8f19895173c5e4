#include <arcslip/scene/keys/natural_frequency.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::scene::file {
namespace {

// The sum of weight^2 value of the parts that act on a degree of freedom alone.
double sum_on(int dof, const std::vector<Part>& parts) {
  double sum = 0;
  for (const Part& part : parts)
    for (const Direction& direction : part.directions)
      if (direction.size() == 1 && direction[0].dof == dof)
        sum += direction[0].weight * direction[0].weight * part.values.front();
  return sum;
}

// A part that acts on a degree of freedom and on others, too; null: none.
const Part* shared_on(int dof, const std::vector<Part>& parts) {
  const auto is_there = [dof](const Term& term) { return term.dof == dof; };
  for (const Part& part : parts)
    for (const Direction& direction : part.directions)
      if (direction.size() > 1 && std::any_of(direction.begin(), direction.end(), is_there)) return &part;
  return nullptr;
}

// What is missing on the degree of freedom for a "frequency", or "" if nothing is.
std::string objection_to_mass(int dof, const Structure& structure) {
  const std::string name = shown(structure.dofs.names[static_cast<std::size_t>(dof)]);
  if (dof < structure.rows)
    return "found the degree of freedom " + name + " of a structure from matrices, must be a \"value\"";
  if (const Part* shared = shared_on(dof, structure.masses))
    return "found the mass " + shown(shared->name) + ", which acts on " + name +
           " and on others; must be a \"value\", or the masses on " + name + " must act there alone";
  if (!(sum_on(dof, structure.masses) > 0))
    return "found no mass on " + name + ", must be a \"value\", or there must be a mass above 0 kg";
  return {};
}

std::string objection_to_spring(int dof, const Structure& structure) {
  if (sum_on(dof, structure.springs) > 0) return {};
  const std::string name = shown(structure.dofs.names[static_cast<std::size_t>(dof)]);
  return "found no spring on " + name +
         " alone, must be a \"value\", or there must be one above 0 N/m, from " + name + " to \"ground\"";
}

// The section with values of the parts that have this key. value(number, dof, objection) sets an
// objection, or is what acts on the degree of freedom.
template <class Value>
Node replaced(const Location& section, const Field& key, const Structure& structure, Faults& faults,
              const Value& value) {
  Node copy = section.node != nullptr ? *section.node : Node();
  auto* parts = std::get_if<Node::List>(&copy.value);
  for (std::size_t i = 0; parts != nullptr && i < parts->size(); ++i) {
    auto* part = std::get_if<Node::Object>(&(*parts)[i].value);
    if (part == nullptr) continue;
    Faults reported_later;
    const Keys keys({&(*parts)[i], child(section.pointer, i)}, {}, reported_later);
    const Location place = keys.find(key.name);
    if (place.node == nullptr) continue;
    const auto number = read_number(place, key, faults);
    const auto on = read_direction(keys, structure.dofs, reported_later);
    std::string objection;
    double result = 0;
    if (keys.has("value"))
      objection = "found " + quoted(key.name) + " and \"value\" together, must be one of them";
    else if (on && on->size() > 1)
      objection = "found a part between degrees of freedom, must be a \"value\": " + quoted(key.name) +
                  " is that of the mass on one";
    else if (on && number && structure.sound)
      result = value(*number, on->front().dof, objection) / (on->front().weight * on->front().weight);
    if (objection.empty() && !std::isfinite(result))
      objection = "found " + number_text(*number) + ", with which the value is too large for a number";
    if (!objection.empty()) faults.add(place.pointer, objection);
    if (!keys.has("value")) part->push_back({"value", {std::isfinite(result) ? result : 0.0}});
  }
  return copy;
}

}  // namespace

Node with_stiffnesses(const Location& springs, const Structure& structure, FrequencyUnit unit,
                      Faults& faults) {
  const Field frequency{
      .name = frequency_key, .unit = unit_name(unit), .lower = 0, .upper = infinity, .lower_open = true};
  return replaced(springs, frequency, structure, faults, [&](double f, int dof, std::string& objection) {
    objection = objection_to_mass(dof, structure);
    const double w = to_rad_per_s(unit) * f;
    return w * (w * sum_on(dof, structure.masses));
  });
}

Node with_dampings(const Location& dampers, const Structure& structure, Faults& faults) {
  const Field ratio{.name = damping_ratio_key, .unit = "-", .lower = 0, .upper = infinity};
  return replaced(dampers, ratio, structure, faults, [&](double zeta, int dof, std::string& objection) {
    objection = objection_to_mass(dof, structure);
    if (objection.empty()) objection = objection_to_spring(dof, structure);
    return 2 * zeta * std::sqrt(sum_on(dof, structure.springs)) * std::sqrt(sum_on(dof, structure.masses));
  });
}

}  // namespace arcslip::scene::file
