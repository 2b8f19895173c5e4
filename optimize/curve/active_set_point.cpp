#include <arcslip/optimize/curve/active_set.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/optimize/certificate/multipliers.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {
namespace {

using continuation::Matrix;
using continuation::Needs;

constexpr int most_corrections = 20;
constexpr double corrected = 1e-11;           // relative: the last correction of z
constexpr double largest_correction = 0.5;    // of y and tau
constexpr double same_frequency = 0.02;       // relative
constexpr double comparison_distance = 1e-2;  // of y: where an amplitude is compared with that at a minimum
constexpr double no_change = 1e-10;           // of A, relative
constexpr double no_weight = 1e-9;            // of a peak next to one that is flat and as high

// [E_z E_sigma; row^T]
Matrix bordered(const OptimalityEvaluator& at, const Vector& row) {
  const Eigen::Index n = row.size() - 1;
  Matrix A(n + 1, n + 1);
  Vector dE(n);
  at.parameter_derivative(0, dE);
  A << std::get<Matrix>(at.jacobian()), dE, row.transpose();
  return A;
}

std::vector<KnownPeak> known(const std::vector<Peak>& peaks) {
  std::vector<KnownPeak> all;
  for (const Peak& peak : peaks) all.push_back({peak.kind, peak.omega(), peak.amplitude});
  return all;
}

}  // namespace

void ActiveSetPoint::take(const OptimalityEvaluator& at) {
  design = at.design();
  peaks = known(at.active_peaks());
}

bool ActiveSetPoint::take_tangent(const OptimalityEvaluator& at, const Vector& row) {
  const Matrix along = continuation::kernel(bordered(at, row).topRows(row.size() - 1));
  if (along.cols() != 1) return false;
  tangent = along.col(0).normalized();
  if (row.dot(tangent) < 0) tangent = -tangent;
  orient(at);
  return true;
}

void ActiveSetPoint::orient(const OptimalityEvaluator& at) {
  continuation::LU<double> lu;
  lu.factorize(bordered(at, tangent));
  orientation = lu.determinant() > 0 ? 1 : -1;
}

void ActiveSetPoint::turn_back() {
  tangent = -tangent;
  orientation = -orientation;
}

bool ActiveSetPoint::move(OptimalityEvaluator& at) const {
  return at.move_to(z, Vector::Constant(1, sigma), Needs::jacobian) == continuation::Evaluated::ok;
}

bool ActiveSetPoint::correct(OptimalityEvaluator& at) {
  for (int k = 0; k < most_corrections; ++k) {
    if (!move(at)) return false;
    const Vector dz = continuation::solve_any(std::get<Matrix>(at.jacobian()), at.residual());
    if (!dz.allFinite() || dz.cwiseAbs().maxCoeff() > largest_correction) return false;
    z -= dz;
    if (dz.norm() <= corrected * (1 + z.norm())) return move(at);
  }
  return false;
}

std::vector<std::size_t> find_again(const PeakState& state, const std::vector<KnownPeak>& wanted,
                                    double tolerance) {
  std::vector<std::size_t> found;
  for (const KnownPeak& peak : wanted) {
    std::optional<std::size_t> nearest;
    const auto distance = [&](std::size_t i) { return std::abs(state.peaks[i].omega() / peak.omega - 1); };
    for (std::size_t i = 0; i < state.peaks.size(); ++i) {
      const Peak& other = state.peaks[i];
      const bool taken = std::find(found.begin(), found.end(), i) != found.end();
      if (other.kind == PeakKind::kink || other.rises_inwards() || taken || distance(i) > same_frequency ||
          std::abs(std::log(other.amplitude / peak.amplitude)) > tolerance)
        continue;
      if (!nearest || distance(i) < distance(*nearest)) nearest = i;
    }
    if (!nearest) return {};
    found.push_back(*nearest);
  }
  return found;
}

std::shared_ptr<const OptimalityData> OptimalitySetting::of(const ActiveSet& active) const {
  return std::make_shared<const OptimalityData>(OptimalityData{peaks, scaled, active, reference});
}

Vector OptimalitySetting::estimate(const ActiveSet& active, Vector& weights) const {
  const auto a = static_cast<Eigen::Index>(active.peaks.size());
  Matrix G = Matrix::Zero(static_cast<Eigen::Index>(size()), a);
  const PeakState& state = peaks.state();
  Vector z(active.unknowns());
  Eigen::Index next = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    if (active.held[k] != 0) continue;
    z[next++] = scaled[k].scaled(state.design[k]);
    for (Eigen::Index i = 0; i < a; ++i) {
      const Peak& peak = state.peaks[active.peaks[static_cast<std::size_t>(i)]];
      const auto row = static_cast<Eigen::Index>(k);
      G(row, i) = peak.gradient[row] * scaled[k].slope(state.design[k]) / peak.amplitude;
    }
  }
  weights = least_combination(G, std::vector<std::size_t>(active.peaks.size(), 0), {1.0});
  z.segment(next, a - 1) = weights.tail(a - 1);
  z[next + a - 1] = std::log(state.peaks[active.peaks[0]].amplitude / reference);
  return z;
}

OptimalitySetting::Moved OptimalitySetting::hold_flat(ActiveSet& active, std::vector<double>& design) const {
  Moved result;
  for (std::size_t k = 0; k < size(); ++k) {
    Vector weights;
    estimate(active, weights);
    const auto has_influence = [&](std::size_t i) {
      const auto at = std::find(active.peaks.begin(), active.peaks.end(), i) - active.peaks.begin();
      if (!(weights[at] > no_weight)) return false;
      const Peak& peak = peaks.state().peaks[i];
      return std::abs(peak.gradient[static_cast<Eigen::Index>(k)] * scaled[k].slope(design[k])) >
             no_influence * peak.amplitude;
    };
    if (active.held[k] != 0 || std::any_of(active.peaks.begin(), active.peaks.end(), has_influence)) continue;
    std::vector<Peak> now;
    for (const std::size_t i : active.peaks) now.push_back(peaks.state().peaks[i]);
    const double before = peaks.state().amplitude(), own = design[k];
    for (const int side : {1, -1}) {
      design[k] = scaled[k].bound(side);
      const PeakState& state = peaks.trace(design);
      if (state.unbounded || !(std::abs(state.amplitude() / before - 1) <= same_level)) continue;
      const auto found = find_again(state, known(now), same_level);
      if (found.empty()) continue;
      active.peaks = found;
      active.held[k] = side;
      result.moved.emplace_back(k, own);
      break;
    }
    if (active.held[k] != 0) continue;
    const auto higher_nearby = [&](double step) {  // at a minimum the slope may be zero, too
      design[k] = scaled[k].value(scaled[k].scaled(own) + step);
      return peaks.trace(design).amplitude() > (1 + no_change) * before;
    };
    if (!higher_nearby(-comparison_distance) || !higher_nearby(comparison_distance)) {
      result.flat = k;
      return result;
    }
    design[k] = own;
    active.peaks = find_again(peaks.trace(design), known(now), same_level);
  }
  return result;
}

}  // namespace arcslip::optimize
