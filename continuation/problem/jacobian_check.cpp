#include <arcslip/continuation/problem/jacobian_check.hpp>

#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/continuation/problem/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <variant>
#include <vector>

namespace arcslip::continuation {
namespace {

constexpr double wider = 4;         // another step, in steps
constexpr double agreement = 1e-4;  // relative differences below are not worth a message

bool is_difference(const Evaluator& at, Eigen::Index n, Eigen::Index column) {
  const ByDifferences by = at.by_differences();
  return column < n ? by.jacobian : by.parameters;
}

}  // namespace

JacobianError check_jacobian(const Problem& problem, In u, In p) {
  const Eigen::Index n = problem.size();
  const auto parameters = problem.parameters();
  if (u.size() != n || p.size() != static_cast<Eigen::Index>(parameters.size()))
    throw std::invalid_argument("the point has " + std::to_string(u.size()) + " unknowns and " +
                                std::to_string(p.size()) + " parameters, the problem has " +
                                std::to_string(n) + " and " + std::to_string(parameters.size()));
  const Vector scales = problem.scales();
  const auto here = problem.evaluator(), nearby = problem.evaluator();
  JacobianError worst;
  if (here->move_to(u, p, Needs::jacobian) != Evaluated::ok) return worst;
  Vector at_u = u, at_p = p, column(n), plus(n), unit = Vector::Zero(n);
  const auto rounding = std::numeric_limits<double>::epsilon() * here->residual().cwiseAbs().maxCoeff();

  const auto compare = [&](int index, double& x, double scale) {
    const double at = x, h = difference_step * std::max(std::abs(at), scale);
    x = at + h;
    bool usable =
        nearby->move_to(at_u, at_p, Needs::residual) == Evaluated::ok && nearby->piece() == here->piece();
    plus = nearby->residual();
    x = at - h;
    usable = usable && nearby->move_to(at_u, at_p, Needs::residual) == Evaluated::ok &&
             nearby->piece() == here->piece();
    x = at;
    if (!usable) return;
    const Vector difference = (plus - nearby->residual()) / (2 * h);
    // Differences of another step size show the accuracy.
    x = at + wider * h;
    if (nearby->move_to(at_u, at_p, Needs::residual) == Evaluated::ok) plus = nearby->residual();
    x = at - wider * h;
    if (nearby->move_to(at_u, at_p, Needs::residual) == Evaluated::ok) plus -= nearby->residual();
    x = at;
    const double doubt = (plus / (2 * wider * h) - difference).cwiseAbs().maxCoeff();
    const double size = std::max(difference.cwiseAbs().maxCoeff(), column.cwiseAbs().maxCoeff()) +
                        rounding / h + (nearby->piece() == here->piece() ? doubt : 0.0) / agreement;
    if (size == 0) return;
    Eigen::Index row = 0;
    const double relative = (difference - column).cwiseAbs().maxCoeff(&row) / size;
    if (!(relative > worst.relative)) return;
    worst = {static_cast<int>(row),          index, column[row], difference[row], relative,
             is_difference(*here, n, index), {}};
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    unit[j] = 1;
    apply(here->jacobian(), unit, column);
    unit[j] = 0;
    compare(static_cast<int>(j), at_u[j], scales[j]);
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto index = static_cast<Eigen::Index>(k);
    here->parameter_derivative(static_cast<int>(k), column);
    compare(static_cast<int>(n + index), at_p[index], parameters[k].change());
  }
  if (worst.relative > agreement) worst.message = describe(worst, problem);
  return worst;
}

// Check of J and dF/dp by differences along a few directions, affordable within a trace for any number
// of unknowns.
//
// Along a generic direction d, e(h) = J d - [F(x + h d) - F(x - h d)] / 2h is at rounding level if J is
// correct. Otherwise it may be the error of the differences: noise and rounding grow like 1/h, the truncation
// error like h^2, and next to a kink the one-sided differences disagree. An error of J is independent of h: J
// is reported as wrong if e(h) is the same for steps in the ratio 1 : 8 : 64 and both sides agree. The row is
// that of the largest e, and bisection finds the column with log2(n) further differences.

namespace {

constexpr double first_step = 6e-6;    // the cube root of the rounding
constexpr double ratio = 8;            // of neighbouring steps
constexpr int finer = 3, coarser = 3;  // steps than the first one
constexpr double same = 0.2;           // of e, from step to step
constexpr double one_sided = 0.25;     // of e: the most by which the differences to the two sides may differ
constexpr double roundings = 1e2;      // of F, which a change along d has to exceed
constexpr double next_share = 1e-4, last_share = 1e-13;  // of the scale of p
constexpr double least_change = 0.1;                     // of the given one
constexpr double looks_reach = 512;                      // of the steps on both sides of one: ratio^finer

// +-(1/2 .. 1), without a pattern.
double without_pattern(Eigen::Index j) {
  const auto bits = (static_cast<std::uint32_t>(j) + 1) * 2654435769u;
  const double size = 0.5 + 0.5 * static_cast<double>(bits & 0xffffu) / 0xffff;
  return bits >> 31 ? size : -size;
}

// sum_j |J_ij u_j|, the size of the terms of F_i, also of those that cancel in it; 0: not known.
void size_of_terms(const Jacobian& J, In u, Vector& size) {
  size.setZero();
  if (const auto* dense = std::get_if<Matrix>(&J))
    for (Eigen::Index j = 0; j < u.size(); ++j) size += std::abs(u[j]) * dense->col(j).cwiseAbs();
  if (const auto* sparse = std::get_if<SparseMatrix>(&J))
    for (Eigen::Index j = 0; j < u.size(); ++j)
      for (SparseMatrix::InnerIterator entry(*sparse, j); entry; ++entry)
        size[entry.row()] += std::abs(entry.value() * u[j]);
}

class Doubt {
 public:
  Doubt(const Problem& problem, In u, In p, int free)
      : problem_(problem),
        n_(problem.size()),
        free_(free),
        here_(problem.evaluator()),
        nearby_(problem.evaluator()),
        u_(u),
        p_(p),
        at_u_(u),
        at_p_(p),
        F_p_(n_),
        plus_(n_),
        F_d_(n_),
        bend_(n_),
        rounding_(n_),
        given_(n_),
        noise_(Vector::Zero(n_)) {}

