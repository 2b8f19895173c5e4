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
constexpr double chord_reach = 1e-4;          // rad: factors are kept where psi has moved less
constexpr double early_look = 0.03;           // rad: after a shorter step the tail of psi is known roughly
constexpr double small_turn = 1e-3;           // rad

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

// Of angles of less than 1e6 rad, to one or two units in the last place of 1, by the series about the nearest
// multiple k pi/2. Without a branch: several are computed at once.
void cosines_and_sines(const SlipPanel::Nodes& angles, SlipPanel::Nodes& cosines, SlipPanel::Nodes& sines) {
  constexpr double to_integer = 6755399441055744.0;  // 1.5 2^52: a sum with it has no digits behind the point
  constexpr double quarter[2] = {0x1.921fb544p+0,
                                 0x1.0b4611a626331p-34};  // of a turn, the first exact times k
  const double *x = angles.data(), two_over_pi = std::numbers::inv_pi * 2;
  double *c = cosines.data(), *s = sines.data();
  for (int j = 0; j < panel_nodes; ++j) {
    const double k = (x[j] * two_over_pi + to_integer) - to_integer;
    const double r = (x[j] - k * quarter[0]) - k * quarter[1], z = r * r;
    const double sine =
        r +
        r * z *
            (-1.0 / 6 +
             z * (1.0 / 120 + z * (-1.0 / 5040 +
                                   z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                            z * (1.0 / 6227020800 - z / 1307674368000.0))))));
    const double cosine =
        1 - 0.5 * z +
        z * z *
            (1.0 / 24 +
             z * (-1.0 / 720 + z * (1.0 / 40320 + z * (-1.0 / 3628800 +
                                                       z * (1.0 / 479001600 + z * (-1.0 / 87178291200.0 +
                                                                                   z / 20922789888000.0))))));
    const double half = 0.5 * k, quarters = k - 4 * ((0.25 * k + to_integer) - to_integer);  // -2 to 2
    const bool odd = half != (half + to_integer) - to_integer;
    const double first = odd ? sine : cosine, second = odd ? cosine : sine;
    c[j] = quarters == 0 || quarters == -1 ? first : -first;
    s[j] = quarters == 0 || quarters == 1 ? second : -second;
  }
}

void turn_to_psi(SlipPanel& panel) {
  cosines_and_sines(panel.psi, panel.outward[0], panel.outward[1]);
}

// About exp(-z) and atan(t), which is enough for a guess.
double decay(double z) {
  return 1 / (1 + z * (1 + z * (1.0 / 2 + z * (1.0 / 6 + z / 24))));
}
double turning(double t) {
  const double square = t * t;
  return square < 0.1 ? t * (1 - square * (1.0 / 3 - square / 5)) : std::atan(t);
}

