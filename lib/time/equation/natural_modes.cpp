#include <arcslip/time/equation/natural_modes.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/run_control.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace arcslip::time {
namespace {

constexpr double massless_share = 1e-13;  // of the largest mass over stiffness
constexpr double damped = 1e-12;          // of a motion without mass, relative to the largest damper

std::string name_of(const EquationOfMotion& equation, Eigen::Index dof) {
  const auto i = static_cast<std::size_t>(dof);
  return i < equation.dof_names.size() ? "\"" + equation.dof_names[i] + "\""
                                       : "number " + std::to_string(i + 1);
}

}  // namespace

std::shared_ptr<const NaturalModes> natural_modes(const EquationOfMotion& equation,
                                                  const control::Control& control) {
  const Matrix &M = equation.M, K = 0.5 * (equation.K + equation.K.transpose());
  const auto fail = [&](const Vector& motion, const std::string& reason) {
    Eigen::Index dof = 0;
    motion.cwiseAbs().maxCoeff(&dof);
    throw SingularMass("degree of freedom " + name_of(equation, dof) + " has no mass of its own" + reason);
  };
  const double shift =
      K.cwiseAbs().maxCoeff() / std::max(M.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const auto modes_of = std::make_shared<NaturalModes>();
  NaturalModes& found = *modes_of;
  const auto by_mass = continuation::symmetric_modes(M, K + shift * M);
  if (!control.keep_going()) return nullptr;
  Eigen::Index none = 0;
  if (by_mass.values.size() == M.rows())
    while (none < M.rows() && by_mass.values[none] * shift <= massless_share) ++none;
  if (by_mass.values.size() == M.rows() && none > 0) {
    found.without_mass = by_mass.V.leftCols(none);
    const auto acts = [](const Matrix& A, const auto& motion) {
      const double largest =
          std::max((A * motion).cwiseAbs().maxCoeff(), (A.transpose() * motion).cwiseAbs().maxCoeff());
      return largest > damped * A.cwiseAbs().maxCoeff() * motion.norm();
    };
    const Matrix circulatory = equation.circulatory();
    for (const auto& motion : found.without_mass.colwise()) {
      if (acts(equation.C, motion)) fail(motion, ", and a damper acts on it");
      if (circulatory.size() > 0 && acts(circulatory, motion))
        fail(motion, ", and an unsymmetric stiffness acts on it");
    }
    const Matrix rest = by_mass.V.rightCols(M.rows() - none);
    auto modes = continuation::symmetric_modes(rest.transpose() * K * rest, rest.transpose() * M * rest);
    found.squares = std::move(modes.values);
    found.V = rest * modes.V;
    return modes_of;
  }
  auto modes = continuation::symmetric_modes(K, M);
  if (modes.values.size() != M.rows() || !modes.V.allFinite()) {
    Eigen::Index least = 0;
    M.diagonal().minCoeff(&least);
    fail(Vector::Unit(M.rows(), least), ", and no spring of the structure holds it");
  }
  found.squares = std::move(modes.values);
  found.V = std::move(modes.V);
  return modes_of;
}

}  // namespace arcslip::time
