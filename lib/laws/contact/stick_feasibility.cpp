#include <arcslip/laws/contact/stick_feasibility.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::elements {
namespace {

constexpr int exchanges = 60;
constexpr double centre_rounding = 1e-13;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// |x - w| - h at an angle, with derivatives by it.
struct Excess {
  Eigen::Vector2d n, t;
  double d, value, d1, d2;

  Excess(const DiscPoint& p, const Eigen::Vector2d& w) {
    const Eigen::Vector2d y = p.x - w;
    d = y.norm();
    n = d > 0 ? Eigen::Vector2d(y / d) : Eigen::Vector2d(1, 0);
    t = quarter_turn(n);
    value = d - p.h;
    d1 = n.dot(p.v) - p.dh;
    const double across = t.dot(p.v);
    d2 = n.dot(p.a) + (d > 0 ? across * across / d : 0) - p.ddh;
  }
};

// Two opposite points: |x - w| - h - r = 0 and its derivative by the angle at both, and n_0 x n_1 = 0.
// Unknowns are w, r and both angles.
struct OppositePoints {
  using Equations = Eigen::Matrix<double, 5, 5>;

  Excess at[2];
  double across[2], by[2];  // t . v; of n_0 x n_1 by a turn of n
  Equations A = Equations::Zero();

  OppositePoints(const DiscPoint& a, const DiscPoint& b, const Eigen::Vector2d& w) : at{{a, w}, {b, w}} {
    for (int k = 0; k < 2; ++k) {
      across[k] = at[k].t.dot((k == 0 ? a : b).v);
      A.row(k) << -at[k].n.transpose(), -1, 0, 0;
      A(k, 3 + k) = at[k].d1;
      A.row(2 + k).head<2>() = -across[k] / at[k].d * at[k].t.transpose();
      A(2 + k, 3 + k) = at[k].d2;
      by[k] = k == 0 ? cross(at[0].t, at[1].n) : cross(at[0].n, at[1].t);
      A.row(4).head<2>() -= by[k] / at[k].d * at[k].t.transpose();
      A(4, 3 + k) = by[k] * across[k] / at[k].d;
    }
  }
  Eigen::Matrix<double, 5, 1> residual(double r) const {
    Eigen::Matrix<double, 5, 1> e;
    e << at[0].value - r, at[1].value - r, at[0].d1, at[1].d1, cross(at[0].n, at[1].n);
    return e;
  }
};

// phi and phi' at an angle.
struct Basis {
  Eigen::RowVectorXd phi, slope;
  Basis(const Harmonics& h, double theta) : phi(h.size()), slope(h.size()) {
    Eigen::VectorXd values(h.size());
    series_basis(h, theta, values);
    phi = values.transpose();
    slope[0] = 0;
    for (int n = 1; n <= h.order; ++n) {
      slope[h.cosine_index(n)] = -n * values[h.sine_index(n)];
      slope[h.sine_index(n)] = n * values[h.cosine_index(n)];
    }
  }
};

// |x - w| - h by the coefficients of x_1, x_2 and h.
Eigen::RowVectorXd by_coefficients(const Excess& at, const Basis& basis) {
  Eigen::RowVectorXd row(3 * basis.phi.size());
  row << at.n[0] * basis.phi, at.n[1] * basis.phi, -basis.phi;
  return row;
}

}  // namespace

StickMargin stick_margin(const DiscInstant& a, const DiscInstant& b) {
  const double d = (b.x - a.x).norm();
  if (d <= std::abs(a.h - b.h)) {  // the larger disc encloses the smaller one's centre by more
    const DiscInstant& least = a.h < b.h ? a : b;
    return {least.x, -least.h};
  }
  const double r = 0.5 * (d - a.h - b.h);
  return {a.x + (r + a.h) / d * (b.x - a.x), r};
}