  JacobianError find() {
    if (here_->move_to(u_, p_, Needs::jacobian) != Evaluated::ok) return {};
    // The equations of a curve may depend on the first point that their evaluator sees, as by their borders.
    if (nearby_->move_to(u_, p_, Needs::residual) != Evaluated::ok) return {};
    here_->parameter_derivative(free_, F_p_);
    piece_ = here_->piece();
    const Vector scales = problem_.scales();
    for (const bool typical : {true, false}) {  // sizes of unknowns: at least their scales, or what they are
      Vector d = Vector::Zero(n_ + 1);
      for (Eigen::Index j = 0; j < n_; ++j)
        d[j] = without_pattern(j) * (typical ? std::max(std::abs(u_[j]), scales[j]) : std::abs(u_[j]));
      const Verdict by_unknowns = judge(d);
      if (by_unknowns.wrong) return name(by_unknowns, d);
      if (by_unknowns.right) break;
    }
    return find_by_parameter();
  }

 private:
  struct Verdict {
    bool right = false, wrong = false;
    Eigen::Index row = 0;
    double step = 0;
  };

  // The scale of p, as of a wide window, may be far longer than what F bends over, so that differences of all
  // steps are wrong alike. So dF/dp is wrong only where shorter ones, down to those of |p|, agree with it no
  // better. Where F changes far less over these than by the given dF/dp they blame nobody: that may be
  // rounding, or as of p^3 at p = 0, where a given 1e-10 is right over longer steps.
  JacobianError find_by_parameter() {
    const double p = std::abs(p_[free_]), size = std::max(p, parameter().change());
    Verdict wrong;
    Vector along = Vector::Zero(n_ + 1), terms(n_);
    agreed_.setConstant(n_, false);
    size_of_terms(here_->jacobian(), u_, terms);
    for (double share = 1; share > last_share && share * size * looks_reach > p; share *= next_share) {
      Vector d = Vector::Zero(n_ + 1);
      d[n_] = share * size;
      if (here_->by_differences().parameters)
        noise_ = share * std::numeric_limits<double>::epsilon() / difference_step * terms;
      const Verdict found = judge(d, share < 1);
      if (found.right) return {};
      if (!found.wrong) continue;
      wrong = found;
      along = d;
    }
    return wrong.wrong && !agreed_[wrong.row] ? name(wrong, along) : JacobianError{};
  }

