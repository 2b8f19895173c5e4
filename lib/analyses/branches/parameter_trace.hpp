#pragma once
// A model with a continuation parameter `over`, its range, and suitable steps.

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/response.hpp>
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

  /// Options with the window. Steps are at most 1/150 of it and, in a range of one sign, 1/12 of the value,
  /// so that the low end of a range of several decades is resolved.
  continuation::Options options() const;

  /// 0 at `from`, 1 at `to`, logarithmic in a range of one sign.
  double share(double value) const;

  /// The inverse of it; exactly `from` and `to` at 0 and 1.
  double value(double share) const;

  /// The model with `over` at another value.
  std::shared_ptr<const model::Model> at(double value) const;
};

/// Throws scene::ParameterError if the scene has no parameter `over`, or the range exceeds its bounds.
/// control: Model::control.
OverParameter over_parameter(scene::Scene scene, const std::string& over, double from, double to,
                             control::Control control = {});

/// The status and stop of a branch over the parameter, once its events are there. doubt: of one that reaches
/// the end of the range.
void set_end(const OverParameter& way, const continuation::BranchStop& stop, const std::string& doubt,
             ResponseBranch& result);

}  // namespace arcslip::observables