// |x_i - w| = r + h_i for all three. Differences of the squares are linear in w and r.
std::optional<StickMargin> stick_margin(const DiscInstant& a, const DiscInstant& b, const DiscInstant& c) {
  Eigen::Matrix2d A;
  A << (b.x - a.x).transpose(), (c.x - a.x).transpose();
  const double scale = A.row(0).norm() * A.row(1).norm();
  if (!(std::abs(A.determinant()) > 1e-12 * scale)) return {};
  const auto side = [&](const DiscInstant& p) {
    return 0.5 * ((p.x - a.x).squaredNorm() - (p.h - a.h) * (p.h + a.h));
  };
  const Eigen::Matrix2d inverse = A.inverse();
  const Eigen::Vector2d at = inverse * Eigen::Vector2d(side(b), side(c));  // w - x_a = at + by r
  const Eigen::Vector2d by = inverse * Eigen::Vector2d(-(b.h - a.h), -(c.h - a.h));
  const double p = by.squaredNorm() - 1, q = at.dot(by) - a.h, s = at.squaredNorm() - a.h * a.h;
  double roots[2];
  if (std::abs(p) < 1e-14) {
    if (q == 0) return {};
    roots[0] = roots[1] = -0.5 * s / q;
  } else {
    const double under = q * q - p * s;
    if (!(under >= 0)) return {};
    const double far = -(q + std::copysign(std::sqrt(under), q));
    roots[0] = far / p;
    roots[1] = far != 0 ? s / far : roots[0];
  }
  std::sort(roots, roots + 2);
  for (const double r : roots) {
    if (r + std::min({a.h, b.h, c.h}) < 0) continue;
    return StickMargin{a.x + at + r * by, r};
  }
  return {};
}

StickCentre::StickCentre(const Harmonics& harmonics)
    : harmonics_(harmonics),
      disc_(harmonics),
      varying_(harmonics.size(), 3),
      angles_(12 * harmonics.order + 48),
      samples_(angles_.theta.size()),
      excess_(samples_.size()) {}

StickCentre::Point StickCentre::point(double theta) const {
  const DiscPoint p = disc_.at(theta);
  return {theta, p.x, p.h};
}

// The local maximum of the excess near an angle. A step that is so short is the last one, since the error
// after it is of its square, and that of the excess of its fourth power.
double StickCentre::climb(double theta) const {
  constexpr double last_step = 1e-8;
  const double reach = whole_turn / static_cast<double>(samples_.size()), begin = theta;
  Excess at(disc_.at(theta), w_);
  for (int i = 0; i < 30; ++i) {
    double step = at.d2 < 0 ? -at.d1 / at.d2 : (at.d1 > 0 ? reach / 8 : -reach / 8);
    step = std::clamp(step, begin - 1.5 * reach - theta, begin + 1.5 * reach - theta);
    if (at.d2 < 0 && std::abs(step) < last_step) return theta + step;
    Excess next(disc_.at(theta + step), w_);
    for (int halvings = 0; next.value < at.value && halvings < 40; ++halvings) {
      step *= 0.5;
      next = Excess(disc_.at(theta + step), w_);
    }
    if (next.value < at.value) break;
    theta += step;
    at = next;
    if (std::abs(step) < 1e-13) break;
  }
  return theta;
}

// Where the excess is largest: the maximum near each sample that may hide it. At a point that coincides with
// w the excess has a cone: on both sides of it.
StickCentre::Point StickCentre::farthest() {
  const std::size_t count = samples_.size();
  const double reach = whole_turn / static_cast<double>(count);
  for (std::size_t k = 0; k < count; ++k) excess_[k] = excess(samples_[k], w_);
  const auto top =
      static_cast<std::size_t>(std::max_element(excess_.begin(), excess_.end()) - excess_.begin());
  Point best = samples_[top];
  const auto try_from = [&](double theta) {
    const Point at = point(climb(theta));
    if (excess(at, w_) > excess(best, w_)) best = at;
  };
  for (std::size_t k = 0; k < count; ++k) {
    const double before = excess_[(k + count - 1) % count], at = excess_[k], after = excess_[(k + 1) % count];
    if (at < before || at < after) continue;
    if (at + 2 * at - before - after < excess(best, w_)) continue;
    try_from(samples_[k].theta);
    const DiscPoint p = disc_.at(samples_[k].theta);
    if ((p.x - w_).norm() > reach * p.v.norm()) continue;
    const double nearby = std::clamp(p.ddh > 0 ? p.v.norm() / p.ddh : reach, 0.0, reach);
    try_from(samples_[k].theta - nearby);
    try_from(samples_[k].theta + nearby);
  }
  return best;
}

