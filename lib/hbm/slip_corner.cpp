#include <arcslip/hbm/slip_corner.hpp>

#include <arcslip/elements/friction_phases.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace arcslip::hbm {
namespace {

using continuation::Evaluated;
using continuation::Needs;

constexpr double beside = 1e-11;       // of the size of h: so far from h = 0 the sides are looked at
constexpr double no_harmonic = 1e-11;  // of the largest coefficient: what is less is rounding
constexpr int polishing = 20;          // steps of Newton's method, to a reversal
constexpr double same_place = 1e-9;    // rad: a reversal at the end of a phase
constexpr double next_to_be = 1e-3;  // of the range of the motion: reversals next to be the highest or lowest
constexpr double same_angle = 0.3;   // rad: farther off, it is another reversal

// The motion of one element, from the unknowns.
class Motion {
 public:
  Motion(const HbmProblem& problem, int element)
      : harmonics_(problem.harmonics()),
        parameters_(problem.model().elements[static_cast<std::size_t>(element)].parameters) {
    const int r = problem.coordinates().unknowns;
    const Vector d = problem.coordinates().P.leftCols(r).transpose() *
                     problem.model().elements[static_cast<std::size_t>(element)].direction;
    for (int i = 0; i < r; ++i)
      if (std::abs(d[i]) > 1e-12 * d.norm()) direction_.emplace_back(i, d[i]);
    w_.resize(harmonics_.size());
    phi_.resize(harmonics_.size());
  }

  const Vector& of(In u) {
    const int c = harmonics_.size();
    w_.setZero();
    for (const auto& [i, weight] : direction_) w_ += weight * u.segment(i * c, c);
    return w_;
  }
  elements::Values at(double theta) const { return elements::series_values(harmonics_, w_, theta); }

  double stiffness(In p) const { return p[parameters_[0]]; }
  double limit(In p) const { return p[parameters_[1]] * p[parameters_[2]]; }
  // Of forces at the last motion.
  double size(In p) const {
    return std::min(limit(p), stiffness(p) * elements::series_bound(harmonics_, w_, 0));
  }
  const Harmonics& harmonics() const { return harmonics_; }

  // g += factor dw(theta)/du, or that of w'.
  void add_value(double theta, double factor, Out g) {
    elements::series_basis(harmonics_, theta, phi_);
    add(factor, g);
  }
  void add_slope(double theta, double factor, Out g) {
    elements::series_basis(harmonics_, theta, phi_);
    for (int j = 0; j < harmonics_.sines(); ++j) {
      const int n = harmonics_.sine_order(j), c = harmonics_.cosine_index(n), s = harmonics_.sine_index(n);
      const double cosine = phi_[c];
      phi_[c] = -n * phi_[s];
      phi_[s] = n * cosine;
    }
    if (!harmonics_.odd) phi_[0] = 0;
    add(factor, g);
  }

  // h and dh/dp_k at the last motion.
  double excess(const SlipCorner& corner, In p) const {
    return 0.5 * (corner.slip_sign * stiffness(p) * range(corner) - turned(corner) * limit(p));
  }
  double excess_derivative(const SlipCorner& corner, In p, int k) const {
    double sum = 0;
    if (parameters_[0] == k) sum += 0.5 * corner.slip_sign * range(corner);
    if (parameters_[1] == k) sum -= 0.5 * turned(corner) * p[parameters_[2]];
    if (parameters_[2] == k) sum -= 0.5 * turned(corner) * p[parameters_[1]];
    return sum;
  }
  void add_excess_gradient(const SlipCorner& corner, In p, Out dh) {
    const double factor = 0.5 * corner.slip_sign * stiffness(p);
    add_value(corner.reversal, factor, dh);
    add_value(corner.anchor, -factor, dh);
  }

 private:
  static double turned(const SlipCorner& corner) { return 1 - corner.slip_sign * corner.anchor_sign; }
  double range(const SlipCorner& corner) const { return at(corner.reversal).x - at(corner.anchor).x; }
  void add(double factor, Out g) const {
    const int c = harmonics_.size();
    for (const auto& [i, weight] : direction_) g.segment(i * c, c) += factor * weight * phi_;
  }

