#include <arcslip/optimize/certificate/multipliers.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/optimize/certificate/certificate.hpp>
#include <arcslip/optimize/evaluation/scaled_parameter.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr double on_bound = 1e-9;     // of the range of y
constexpr double no_descent = 1e-12;  // of |G|^2: a multiplier that would gain less stays 0
constexpr int steps_per_column = 20;  // far more than there are: guards against cycling by rounding

// Minimizes |G m| subject to the sums of the groups, over the free columns; the others stay 0. The only
// member of a group has its share; columns beyond the groups have no sum.
Eigen::VectorXd minimum_of(const Eigen::MatrixXd& G, const std::vector<std::size_t>& group,
                           const std::vector<double>& shares, const std::vector<bool>& is_free) {
  std::vector<std::size_t> members(shares.size() + 1, 0);
  for (std::size_t i = 0; i < group.size(); ++i)
    if (is_free[i]) ++members[group[i]];
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(G.cols());
  std::vector<Eigen::Index> columns, row(shares.size(), -1);  // rows of the sums
  Eigen::Index rows = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const std::size_t g = group[i];
    if (!is_free[i]) continue;
    if (g < shares.size() && members[g] == 1) {
      weights[column] = shares[g];
      continue;
    }
    columns.push_back(column);
    if (g < shares.size() && row[g] < 0) row[g] = rows++;
  }
  if (columns.empty()) return weights;
  const auto k = static_cast<Eigen::Index>(columns.size());
  const Eigen::MatrixXd free = G(Eigen::all, columns);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(k + rows, k + rows);
  Eigen::VectorXd b(k + rows);
  A.topLeftCorner(k, k) = free.transpose() * free;
  b.head(k) = -free.transpose() * (G * weights);
  for (Eigen::Index i = 0; i < k; ++i) {
    const std::size_t g = group[static_cast<std::size_t>(columns[static_cast<std::size_t>(i)])];
    if (g == shares.size()) continue;
    A(i, k + row[g]) = A(k + row[g], i) = 1;
    b[k + row[g]] = shares[g];
  }
  const Eigen::VectorXd x = continuation::solve_any(A, b);
  for (Eigen::Index i = 0; i < k; ++i) weights[columns[static_cast<std::size_t>(i)]] = x[i];
  return weights;
}

}  // namespace

Eigen::VectorXd least_combination(const Eigen::MatrixXd& G, const std::vector<std::size_t>& group,
                                  const std::vector<double>& shares) {
  const auto n = static_cast<std::size_t>(G.cols());
  std::vector<std::size_t> members(shares.size() + 1, 0);
  for (const std::size_t g : group) ++members[g];
  std::vector<bool> is_free(n);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(G.cols());
  for (std::size_t i = 0; i < n; ++i) {
    is_free[i] = group[i] < shares.size();
    if (is_free[i])
      weights[static_cast<Eigen::Index>(i)] = shares[group[i]] / static_cast<double>(members[group[i]]);
  }
  for (std::size_t step = 0; step < steps_per_column * n; ++step) {
    const Eigen::VectorXd next = minimum_of(G, group, shares, is_free);
    double way = 1;
    Eigen::Index first = -1;  // that becomes 0 on the way
    for (Eigen::Index i = 0; i < next.size(); ++i)
      if (next[i] < 0 && weights[i] / (weights[i] - next[i]) < way) {
        way = weights[i] / (weights[i] - next[i]);
        first = i;
      }
    weights += way * (next - weights);
    if (first >= 0) {
      weights[first] = 0;
      is_free[static_cast<std::size_t>(first)] = false;
      continue;
    }
    // d|G m|^2/2 of a column against that of the free ones of its group, which are equal.
    const Eigen::VectorXd slope = G.transpose() * (G * weights);
    std::vector<double> level(shares.size() + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
      if (is_free[i] && group[i] < shares.size()) level[group[i]] = slope[static_cast<Eigen::Index>(i)];
    std::size_t best = n;
    double most = -no_descent * G.squaredNorm();
    for (std::size_t i = 0; i < n; ++i) {
      const double descent = slope[static_cast<Eigen::Index>(i)] - level[group[i]];
      if (is_free[i] || descent >= most) continue;
      most = descent;
      best = i;
    }
    if (best == n) break;
    is_free[best] = true;
  }
  return weights;
}

bool is_stationary(const Balance& balance) {
  return balance.stationarity <= most_stationarity && balance.complementarity <= most_complementarity;
}

Balance balance(const LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
                std::vector<ActiveLimit> limits) {
  Balance result;
  const std::vector<double>& design = cases.state(0).design;
  const auto n = static_cast<Eigen::Index>(design.size());
  std::vector<Vector> columns;
  std::vector<std::size_t> group, count(cases.groups(), 0);
  std::vector<double> heights, shares, slack;
  for (std::size_t g = 0; g < cases.groups(); ++g) {
    heights.push_back(cases.height(cases.highest_of(g)));
    shares.push_back(heights[g] / cases.value());
  }
  Vector slope(n);  // dp/dy
  for (std::size_t k = 0; k < design.size(); ++k) {
    const ScaledParameter scale(lower[k], upper[k]);
    slope[static_cast<Eigen::Index>(k)] = scale.slope(design[k]);
    const double y = scale.scaled(design[k]), y_lower = scale.scaled(lower[k]),
                 y_upper = scale.scaled(upper[k]);
    const double near = on_bound * (y_upper - y_lower);
    result.at_bound.push_back(y <= y_lower + near ? -1 : y >= y_upper - near ? 1 : 0);
  }
  for (std::size_t c = 0; c < cases.size(); ++c)
    for (std::size_t i = 0; i < cases.state(c).peaks.size(); ++i) {
      const Peak& peak = cases.state(c).peaks[i];
      const std::size_t g = cases.group(c);
      if (peak.amplitude == 0 || cases.weight(c) * peak.amplitude < (1 - as_high) * heights[g]) continue;
      result.active.push_back({c, i});
      columns.push_back(peak.gradient.cwiseProduct(slope) / peak.amplitude);
      slack.push_back(std::log(heights[g] / (cases.weight(c) * peak.amplitude)));
      group.push_back(g);
      if (++count[g] > 1 || peak.kind == PeakKind::kink) result.smooth = false;
    }
  for (const ActiveLimit& limit : limits) {
    columns.push_back(limit.gradient);
    slack.push_back(std::max(0.0, limit.slack));
  }
  for (Eigen::Index k = 0; k < n; ++k)
    if (const int side = result.at_bound[static_cast<std::size_t>(k)]; side != 0)
      columns.push_back(side * Vector::Unit(n, k));
  group.resize(columns.size(), shares.size());
  slack.resize(columns.size(), 0.0);
  Eigen::MatrixXd G(n, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) G.col(static_cast<Eigen::Index>(i)) = columns[i];
  const Eigen::VectorXd m = least_combination(G, group, shares);
  result.left = G * m;
  result.stationarity = result.left.norm();
  result.complementarity = m.dot(Eigen::VectorXd::Map(slack.data(), m.size()));
  Eigen::Index next = 0;
  for (ActivePeak& peak : result.active) peak.multiplier = m[next++];
  for (ActiveLimit& limit : limits) limit.multiplier = m[next++];
  result.limits = std::move(limits);
  return result;
}

}  // namespace arcslip::optimize