  const Parameter& parameter() const { return problem_.parameters()[static_cast<std::size_t>(free_)]; }

  // given_ = J d.
  void multiply(const Vector& d) {
    apply(here_->jacobian(), d.head(n_), given_);
    given_ += d[n_] * F_p_;
  }

  bool look(const Vector& d, double h) {
    at_u_ = u_ + h * d.head(n_);
    at_p_[free_] = p_[free_] + h * d[n_];
    if (at_p_[free_] < parameter().lower || at_p_[free_] > parameter().upper) return false;
    return nearby_->move_to(at_u_, at_p_, Needs::residual) == Evaluated::ok &&
           nearby_->residual().size() == n_ && nearby_->residual().allFinite() && nearby_->piece() == piece_;
  }

  // F_d_, and bend_: how much the differences to the two sides differ. False: not within the piece.
  bool difference(const Vector& d, double h) {
    if (!look(d, h)) return false;
    plus_ = nearby_->residual();
    if (!look(d, -h)) return false;
    const Vector& minus = nearby_->residual();
    F_d_ = (plus_ - minus) / (2 * h);
    rounding_ = (std::numeric_limits<double>::epsilon() / h) * plus_.cwiseAbs().cwiseMax(minus.cwiseAbs());
    bend_ = (plus_ + minus - 2 * here_->residual()).cwiseAbs() / h;
    return F_d_.allFinite();
  }

  double relative(Eigen::Index i) const {
    const double size = std::max(std::abs(given_[i]), std::abs(F_d_[i]));
    return size > 0 ? std::abs(given_[i] - F_d_[i]) / size : 0;
  }

  bool agrees() const {
    for (Eigen::Index i = 0; i < n_; ++i)
      if (relative(i) > largest_jacobian_error) return false;
    return true;
  }

  // Notes the rows that agree.
  bool compare() {
    for (Eigen::Index i = 0; i < n_; ++i)
      agreed_[i] = agreed_[i] || (F_d_[i] != 0 && relative(i) <= largest_jacobian_error);
    return agrees();
  }

  // The middle of the finest three steps that are judged.
  std::size_t finest_middle(bool is_interior) const {
    return is_interior && here_->by_differences().jacobian ? finer - 2 : finer - 1;
  }

  // only_changing: rows that hardly change are not judged.
  Verdict judge(const Vector& d, bool only_changing = false) {
    multiply(d);
    if (d.isZero(0) || !given_.allFinite()) return {};
    agreed_.resize(n_);
    if (difference(d, first_step) && compare()) return {.right = true};
    struct Look {
      bool usable = false;
      Vector error, bend, size, rounding;
    };
    std::vector<Look> looks;
    for (int k = -finer; k <= coarser; ++k) {
      Look& now = looks.emplace_back();
      now.usable = difference(d, first_step * std::pow(ratio, k));
      if (!now.usable) continue;
      compare();
      now.error = given_ - F_d_;
      now.bend = bend_;
      now.rounding = rounding_;
      now.size = given_.cwiseAbs().cwiseMax(F_d_.cwiseAbs());
    }
    Verdict worst;
    double largest = largest_jacobian_error;
    // Finer steps alone would blame a J that is itself computed by differences, at an edge of the domain; in
    // its interior they find a kink that is closer than the step of these.
    for (std::size_t k = finest_middle(looks[finer].usable); k + 1 < looks.size(); ++k) {
      const Look &below = looks[k - 1], &now = looks[k], &above = looks[k + 1];
      if (!below.usable || !now.usable || !above.usable) continue;
      for (Eigen::Index i = 0; i < n_; ++i) {
        const double e = std::abs(now.error[i]);
        if (!(e > largest * now.size[i]) || now.bend[i] > one_sided * e ||
            !(e > roundings * std::max(below.rounding[i], noise_[i])) ||
            (only_changing && std::abs(given_[i] - now.error[i]) < least_change * std::abs(given_[i])) ||
            std::abs(below.error[i] - now.error[i]) > same * e ||
            std::abs(above.error[i] - now.error[i]) > same * e)
          continue;
        largest = e / now.size[i];
        worst = {.wrong = true, .row = i, .step = first_step * std::pow(ratio, static_cast<int>(k) - finer)};
      }
    }
    return worst;
  }