  Harmonics harmonics_;
  std::vector<int> parameters_;  // k_d, mu, F_n
  std::vector<std::pair<int, double>> direction_;
  Vector w_, phi_;
};

// The reversal next to an angle, of the same kind: a maximum of sign w.
bool polish(const Motion& motion, double sign, double& theta) {
  const double begin = theta;
  for (int k = 0; k < polishing; ++k) {
    const auto w = motion.at(theta);
    if (!(sign * w.d2 < 0)) return false;
    const double step = -w.d1 / w.d2;
    theta += step;
    if (!(std::abs(theta - begin) <= same_angle)) return false;
    if (std::abs(step) <= 1e-14) break;
  }
  return true;
}

// The same corner, or an image of it by a symmetry of the element's motion w.
bool is_listed(const std::vector<SlipCorner>& all, const SlipCorner& corner, const Harmonics& harmonics,
               In w) {
  return std::any_of(all.begin(), all.end(), [&](const SlipCorner& other) {
    const double sign = other.slip_sign * corner.slip_sign, turn = corner.anchor - other.anchor;
    const double apart = corner.reversal - other.reversal - turn;
    return other.element == corner.element && other.anchor_sign * corner.anchor_sign == sign &&
           std::abs(std::remainder(apart, 2 * std::numbers::pi)) <= same_place &&
           elements::is_image(harmonics, w, turn, sign);
  });
}

// Of full stick: from the lowest reversal to the highest and, where there is a mean, from one that is the
// highest or lowest to one that is next to be. Several may be next to be these.
template <class Add>
void add_of_stick(const Motion& motion, const std::vector<elements::Reversal>& turns, double highest,
                  double lowest, int element, Add&& add) {
  const double near = next_to_be * (highest - lowest);
  std::vector<double> tops, bottoms;
  for (const auto& turn : turns) {
    if (motion.harmonics().odd) {
      const bool is_top = turn.x > 0;
      if (std::abs(turn.x) >= highest - near)
        tops.push_back(is_top ? turn.theta : turn.theta + std::numbers::pi);
    } else if (turn.x >= highest - near) {
      tops.push_back(turn.theta);
    } else if (turn.x <= lowest + near) {
      bottoms.push_back(turn.theta);
    }
  }
  if (motion.harmonics().odd) {
    for (const double top : tops) add({element, top - std::numbers::pi, top, -1, 1});
    return;
  }
  for (std::size_t i = 0; i < tops.size(); ++i) {
    for (const double bottom : bottoms) add({element, bottom, tops[i], -1, 1});
    for (std::size_t j = 0; j < i; ++j) add({element, tops[j], tops[i], 1, 1});
  }
  for (std::size_t i = 0; i < bottoms.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) add({element, bottoms[j], bottoms[i], -1, -1});
}

class SlipCornerEvaluator final : public continuation::Evaluator {
 public:
  SlipCornerEvaluator(std::shared_ptr<const HbmProblem> problem, const SlipCorner& corner)
      : problem_(std::move(problem)),
        corner_(corner),
        n_(problem_->size()),
        inner_(problem_->hbm_evaluator()),
        motion_(*problem_, corner.element),
        R_(n_ + 3),
        gradient_(n_),
        jacobian_(Eigen::MatrixXd(n_ + 3, n_ + 3)) {}

  Evaluated move_to(continuation::In x, continuation::In p, Needs needs) override {
    p_ = p;
    p_[model::frequency] = x[n_];
    const Evaluated result = inner_->move_to(x.head(n_), p_, needs);
    if (result != Evaluated::ok) return result;
    const double size = motion_.of(x.head(n_)).norm();
    if (!(size > 0)) return Evaluated::outside_domain;
    corner_.anchor = x[n_ + 1];
    corner_.reversal = x[n_ + 2];
    const auto anchor = motion_.at(corner_.anchor), reversal = motion_.at(corner_.reversal);
    R_ << inner_->residual(), motion_.excess(corner_, p_), anchor.d1, reversal.d1;
    if (needs == Needs::residual) return result;
    auto& J = std::get<Eigen::MatrixXd>(jacobian_);
    J.setZero();
    J.topLeftCorner(n_, n_) = std::get<Eigen::MatrixXd>(inner_->jacobian());
    inner_->parameter_derivative(model::frequency, J.col(n_).head(n_));
    gradient_.setZero();
    motion_.add_excess_gradient(corner_, p_, gradient_);
    J.row(n_).head(n_) = gradient_.transpose();
    const double factor = 0.5 * corner_.slip_sign * motion_.stiffness(p_);
    J(n_, n_ + 1) = -factor * anchor.d1;
    J(n_, n_ + 2) = factor * reversal.d1;
    set_slope_row(n_ + 1, corner_.anchor, anchor.d2);
    set_slope_row(n_ + 2, corner_.reversal, reversal.d2);
    return result;
  }
  const Vector& residual() const override { return R_; }
  const continuation::Jacobian& jacobian() const override { return jacobian_; }
  void parameter_derivative(int k, continuation::Out dR) const override {
    dR.setZero();
    if (k == model::frequency) return;
    inner_->parameter_derivative(k, dR.head(n_));
    dR[n_] = motion_.excess_derivative(corner_, p_, k);
  }

