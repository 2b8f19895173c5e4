#pragma once
// The model of a scene: which part acts where, with every number replaced by the index of its parameter.
// Immutable. The parameter vector p holds the values, so that other values need no other model; the model
// keeps the defaults.

#include <arcslip/continuation/problem.hpp>
#include <arcslip/elements/element.hpp>
#include <arcslip/scene/scene.hpp>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace arcslip::model {

/// A mass, damper or spring: value * d d^T on the degrees of freedom.
struct LinearPart {
  int parameter;
  Eigen::VectorXd direction;  // d, dofs
};

enum class Law { jenkins, cubic_spring };

/// A nonlinear element: its force law acts on d . x, along d.
struct NonlinearPart {
  std::string name;
  Law law;
  std::vector<int> parameters;  // of its fields
  Eigen::VectorXd direction;
};

/// (cosine cos n theta + sine sin n theta) d.
struct Force {
  int harmonic;
  int cosine, sine;  // parameters
  Eigen::VectorXd direction;
};

struct Model {
  int dofs = 0;
  std::vector<std::string> dof_names;
  std::vector<continuation::Parameter> parameters;  // [0] is "frequency", rad/s; ties stand for their members
  std::vector<LinearPart> masses, dampers, springs;
  std::vector<NonlinearPart> elements;
  std::vector<Force> forces;
  Eigen::VectorXd response;  // direction whose motion is observed
  elements::Harmonics
      harmonics;  // odd only, where no even harmonic is excited: all laws here are antisymmetric
  scene::Harmonics settings;
  int force_harmonic = 1;  // lowest order excited: the fundamental
};

/// Index of the excitation frequency in the parameters.
inline constexpr int frequency = 0;

/// From a checked scene.
Model build(const scene::Scene& scene);

/// Index of a parameter; a tied field leads to its tie. Throws scene::ParameterError.
int parameter_index(const Model& model, const std::string& name);

/// The law of one element for a set of harmonics.
std::unique_ptr<elements::Element> make_element(const Model& model, const NonlinearPart& part,
                                                const elements::Harmonics& harmonics);

/// sum of p * d d^T.
Eigen::MatrixXd assemble(const std::vector<LinearPart>& parts, const continuation::Vector& p, int dofs);

/// Where the mean position is an unknown: a degree of freedom whose mean no spring holds, neither linear nor
/// cubic, directly or through others. Friction forces do not depend on it, so that it would be arbitrary or
/// drift. Empty where there is none.
std::optional<int> drifting_dof(const Model& model, const continuation::Vector& p);

}  // namespace arcslip::model
