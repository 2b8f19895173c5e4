#include <arcslip/analyses/modes_and_time/perturbed_transient.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace arcslip::observables {
namespace {

using time::Matrix;
using time::MotionState;
using time::Vector;

constexpr double returned_distance = 1e-6;  // of two motions, relative
constexpr double shooting_distance =
    0.1;                                // between the response and the motion that shooting finds, relative
constexpr int most_measured = 100;      // periods
constexpr double well_followed = 1e-3;  // by one multiplier

// (x, v/omega, z)
Vector stacked(const MotionState& state, double omega) {
  Vector y(state.x.size() + state.v.size() + state.z.size());
  y << state.x, state.v / omega, state.z;
  return y;
}

MotionState state_of(const Vector& y, Eigen::Index n, double omega) {
  return {y.head(n), y.segment(n, n) * omega, y.tail(y.size() - 2 * n)};
}

// Along the largest multiplier, of unit length, in (x, v/omega, z); sliders that rest are not moved.
Vector slowest_direction(const time::ShootingResult& shot, Eigen::Index n, double omega) {
  const Eigen::Index size = shot.map.monodromy.rows();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < size; ++i)
    if (std::none_of(shot.map.resting.begin(), shot.map.resting.end(),
                     [&](const time::RestingSlider& slider) { return 2 * n + slider.slider == i; }))
      kept.push_back(i);
  Vector scale = Vector::Ones(size);
  scale.segment(n, n).setConstant(omega);
  const Matrix M = scale.cwiseInverse().asDiagonal() * shot.map.monodromy * scale.asDiagonal();
  const continuation::Modes modes = continuation::modes(M(kept, kept));
  Vector all = Vector::Zero(size);
  if (modes.values.size() == 0) return all;
  Eigen::Index largest = 0;
  modes.values.cwiseAbs().maxCoeff(&largest);
  Vector along = modes.V.col(largest).real();
  if (const Vector other = modes.V.col(largest).imag(); other.norm() > along.norm()) along = other;
  along.normalize();
  for (std::size_t i = 0; i < kept.size(); ++i) all[kept[i]] = along[static_cast<Eigen::Index>(i)];
  return all;
}

}  // namespace

double growth_of(const Matrix& d) {
  const Eigen::Index count = d.cols();
  if (count < 2) return 0;
  if (count == 2) return d.col(1).norm() / d.col(0).norm();
  // Each equation relative to its size.
  Matrix before(d.rows() * (count - 2), 2);
  Vector after(before.rows());
  for (Eigen::Index k = 0; k + 2 < count; ++k) {
    const double size = d.middleCols(k, 3).norm();
    before.col(0).segment(k * d.rows(), d.rows()) = d.col(k + 1) / size;
    before.col(1).segment(k * d.rows(), d.rows()) = d.col(k) / size;
    after.segment(k * d.rows(), d.rows()) = d.col(k + 2) / size;
  }
  const Vector first = before.col(0);
  const double one = first.dot(after) / first.squaredNorm();
  if ((after - one * first).norm() <= well_followed * after.norm()) return std::abs(one);
  const Matrix ab = continuation::least_squares(before, after).X;
  const std::complex<double> root = std::sqrt(std::complex<double>(ab(0) * ab(0) / 4 + ab(1)));
  return std::max(std::abs(ab(0) / 2 + root), std::abs(ab(0) / 2 - root));
}

Departure departure(const Integrator& integrator, const MotionState& nearby, double omega, double disturbance,
                    const time::SettleOptions& options, const std::function<bool(long, double)>& progress) {
  Departure found;
  time::ShootingOptions shooting;
  shooting.transients = 0;
  shooting.tolerance = std::min(1e-9, std::max(1e-3 * disturbance, 1e-12));
  const time::ShootingResult shot = time::shoot(integrator.flow, nearby, omega, shooting);
  const Eigen::Index n = nearby.x.size();
  const Vector at = stacked(shot.start, omega);
  const double size = at.norm();
  if (!shot.converged() || (at - stacked(nearby, omega)).norm() > shooting_distance * size) {
    found.failure = shot.converged() ? "shooting from the response came to another motion, which is " +
                                           std::to_string((at - stacked(nearby, omega)).norm() / size) +
                                           " of its size away: take more harmonics"
                                     : shot.message;
    return found;
  }
  found.amplitude = integrator.periods(shot.start, 1, false).amplitude;
  found.start = state_of(at + disturbance * size * slowest_direction(shot, n, omega), n, omega);

  MotionState state = found.start;
  std::vector<Vector> course;
  time::SettleOptions rest = options;
  for (int k = 0; disturbance > 0 && k < most_measured && rest.periods > 0; ++k) {
    const Vector d = stacked(state, omega) - at;
    const double relative = d.norm() / size;
    if (relative < 1e-3 * disturbance || relative > 10 * disturbance) break;
    course.push_back(d);
    time::PeriodMotion period = integrator.periods(state, 1, false);
    if (!period.done()) break;  // which is determined by the rest
    state = std::move(period.end);
    --rest.periods;
    if (progress && !progress(k + 1, relative)) break;
  }
  Matrix d(at.size(), static_cast<Eigen::Index>(course.size()));
  for (std::size_t k = 0; k < course.size(); ++k) d.col(static_cast<Eigen::Index>(k)) = course[k];
  found.growth = growth_of(d);

  const long measured = options.periods - rest.periods;
  found.end = time::settle(
      integrator.periods, integrator.flow, state, omega, rest,
      [&](long periods, double change) { return !progress || progress(measured + periods, change); });
  found.end.periods += measured;
  found.distance = (stacked(found.end.state, omega) - at).norm() / size;
  found.returned = found.end.reason == time::SettleEnd::settled && found.end.period == 1 &&
                   found.distance <= returned_distance;
  return found;
}

}  // namespace arcslip::observables
