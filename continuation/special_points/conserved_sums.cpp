#include <arcslip/continuation/special_points/conserved_sums.hpp>

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>
#include <arcslip/continuation/special_points/dependent_equations.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr int confirming_places = 3;
constexpr double far_from_the_place = 0.03;    // of u, or its scales
constexpr double largest_null_product = 1e-7;  // of l J, relative: J may come from differences
constexpr double no_term = 1e-9;               // of the largest coefficient of a sum

// Whether l J = 0 at places around u.
bool is_null_vector_of_J(const Problem& problem, const Vector& u, const Vector& p, const Vector& l) {
  const auto at = problem.evaluator();
  const Vector scales = problem.scales();
  for (int place = 0; place < confirming_places; ++place) {
    Vector x = u;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x[i] += far_from_the_place * std::max(std::abs(u[i]), scales[i]) *
              std::sin(0.7 + 1.9 * static_cast<double>(i) + 2.3 * place);
    if (at->move_to(x, p, Needs::jacobian) != Evaluated::ok) return false;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      Vector column(x.size());
      apply(at->jacobian(), Vector::Unit(x.size(), j), column);
      if (std::abs(l.dot(column)) > largest_null_product * l.norm() * column.norm()) return false;
    }
  }
  return true;
}

// The row of a sum: the equation that no other sum has a part of.
Eigen::Index pivot_of(const Matrix& L, Eigen::Index k) {
  const double largest = L.row(k).cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < L.cols(); ++j) {
    bool alone = std::abs(L(k, j)) > no_term * largest;
    for (Eigen::Index i = 0; i < L.rows(); ++i)
      alone = alone && (i == k || std::abs(L(i, j)) <= no_term * L.row(i).cwiseAbs().maxCoeff());
    if (alone) return j;
  }
  throw std::invalid_argument("the conserved sums depend on each other");
}

struct SumsOfProblem {
  std::shared_ptr<const Problem> problem;
  ConservedSums sums;
  Vector u0;
  std::vector<Parameter> parameters;

  Eigen::Index inner_parameters() const {
    return static_cast<Eigen::Index>(parameters.size()) - sums.L.rows();
  }
};

class ClosedEvaluator final : public Evaluator {
 public:
  explicit ClosedEvaluator(std::shared_ptr<const SumsOfProblem> of)
      : of_(std::move(of)),
        inner_(of_->problem->evaluator()),
        F_(of_->u0.size()),
        p_(of_->inner_parameters()) {
    J_ = inner_->jacobian();
  }

  Evaluated move_to(In u, In p, Needs needs) override {
    p_ = p.head(p_.size());
    const Evaluated result = inner_->move_to(u, p_, needs);
    if (result != Evaluated::ok) return result;
    F_ = inner_->residual();
    const ConservedSums& sums = of_->sums;
    for (std::size_t k = 0; k < sums.rows.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      F_[sums.rows[k]] = sums.L.row(i).dot(u - of_->u0) - p[p_.size() + i];
    }
    if (needs == Needs::jacobian) take_jacobian();
    return Evaluated::ok;
  }

  const Vector& residual() const override { return F_; }
  const Jacobian& jacobian() const override { return J_; }

  void parameter_derivative(int k, Out dF) const override {
    if (k < p_.size()) {
      inner_->parameter_derivative(k, dF);
      clear(dF);
    } else {
      dF.setZero();
      dF[of_->sums.rows[static_cast<std::size_t>(k - p_.size())]] = -1;
    }
  }

  bool second_derivative(In w, In v, In q, Out du, Out dp) const override {
    Vector left = w;
    clear(left);
    dp.setZero();
    return inner_->second_derivative(left, v, q.head(p_.size()), du, dp.head(p_.size()));
  }

  bool directional_derivative(int order, In v, In q, Out d) const override {
    if (!inner_->directional_derivative(order, v, q.head(p_.size()), d)) return false;
    clear(d);
    return true;
  }