// The minimiser for a few points, of which those that decide it are kept: the subset with the largest r.
void StickCentre::solve(std::vector<Point>& basis) {
  std::vector<Point> best;
  Eigen::Vector2d w = basis[0].x;
  double r = -basis[0].h;
  best = {basis[0]};
  const auto take = [&](const StickMargin& margin, std::vector<Point> points) {
    if (!(margin.r > r)) return;
    r = margin.r;
    w = margin.w;
    best = std::move(points);
  };
  for (std::size_t i = 0; i < basis.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) take(stick_margin(basis[i], basis[j]), {basis[i], basis[j]});
  for (std::size_t i = 0; i < basis.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        // Only if no pair of them decides already.
        const Point &a = basis[i], &b = basis[j], &c = basis[k];
        const auto decides = [&](const Point& one, const Point& two, const Point& other) {
          const StickMargin margin = stick_margin(one, two);
          return excess(other, margin.w) <=
                 margin.r + 1e-15 * (std::abs(margin.r) + std::abs(other.h) + other.x.norm());
        };
        if (decides(a, b, c) || decides(a, c, b) || decides(b, c, a)) continue;
        if (const auto margin = stick_margin(a, b, c)) take(*margin, {a, b, c});
      }
  basis = best;
  w_ = w;
  r_ = r;
}

void StickCentre::find(const Disc& disc) {
  mean_x_ = disc.mean();
  mean_h_ = disc.coefficients(2)[0];
  for (int i = 0; i < 3; ++i) varying_.col(i) = disc.coefficients(i);
  varying_.row(0).setZero();
  unit_ = disc.motion_bound(0) > 0 ? disc.motion_bound(0) : 1;
  varying_ /= unit_;
  disc_.set(varying_.col(0), varying_.col(1), varying_.col(2));
  const double size = disc_.motion_bound(0);
  active_.clear();
  w_.setZero();
  disc_.at(angles_, 1, samples_);
  const auto least = std::min_element(samples_.begin(), samples_.end(),
                                      [](const Point& a, const Point& b) { return a.h < b.h; });
  if (!(size > 0)) {
    r_ = -least->h;
    return;
  }
  w_ = least->x;
  r_ = -least->h;
  std::vector<Point> basis{*least};
  for (int i = 0; i < exchanges; ++i) {
    const Point next = farthest();
    if (!(excess(next, w_) > r_ + centre_rounding * size)) break;
    const double before = r_;
    basis.push_back(next);
    solve(basis);
    if (!(r_ > before)) break;
  }
  for (const Point& at : basis) active_.push_back(at.theta);
  polish();
}

// Neighbouring points are one maximum.
void StickCentre::merge_neighbours() {
  std::vector<double> distinct;
  for (const double theta : active_) {
    const bool known = std::any_of(distinct.begin(), distinct.end(), [&](double other) {
      return std::abs(std::remainder(theta - other, whole_turn)) < half_spacing() &&
             Excess(disc_.at(theta), w_).n.dot(Excess(disc_.at(other), w_).n) > 0.5;
    });
    if (!known) distinct.push_back(theta);
  }
  active_ = distinct;
}

// A step of Newton's method, with its length; not finite where there is none.
double StickCentre::polish_three() {
  const double same = half_spacing();
  Eigen::Matrix3d A;
  Eigen::Vector3d e;
  for (int k = 0; k < 3; ++k) {
    double& theta = active_[static_cast<std::size_t>(k)];
    const Excess here(disc_.at(theta), w_);
    if (here.d2 < 0) theta -= std::clamp(here.d1 / here.d2, -same, same);
    const Excess at(disc_.at(theta), w_);
    A.row(k) << -at.n.transpose(), -1;
    e[k] = at.value - r_;
  }
  const Eigen::Vector3d step = A.fullPivLu().solve(-e);
  w_ += step.head<2>();
  r_ += step[2];
  return step.norm();
}

double StickCentre::polish_opposite() {
  const double same = half_spacing();
  const OppositePoints points(disc_.at(active_[0]), disc_.at(active_[1]), w_);
  const Eigen::Matrix<double, 5, 1> step = points.A.fullPivLu().solve(-points.residual(r_));
  if (!step.allFinite()) return std::numeric_limits<double>::infinity();
  w_ += step.head<2>();
  r_ += step[2];
  for (int k = 0; k < 2; ++k) active_[static_cast<std::size_t>(k)] += std::clamp(step[3 + k], -same, same);
  return step.head<3>().norm();
}

