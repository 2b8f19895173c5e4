#include <arcslip/analyses/branches/half_branch_entry.hpp>

#include <arcslip/continuation/events/root.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {

using continuation::Vector;

namespace {

constexpr std::size_t points_around = 12;   // points next to an event in which its branch point is looked for
constexpr double absent = 1e-6;             // of a motion: the harmonics that it lacks
constexpr double same_branch_point = 1e-7;  // distance of two branch points, relative
constexpr double resolved_step = 1e-13;     // of a step, in which the zero lies
constexpr double continuous = 1e-5;         // of its change over the step: J_XX jumps across zero
constexpr double singular = 1e-13;          // reciprocal condition where another mode is zero, too
constexpr int bisections = 12;
constexpr int sweeps = 4;  // of inverse iteration

constexpr double longest_entry = 1e-3, shortest_entry = 1e-6;  // relative to 1 + |u|
constexpr double entry_reduction = 0.25;
constexpr double entry_error = 0.25;  // of the distance to other half-branches
constexpr double entry_turn = 0.3;    // of the angle to them

// Of the unknowns of one set of harmonics, those that another one of fewer lacks.
std::vector<int> lacking(const elements::Harmonics& wide, const elements::Harmonics& narrow, int blocks) {
  const auto is_new = [&](int n) {
    const int m = n * narrow.period;
    return m % wide.period != 0 || !narrow.has(m / wide.period);
  };
  std::vector<int> all;
  for (int block = 0; block < blocks; ++block)
    for (int i = 0; i < wide.size(); ++i) {
      const int n = i < wide.cosines() ? wide.cosine_order(i) : wide.sine_order(i - wide.cosines());
      if (is_new(n)) all.push_back(block * wide.size() + i);
    }
  return all;
}

// The singular vectors of the smallest singular value, by inverse iteration.
void smallest(const continuation::LU<double>& J, Vector& left, Vector& right) {
  for (Eigen::Index i = 0; i < right.size(); ++i) right[i] = std::sin(0.7 * static_cast<double>(i * i) + 0.3);
  right.normalize();
  for (int k = 0; k < sweeps; ++k) {
    J.solve_transposed(right, left);
    left.normalize();
    J.solve(left, right);
    right.normalize();
  }
}

}  // namespace

elements::Harmonics without(const elements::Harmonics& harmonics, BrokenSymmetry symmetry) {
  elements::Harmonics wide = harmonics;
  wide.odd = false;
  if (symmetry == BrokenSymmetry::period) {
    wide.order *= 2;
    wide.period *= 2;
  }
  return wide;
}

std::shared_ptr<const hbm::HbmProblem> in_harmonics(const hbm::HbmProblem& problem,
                                                    const elements::Harmonics& harmonics, double about) {
  auto model = std::make_shared<const model::Model>(model::in_harmonics(problem.model(), harmonics));
  return std::make_shared<const hbm::HbmProblem>(std::move(model), harmonics, problem.displacement(),
                                                 problem.parameters()[model::frequency].scale, about);
}

bool within(const hbm::HbmProblem& problem, const Vector& u, const elements::Harmonics& narrow) {
  double square = 0;
  for (const int i : lacking(problem.harmonics(), narrow, problem.blocks())) square += u[i] * u[i];
  return std::sqrt(square) <= absent * u.norm();
}

WiderBranchPoints::WiderBranchPoints(std::shared_ptr<const hbm::HbmProblem> narrow,
                                     std::shared_ptr<const hbm::HbmProblem> wide)
    : narrow_(std::move(narrow)),
      wide_(std::move(wide)),
      at_(wide_->hbm_evaluator()),
      added_(lacking(wide_->harmonics(), narrow_->harmonics(), wide_->blocks())),
      p_(continuation::parameter_values(*wide_)),
      u_(wide_->size()) {}

// Sets u_ and J_.
bool WiderBranchPoints::move_to(const Vector& v) {
  const Eigen::Index n = v.size() - 1;
  elements::transfer(narrow_->harmonics(), v.head(n), wide_->harmonics(), u_);
  p_[model::frequency] = v[n];
  if (at_->move_to(u_, p_, continuation::Needs::jacobian) != continuation::Evaluated::ok) return false;
  J_ = std::get<Eigen::MatrixXd>(at_->jacobian())(added_, added_);
  return J_.allFinite();
}

// Of det J_XX; 0: not known.
int WiderBranchPoints::sign_at(const Vector& v) {
  if (!move_to(v)) return 0;
  lu_.factorize(J_);
  int sign = static_cast<int>(lu_.permutation_sign());
  for (Eigen::Index i = 0; i < J_.rows(); ++i) sign *= lu_.pivot(i) > 0 ? 1 : (lu_.pivot(i) < 0 ? -1 : 0);
  return sign;
}

