#include <arcslip/laws/contact/slip_collocation.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace arcslip::elements {
namespace {

constexpr double no_solution = std::numeric_limits<double>::infinity();
constexpr int collocation_newton_steps = 8;
constexpr double direction_rounding = 1e-13;  // rad

double legendre(int degree, double t) {
  double before = 1, at = t;
  if (degree == 0) return 1;
  for (int k = 1; k < degree; ++k) {
    const double next = ((2 * k + 1) * t * at - k * before) / (k + 1);
    before = at;
    at = next;
  }
  return at;
}

// The roots of P_s - P_(s-1), s = panel_nodes, the last of which is 1.
SlipPanel::Nodes radau() {
  SlipPanel::Nodes nodes;
  const auto f = [](double t) { return legendre(panel_nodes, t) - legendre(panel_nodes - 1, t); };
  constexpr int samples = 1000;
  int found = 0;
  for (int k = 0; k < samples && found < panel_nodes - 1; ++k) {
    double below = -1 + 2.0 * k / samples, above = -1 + 2.0 * (k + 1) / samples;
    const bool rises = f(below) < 0;
    if (rises == (f(above) < 0)) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (below + above);
      ((f(middle) < 0) == rises ? below : above) = middle;
    }
    nodes[found++] = 0.5 * (below + above);
  }
  nodes[panel_nodes - 1] = 1;
  return nodes;
}

}  // namespace

SlipCollocation::SlipCollocation() : nodes_(radau()) {
  Eigen::Matrix<double, panel_nodes + 1, 1> t;
  t << -1, nodes_;
  for (int j = 0; j < panel_nodes; ++j) {
    const double p = legendre(panel_nodes - 1, nodes_[j]);
    weights_[j] = (1 + nodes_[j]) / (panel_nodes * panel_nodes * p * p);
  }
  for (int i = 0; i <= panel_nodes; ++i) {
    barycentric_[i] = 1;
    for (int j = 0; j <= panel_nodes; ++j)
      if (j != i) barycentric_[i] /= t[i] - t[j];
  }
  for (int j = 0; j < panel_nodes; ++j) {
    double own = 0;
    for (int i = 0; i <= panel_nodes; ++i) {
      if (i == j + 1) continue;
      const double d = barycentric_[i] / barycentric_[j + 1] / (t[j + 1] - t[i]);
      own -= d;
      if (i == 0)
        by_first_[j] = d;
      else
        derivative_(j, i - 1) = d;
    }
    derivative_(j, j) = own;
  }
  Eigen::Matrix<double, panel_nodes + 1, panel_nodes + 1> basis;
  for (int i = 0; i <= panel_nodes; ++i)
    for (int k = 0; k <= panel_nodes; ++k) basis(i, k) = legendre(k, t[i]);
  tail_ = basis.inverse().bottomRows(2);
}

// With x' and h frozen between neighbouring nodes tan((psi - arg x')/2) decays exponentially.
void SlipCollocation::guess(const std::array<DiscPoint, panel_nodes>& at, SlipPanel& panel) const {
  double psi = panel.from, theta = panel.begin;
  for (int j = 0; j < panel_nodes; ++j) {
    const DiscPoint& p = at[static_cast<std::size_t>(j)];
    const double speed = p.v.norm();
    if (speed > 0) {
      const double rate = std::max(p.h, 0.0) > 0 ? speed / p.h * (panel.theta[j] - theta) : 1e3;
      const double beta = std::remainder(psi - std::atan2(p.v[1], p.v[0]), 2 * std::numbers::pi);
      psi += 2 * std::atan(std::tan(0.5 * beta) * std::exp(-std::min(rate, 700.0))) - beta;
    }
    panel.psi[j] = psi;
    theta = panel.theta[j];
  }
}

