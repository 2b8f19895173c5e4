#pragma once
// f = c_1 q + c_2 q^2 + ... up to a degree that is an option of the element, and with it the number of
// fields.

#include <arcslip/laws/sampled_law.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace own_laws {

using namespace arcslip;
using elements::Fields, elements::In;

struct PolynomialOptions {
  int degree = 1;
  friend bool operator==(const PolynomialOptions&, const PolynomialOptions&) = default;
};

inline constexpr int largest_degree = 9;
inline constexpr std::string_view coefficient_names[largest_degree] = {"c1", "c2", "c3", "c4", "c5",
                                                                       "c6", "c7", "c8", "c9"};

class PolynomialLaw final : public elements::SampledLaw {
 public:
  explicit PolynomialLaw(int degree) : degree_(degree) {
    for (int k = 0; k < degree; ++k)
      fields_[k] = {.name = coefficient_names[k],
                    .unit = "N/m^n",
                    .lower = -std::numeric_limits<double>::infinity(),
                    .upper = std::numeric_limits<double>::infinity(),
                    .help = "coefficient"};
  }
  std::string_view name() const override { return "polynomial"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override {
    return {fields_, static_cast<std::size_t>(degree_)};
  }
  elements::Facts facts() const override { return {.antisymmetric = degree_ == 1}; }
  elements::Traits traits(Fields fields, int) const override {
    return {.stiffness = degree_ > 1 ? std::numeric_limits<double>::infinity() : fields[0],
            .holds_mean = true,
            .several_responses = degree_ > 1,
            .far_power = static_cast<double>(degree_)};
  }
  double stiffness(Fields fields, int, double reach) const override {
    double sum = 0;
    for (int k = 0; k < degree_; ++k)
      sum += (k + 1) * std::abs(fields[static_cast<std::size_t>(k)]) * std::pow(reach, k);
    return sum;
  }
  int samples(const elements::Harmonics& h) const override { return (degree_ + 1) * h.order + 2; }
  void sample(Fields fields, const Eigen::MatrixXd& q, elements::SampledForce& at) const override {
    at.f.setZero();
    at.f_q.setZero();
    for (int k = 0; k < degree_; ++k) {
      const double c = fields[static_cast<std::size_t>(k)];
      at.f_field.col(k) = q.col(0).array().pow(k + 1);
      at.f += c * at.f_field.col(k);
      at.f_q.array() += c * (k + 1) * q.array().pow(k);
    }
  }
  double stored(Fields fields, In q) const override {
    double sum = 0;
    for (int k = 0; k < degree_; ++k)
      sum += fields[static_cast<std::size_t>(k)] * std::pow(q[0], k + 2) / (k + 2);
    return sum;
  }

 private:
  int degree_;
  scene::Field fields_[largest_degree];
};

inline scene::file::KeysOf<PolynomialOptions> polynomial_options() {
  scene::file::KeysOf<PolynomialOptions> keys;
  keys.add(scene::file::whole("degree", &PolynomialOptions::degree, 1, largest_degree, "of the polynomial"));
  return keys;
}

class PolynomialType final : public scene::file::KeyedPart<PolynomialOptions, elements::LawType> {
 public:
  PolynomialType() : KeyedPart(polynomial_options()) {
    for (int k = 1; k <= largest_degree; ++k) laws_.push_back(std::make_shared<const PolynomialLaw>(k));
  }
  std::string_view name() const override { return "polynomial"; }
  std::string_view help() const override { return "a spring whose force is a polynomial"; }
  std::span<const scene::Field> fields(const scene::Settings& options) const override {
    return at(options)->fields({});
  }
  std::shared_ptr<const elements::Law> law(const scene::Settings& options) const override {
    return at(options);
  }

 private:
  static PolynomialOptions of(const scene::Settings& options) {
    return options.empty() ? PolynomialOptions{} : options.as<PolynomialOptions>();
  }
  const std::shared_ptr<const PolynomialLaw>& at(const scene::Settings& options) const {
    return laws_[static_cast<std::size_t>(of(options).degree - 1)];
  }

  std::vector<std::shared_ptr<const PolynomialLaw>> laws_;
};

}  // namespace own_laws
