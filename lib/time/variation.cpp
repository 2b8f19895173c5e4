#include <arcslip/time/variation.hpp>

#include <arcslip/continuation/linear/widest.hpp>

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

Variable::Variable(const Matrix& over_mass, const Matrix& along, Eigen::Index powers, bool moving)
    : directions(along.cols()),
      T(Matrix::Zero(along.cols(), powers * along.cols())),
      size(over_mass.norm() * along.norm()) {
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

void Variation::set(const Matrix& K, const Matrix& C, const Matrix& G) {
  entries_.clear();
  rows_.clear();
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    rows_.push_back(entries_.size());
    for (Eigen::Index j = 0; j < K.cols(); ++j)
      if (K(i, j) != 0 || C(i, j) != 0) entries_.push_back({j, K(i, j), C(i, j)});
  }
  rows_.push_back(entries_.size());
  G_ = G;
}

void Variation::move(double h, double fastest, const std::vector<Variable>& variables, Matrix& W, Matrix& V) {
  if (!(h > 0)) return;
  if (!variables.empty()) return series(h, terms_of(h, fastest, variables), G_, variables, W, V);
  const double pieces = std::max(1.0, std::ceil(h * fastest / longest));
  if (pieces > few) return squared(h, fastest, std::ilogb(pieces) + 1, W, V);
  for (int i = 0; i < static_cast<int>(pieces); ++i)
    series(h / pieces, time::terms_of(h * fastest / pieces), G_, variables, W, V);
}

// Until the terms of a bound are negligible, w'' = fastest^2 w + sum_j |T_j| s^j w + ...: as many in a row as
// one depends on.
std::size_t Variation::terms_of(double h, double fastest, const std::vector<Variable>& variables) {
  by_w_.clear();
  by_v_.clear();
  const auto add = [](const Matrix& coefficients, const Variable& of, std::vector<double>& to) {
    const auto powers = static_cast<std::size_t>(coefficients.cols() / of.directions);
    to.resize(std::max(to.size(), powers), 0);
    for (std::size_t j = 0; j < powers; ++j)
      to[j] += of.size * coefficients.middleCols(static_cast<Eigen::Index>(j) * of.directions, of.directions)
                             .cwiseAbs()
                             .sum();
  };
  for (const Variable& variable : variables) {
    add(variable.T, variable, by_w_);
    add(variable.B, variable, by_v_);
  }
  double square = fastest * fastest;
  for (const double each : by_w_) square += each;
  const double rate = std::sqrt(square);
  if (rate == 0) return 2;
  size_w_.assign(1, 1);  // of rate w
  size_v_.assign(1, 1);
  std::size_t small = 0;
  for (std::size_t k = 0; small <= by_w_.size() && k + 1 < most_terms; ++k) {
    const double factor = h / static_cast<double>(k + 1);
    double v = fastest * fastest / rate * size_w_[k];
    for (std::size_t j = 0; j <= k && j < by_w_.size(); ++j) v += by_w_[j] / rate * size_w_[k - j];
    for (std::size_t j = 0; j <= k && j < by_v_.size(); ++j) v += by_v_[j] * size_v_[k - j];
    size_w_.push_back(factor * rate * size_v_[k]);
    size_v_.push_back(factor * v);
    small = std::max(size_w_.back(), size_v_.back()) > left_out ? 0 : small + 1;
  }
  return std::max<std::size_t>(size_w_.size() - small, 2);
}

namespace {

// Several w side by side.
constexpr Eigen::Index lanes = 4;

[[gnu::always_inline]] inline double* lane(std::vector<double>& of, Eigen::Index i) {
  return of.data() + lanes * i;
}

[[gnu::always_inline]] inline void add(double weight, const double* from, double* __restrict to) {
  for (Eigen::Index r = 0; r < lanes; ++r) to[r] += weight * from[r];
}

// The w from `start` on, 0 beyond the last one.
void take(const Matrix& of, Eigen::Index start, std::vector<double>& into) {
  const Eigen::Index rows = std::min(lanes, of.rows() - start);
  for (Eigen::Index i = 0; i < of.cols(); ++i)
    for (Eigen::Index r = 0; r < lanes; ++r) lane(into, i)[r] = r < rows ? of(start + r, i) : 0;
}

void give(std::vector<double>& from, Eigen::Index start, Matrix& to) {
  const Eigen::Index rows = std::min(lanes, to.rows() - start);
  for (Eigen::Index i = 0; i < to.cols(); ++i)
    for (Eigen::Index r = 0; r < rows; ++r) to(start + r, i) = lane(from, i)[r];
}

// Of D, to the terms before.
[[gnu::always_inline]] inline void project(const Variable& variable, std::vector<double>& of, double* into) {
  std::fill_n(into, lanes * variable.directions, 0.0);
  for (const Variable::Entry& entry : variable.from)
    add(entry.weight, lane(of, entry.dof), into + lanes * entry.direction);
}

// sum += sum_j T_j (term k - j).
[[gnu::always_inline]] inline void convolve(const Matrix& T, std::size_t k, const double* terms,
                                            std::vector<double>& sum) {
  const Eigen::Index directions = T.rows(), powers = T.cols() / directions;
  const auto last = static_cast<Eigen::Index>(k);
  for (Eigen::Index j = 0; j <= last && j < powers; ++j)
    for (Eigen::Index b = 0; b < directions; ++b)
      for (Eigen::Index a = 0; a < directions; ++a)
        add(T(a, j * directions + b), terms + lanes * ((last - j) * directions + b), lane(sum, a));
}

}  // namespace

