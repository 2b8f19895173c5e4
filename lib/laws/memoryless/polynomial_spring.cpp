#include <arcslip/laws/memoryless/polynomial_spring.hpp>

#include <arcslip/laws/memoryless/formula_law.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::elements {
namespace {

using scene::file::Reading;

constexpr int largest_power = 9;
constexpr std::string_view allowed_coefficients =
    "an object with a coefficient for each of some powers from 1 to 9";
constexpr std::string_view coefficients_help =
    "{\"2\": c2, \"3\": c3}: force = c2 displacement^2 + c3 displacement^3";

constexpr scene::Field coefficient(std::string_view name, std::string_view unit, std::string_view place) {
  return {.name = name,
          .unit = unit,
          .lower = -infinity,
          .upper = infinity,
          .help = "coefficient of this power of the displacement",
          .place = place};
}

constexpr scene::Field coefficient_fields[largest_power] = {
    coefficient("c1", "N/m", "/coefficients/1"),   coefficient("c2", "N/m^2", "/coefficients/2"),
    coefficient("c3", "N/m^3", "/coefficients/3"), coefficient("c4", "N/m^4", "/coefficients/4"),
    coefficient("c5", "N/m^5", "/coefficients/5"), coefficient("c6", "N/m^6", "/coefficients/6"),
    coefficient("c7", "N/m^7", "/coefficients/7"), coefficient("c8", "N/m^8", "/coefficients/8"),
    coefficient("c9", "N/m^9", "/coefficients/9")};

/// A formula with the fields that it refers to.
class PolynomialSpring {
 public:
  /// Ascending powers.
  explicit PolynomialSpring(std::vector<int> powers)
      : powers_(std::move(powers)), fields_(fields_of(powers_)) {
    std::string force;
    for (const int n : powers_)
      force += (force.empty() ? "c" : " + c") + std::to_string(n) + "*q^" + std::to_string(n);
    law_.emplace("polynomial_spring", "a spring whose force is a polynomial",
                 std::vector{force.empty() ? "0" : force}, fields_);
  }
  PolynomialSpring(const PolynomialSpring&) = delete;
  PolynomialSpring& operator=(const PolynomialSpring&) = delete;

  const std::vector<int>& powers() const { return powers_; }
  const FormulaLaw& law() const { return *law_; }

 private:
  static std::vector<scene::Field> fields_of(const std::vector<int>& powers) {
    std::vector<scene::Field> fields;
    for (const int n : powers) fields.push_back(coefficient_fields[n - 1]);
    return fields;
  }

  std::vector<int> powers_;
  std::vector<scene::Field> fields_;
  std::optional<FormulaLaw> law_;
};

struct PolynomialSpringOptions {
  std::shared_ptr<const PolynomialSpring> spring =
      std::make_shared<const PolynomialSpring>(std::vector<int>());
  friend bool operator==(const PolynomialSpringOptions& a, const PolynomialSpringOptions& b) {
    return a.spring->powers() == b.spring->powers();
  }
};

void read_coefficients(const Reading& reading, PolynomialSpringOptions& options) {
  const auto place = reading.keys.require("coefficients", std::string(allowed_coefficients), reading.faults);
  if (place.node == nullptr) return;
  if (place.node->get<scene::file::Node::Object>() == nullptr)
    return scene::file::add_wrong_type(place, allowed_coefficients, reading.faults);
  std::vector<int> powers;
  const auto all = scene::file::members(place, reading.faults);
  for (const auto* member : all) {
    const std::string& key = member->key;
    if (key.size() == 1 && key[0] >= '1' && key[0] <= '9')
      powers.push_back(key[0] - '0');
    else
      reading.faults.add(scene::file::child(place.pointer, key),
                         "found the power " + scene::file::shown(key) + ", must be an integer from 1 to 9");
  }
  if (all.empty())
    reading.faults.add(place.pointer, "found an empty object, must be " + std::string(allowed_coefficients));
  std::sort(powers.begin(), powers.end());
  options.spring = std::make_shared<const PolynomialSpring>(powers);
}

scene::file::KeysOf<PolynomialSpringOptions> coefficient_keys() {
  scene::Key key;
  key.name = "coefficients";
  key.allowed = allowed_coefficients;
  key.required = true;
  key.help = coefficients_help;
  key.schema = R"({"type": "object", "minProperties": 1, "additionalProperties": false,
    "patternProperties": {"^[1-9]$": {"type": "number"}}})";
  scene::file::KeysOf<PolynomialSpringOptions> keys;
  // The writer puts the coefficients there with the fields.
  keys.add({{key},
            read_coefficients,
            [](const PolynomialSpringOptions&, const scene::Scene&, scene::file::Node::Object&) {}});
  return keys;
}

class PolynomialSpringType final : public scene::file::KeyedPart<PolynomialSpringOptions, LawType> {
 public:
  PolynomialSpringType() : KeyedPart(coefficient_keys()) {}
  std::string_view name() const override { return "polynomial_spring"; }
  std::string_view help() const override { return "a spring whose force is a polynomial"; }
  std::span<const scene::Field> fields(const scene::Settings& options) const override {
    return options.empty() ? std::span<const scene::Field>()
                           : options.as<PolynomialSpringOptions>().spring->law().fields({});
  }
  std::shared_ptr<const Law> law(const scene::Settings& options) const override {
    const auto spring =
        options.empty() ? PolynomialSpringOptions{}.spring : options.as<PolynomialSpringOptions>().spring;
    return {spring, &spring->law()};
  }
};

}  // namespace

const LawType& polynomial_spring() {
  static const PolynomialSpringType type;
  return type;
}

scene::Settings polynomial_powers(std::vector<int> powers) {
  std::sort(powers.begin(), powers.end());
  for (const int n : powers)
    if (n < 1 || n > largest_power || std::count(powers.begin(), powers.end(), n) > 1)
      throw std::invalid_argument("power " + std::to_string(n) + ": must be from 1 to 9, and only once");
  return scene::Settings::of(
      PolynomialSpringOptions{std::make_shared<const PolynomialSpring>(std::move(powers))});
}

}  // namespace arcslip::elements