  // By bisection of the columns in d.
  JacobianError name(const Verdict& verdict, const Vector& d) {
    std::vector<Eigen::Index> columns;
    for (Eigen::Index j = 0; j <= n_; ++j)
      if (d[j] != 0) columns.push_back(j);
    Vector part(n_ + 1);
    const auto error = [&](std::size_t begin, std::size_t end) {
      part.setZero();
      for (std::size_t k = begin; k < end; ++k) part[columns[k]] = d[columns[k]];
      multiply(part);
      if (!difference(part, verdict.step)) return std::numeric_limits<double>::quiet_NaN();
      return std::abs(given_[verdict.row] - F_d_[verdict.row]);
    };
    std::size_t begin = 0, end = columns.size();
    while (end - begin > 1) {
      const std::size_t middle = (begin + end) / 2;
      const double left = error(begin, middle), right = error(middle, end);
      (std::isnan(right) || left >= right ? end : begin) = middle;
    }
    if (std::isnan(error(begin, end)) || relative(verdict.row) <= largest_jacobian_error) return {};
    const Eigen::Index j = columns[begin];
    JacobianError found{static_cast<int>(verdict.row),
                        static_cast<int>(j),
                        given_[verdict.row] / d[j],
                        F_d_[verdict.row] / d[j],
                        relative(verdict.row),
                        is_difference(*here_, n_, j),
                        {}};
    if (j == n_) found.column += free_;
    found.message = describe(found, problem_);
    return found;
  }

  const Problem& problem_;
  Eigen::Index n_;
  int free_;
  std::unique_ptr<Evaluator> here_, nearby_;
  Vector u_, p_, at_u_, at_p_, F_p_, plus_, F_d_, bend_, rounding_, given_;
  Vector noise_;  // along d, of a dF/dp that is itself a difference, by the terms that cancel in F
  std::uint64_t piece_ = 0;
  Eigen::Array<bool, Eigen::Dynamic, 1> agreed_;  // rows, with any difference
};

}  // namespace

std::string describe(const JacobianError& worst, const Problem& problem) {
  std::ostringstream text;
  text.precision(6);
  text << "dF[" << worst.row << "]/d";
  const bool of_u = worst.column < problem.size();
  if (of_u)
    text << "u[" << worst.column << "]";
  else
    text << "(" << problem.parameters()[static_cast<std::size_t>(worst.column - problem.size())].name << ")";
  if (!worst.by_differences) {
    text << " is given as " << worst.given << ", finite differences give " << worst.difference;
    return "the Jacobian is wrong: " + text.str();
  }
  text << " is " << worst.given << " by differences with the default step, " << worst.difference
       << " with others: F has a kink, or changes over less than the step: "
       << (of_u ? "give `piece`, `jacobian`, or `scales` of the size of u"
                : "give `piece`, `derivative`, or a `scale` of the parameter");
  return text.str();
}

JacobianError doubt_jacobian(const Problem& problem, In u, In p, int free) {
  try {
    return Doubt(problem, u, p, free).find();
  } catch (const std::exception&) {  // an exception at another point is no error of J
    return {};
  }
}

}  // namespace arcslip::continuation
