#pragma once
// What every law promises of its corners: the equations of a guard have the derivatives of their differences,
// and its angles are found again from next to.

#include "lib/laws/every_law.hpp"

#include <arcslip/laws/grazing_condition.hpp>

namespace every_corner {

using namespace arcslip;
using Eigen::MatrixXd, Eigen::VectorXd;

inline elements::Corners::Equations equations(elements::Corners& corners, const elements::Corner& corner,
                                              const VectorXd& u, const std::vector<double>& fields) {
  elements::Corners::Equations at(u.size(), static_cast<int>(corner.angles.size()),
                                  static_cast<int>(fields.size()));
  corners.equations(corner, u, fields, at);
  return at;
}

/// By the motion, the fields and the angles, against differences.
inline void check_equations(elements::Corners& corners, const elements::Corner& corner, const VectorXd& u,
                            const std::vector<double>& fields, double tolerance) {
  const auto values = [&](const std::vector<double>& angles, const VectorXd& motion,
                          const std::vector<double>& f) {
    return VectorXd(equations(corners, {corner.guard, angles}, motion, f).values);
  };
  const auto list = [](const VectorXd& v) { return std::vector<double>(v.begin(), v.end()); };
  const auto vector = [](const std::vector<double>& v) {
    return VectorXd(VectorXd::Map(v.data(), static_cast<Eigen::Index>(v.size())));
  };
  const auto at = equations(corners, corner, u, fields);
  const auto check = [&](const std::function<VectorXd(const VectorXd&)>& f, const VectorXd& x,
                         const MatrixXd& derivative) {
    CHECK((every_law::differences(f, x, 1e-6) - derivative).cwiseAbs().maxCoeff() < tolerance);
  };
  check([&](const VectorXd& v) { return values(corner.angles, v, fields); }, u, at.by_motion);
  check([&](const VectorXd& f) { return values(corner.angles, u, list(f)); }, vector(fields), at.by_field);
  check([&](const VectorXd& t) { return values(list(t), u, fields); }, vector(corner.angles), at.by_angle);
}

/// The angles of a corner from angles next to them.
inline void check_polish(elements::Corners& corners, const elements::Corner& corner, const VectorXd& u,
                         const std::vector<double>& fields) {
  elements::Corner near = corner;
  for (double& angle : near.angles) angle += 1e-3;
  REQUIRE(corners.polish(near, u, fields));
  for (std::size_t i = 0; i < near.angles.size(); ++i)
    CHECK(std::abs(near.angles[i] - corner.angles[i]) < 1e-8);
}

}  // namespace every_corner
