#include <arcslip/time/variation.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::time {
namespace {

constexpr std::size_t most_terms = 64;
constexpr double longest = 2;       // rad of the fastest motion, in one series
constexpr int few = 4;              // series in a row cost less than halving and squaring
constexpr double left_out = 1e-19;  // by the first term that is left out, relative

// The first k with x^k/k! below left_out.
std::size_t terms_of(double x) {
  double term = 1;
  std::size_t k = 0;
  while (term > left_out && k < most_terms) term *= x / static_cast<double>(++k);
  return std::max<std::size_t>(k, 2);
}

}  // namespace

Variable::Variable(const Matrix& over_mass, const Matrix& along, std::size_t powers, bool moving)
    : T(powers, Matrix::Zero(along.cols(), along.cols())), size(over_mass.norm() * along.norm()) {
  if (moving) B = T;
  const auto entries = [](const Matrix& of) {
    std::vector<Entry> all;
    for (Eigen::Index j = 0; j < of.cols(); ++j)
      for (Eigen::Index i = 0; i < of.rows(); ++i)
        if (of(i, j) != 0) all.push_back({i, j, of(i, j)});
    return all;
  };
  onto = entries(over_mass);
  from = entries(along);
}

void Variation::move(double h, double fastest, const Matrix& K, const Matrix& C, const Matrix& G,
                     const std::vector<Variable>& variables, Matrix& W, Matrix& V) {
  if (!(h > 0)) return;
  take(K, C);
  const double pieces = std::max(1.0, std::ceil(h * fastest / longest));
  if (!variables.empty() || pieces <= 1) return series(h, fastest, G, variables, W, V);
  if (pieces > few) return squared(h, fastest, std::ilogb(pieces) + 1, G, W, V);
  for (int i = 0; i < static_cast<int>(pieces); ++i) series(h / pieces, fastest, G, variables, W, V);
}

void Variation::take(const Matrix& K, const Matrix& C) {
  rows_.resize(static_cast<std::size_t>(K.rows()));
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    auto& row = rows_[static_cast<std::size_t>(i)];
    row.clear();
    for (Eigen::Index j = 0; j < K.cols(); ++j)
      if (K(i, j) != 0 || C(i, j) != 0) row.push_back({j, K(i, j), C(i, j)});
  }
}

void Variation::series(double h, double fastest, const Matrix& G, const std::vector<Variable>& variables,
                       Matrix& W, Matrix& V) {
  const std::size_t terms = terms_of(h * fastest);
  const Eigen::Index starts = W.rows();
  w_ = W;
  v_ = V;
  next_w_.resizeLike(W);
  next_v_.resizeLike(V);
  along_w_.resize(variables.size());
  along_v_.resize(variables.size());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const auto columns = static_cast<Eigen::Index>(most_terms) * variables[i].T.front().rows();
    along_w_[i].resize(starts, columns);
    if (!variables[i].B.empty()) along_v_[i].resize(starts, columns);
  }
  for (std::size_t k = 0; k < terms; ++k) {
    const double factor = h / static_cast<double>(k + 1);
    next_w_ = factor * v_;
    for (Eigen::Index i = 0; i < W.cols(); ++i) {
      double* const next = next_v_.col(i).data();
      for (Eigen::Index r = 0; r < starts; ++r) next[r] = k == 0 && G.size() > 0 ? G(r, i) : 0;
      for (const Entry& entry : rows_[static_cast<std::size_t>(i)]) {
        const double* const w = w_.col(entry.column).data();
        const double* const v = v_.col(entry.column).data();
        for (Eigen::Index r = 0; r < starts; ++r) next[r] -= entry.k * w[r] + entry.c * v[r];
      }
    }
    for (std::size_t i = 0; i < variables.size(); ++i)
      add_variable(variables[i], k, along_w_[i], along_v_[i]);
    next_v_ *= factor;
    W += next_w_;
    V += next_v_;
    w_.swap(next_w_);
    v_.swap(next_v_);
  }
}

namespace {

// into.col(offset + direction) = of D.
void project(const Variable& variable, const Matrix& of, Eigen::Index offset, Matrix& into) {
  into.middleCols(offset, variable.T.front().rows()).setZero();
  for (const Variable::Entry& entry : variable.from) {
    const double* const from = of.col(entry.dof).data();
    double* const to = into.col(offset + entry.direction).data();
    for (Eigen::Index r = 0; r < of.rows(); ++r) to[r] += entry.weight * from[r];
  }
}

// sum += sum_j (term k - j) T_j^T.
void convolve(const std::vector<Matrix>& T, std::size_t k, const Matrix& terms, Matrix& sum) {
  for (std::size_t j = 0; j <= k && j < T.size(); ++j) {
    const Matrix& by = T[j];
    for (Eigen::Index b = 0; b < by.cols(); ++b) {
      const double* const from = terms.col(static_cast<Eigen::Index>(k - j) * by.cols() + b).data();
      for (Eigen::Index a = 0; a < by.rows(); ++a) {
        const double weight = by(a, b);
        if (weight == 0) continue;
        double* const to = sum.col(a).data();
        for (Eigen::Index r = 0; r < sum.rows(); ++r) to[r] += weight * from[r];
      }
    }
  }
}

}  // namespace

void Variation::add_variable(const Variable& variable, std::size_t k, Matrix& along_w, Matrix& along_v) {
  const Eigen::Index directions = variable.T.front().rows();
  const Eigen::Index offset = static_cast<Eigen::Index>(k) * directions;
  project(variable, w_, offset, along_w);
  sum_.setZero(w_.rows(), directions);
  convolve(variable.T, k, along_w, sum_);
  if (!variable.B.empty()) {
    project(variable, v_, offset, along_v);
    convolve(variable.B, k, along_v, sum_);
  }
  if (const auto j = static_cast<Eigen::Index>(k); j < variable.by_memory.cols())
    sum_.noalias() += variable.memory * variable.by_memory.col(j).transpose();
  for (const Variable::Entry& entry : variable.onto) {
    const double* const from = sum_.col(entry.direction).data();
    double* const to = next_v_.col(entry.dof).data();
    for (Eigen::Index r = 0; r < sum_.rows(); ++r) to[r] -= entry.weight * from[r];
  }
}

// The map of (w, w', G as inputs) over h/2^halvings, squared as often: from the right, as the w are rows.
void Variation::squared(double h, double fastest, int halvings, const Matrix& G, Matrix& W, Matrix& V) {
  const Eigen::Index n = W.cols(), inputs = G.size() > 0 ? n : 0, size = 2 * n + inputs;
  map_w_.setZero(size, n);
  map_v_.setZero(size, n);
  map_w_.topRows(n).setIdentity();
  map_v_.middleRows(n, n).setIdentity();
  input_.setZero(inputs > 0 ? size : 0, inputs);
  input_.bottomRows(inputs).setIdentity();
  series(std::ldexp(h, -halvings), fastest, input_, {}, map_w_, map_v_);
  map_.setZero(size, size);
  map_.leftCols(n) = map_w_;
  map_.middleCols(n, n) = map_v_;
  map_.bottomRightCorner(inputs, inputs).setIdentity();
  for (int i = 0; i < halvings; ++i) {
    twice_.noalias() = map_ * map_;
    map_.swap(twice_);
  }
  state_.resize(W.rows(), size);
  state_.leftCols(n) = W;
  state_.middleCols(n, n) = V;
  if (inputs > 0) state_.rightCols(n) = G;
  moved_.noalias() = state_ * map_;
  W = moved_.leftCols(n);
  V = moved_.middleCols(n, n);
}

}  // namespace arcslip::time
