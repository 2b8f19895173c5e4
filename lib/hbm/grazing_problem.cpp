#include <arcslip/hbm/grazing_problem.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::hbm {
namespace {

using continuation::Evaluated;
using continuation::Needs;

constexpr double side_distance = 1e-11;  // of the size of h: so far from h = 0 the sides are looked at
constexpr double no_harmonic = 1e-11;    // of the largest coefficient: what is less is rounding

// The corners of one element, from the unknowns.
class ElementCorners {
 public:
  ElementCorners(const HbmProblem& problem, int element)
      : part_(problem.model().elements[static_cast<std::size_t>(element)]),
        map_(problem.map_of(static_cast<std::size_t>(element))),
        corners_(part_.law->corners(problem.harmonics())),
        at_(map_.size(), 0, static_cast<Eigen::Index>(part_.field_count)),
        w_(map_.size()),
        fields_(part_.field_count) {}

  bool any() const { return corners_ != nullptr; }
  elements::Corners& at(In u, In p) {
    map_.gather(u, w_);
    part_.set_fields(p, fields_);
    p_ = p;
    return *corners_;
  }
  const Vector& motion() const { return w_; }
  const std::vector<double>& fields() const { return fields_; }

  // h and the equations of its angles. The reference holds until the next call.
  const elements::Corners::Equations& equations(const elements::Corner& corner, In u, In p) {
    at(u, p);
    const auto angles = static_cast<int>(corner.angles.size());
    if (at_.by_angle.cols() != angles) at_ = {map_.size(), angles, static_cast<Eigen::Index>(fields_.size())};
    corners_->equations(corner, w_, fields_, at_);
    return at_;
  }
  // h after these, with the angles eliminated: its row becomes that of the total derivatives.
  void eliminate_angles() {
    const Eigen::Index angles = at_.by_angle.cols();
    if (at_.by_angle.row(0).isZero(0)) return;
    const Vector by_equation =
        continuation::solve(at_.by_angle.bottomRows(angles).transpose(), at_.by_angle.row(0).transpose());
    at_.by_motion.row(0) -= by_equation.transpose() * at_.by_motion.bottomRows(angles);
    at_.by_field.row(0) -= by_equation.transpose() * at_.by_field.bottomRows(angles);
  }
  // d(row)/dp_k after these.
  double parameter_derivative(Eigen::Index row, int k) const {
    double sum = 0;
    for (const model::Share& share : part_.shares)
      if (share.number.depends_on(k))
        sum += share.factor * share.number.rate(p_, k) * at_.by_field(row, share.field);
    return sum;
  }
  // g = d(row)/du.
  void gradient(Eigen::Index row, Out g) {
    g.setZero();
    w_ = at_.by_motion.row(row).transpose();
    map_.add(w_, g);
  }

 private:
  const model::NonlinearPart& part_;
  ElementMap map_;
  std::unique_ptr<elements::Corners> corners_;
  elements::Corners::Equations at_;
  Vector w_, p_;
  std::vector<double> fields_;
};

class CornerEvaluator final : public continuation::Evaluator {
 public:
  CornerEvaluator(std::shared_ptr<const HbmProblem> problem, const Corner& corner)
      : problem_(std::move(problem)),
        corner_(corner),
        n_(problem_->size()),
        inner_(problem_->hbm_evaluator()),
        corners_(*problem_, corner.element),
        R_(n_ + 1 + static_cast<Eigen::Index>(corner.angles.size())),
        gradient_(n_),
        jacobian_(Eigen::MatrixXd(R_.size(), R_.size())) {}

  Evaluated move_to(continuation::In x, continuation::In p, Needs needs) override {
    p_ = p;
    p_[model::frequency] = x[n_];
    const Evaluated result = inner_->move_to(x.head(n_), p_, needs);
    if (result != Evaluated::ok) return result;
    for (std::size_t i = 0; i < corner_.angles.size(); ++i)
      corner_.angles[i] = x[n_ + 1 + static_cast<Eigen::Index>(i)];
    const auto& at = corners_.equations(corner_, x.head(n_), p_);
    if (!(corners_.motion().norm() > 0)) return Evaluated::outside_domain;
    R_ << inner_->residual(), at.values;
    if (needs == Needs::residual) return result;
    auto& J = std::get<Eigen::MatrixXd>(jacobian_);
    J.setZero();
    J.topLeftCorner(n_, n_) = std::get<Eigen::MatrixXd>(inner_->jacobian());
    inner_->parameter_derivative(model::frequency, J.col(n_).head(n_));
    J.block(n_, n_ + 1, at.by_angle.rows(), at.by_angle.cols()) = at.by_angle;
    for (Eigen::Index row = 0; row < at.values.size(); ++row) {
      corners_.gradient(row, gradient_);
      J.row(n_ + row).head(n_) = gradient_.transpose();
    }
    return result;
  }
  const Vector& residual() const override { return R_; }
  const continuation::Jacobian& jacobian() const override { return jacobian_; }
  void parameter_derivative(int k, continuation::Out dR) const override {
    dR.setZero();
    if (k == model::frequency) return;
    inner_->parameter_derivative(k, dR.head(n_));
    for (Eigen::Index row = 0; n_ + row < dR.size(); ++row)
      dR[n_ + row] = corners_.parameter_derivative(row, k);
  }

