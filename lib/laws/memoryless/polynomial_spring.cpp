#include <arcslip/laws/memoryless/polynomial_spring.hpp>

#include <arcslip/laws/sampled_law.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <algorithm>
#include <cmath>
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

class PolynomialSpring final : public SampledLaw {
 public:
  /// Ascending powers.
  explicit PolynomialSpring(std::vector<int> powers) : powers_(std::move(powers)) {
    for (const int n : powers_) fields_.push_back(coefficient_fields[n - 1]);
  }
  const std::vector<int>& powers() const { return powers_; }

  std::string_view name() const override { return polynomial_spring().name(); }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return fields_; }

  bool antisymmetric() const override {
    return std::all_of(powers_.begin(), powers_.end(), [](int n) { return n % 2 == 1; });
  }
  Traits traits(Fields fields, int) const override {
    Traits traits;
    for (std::size_t k = 0; k < powers_.size(); ++k) {
      if (fields[k] == 0) continue;
      traits.far_power = powers_[k];
      traits.stiffness = powers_[k] == 1 ? std::abs(fields[k]) : infinity;
      traits.holds_mean = traits.holds_mean || powers_[k] % 2 == 1;
      traits.several_responses = powers_[k] > 1;
    }
    if (powers_ == std::vector{1} && fields[0] > 0) traits.stiffness_field = 0;
    return traits;
  }
  double stiffness(Fields fields, int, double reach) const override {
    double sum = 0;
    for (std::size_t k = 0; k < powers_.size(); ++k)
      if (fields[k] != 0) sum += powers_[k] * std::abs(fields[k]) * std::pow(reach, powers_[k] - 1);
    return sum;
  }
  int samples(int order) const override { return ((powers_.empty() ? 0 : powers_.back()) + 1) * order + 2; }

  void sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const override {
    at.f.setZero();
    at.f_q.setZero();
    for (Eigen::Index s = 0; s < q.rows(); ++s) {
      double power = 1;  // q^(n-1)
      int n = 1;
      for (std::size_t k = 0; k < powers_.size(); ++k) {
        for (; n < powers_[k]; ++n) power *= q(s, 0);
        at.f_field(s, static_cast<Eigen::Index>(k)) = power * q(s, 0);
        at.f(s, 0) += fields[k] * power * q(s, 0);
        at.f_q(s, 0) += n * fields[k] * power;
      }
    }
  }
  double stored(Fields fields, In q, In) const override {
    double sum = 0;
    for (std::size_t k = 0; k < powers_.size(); ++k)
      sum += fields[k] * std::pow(q[0], powers_[k] + 1) / (powers_[k] + 1);
    return sum;
  }
  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    double linear = 0;
    for (std::size_t k = 0; k < powers_.size(); ++k) {
      if (powers_[k] == 1) linear = fields[k];
      if (powers_[k] > 1 && fields[k] != 0) return {};
    }
    Automaton spring(-1);
    spring.add("linear", linear, 0, 0);
    return std::vector{spring};
  }

 private:
  std::vector<int> powers_;
  std::vector<scene::Field> fields_;
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
                           : options.as<PolynomialSpringOptions>().spring->fields({});
  }
  std::shared_ptr<const Law> law(const scene::Settings& options) const override {
    return options.empty() ? PolynomialSpringOptions{}.spring : options.as<PolynomialSpringOptions>().spring;
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