  ByDifferences by_differences() const override { return inner_->by_differences(); }
  void set_state(In state) override { inner_->set_state(state); }
  void next_state(Out state) const override { inner_->next_state(state); }
  std::uint64_t piece() const override { return inner_->piece(); }
  Evaluated test_piece(In u, In p, std::uint64_t piece, PieceTest test, bool& inside) override {
    return inner_->test_piece(u, p.head(p_.size()), piece, test, inside);
  }

 private:
  void clear(Eigen::Ref<Vector> of_rows) const {
    for (const Eigen::Index row : of_->sums.rows) of_rows[row] = 0;
  }

  void take_jacobian() {
    const ConservedSums& sums = of_->sums;
    if (const auto* full = std::get_if<Matrix>(&inner_->jacobian())) {
      Matrix& J = std::get<Matrix>(J_);
      J = *full;
      for (std::size_t k = 0; k < sums.rows.size(); ++k)
        J.row(sums.rows[k]) = sums.L.row(static_cast<Eigen::Index>(k));
      return;
    }
    const auto& sparse = std::get<SparseMatrix>(inner_->jacobian());
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<bool> replaced(static_cast<std::size_t>(sparse.rows()));
    for (const Eigen::Index row : sums.rows) replaced[static_cast<std::size_t>(row)] = true;
    for (int j = 0; j < sparse.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(sparse, j); it; ++it)
        if (!replaced[static_cast<std::size_t>(it.row())])
          entries.emplace_back(static_cast<int>(it.row()), j, it.value());
    for (std::size_t k = 0; k < sums.rows.size(); ++k)
      for (Eigen::Index j = 0; j < sums.L.cols(); ++j)
        if (sums.L(static_cast<Eigen::Index>(k), j) != 0)
          entries.emplace_back(static_cast<int>(sums.rows[k]), static_cast<int>(j),
                               sums.L(static_cast<Eigen::Index>(k), j));
    SparseMatrix& J = std::get<SparseMatrix>(J_);
    J.setFromTriplets(entries.begin(), entries.end());
    J.makeCompressed();
  }

  std::shared_ptr<const SumsOfProblem> of_;
  std::unique_ptr<Evaluator> inner_;
  Vector F_, p_;
  Jacobian J_;
};

class ClosedProblem final : public Problem {
 public:
  explicit ClosedProblem(std::shared_ptr<const SumsOfProblem> of) : of_(std::move(of)) {}
  int size() const override { return of_->problem->size(); }
  std::span<const Parameter> parameters() const override { return of_->parameters; }
  Vector scales() const override { return of_->problem->scales(); }
  bool metric(In v, Out Mv) const override { return of_->problem->metric(v, Mv); }
  std::unique_ptr<Evaluator> evaluator() const override { return std::make_unique<ClosedEvaluator>(of_); }
  Vector initial_state() const override { return of_->problem->initial_state(); }
  bool cheap_residual() const override { return of_->problem->cheap_residual(); }
  bool chord_pays() const override { return of_->problem->chord_pays(); }
  bool smooth() const override { return of_->problem->smooth(); }
  bool is_unknown(int k) const override { return k < of_->inner_parameters() && of_->problem->is_unknown(k); }
  std::unique_ptr<LinearSolver> linear_solver() const override { return of_->problem->linear_solver(); }
  std::shared_ptr<const Problem> with_scale(int k, double scale) const override {
    auto scaled = std::make_shared<SumsOfProblem>(*of_);
    scaled->parameters[static_cast<std::size_t>(k)].scale = scale;
    if (k < of_->inner_parameters())
      if (auto inner = of_->problem->with_scale(k, scale)) scaled->problem = std::move(inner);
    return std::make_shared<const ClosedProblem>(std::move(scaled));
  }

 private:
  std::shared_ptr<const SumsOfProblem> of_;
};

