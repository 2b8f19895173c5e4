#include <arcslip/laws/law.hpp>

#include <stdexcept>
#include <string>

namespace arcslip::elements {

SampledForce::SampledForce(Eigen::Index rows, Eigen::Index directions, Eigen::Index fields)
    : f(Eigen::MatrixXd::Zero(rows, directions)),
      f_q(Eigen::MatrixXd::Zero(rows, directions * directions)),
      f_v(f_q),
      f_field(Eigen::MatrixXd::Zero(rows, directions * fields)) {}

StepEnd::StepEnd(int directions, int memory)
    : f(Eigen::VectorXd::Zero(directions)),
      dz(Eigen::VectorXd::Zero(memory)),
      v(f),
      f_q(Eigen::MatrixXd::Zero(directions, directions)),
      f_z(Eigen::MatrixXd::Zero(directions, memory)),
      f_start(f_q),
      f_v(f_q),
      z_q(Eigen::MatrixXd::Zero(memory, directions)),
      z_z(Eigen::MatrixXd::Identity(memory, memory)),
      z_start(z_q) {}

Eigen::RowVectorXd Law::slider_bound(Fields, int k, int) const {
  return Eigen::RowVectorXd::Unit(directions(), slider_direction(k));
}

std::optional<std::vector<Automaton>> Law::automata(Fields) const {
  return {};
}

bool LawType::has_wear(const scene::Settings& options) const {
  return law(options)->dissipative();
}

Eigen::MatrixXd tangent_at_rest(const Law& law, Fields fields) {
  const int d = law.directions();
  if (law.memory() > 0) {
    Eigen::VectorXd largest(d);
    for (int i = 0; i < d; ++i) largest[i] = law.stiffness(fields, i, 0);
    return largest.asDiagonal();
  }
  StepEnd at(d, 0);
  Eigen::VectorXd memory(0);
  law.begin(fields, Eigen::VectorXd::Zero(d), memory, at);
  return 0.5 * (at.f_q + at.f_q.transpose());
}

std::shared_ptr<const Law> law_of(const scene::Part& part) {
  const auto* type = dynamic_cast<const LawType*>(part.type);
  if (type == nullptr) throw std::invalid_argument("the element \"" + part.name + "\" has no law of force");
  return type->law(part.options);
}

}  // namespace arcslip::elements
