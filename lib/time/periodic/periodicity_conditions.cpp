#include <arcslip/time/periodic/periodicity_conditions.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>

namespace arcslip::time {

Vector stacked(const MotionState& state) {
  Vector X(state.x.size() + state.v.size() + state.z.size());
  X << state.x, state.v, state.z;
  return X;
}

MotionState unstacked(continuation::In X, Eigen::Index dofs) {
  return {X.head(dofs), X.segment(dofs, dofs), X.tail(X.size() - 2 * dofs)};
}

void defect_of(const PeriodMap& map, continuation::In X, Vector& F) {
  const Eigen::Index n = map.end.x.size();
  F.resize(X.size());
  F << map.end.x, map.end.v, map.end.z;
  for (const RestingSlider& slider : map.resting) F[2 * n + slider.slider] = slider.offset;
  F -= X;
}

void defect_by_start(const PeriodMap& map, Matrix& J) {
  const Eigen::Index n = map.end.x.size();
  J = map.monodromy;
  for (const RestingSlider& slider : map.resting) J.row(2 * n + slider.slider) = slider.derivative;
  J.diagonal().array() -= 1;
}

std::vector<std::complex<double>> multipliers_of(const PeriodMap& map) {
  const Eigen::Index n = map.end.x.size();
  const Matrix& M = map.monodromy;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    if (std::none_of(map.resting.begin(), map.resting.end(),
                     [&](const RestingSlider& slider) { return 2 * n + slider.slider == i; }))
      kept.push_back(i);
  const Eigen::VectorXcd values = continuation::eigenvalues(M(kept, kept));
  std::vector<std::complex<double>> multipliers(values.begin(), values.end());
  std::sort(multipliers.begin(), multipliers.end(),
            [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return multipliers;
}

}  // namespace arcslip::time