void Variation::series(double h, std::size_t terms, const Matrix& G, const std::vector<Variable>& variables,
                       Matrix& W, Matrix& V) {
  const auto size = static_cast<std::size_t>(lanes * W.cols());
  for (auto* each : {&at_.w, &at_.v, &at_.next_w, &at_.next_v, &at_.sum_w, &at_.sum_v}) each->resize(size);
  at_.along_w.resize(variables.size());
  at_.along_v.resize(variables.size());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::size_t along = most_terms * static_cast<std::size_t>(lanes * variables[i].directions);
    at_.along_w[i].resize(along);
    if (variables[i].B.size() > 0) at_.along_v[i].resize(along);
  }
  for (Eigen::Index start = 0; start < W.rows(); start += lanes) {
    take(W, start, at_.w);
    take(V, start, at_.v);
    at_.sum_w = at_.w;
    at_.sum_v = at_.v;
    continuation::widest([&]() __attribute__((always_inline)) { add_terms(terms, h, start, G, variables); });
    give(at_.sum_w, start, W);
    give(at_.sum_v, start, V);
  }
}

[[gnu::always_inline]] inline void Variation::add_terms(std::size_t terms, double h, Eigen::Index start,
                                                        const Matrix& G,
                                                        const std::vector<Variable>& variables) {
  const auto dofs = static_cast<Eigen::Index>(rows_.size()) - 1;
  for (std::size_t k = 0; k < terms; ++k) {
    const double factor = h / static_cast<double>(k + 1);
    if (k == 0 && G.size() > 0)
      take(G, start, at_.next_v);
    else
      std::fill(at_.next_v.begin(), at_.next_v.end(), 0.0);
    for (Eigen::Index i = 0; i < dofs; ++i) {
      double sum[lanes];
      std::copy_n(lane(at_.next_v, i), lanes, sum);
      for (std::size_t e = rows_[static_cast<std::size_t>(i)]; e < rows_[static_cast<std::size_t>(i) + 1];
           ++e) {
        const Entry& entry = entries_[e];
        const double* const w = lane(at_.w, entry.column);
        const double* const v = lane(at_.v, entry.column);
        for (Eigen::Index r = 0; r < lanes; ++r) sum[r] -= entry.k * w[r] + entry.c * v[r];
      }
      std::copy_n(sum, lanes, lane(at_.next_v, i));
    }
    for (std::size_t i = 0; i < variables.size(); ++i)
      add_variable(variables[i], k, start, at_.along_w[i].data(), at_.along_v[i].data());
    for (Eigen::Index i = 0; i < lanes * dofs; ++i) {
      const auto at = static_cast<std::size_t>(i);
      at_.next_w[at] = factor * at_.v[at];
      at_.next_v[at] *= factor;
      at_.sum_w[at] += at_.next_w[at];
      at_.sum_v[at] += at_.next_v[at];
    }
    at_.w.swap(at_.next_w);
    at_.v.swap(at_.next_v);
  }
}

[[gnu::always_inline]] inline void Variation::add_variable(const Variable& variable, std::size_t k,
                                                           Eigen::Index start, double* along_w,
                                                           double* along_v) {
  const auto offset = static_cast<Eigen::Index>(k) * lanes * variable.directions;
  at_.sum.assign(static_cast<std::size_t>(lanes * variable.directions), 0.0);
  project(variable, at_.w, along_w + offset);
  convolve(variable.T, k, along_w, at_.sum);
  if (variable.B.size() > 0) {
    project(variable, at_.v, along_v + offset);
    convolve(variable.B, k, along_v, at_.sum);
  }
  if (const auto j = static_cast<Eigen::Index>(k); j < variable.by_memory.cols()) {
    const Eigen::Index rows = std::min(lanes, variable.memory.size() - start);
    for (Eigen::Index a = 0; a < variable.directions; ++a)
      for (Eigen::Index r = 0; r < rows; ++r)
        lane(at_.sum, a)[r] += variable.memory[start + r] * variable.by_memory(a, j);
  }
  for (const Variable::Entry& entry : variable.onto)
    add(-entry.weight, lane(at_.sum, entry.direction), lane(at_.next_v, entry.dof));
}

// The map of (w, w', G as inputs) over h/2^halvings, squared as often: from the right, as the w are rows.
void Variation::squared(double h, double fastest, int halvings, Matrix& W, Matrix& V) {
  const Eigen::Index n = W.cols(), inputs = G_.size() > 0 ? n : 0, size = 2 * n + inputs;
  map_w_.setZero(size, n);
  map_v_.setZero(size, n);
  map_w_.topRows(n).setIdentity();
  map_v_.middleRows(n, n).setIdentity();
  input_.setZero(inputs > 0 ? size : 0, inputs);
  input_.bottomRows(inputs).setIdentity();
  series(std::ldexp(h, -halvings), time::terms_of(std::ldexp(h, -halvings) * fastest), input_, {}, map_w_,
         map_v_);
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
  if (inputs > 0) state_.rightCols(n) = G_;
  moved_.noalias() = state_ * map_;
  W = moved_.leftCols(n);
  V = moved_.middleCols(n, n);
}

}  // namespace arcslip::time
