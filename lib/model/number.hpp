#pragma once
// The numbers of a model, by the parameters p.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/formula/formula.hpp>
#include <arcslip/scene/field.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace arcslip::model {

/// A formula whose inputs are all parameters, in their order.
struct NumberFormula {
  std::string name;  // of the number: "part.field"
  formula::Formula formula;
  scene::Field bounds;  // without a name

  double value(continuation::In p) const {
    return formula.value(std::span(p.data(), static_cast<std::size_t>(p.size())));
  }
  double rate(continuation::In p, int k) const {
    return formula.derivative(std::span(p.data(), static_cast<std::size_t>(p.size())), k);
  }
};

/// A parameter, or a formula of parameters; or none.
class Number {
 public:
  Number() = default;
  /// One of the parameters.
  Number(int parameter) : parameter_(parameter) {}
  explicit Number(std::shared_ptr<const NumberFormula> formula) : formula_(std::move(formula)) {}

  bool given() const { return parameter_ >= 0 || formula_ != nullptr; }
  /// Its index, where it is a parameter; else -1.
  int parameter() const { return parameter_; }
  const std::shared_ptr<const NumberFormula>& formula() const { return formula_; }

  double value(continuation::In p) const { return parameter_ >= 0 ? p[parameter_] : formula_->value(p); }
  double value_or(continuation::In p, double otherwise) const { return given() ? value(p) : otherwise; }
  bool depends_on(int k) const { return formula_ != nullptr ? formula_->formula.uses(k) : parameter_ == k; }
  /// Its derivative by p_k.
  double rate(continuation::In p, int k) const {
    if (formula_ == nullptr) return given() && parameter_ == k ? 1 : 0;
    return formula_->rate(p, k);
  }

 private:
  int parameter_ = -1;
  std::shared_ptr<const NumberFormula> formula_;
};

}  // namespace arcslip::model