 private:
  void set_slope_row(Eigen::Index row, double theta, double second) {
    auto& J = std::get<Eigen::MatrixXd>(jacobian_);
    gradient_.setZero();
    motion_.add_slope(theta, 1, gradient_);
    J.row(row).head(n_) = gradient_.transpose();
    J(row, row) = second;
  }

  std::shared_ptr<const HbmProblem> problem_;
  SlipCorner corner_;
  Eigen::Index n_;
  std::unique_ptr<HbmEvaluator> inner_;
  Motion motion_;
  Vector p_, R_, gradient_;
  continuation::Jacobian jacobian_;
};

class SlipCornerProblem final : public continuation::Problem {
 public:
  SlipCornerProblem(std::shared_ptr<const HbmProblem> problem, const SlipCorner& corner)
      : problem_(std::move(problem)), corner_(corner) {}
  int size() const override { return problem_->size() + 3; }
  std::span<const continuation::Parameter> parameters() const override { return problem_->parameters(); }
  Vector scales() const override {
    Vector scales(size());
    scales << problem_->scales(), problem_->parameters()[model::frequency].scale, 1, 1;
    return scales;
  }
  std::unique_ptr<continuation::Evaluator> evaluator() const override {
    return std::make_unique<SlipCornerEvaluator>(problem_, corner_);
  }

 private:
  std::shared_ptr<const HbmProblem> problem_;
  SlipCorner corner_;
};

}  // namespace

std::optional<double> slip_excess(const HbmProblem& problem, SlipCorner& corner, In u, In p) {
  Motion motion(problem, corner.element);
  motion.of(u);
  if (!polish(motion, corner.anchor_sign, corner.anchor) ||
      !polish(motion, corner.slip_sign, corner.reversal))
    return {};
  return motion.excess(corner, p);
}

double slip_excess_size(const HbmProblem& problem, const SlipCorner& corner, In u, In p) {
  Motion motion(problem, corner.element);
  motion.of(u);
  return motion.size(p);
}

double slip_limit(const HbmProblem& problem, int element, In p) {
  const auto& parameters = problem.model().elements[static_cast<std::size_t>(element)].parameters;
  return p[parameters[1]] * p[parameters[2]];
}

void slip_excess_gradient(const HbmProblem& problem, const SlipCorner& corner, In p, Out dh) {
  dh.setZero();
  Motion(problem, corner.element).add_excess_gradient(corner, p, dh);
}

void slip_excess_direction(const HbmProblem& problem, const SlipCorner& corner, In u, In p, Out d) {
  slip_excess_gradient(problem, corner, p, d);
  const Harmonics& harmonics = problem.harmonics();
  const Eigen::Index c = harmonics.size(), coordinates = u.size() / c;
  const Eigen::Map<const Eigen::MatrixXd> motion(u.data(), c, coordinates);
  Eigen::Map<Eigen::MatrixXd> along(d.data(), c, coordinates);
  const double none = no_harmonic * u.cwiseAbs().maxCoeff();
  const auto has = [&](Eigen::Index k) { return motion.row(k).cwiseAbs().maxCoeff() > none; };
  if (!harmonics.odd && !has(0)) along.row(0).setZero();
  for (int j = 0; j < harmonics.sines(); ++j) {
    const int n = harmonics.sine_order(j), cosine = harmonics.cosine_index(n), sine = harmonics.sine_index(n);
    if (has(cosine) || has(sine)) continue;
    along.row(cosine).setZero();
    along.row(sine).setZero();
  }
}

double slip_excess_derivative(const HbmProblem& problem, const SlipCorner& corner, In u, In p, int k) {
  Motion motion(problem, corner.element);
  motion.of(u);
  return motion.excess_derivative(corner, p, k);
}