std::optional<HalfBranch> WiderBranchPoints::locate(const std::vector<Vector>& branch, std::size_t after,
                                                    std::string& why) {
  why = "no branch of these harmonics crosses there; more harmonics may resolve it";
  std::vector<std::optional<int>> signs(branch.size());
  const auto sign = [&](std::size_t i) {
    if (!signs[i]) signs[i] = sign_at(branch[i]);
    return *signs[i];
  };
  const auto in_step = [&](std::size_t i) -> std::optional<HalfBranch> {
    if (i + 1 >= branch.size() || sign(i) * sign(i + 1) >= 0) return {};
    auto found = refine(branch[i], branch[i + 1], why);
    if (!found) return {};
    const auto is_it = [&](const Vector& x) { return (x - found->x).norm() <= same_branch_point * x.norm(); };
    if (std::any_of(found_.begin(), found_.end(), is_it)) return {};
    found_.push_back(found->x);
    return found;
  };
  for (std::size_t d = 0; d <= points_around; ++d) {
    if (auto found = in_step(after + d)) return found;
    if (d == 0 || d > after) continue;
    if (auto found = in_step(after - d)) return found;
  }
  return {};
}

// From u_ and p_, in the direction of a vector of the added unknowns.
HalfBranch WiderBranchPoints::half_branch_along(const Vector& added) const {
  HalfBranch found;
  found.problem = wide_;
  found.x.resize(u_.size() + 1);
  found.x << u_, p_[model::frequency];
  found.direction = Vector::Zero(u_.size() + 1);
  for (std::size_t i = 0; i < added_.size(); ++i)
    found.direction[added_[i]] = added[static_cast<Eigen::Index>(i)];
  continuation::Counts counts;
  const continuation::Corrector with(*wide_, p_, model::frequency, {}, counts);
  found.direction /= std::sqrt(with.dot(found.direction, found.direction));
  found.angle = std::acos(0.0);
  return found;
}

// Between two points of the branch with different signs.
std::optional<HalfBranch> WiderBranchPoints::refine(const Vector& from, const Vector& to, std::string& why) {
  const Eigen::Index n = from.size() - 1;
  continuation::Counts counts;
  continuation::Corrector branch(*narrow_, hbm::parameters_at(*narrow_, from[n]), model::frequency, {},
                                 counts);
  Vector chord = to - from;
  chord /= std::sqrt(branch.dot(chord, chord));
  const Vector row = branch.border_row(chord);
  Vector v;
  const auto place = [&](double share) {
    v = (1 - share) * from + share * to;
    return branch.correct(v, row, false).converged && move_to(v);
  };
  double a = 0, b = 1;
  int sign_a = sign_at(from);
  const auto size = static_cast<Eigen::Index>(added_.size());
  Vector left(size), right(size), solution(size);
  // 1/(right . J_XX^-1 left): of the size of the smallest singular value, and zero with it.
  const auto value = [&](double share) {
    if (!place(share)) return std::nan("");
    lu_.factorize(J_);
    lu_.solve(left, solution);
    return 1 / right.dot(solution);
  };
  for (int k = 0; k < bisections; ++k) {
    if (!place(0.5 * (a + b))) break;
    lu_.factorize(J_);
    smallest(lu_, left, right);
    const double at_a = value(a), at_b = value(b);
    if (at_a * at_b < 0) {
      const auto root = continuation::find_root(value, a, at_a, b, at_b, resolved_step);
      const double least = std::min(std::abs(root.f_lower), std::abs(root.f_upper));
      if (least <= continuous * std::max(std::abs(at_a), std::abs(at_b)) && place(root.x)) {
        lu_.factorize(J_);
        smallest(lu_, left, right);
        lu_.factorize(J_ + J_.norm() * left * right.transpose());
        if (lu_.reciprocal_condition() < singular) {
          why = "several branches cross there at once, as in symmetric structures";
          return {};
        }
        return half_branch_along(right);
      }
    }
    const double middle = 0.5 * (a + b);
    if (!place(middle)) break;
    const Vector there = v;
    const int sign = sign_at(there);
    (sign == sign_a ? a : b) = middle;
  }
  why = "the stiffness of the contacts jumps there, so that the branch that leaves has no tangent of its own";
  return {};
}

std::optional<Entry> enter(const HalfBranch& way, continuation::Corrector& with) {
  const double size = 1 + with.norm_u(way.x);
  const Vector row = with.border_row(way.direction);
  Entry entry;
  entry.tangent.resize(way.x.size());
  for (entry.step = longest_entry * size; entry.step >= shortest_entry * size;
       entry.step *= entry_reduction) {
    const Vector predicted = way.x + entry.step * way.direction;
    entry.v = predicted;
    if (!with.correct(entry.v, row, false).converged || !with.tangent(entry.tangent)) continue;
    const Vector miss = entry.v - predicted;
    if (std::sqrt(with.dot(miss, miss)) > entry_error * std::sin(std::min(way.angle, 1.5)) * entry.step ||
        with.dot(entry.tangent, way.direction) < std::cos(entry_turn * way.angle))
      continue;
    return entry;
  }
  return {};
}

}  // namespace arcslip::observables
