#pragma once
// A model whose parameter `over` goes from one value to another, and the steps that suit its range.

#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/scene/scene.hpp>

#include <memory>
#include <string>

namespace arcslip::observables {

struct OverParameter {
  std::shared_ptr<const model::Model> model;  // with `over` at `from`, and in the scale of its range
  std::string name;
  int index = 0;  // of the parameter
  double from = 0, to = 0;

  double lower() const { return from < to ? from : to; }
  double upper() const { return from < to ? to : from; }
  int direction() const { return from < to ? 1 : -1; }
  bool has_one_sign() const { return lower() > 0 || upper() < 0; }

  /// The window. No step is longer than 1/150 of it, nor, in a range of one sign, than 1/12 of the value: so
  /// ranges of several decades keep their low end.
  continuation::Options options() const;

  /// 0 at `from`, 1 at `to`, by the logarithm in a range of one sign.
  double share(double value) const;

  /// The inverse of it; exactly `from` and `to` at 0 and 1.
  double value(double share) const;

  /// The model with `over` at another value.
  std::shared_ptr<const model::Model> at(double value) const;
};

/// Throws scene::ParameterError where the scene has no parameter `over`, or it may not take these values.
OverParameter over_parameter(scene::Scene scene, const std::string& over, double from, double to);

}  // namespace arcslip::observables
