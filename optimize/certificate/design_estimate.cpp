// How far the harmonics left out may move the optimum, to first order. With more harmonics the active peaks
// have the amplitudes A_i + dA_i (observables/truncation.hpp), and the conditions of the minimum
//
//   sum_i mu_i w_i d(A_i + dA_i)/dp = 0,   w_i (A_i + dA_i) = tau_g,   sum_i mu_i = 1 in each group g
//
// hold at p + dp with
//
//   sum_i mu_i w_i H_i dp + sum_i dmu_i w_i g_i = -sum_i mu_i w_i d(dA_i)/dp
//   w_i g_i . dp - dtau_g = -w_i dA_i,   sum_i dmu_i = 0
//
// where g_i and H_i are the derivatives of A_i, and parameters at a bound stay there.

#include <arcslip/optimize/certificate/certify.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/run_control.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {
namespace {

constexpr double without_weight = 1e-6;  // multiplier of a peak that is as high by chance

// An active peak, by its group; sizes in m.
struct Active {
  std::size_t group;
  double share;                // mu_i w_i
  double weight, change;       // w_i, dA_i
  Vector gradient, of_change;  // g_i, d(dA_i)/dp
  continuation::Matrix hessian;
};

// The active peaks with a weight, differentiated by the parameters in `free`. Empty: not known. flagged: set
// where the change of one may be too low.
std::vector<Active> differentiated(const LoadCases& cases, const Balance& balance,
                                   const std::vector<Eigen::Index>& free, const control::Control& control,
                                   bool& flagged) {
  const auto change = [](const observables::Solution& at) { return at.truncation_change; };
  constexpr observables::Observed read{.motion = false};
  std::vector<Active> all;
  for (const ActivePeak& each : balance.active) {
    if (each.multiplier < without_weight) continue;
    PeakAmplitude& peaks = cases.peaks(each.in_case);
    const Peak& peak = cases.state(each.in_case).peaks[each.peak];
    const auto point = peaks.observe(peak, read);
    flagged = flagged || point.truncation_flagged;
    Active& active = all.emplace_back(Active{.group = cases.group(each.in_case),
                                             .share = each.multiplier * cases.value() / peak.amplitude,
                                             .weight = cases.weight(each.in_case),
                                             .change = change(point),
                                             .gradient = peak.gradient(free),
                                             .of_change = Vector(static_cast<Eigen::Index>(free.size())),
                                             .hessian = peaks.hessian(each.peak)});
    if (active.hessian.size() == 0) return {};
    for (std::size_t k = 0; k < free.size(); ++k) {
      if (!control.keep_going()) return {};
      active.of_change[static_cast<Eigen::Index>(k)] =
          peaks.change(each.peak, static_cast<std::size_t>(free[k]), change, read);
    }
  }
  return all;
}

// J x = r for x = (dp of the free parameters; and for each group of several peaks their dmu, and dtau).
struct Equations {
  continuation::Matrix J;
  Vector r, scale;  // scale: of x, in amplitudes; of dp 1
};

Equations equations_of(const std::vector<Active>& all, const LoadCases& cases,
                       const std::vector<Eigen::Index>& free) {
  const auto n = static_cast<Eigen::Index>(free.size());
  const auto members = [&](std::size_t group) {
    return std::count_if(all.begin(), all.end(), [&](const Active& each) { return each.group == group; });
  };
  Eigen::Index size = n;
  for (std::size_t g = 0; g < cases.groups(); ++g) size += members(g) > 1 ? members(g) + 1 : 0;
  Equations made{continuation::Matrix::Zero(size, size), Vector::Zero(size), Vector::Ones(size)};
  auto& [J, r, scale] = made;
  Eigen::Index next = n;
  for (std::size_t g = 0; g < cases.groups(); ++g) {
    const bool several = members(g) > 1;
    const Eigen::Index tau = next + members(g);
    for (const Active& each : all) {
      if (each.group != g) continue;
      J.topLeftCorner(n, n) += each.share * each.hessian(free, free);
      r.head(n) -= each.share * each.of_change;
      if (!several) continue;
      J.col(next).head(n) = each.weight * each.gradient;
      J.row(next).head(n) = each.weight * each.gradient.transpose();
      J(next, tau) = J(tau, next) = -1;
      r[next++] = -each.weight * each.change;
    }
    if (several) scale[next++] = cases.value();
  }
  return made;
}

}  // namespace

DesignEstimate design_estimate(const LoadCases& cases, const Balance& balance,
                               const control::Control& control) {
  DesignEstimate result;
  const std::vector<double>& design = cases.state(0).design;
  const bool limited = std::any_of(balance.limits.begin(), balance.limits.end(),
                                   [](const ActiveLimit& limit) { return limit.multiplier > 0; });
  if (limited || !std::isfinite(cases.value())) return result;
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < design.size(); ++k)
    if (balance.at_bound[k] == 0) free.push_back(static_cast<Eigen::Index>(k));
  const auto n = static_cast<Eigen::Index>(free.size());
  const std::vector<Active> all = differentiated(cases, balance, free, control, result.flagged);
  if (all.empty()) return result;
  auto [J, r, scale] = equations_of(all, cases, free);
  if (r.size() == 0) {
    result.change.assign(design.size(), 0);
    return result;
  }
  // In parameters and amplitudes of the same size.
  for (Eigen::Index k = 0; k < n; ++k) {
    const double value = std::abs(design[static_cast<std::size_t>(free[k])]);
    scale[k] = value > 0 ? value : 1;
  }
  const Vector x = scale.cwiseProduct(
      continuation::solve(scale.asDiagonal() * J * scale.asDiagonal(), scale.cwiseProduct(r)));
  if (!x.allFinite()) return result;
  result.change.assign(design.size(), 0);
  for (Eigen::Index k = 0; k < n; ++k) result.change[static_cast<std::size_t>(free[k])] = std::abs(x[k]);
  return result;
}

}  // namespace arcslip::optimize