void check_sums(const Problem& problem, const ConservedSums& sums, const Vector& u0,
                const std::vector<std::string>& names) {
  const Eigen::Index n = problem.size(), k = sums.L.rows();
  if (u0.size() != n || (k > 0 && sums.L.cols() != n) || static_cast<Eigen::Index>(sums.rows.size()) != k)
    throw std::invalid_argument("the conserved sums are " + std::to_string(k) + " x " +
                                std::to_string(sums.L.cols()) + " with " + std::to_string(sums.rows.size()) +
                                " rows at " + std::to_string(u0.size()) + " unknowns, the problem has " +
                                std::to_string(n));
  for (const Eigen::Index row : sums.rows)
    if (row < 0 || row >= n)
      throw std::invalid_argument("a conserved sum takes the place of equation " + std::to_string(row) +
                                  " of " + std::to_string(n));
  for (auto row = sums.rows.begin(); row != sums.rows.end(); ++row)
    if (std::find(sums.rows.begin(), row, *row) != row)
      throw std::invalid_argument("two conserved sums take the place of equation " + std::to_string(*row));
  if (!names.empty() && static_cast<Eigen::Index>(names.size()) != k)
    throw std::invalid_argument(std::to_string(names.size()) + " names for " + std::to_string(k) +
                                " conserved sums");
  if (std::holds_alternative<const Operator*>(problem.evaluator()->jacobian()))
    throw std::invalid_argument(
        "conserved sums take the place of rows of the Jacobian, which is an operator");
}

}  // namespace

ConservedSums conserved_sums(const Problem& problem, const Vector& u, const Vector& p, int along) {
  const auto parameters = static_cast<Eigen::Index>(problem.parameters().size());
  if (u.size() != problem.size() || p.size() != parameters || along < 0 || along >= parameters)
    throw std::invalid_argument(std::to_string(u.size()) + " unknowns and " + std::to_string(p.size()) +
                                " parameters with " + std::to_string(along) + " moved, the problem has " +
                                std::to_string(problem.size()) + " and " + std::to_string(parameters));
  ConservedSums found;
  Vector v(u.size() + 1);
  v << u, p[along];
  try {
    const auto L = dependent_combinations(problem, v, p, along);
    found.L.resize(0, u.size());
    for (Eigen::Index k = 0; L && k < L->rows(); ++k) {
      Vector l = L->row(k);
      const double largest = l.cwiseAbs().maxCoeff();
      l = (l.array().abs() <= no_term * largest).select(0, l);
      if (!is_null_vector_of_J(problem, u, p, l)) continue;
      found.L.conservativeResize(found.L.rows() + 1, Eigen::NoChange);
      found.L.bottomRows(1) = l.transpose();
      found.words.push_back(words_of_sum(l, "u"));
    }
  } catch (const std::exception&) {  // F cannot be evaluated, as it says
    return {Matrix(0, u.size()), {}, {}};
  }
  for (Eigen::Index k = 0; k < found.L.rows(); ++k) found.rows.push_back(pivot_of(found.L, k));
  return found;
}

std::shared_ptr<const Problem> with_conserved_sums(std::shared_ptr<const Problem> problem, ConservedSums sums,
                                                   const Vector& u0, std::vector<std::string> names) {
  check_sums(*given(problem), sums, u0, names);
  auto of = std::make_shared<SumsOfProblem>();
  const auto all = problem->parameters();
  of->parameters.assign(all.begin(), all.end());
  for (Eigen::Index k = 0; k < sums.L.rows(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    of->parameters.push_back({names.empty() ? "sum_" + std::to_string(k + 1) : names[i], ""});
  }
  check_parameters(of->parameters);
  of->problem = std::move(problem);
  of->sums = std::move(sums);
  of->u0 = u0;
  return std::make_shared<const ClosedProblem>(std::move(of));
}

}  // namespace arcslip::continuation