double SlipCollocation::solve(const Disc& disc, double begin, double end, double from, double tolerance,
                              SlipPanel& panel) const {
  panel.begin = begin;
  panel.end = end;
  panel.from = from;
  const double half = 0.5 * (end - begin);
  std::array<DiscPoint, panel_nodes> at;
  for (int j = 0; j < panel_nodes; ++j) {
    panel.theta[j] = j == panel_nodes - 1 ? end : begin + half * (1 + nodes_[j]);
    at[static_cast<std::size_t>(j)] = disc.at(panel.theta[j]);
    panel.h[j] = std::max(at[static_cast<std::size_t>(j)].h, 0.0);
  }
  guess(at, panel);
  bool settled = false;
  for (int i = 0; i < collocation_newton_steps && !settled; ++i) {
    panel.rate = (derivative_ * panel.psi + by_first_ * from) / half;
    for (int j = 0; j < panel_nodes; ++j) {
      const Eigen::Vector2d& v = at[static_cast<std::size_t>(j)].v;
      const double c = std::cos(panel.psi[j]), sine = std::sin(panel.psi[j]);
      panel.along[j] = c * v[0] + sine * v[1];
      panel.across[j] = c * v[1] - sine * v[0];
    }
    const SlipPanel::Nodes residual = panel.h.cwiseProduct(panel.rate) - panel.across;
    const SlipPanel::Nodes step = matrix(panel).partialPivLu().solve(residual);
    if (!step.allFinite() || !(step.cwiseAbs().maxCoeff() < 3)) return no_solution;
    panel.psi -= step;
    settled = step.cwiseAbs().maxCoeff() <= direction_rounding ||
              step.cwiseProduct(panel.h).cwiseAbs().maxCoeff() <= 1e-3 * tolerance;
  }
  if (!settled) return no_solution;
  for (int j = 0; j < panel_nodes; ++j) {
    const DiscPoint& p = at[static_cast<std::size_t>(j)];
    const double c = std::cos(panel.psi[j]), sine = std::sin(panel.psi[j]);
    panel.along[j] = c * p.v[0] + sine * p.v[1];
    panel.across[j] = c * p.v[1] - sine * p.v[0];
    panel.spare[j] = panel.along[j] - p.dh;
    panel.gain[j] = c * p.a[0] + sine * p.a[1] - p.ddh;
  }
  panel.rate = (derivative_ * panel.psi + by_first_ * from) / half;
  panel.gain += panel.rate.cwiseProduct(panel.across);
  Eigen::Matrix<double, panel_nodes + 1, 1> values;
  values << from, panel.psi;
  return (tail_ * values).cwiseAbs().sum() * panel.h.maxCoeff();
}

void SlipCollocation::hold(const Disc& disc, double begin, double end, double psi, SlipPanel& panel) const {
  panel.begin = begin;
  panel.end = end;
  panel.from = psi;
  panel.psi.setConstant(psi);
  panel.rate.setZero();
  const double c = std::cos(psi), sine = std::sin(psi);
  for (int j = 0; j < panel_nodes; ++j) {
    panel.theta[j] = j == panel_nodes - 1 ? end : begin + 0.5 * (end - begin) * (1 + nodes_[j]);
    const DiscPoint at = disc.at(panel.theta[j]);
    panel.h[j] = std::max(at.h, 0.0);
    panel.along[j] = c * at.v[0] + sine * at.v[1];
    panel.across[j] = c * at.v[1] - sine * at.v[0];
    panel.spare[j] = panel.along[j] - at.dh;
    panel.gain[j] = c * at.a[0] + sine * at.a[1] - at.ddh;
  }
}

SlipPanel::Square SlipCollocation::matrix(const SlipPanel& panel) const {
  SlipPanel::Square m = (2 / panel.length() * panel.h).asDiagonal() * derivative_;
  m.diagonal() += panel.along;
  return m;
}

SlipPanel::Nodes SlipCollocation::column(const SlipPanel& panel) const {
  return 2 / panel.length() * panel.h.cwiseProduct(by_first_);
}

double SlipCollocation::psi(const SlipPanel& panel, double theta) const {
  const double t = 2 * (theta - panel.begin) / panel.length() - 1;
  double sum = 0, weight = 0;
  for (int i = 0; i <= panel_nodes; ++i) {
    const double apart = t - (i == 0 ? -1 : nodes_[i - 1]), value = i == 0 ? panel.from : panel.psi[i - 1];
    if (apart == 0) return value;
    sum += barycentric_[i] / apart * value;
    weight += barycentric_[i] / apart;
  }
  return sum / weight;
}

}  // namespace arcslip::elements