std::vector<SlipCorner> slip_corners_near(const HbmProblem& problem, In u, In p, double tolerance) {
  std::vector<SlipCorner> near;
  const auto& elements = problem.model().elements;
  for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
    if (elements[static_cast<std::size_t>(e)].law != model::Law::jenkins) continue;
    Motion motion(problem, e);
    const Vector& w = motion.of(u);
    const double limit = motion.limit(p);
    if (!(limit > 0)) continue;
    const auto add = [&](const SlipCorner& corner) {
      const double size = corner.anchor_sign == corner.slip_sign ? motion.size(p) : limit;
      if (std::abs(motion.excess(corner, p)) <= tolerance * size &&
          !is_listed(near, corner, motion.harmonics(), w))
        near.push_back(corner);
    };
    elements::FrictionPhases phases(motion.harmonics());
    elements::Reversals reversals(motion.harmonics());
    const auto& all = phases.find(w, limit / motion.stiffness(p));
    const auto& turns = reversals.find(w);
    if (turns.empty()) continue;
    if (all.empty()) {
      const auto &highest = phases.highest(), &lowest = phases.lowest();
      add({e, lowest.theta, highest.theta, -1, 1});
      add_of_stick(motion, turns, highest.x, lowest.x, e, add);
      continue;
    }
    for (const auto& phase : all) {
      if (phase.slip_end > phase.end) add({e, phase.begin, phase.slip_end, phase.sign, phase.slip_sign});
      const double span = motion.harmonics().span();
      for (const auto& turn : turns) {
        double theta = turn.theta;
        while (theta <= phase.begin + same_place) theta += span;
        if (theta < phase.end - same_place)
          add({e, phase.begin, theta, phase.sign, motion.at(theta).d2 < 0 ? 1.0 : -1.0});
      }
    }
  }
  return near;
}

std::shared_ptr<const continuation::Problem> slip_corner_points(std::shared_ptr<const HbmProblem> problem,
                                                                const SlipCorner& corner) {
  return std::make_shared<SlipCornerProblem>(std::move(problem), corner);
}

CornerSides::CornerSides(std::shared_ptr<const HbmProblem> problem, const SlipCorner& corner,
                         continuation::Quantity quantity)
    : problem_(std::move(problem)),
      corner_(corner),
      quantity_(std::move(quantity)),
      evaluator_(problem_->hbm_evaluator()),
      border_(problem_->size(), 1),
      dh_(problem_->size()),
      dq_(problem_->size()),
      t_(problem_->size() + 1),
      scales_(problem_->size() + 1) {
  scales_ << problem_->scales(), problem_->parameters()[model::frequency].scale;
}

CornerSlopes CornerSides::slopes(In x, In p) {
  const Eigen::Index n = problem_->size();
  const double none = std::numeric_limits<double>::quiet_NaN();
  u_ = x.head(n);
  p_ = p;
  p_[model::frequency] = x[n];
  CornerSlopes slopes{none, none, 0};
  corner_.anchor = x[n + 1];
  corner_.reversal = x[n + 2];
  slip_excess_direction(*problem_, corner_, u_, p_, dh_);
  slopes.slip = slope(1, slopes.direction);
  slopes.stick = slope(-1, slopes.direction);
  return slopes;
}

// The border row is grad h: the solution points to growing h, and the sign of the determinant says whether
// that is the orientation.
double CornerSides::slope(double side, int& direction) {
  const Eigen::Index n = problem_->size();
  const double none = std::numeric_limits<double>::quiet_NaN();
  beside_ = u_ + side * beside * slip_excess_size(*problem_, corner_, u_, p_) / dh_.squaredNorm() * dh_;
  if (evaluator_->move_to(beside_, p_, Needs::jacobian) != Evaluated::ok) return none;
  evaluator_->parameter_derivative(model::frequency, border_.columns.col(0));
  border_.rows.col(0) = dh_;
  border_.corner(0, 0) = 0;
  if (!solver_) solver_ = continuation::suitable_solver(evaluator_->jacobian());
  if (!solver_->factorize(evaluator_->jacobian(), border_)) return none;
  t_ = Vector::Unit(n + 1, n);
  solver_->solve(t_);
  direction = solver_->determinant_sign().value_or(1);
  t_ *= direction / t_.cwiseQuotient(scales_).norm();
  quantity_.gradient(*evaluator_, beside_, p_, dq_);
  return dq_.dot(t_.head(n)) +
         quantity_.parameter_derivative(*evaluator_, beside_, p_, model::frequency) * t_[n];
}

}  // namespace arcslip::hbm
