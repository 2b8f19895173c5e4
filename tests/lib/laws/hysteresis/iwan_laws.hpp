#pragma once
// Laws "iwan" with their options, as a scene has them.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/laws/law_type.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace iwan_laws {

using namespace arcslip;

/// element: its keys behind its place.
inline scene::Scene oscillator(const std::string& element, double force = 0.4, int order = 7,
                               double damping = 0.05, const std::string& more_forces = "") {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": )"
       << damping << R"(}]}, "elements": [{"name": "joint", "at": "x", )" << element
       << R"(}], "excitation": [{"name": "f", "at": "x", "cosine": )" << force << "}" << more_forces
       << R"(], "harmonics": {"order": )" << order
       << R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 0.4, "to": 2.5}]})";
  return scenes::parse(text.str());
}

inline const std::string uniform = R"("type": "iwan", "stiffness": 2, "slip_force": 3)";
inline const std::string four_parameter =
    R"("type": "iwan", "distribution": "four-parameter", "stiffness": 2, "slip_force": 3, "exponent": -0.1, "beta": 0.1)";

inline std::string table(const std::vector<std::pair<double, double>>& sliders) {
  std::ostringstream text;
  text.precision(17);
  text << R"("type": "iwan", "distribution": "table", "table": [)";
  for (std::size_t i = 0; i < sliders.size(); ++i)
    text << (i > 0 ? ", [" : "[") << sliders[i].first << ", " << sliders[i].second << "]";
  return text.str() + "]";
}

inline std::shared_ptr<const elements::Law> law(const std::string& element) {
  return elements::law_of(oscillator(element).elements.front());
}

struct At {
  Eigen::VectorXd force;
  Eigen::MatrixXd jacobian;
  std::vector<Eigen::VectorXd> by_field;
  double stick_share;
};

inline At at(elements::Element& element, const Eigen::VectorXd& u, const std::vector<double>& fields) {
  element.move_to(u, fields, true);
  At result{element.force(), element.jacobian(), {}, 0};
  for (std::size_t k = 0; k < fields.size(); ++k) {
    Eigen::VectorXd dF(u.size());
    element.field_derivative(static_cast<int>(k), dF);
    result.by_field.push_back(dF);
  }
  elements::FrictionState state;
  REQUIRE(element.friction(state));
  result.stick_share = state.stick_share;
  return result;
}

}  // namespace iwan_laws
