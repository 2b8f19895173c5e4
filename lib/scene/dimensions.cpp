// The dimensions of formulas.
#include <arcslip/scene/formulas.hpp>
#include <arcslip/scene/unit.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace arcslip::scene {
namespace {

using formula::Operation;

constexpr double same_power = 1e-9;

// Powers of kg, m, s and turns; none: any, as that of a plain number. Other angles are pure numbers.
using Dimension = std::optional<std::array<double, 4>>;

Dimension dimension_of(std::string_view unit) {
  const auto known = unit.empty() ? std::nullopt : unit_of(unit);
  if (!known) return {};
  return std::array{static_cast<double>(known->mass), static_cast<double>(known->length),
                    static_cast<double>(known->time), static_cast<double>(known->turns)};
}

bool differ(const Dimension& a, const Dimension& b) {
  if (!a || !b) return false;
  for (std::size_t i = 0; i < a->size(); ++i)
    if (std::abs((*a)[i] - (*b)[i]) > same_power) return true;
  return false;
}

// Of a^p b^q.
Dimension product(const Dimension& a, double p, const Dimension& b, double q) {
  if (!a || !b) return {};
  std::array<double, 4> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = p * (*a)[i] + q * (*b)[i];
  return all;
}

std::string text_of(const Dimension& dimension) {
  std::array<int, 4> whole{};
  for (std::size_t i = 0; i < whole.size(); ++i) {
    whole[i] = static_cast<int>(std::lround((*dimension)[i]));
    if (std::abs(whole[i] - (*dimension)[i]) > same_power) return "another dimension";
  }
  if (whole == std::array{0, 0, -1, 1}) return "Hz";
  if (whole[3] != 0) return "another dimension";
  const std::string unit = coherent_text({whole[0], whole[1], whole[2]});
  return unit == "-" ? "a pure number" : unit;
}

/// The dimension of each node of a formula, up to the first that has none.
class Dimensions {
 public:
  Dimensions(const formula::Formula& formula, std::span<const std::string> units)
      : nodes_(formula.nodes()), units_(units) {
    for (const formula::Node& node : nodes_) {
      of_.push_back(of(node));
      if (!fault_.empty()) return;
    }
  }
  const std::string& fault() const { return fault_; }
  const Dimension& at(int node) const { return of_[static_cast<std::size_t>(node)]; }

 private:
  Dimension of(const formula::Node& node) {
    switch (node.operation) {
      case Operation::constant:
        return {};
      case Operation::input:
        return dimension_of(units_[static_cast<std::size_t>(node.input())]);
      case Operation::negate:
      case Operation::abs:
        return at(node.a);
      case Operation::multiply:
        return product(at(node.a), 1, at(node.b), 1);
      case Operation::divide:
        return product(at(node.a), 1, at(node.b), -1);
      case Operation::whole_power:
        return product(at(node.a), node.value, at(node.a), 0);
      case Operation::sqrt:
        return product(at(node.a), 0.5, at(node.a), 0);
      case Operation::power:
        return power(node);
      case Operation::add:
      case Operation::subtract:
      case Operation::min:
      case Operation::max:
      case Operation::hypot:
        return common(node.a, node.b, "which adds or compares ");
      default:
        return choice(node);
    }
  }

  // Of what decides, and of functions.
  Dimension choice(const formula::Node& node) {
    switch (node.operation) {
      case Operation::less:
      case Operation::less_or_equal:
      case Operation::equal:
      case Operation::not_equal:
        common(node.a, node.b, "which compares ");
        return Dimension(std::in_place);
      case Operation::choose:
        return common(node.b, node.c, "which chooses between ");
      case Operation::sign:
        return Dimension(std::in_place);
      default:
        return function(node);
    }
  }

  Dimension common(int a, int b, const std::string& what) {
    if (differ(at(a), at(b))) fault_ = what + text_of(at(a)) + " and " + text_of(at(b));
    return at(a) ? at(a) : at(b);
  }

  Dimension power(const formula::Node& node) {
    const formula::Node& exponent = nodes_[static_cast<std::size_t>(node.b)];
    pure(node.b, "which has an exponent in ");
    if (exponent.operation == Operation::constant) return product(at(node.a), exponent.value, at(node.a), 0);
    return differ(at(node.a), Dimension(std::in_place)) ? Dimension() : at(node.a);
  }

  // Of sin, exp and the like.
  Dimension function(const formula::Node& node) {
    pure(node.a, "which has a function of ");
    return Dimension(std::in_place);
  }

  void pure(int node, const std::string& what) {
    if (differ(at(node), Dimension(std::in_place))) fault_ = what + text_of(at(node));
  }

  std::span<const formula::Node> nodes_;
  std::span<const std::string> units_;
  std::vector<Dimension> of_;
  std::string fault_;
};

}  // namespace

std::string dimension_fault(const formula::Formula& formula, std::span<const std::string> units,
                            std::string_view wanted) {
  const Dimensions dimensions(formula, units);
  if (!dimensions.fault().empty()) return dimensions.fault();
  const Dimension& found = dimensions.at(formula.results().front());
  if (!differ(found, dimension_of(wanted))) return {};
  return "which is " + text_of(found) + ", must be " +
         (wanted == "-" ? "a pure number" : std::string(wanted));
}

}  // namespace arcslip::scene