 private:
  std::shared_ptr<const HbmProblem> problem_;
  Corner corner_;
  Eigen::Index n_;
  std::unique_ptr<HbmEvaluator> inner_;
  ElementCorners corners_;
  Vector p_, R_, gradient_;
  continuation::Jacobian jacobian_;
};

class CornerProblem final : public continuation::Problem {
 public:
  CornerProblem(std::shared_ptr<const HbmProblem> problem, const Corner& corner)
      : problem_(std::move(problem)), corner_(corner) {}
  int size() const override { return problem_->size() + 1 + static_cast<int>(corner_.angles.size()); }
  std::span<const continuation::Parameter> parameters() const override { return problem_->parameters(); }
  Vector scales() const override {
    Vector scales(size());
    scales << problem_->scales(), problem_->parameters()[model::frequency].scale,
        Vector::Ones(static_cast<Eigen::Index>(corner_.angles.size()));
    return scales;
  }
  std::unique_ptr<continuation::Evaluator> evaluator() const override {
    return std::make_unique<CornerEvaluator>(problem_, corner_);
  }

 private:
  std::shared_ptr<const HbmProblem> problem_;
  Corner corner_;
};

}  // namespace

std::optional<double> corner_excess(const HbmProblem& problem, Corner& corner, In u, In p) {
  ElementCorners corners(problem, corner.element);
  if (!corners.at(u, p).polish(corner, corners.motion(), corners.fields())) return {};
  return corners.equations(corner, u, p).values[0];
}

double corner_size(const HbmProblem& problem, const Corner& corner, In u, In p) {
  ElementCorners corners(problem, corner.element);
  elements::Corners& at = corners.at(u, p);
  return at.size(corner, corners.motion(), corners.fields());
}

void corner_gradient(const HbmProblem& problem, const Corner& corner, In u, In p, Out dh) {
  ElementCorners corners(problem, corner.element);
  corners.equations(corner, u, p);
  corners.eliminate_angles();
  corners.gradient(0, dh);
}

void corner_direction(const HbmProblem& problem, const Corner& corner, In u, In p, Out d) {
  corner_gradient(problem, corner, u, p, d);
  const Harmonics& harmonics = problem.harmonics();
  const Eigen::Index c = harmonics.size(), blocks = u.size() / c;
  const Eigen::Map<const Eigen::MatrixXd> motion(u.data(), c, blocks);
  Eigen::Map<Eigen::MatrixXd> along(d.data(), c, blocks);
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

double corner_derivative(const HbmProblem& problem, const Corner& corner, In u, In p, int k) {
  ElementCorners corners(problem, corner.element);
  corners.equations(corner, u, p);
  corners.eliminate_angles();
  return corners.parameter_derivative(0, k);
}

std::vector<Corner> corners_near(const HbmProblem& problem, In u, In p, double tolerance) {
  std::vector<Corner> found;
  for (int e = 0; e < static_cast<int>(problem.model().elements.size()); ++e) {
    ElementCorners corners(problem, e);
    if (!corners.any()) continue;
    elements::Corners& at = corners.at(u, p);
    for (auto& corner : at.near(corners.motion(), corners.fields(), tolerance))
      found.push_back({std::move(corner), e});
  }
  return found;
}

Vector with_angles(const Vector& x, const Corner& corner) {
  const auto count = static_cast<Eigen::Index>(corner.angles.size());
  Vector all(x.size() + count);
  all << x, Eigen::Map<const Vector>(corner.angles.data(), count);
  return all;
}

Corner at_angles(Corner corner, const Vector& unknowns) {
  const auto count = static_cast<Eigen::Index>(corner.angles.size());
  for (Eigen::Index i = 0; i < count; ++i)
    corner.angles[static_cast<std::size_t>(i)] = unknowns[unknowns.size() - count + i];
  return corner;
}

std::shared_ptr<const continuation::Problem> corner_points(std::shared_ptr<const HbmProblem> problem,
                                                           const Corner& corner) {
  return std::make_shared<CornerProblem>(std::move(problem), corner);
}

CornerSides::CornerSides(std::shared_ptr<const HbmProblem> problem, const Corner& corner,
                         continuation::StationaryQuantity quantity)
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
  corner_ = at_angles(std::move(corner_), x);
  corner_direction(*problem_, corner_, u_, p_, dh_);
  slopes.above = slope(1, slopes.direction);
  slopes.below = slope(-1, slopes.direction);
  return slopes;
}

// The border row is grad h: the solution points towards increasing h, and the sign of the determinant shows
// whether that is the orientation.
double CornerSides::slope(double side, int& direction) {
  const Eigen::Index n = problem_->size();
  const double none = std::numeric_limits<double>::quiet_NaN();
  nearby_ = u_ + side * side_distance * corner_size(*problem_, corner_, u_, p_) / dh_.squaredNorm() * dh_;
  if (evaluator_->move_to(nearby_, p_, Needs::jacobian) != Evaluated::ok) return none;
  evaluator_->parameter_derivative(model::frequency, border_.columns.col(0));
  border_.rows.col(0) = dh_;
  border_.corner(0, 0) = 0;
  if (!solver_) solver_ = continuation::suitable_solver(evaluator_->jacobian());
  if (!solver_->factorize(evaluator_->jacobian(), border_)) return none;
  t_ = Vector::Unit(n + 1, n);
  solver_->solve(t_);
  direction = solver_->determinant_sign().value_or(1);
  t_ *= direction / t_.cwiseQuotient(scales_).norm();
  quantity_.gradient(*evaluator_, nearby_, p_, dq_);
  return dq_.dot(t_.head(n)) +
         quantity_.parameter_derivative(*evaluator_, nearby_, p_, model::frequency) * t_[n];
}

}  // namespace arcslip::hbm