// Two points have to be opposite, which the values alone decide poorly.
void StickCentre::polish() {
  merge_neighbours();
  const Eigen::Vector2d w = w_;
  const double r = r_, size = disc_.motion_bound(0);
  const std::vector<double> angles = active_;
  bool settled = active_.size() < 2;
  for (int i = 0; i < 12 && !settled; ++i) {
    const double change = active_.size() == 3 ? polish_three() : polish_opposite();
    settled = change <= centre_rounding * size;
    if (!std::isfinite(change)) break;
  }
  // Newton's method may have left for somewhere else.
  if (settled && (w_ - w).norm() <= 1e-2 * size && std::abs(r_ - r) <= 1e-6 * size) return;
  w_ = w;
  r_ = r;
  active_ = angles;
  if (active_.size() > 3) active_.resize(3);
}

void StickCentre::derivative(Eigen::Ref<Eigen::MatrixXd> dw) const {
  dw.setZero();
  if (active_.size() < 2)
    derivative_of_one(dw);
  else if (active_.size() == 3)
    derivative_of_three(dw);
  else
    derivative_of_opposite(dw);
}

// Along with the disc: its mean, or the only active point.
void StickCentre::derivative_of_one(Eigen::Ref<Eigen::MatrixXd> dw) const {
  const Eigen::Index c = harmonics_.size();
  const Eigen::VectorXd phi = active_.empty() ? Eigen::VectorXd(Eigen::VectorXd::Unit(c, 0))
                                              : Eigen::VectorXd(Basis(harmonics_, active_[0]).phi);
  dw.row(0).head(c) = phi.transpose();
  dw.row(1).segment(c, c) = phi.transpose();
}

void StickCentre::derivative_of_three(Eigen::Ref<Eigen::MatrixXd> dw) const {
  Eigen::Matrix3d A;
  Eigen::MatrixXd rows(3, dw.cols());
  for (int k = 0; k < 3; ++k) {
    const double theta = active_[static_cast<std::size_t>(k)];
    const Excess at(disc_.at(theta), w_);
    A.row(k) << at.n.transpose(), 1;
    rows.row(k) = by_coefficients(at, Basis(harmonics_, theta));
  }
  const Eigen::MatrixXd all = A.fullPivLu().solve(rows);
  dw = all.topRows(2);
}

void StickCentre::derivative_of_opposite(Eigen::Ref<Eigen::MatrixXd> dw) const {
  const Eigen::Index c = harmonics_.size();
  const OppositePoints points(disc_.at(active_[0]), disc_.at(active_[1]), w_);
  const Basis bases[2] = {{harmonics_, active_[0]}, {harmonics_, active_[1]}};
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(5, 3 * c);
  for (int k = 0; k < 2; ++k) {
    const Excess& at = points.at[k];
    const Basis& basis = bases[k];
    rows.row(k) = by_coefficients(at, basis);
    for (int i = 0; i < 2; ++i) {
      rows.row(2 + k).segment(i * c, c) =
          at.n[i] * basis.slope + points.across[k] / at.d * at.t[i] * basis.phi;
      rows.row(4).segment(i * c, c) += points.by[k] / at.d * at.t[i] * basis.phi;
    }
    rows.row(2 + k).tail(c) = -basis.slope;
  }
  const auto lu = points.A.fullPivLu();
  if (lu.isInvertible()) {
    const Eigen::MatrixXd all = lu.solve(rows);
    dw = -all.topRows(2);
    return;
  }
  // Along the line through both as their values say, across it with the mean of both.
  const Eigen::Vector2d &n = points.at[0].n, &t = points.at[0].t;
  const Eigen::RowVectorXd along = 0.5 * (rows.row(0) - rows.row(1));
  for (int i = 0; i < 2; ++i) {
    dw.row(i) = n[i] * along;
    for (const Basis& basis : bases)
      for (int j = 0; j < 2; ++j) dw.row(i).segment(j * c, c) += 0.5 * t[i] * t[j] * basis.phi;
  }
}

}  // namespace arcslip::elements
