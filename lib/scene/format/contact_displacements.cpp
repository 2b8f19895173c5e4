#include <arcslip/scene/format/patch_rows.hpp>

#include <arcslip/scene/keys/csv_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace arcslip::scene::file {
namespace {

constexpr std::string_view wanted_sum = "degrees of freedom, as in a, a - b or 0.6*a + 0.8*b - c";

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

class Displacements {
 public:
  Displacements(const Dofs& dofs, const Report& report) : dofs_(dofs), report_(report) {}

  Direction sum(std::string_view text) {
    Direction direction;
    double sign = 1;
    bool is_term = true;
    for (const std::string_view word : split(text, ' ')) {
      if (word.empty()) continue;
      if (is_term ? !add(word, sign, direction) : word != "+" && word != "-") {
        if (!is_term) fault("found " + shown(text) + ", must be a sum of " + std::string(wanted_sum));
        return {};
      }
      if (!is_term) sign = word == "+" ? 1 : -1;
      is_term = !is_term;
    }
    std::erase_if(direction, [](const Term& term) { return term.weight == 0; });
    if (is_term || direction.empty())
      fault("found the place " + shown(text) + ", must be a sum of " + std::string(wanted_sum) +
            ", that is not zero");
    return direction;
  }

  std::vector<Direction> along_axes(const NodeCells& cells, std::span<const std::string> names) {
    const std::size_t before = faults_;
    const std::vector<WeightedNode> own = nodes(cells.nodes), against = nodes(cells.against);
    if (own.empty() && faults_ == before) fault("found no nodes, must have at least one");
    if (faults_ == before) check_sides(own, against);
    const auto normal = axis("normal", cells.normal), along = axis("tangent", cells.tangent);
    if (!normal && faults_ == before) fault("found no normal, must be three numbers");
    if (faults_ > before) return {};
    const auto tangent = tangent_to(*normal, along);
    if (!tangent) {
      fault("found the tangent " + shown(cells.tangent) + ", must not be along the normal");
      return {};
    }
    std::vector<Direction> all;
    for (const std::string& name : names) {
      const Axis of = name == "normal"         ? *normal
                      : name == "tangential_2" ? cross(*normal, *tangent)
                                               : *tangent;
      all.push_back(direction_along(of, own, against));
      if (faults_ > before) break;
    }
    return all;
  }

 private:
  void fault(const std::string& what) {
    ++faults_;
    report_(what);
  }

  // "0 0 1", of length 1.
  std::optional<Axis> axis(std::string_view column, std::string_view text) {
    if (text.empty()) return {};
    Axis found{};
    std::size_t count = 0;
    bool numbers = true;
    for (const std::string_view word : split(text, ' ')) {
      if (word.empty()) continue;
      const auto value = number_in(word);
      if (value && count < 3) found[count] = *value;
      numbers = numbers && value;
      ++count;
    }
    auto axis = numbers && count == 3 ? of_length_one(found) : std::nullopt;
    if (!axis)
      fault("found the " + std::string(column) + " " + shown(text) +
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
            number_in(word.substr(0, star)).value_or(std::numeric_limits<double>::quiet_NaN())};
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

  bool add(std::string_view word, double weight, Direction& direction) {
    std::string name(word);
    auto found = dofs_.index.find(name);
    if (const auto star = word.find('*'); found == dofs_.index.end() && star != std::string_view::npos)
      if (const auto factor = number_in(word.substr(0, star))) {
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

  const Dofs& dofs_;
  const Report& report_;
  std::size_t faults_ = 0;
};

}  // namespace

Direction displacement(std::string_view sum, const Dofs& dofs, const Report& report) {
  return Displacements(dofs, report).sum(sum);
}

std::vector<Direction> displacements(const NodeCells& cells, std::span<const std::string> names,
                                     const Dofs& dofs, const Report& report) {
  return Displacements(dofs, report).along_axes(cells, names);
}

}  // namespace arcslip::scene::file