// n at the nodes, where psi becomes less by a step.
void turn(const SlipPanel::Nodes& step, double size, SlipPanel& panel) {
  if (size > small_turn) return turn_to_psi(panel);
  const SlipPanel::Nodes square = step.cwiseProduct(step);
  const SlipPanel::Nodes cosine = SlipPanel::Nodes::Ones() - 0.5 * square + square.cwiseProduct(square) / 24;
  const SlipPanel::Nodes sine = step - step.cwiseProduct(square) / 6;
  const SlipPanel::Nodes first = panel.outward[0];
  panel.outward[0] = cosine.cwiseProduct(first) + sine.cwiseProduct(panel.outward[1]);
  panel.outward[1] = cosine.cwiseProduct(panel.outward[1]) - sine.cwiseProduct(first);
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

void SlipFactors::factorize(const SlipPanel::Square& matrix) {
  lu_ = matrix;
#pragma GCC unroll 16
  for (int k = 0; k < panel_nodes; ++k) {
    inverse_[k] = 1 / lu_(k, k);
    for (int i = k + 1; i < panel_nodes; ++i) lu_(i, k) *= inverse_[k];
    // In pairs of rows: where k is the first of one, it stays as it is.
    SlipPanel::Nodes below = lu_.col(k);
    below[k] = 0;
    const int pairs = (k + 1) & ~1;
    for (int j = k + 1; j < panel_nodes; ++j)
      for (int i = pairs; i < panel_nodes; ++i) lu_(i, j) -= below[i] * lu_(k, j);
  }
}

SlipPanel::Nodes SlipFactors::solve(SlipPanel::Nodes right) const {
#pragma GCC unroll 16
  for (int k = 0; k < panel_nodes; ++k)
    for (int i = k + 1; i < panel_nodes; ++i) right[i] -= lu_(i, k) * right[k];
#pragma GCC unroll 16
  for (int k = panel_nodes - 1; k >= 0; --k) {
    right[k] *= inverse_[k];
    for (int i = 0; i < k; ++i) right[i] -= lu_(i, k) * right[k];
  }
  return right;
}

SlipPanel::Square SlipFactors::inverse() const {
  SlipPanel::Square all;
  for (int j = 0; j < panel_nodes; ++j) all.col(j) = solve(SlipPanel::Nodes::Unit(j));
  return all;
}

// With x'/h constant between neighbouring nodes, (cos psi/2, sin psi/2) times any factor obeys a linear
// equation, whose matrix is symmetric.
void SlipCollocation::guess(const Disc& disc, SlipPanel& panel) const {
  const DiscPoint first = disc.at(panel.begin);
  double theta = panel.begin, h = std::max(first.h, 0.0), psi = panel.from;
  Eigen::Vector2d v = first.v, half(std::cos(0.5 * psi), std::sin(0.5 * psi));
  for (int j = 0; j < panel_nodes; ++j) {
    const Eigen::Vector2d here(panel.v[0][j], panel.v[1][j]), sum = v + here;
    const double speed = sum.norm(), width = h + panel.h[j];
    if (speed > 0) {
      const Eigen::Vector2d along = sum / speed;
      const double e = width > 0 ? decay((panel.theta[j] - theta) * speed / width) : 0;
      Eigen::Vector2d next(along[0] * half[0] + along[1] * half[1], along[1] * half[0] - along[0] * half[1]);
      next = (1 + e) * half + (1 - e) * next;
      const double turned = half[0] * next[1] - half[1] * next[0], kept = half.dot(next);
      if (kept > 0) psi += 2 * turning(turned / kept);
      if (next.squaredNorm() > 1e-100) half = next;
    }
    panel.psi[j] = psi;
    theta = panel.theta[j];
    h = panel.h[j];
    v = here;
  }
  turn_to_psi(panel);
}

void SlipCollocation::place(const Disc& disc, double begin, double end, SlipPanel& panel) const {
  panel.begin = begin;
  panel.end = end;
  panel.theta = begin + 0.5 * (end - begin) * (1 + nodes_.array());
  panel.theta[panel_nodes - 1] = end;
  cosines_and_sines(panel.theta, panel.cosine, panel.sine);
  disc.at<panel_nodes>(panel.cosine, panel.sine, panel);
  panel.h = panel.h.cwiseMax(0.0);
}

void SlipCollocation::set_rate(SlipPanel& panel) const {
  panel.rate = by_first_ * panel.from;
  for (int i = 0; i < panel_nodes; ++i) panel.rate += panel.psi[i] * derivative_.col(i);
  panel.rate *= 2 / panel.length();
  panel.along = panel.outward[0].cwiseProduct(panel.v[0]) + panel.outward[1].cwiseProduct(panel.v[1]);
  panel.across = panel.outward[0].cwiseProduct(panel.v[1]) - panel.outward[1].cwiseProduct(panel.v[0]);
}

double SlipCollocation::tail(const SlipPanel& panel) const {
  Eigen::Vector2d sum = tail_.col(0) * panel.from;
  for (int i = 0; i < panel_nodes; ++i) sum += tail_.col(i + 1) * panel.psi[i];
  return sum.cwiseAbs().sum() * panel.h.maxCoeff();
}

// The factors are kept while psi has hardly moved since: the next step is about as long as this one times
// what psi has moved, by which Newton's method is known to have ended.
double SlipCollocation::newton(double tolerance, SlipPanel& panel) const {
  SlipFactors factors;
  double moved = no_solution, before = no_solution;
  for (int i = 0; i < collocation_newton_steps; ++i) {
    set_rate(panel);
    if (moved > chord_reach) {
      factors.factorize(matrix(panel));
      moved = 0;
    }
    const SlipPanel::Nodes step = factors.solve(panel.h.cwiseProduct(panel.rate) - panel.across);
    const double size = step.cwiseAbs().maxCoeff();
    if (!(size < 3) || (i > 1 && size > 0.5 * before && size > direction_rounding)) return no_solution;
    panel.psi -= step;
    turn(step, size, panel);
    moved += size;
    if (size <= direction_rounding || size * moved <= 0.1 * direction_rounding) {
      finish(panel);
      return tail(panel);
    }
    before = size;
    if (size > early_look) continue;
    const double rough = tail(panel);
    if (rough > 4 * tolerance + 2 * size * panel.h.maxCoeff()) return rough;
  }
  return no_solution;
}

void SlipCollocation::finish(SlipPanel& panel) const {
  set_rate(panel);
  panel.turn[0] = -panel.outward[1];
  panel.turn[1] = panel.outward[0];
  panel.spare = panel.along - panel.dh;
  panel.gain = panel.outward[0].cwiseProduct(panel.a[0]) + panel.outward[1].cwiseProduct(panel.a[1]) -
               panel.ddh + panel.rate.cwiseProduct(panel.across);
}

double SlipCollocation::solve(const Disc& disc, double begin, double end, double from, double tolerance,
                              SlipPanel& panel) const {
  place(disc, begin, end, panel);
  panel.from = from;
  guess(disc, panel);
  return newton(tolerance, panel);
}

double SlipCollocation::solve_near(const Disc& disc, const SlipPanel& known, double begin, double end,
                                   double from, double tolerance, SlipPanel& panel) const {
  if (begin == known.begin && end == known.end) {
    panel = known;
  } else {
    place(disc, begin, end, panel);
    interpolate(known, panel.theta, panel.psi);
    turn_to_psi(panel);
  }
  const double turns = whole_turn * std::round((from - known.from) / whole_turn);
  panel.psi.array() += turns;
  panel.from = from;
  return newton(tolerance, panel);
}

void SlipCollocation::hold(const Disc& disc, double begin, double end, double psi, SlipPanel& panel) const {
  place(disc, begin, end, panel);
  panel.from = psi;
  panel.psi.setConstant(psi);
  turn_to_psi(panel);
  finish(panel);
  panel.rate.setZero();
}

SlipPanel::Square SlipCollocation::matrix(const SlipPanel& panel) const {
  const SlipPanel::Nodes scale = 2 / panel.length() * panel.h;
  SlipPanel::Square m;
  for (int i = 0; i < panel_nodes; ++i) m.col(i) = scale.cwiseProduct(derivative_.col(i));
  m.diagonal() += panel.along;
  return m;
}

SlipPanel::Nodes SlipCollocation::column(const SlipPanel& panel) const {
  return 2 / panel.length() * panel.h.cwiseProduct(by_first_);
}

// psi at several angles.
void SlipCollocation::interpolate(const SlipPanel& panel, const SlipPanel::Nodes& theta,
                                  SlipPanel::Nodes& values) const {
  const SlipPanel::Nodes t = 2 / panel.length() * (theta.array() - panel.begin) - 1;
  SlipPanel::Nodes weight = barycentric_[0] * (t.array() + 1).inverse(), sum = weight * panel.from;
  for (int i = 0; i < panel_nodes; ++i) {
    const SlipPanel::Nodes share = barycentric_[i + 1] * (t.array() - nodes_[i]).inverse();
    weight += share;
    sum += share * panel.psi[i];
  }
  values = sum.cwiseQuotient(weight);
  for (int j = 0; j < panel_nodes; ++j)
    if (!std::isfinite(values[j])) values[j] = psi(panel, theta[j]);
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
