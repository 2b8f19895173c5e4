#include <arcslip/stability/variational_integrator.hpp>

#include <arcslip/continuation/linear/cpu_dispatch.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::time {
namespace {

constexpr std::size_t most_exponential_terms = 64;
constexpr double longest_exponent = 2;         // rad of the fastest motion, in one series
constexpr int few_series = 4;                  // series in a row cost less than halving and squaring
constexpr double first_term_left_out = 1e-17;  // by the first term that is left out, relative

// The first k with x^k/k! below left_out.
std::size_t terms_of(double x) {
  double term = 1;
  std::size_t k = 0;
  while (term > first_term_left_out && k < most_exponential_terms) term *= x / static_cast<double>(++k);
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
  for (Eigen::Index b = 0; b < directions; ++b)
    from_ends.push_back(static_cast<std::size_t>(
        std::count_if(from.begin(), from.end(), [&](const Entry& of) { return of.direction <= b; })));
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

void Variation::move(double h, double fastest, std::vector<Variable>& variables, Matrix& W, Matrix& V) {
  if (!(h > 0)) return;
  if (!variables.empty()) return series(h, terms_of(h, fastest, variables), G_, variables, W, V);
  const double pieces = std::max(1.0, std::ceil(h * fastest / longest_exponent));
  if (pieces > few_series) return squared(h, fastest, std::ilogb(pieces) + 1, W, V);
  for (int i = 0; i < static_cast<int>(pieces); ++i)
    series(h / pieces, time::terms_of(h * fastest / pieces), G_, variables, W, V);
}

Matrix Variation::acceleration(const std::vector<Variable>& variables, const Matrix& W,
                               const Matrix& V) const {
  Matrix A = G_.size() > 0 ? G_ : Matrix::Zero(W.rows(), W.cols());
  for (Eigen::Index i = 0; i < A.cols(); ++i)
    for (std::size_t k = rows_[static_cast<std::size_t>(i)]; k < rows_[static_cast<std::size_t>(i) + 1]; ++k)
      A.col(i) -= entries_[k].k * W.col(entries_[k].column) + entries_[k].c * V.col(entries_[k].column);
  const auto add = [](const Matrix& of, const Matrix& coefficients, Matrix& force) {
    for (Eigen::Index j = 0; j < coefficients.cols(); j += of.cols())
      force.noalias() += of * coefficients.middleCols(j, of.cols()).transpose();
  };
  const auto along = [](const Variable& variable, const Matrix& of) {
    Matrix all = Matrix::Zero(of.rows(), variable.directions);
    for (const Variable::Entry& from : variable.from)
      all.col(from.direction) += from.weight * of.col(from.dof);
    return all;
  };
  for (const Variable& variable : variables) {
    Matrix force = Matrix::Zero(W.rows(), variable.directions);
    add(along(variable, W), variable.T, force);
    if (variable.B.size() > 0) add(along(variable, V), variable.B, force);
    if (variable.by_memory.size() > 0) add(variable.memory, variable.by_memory, force);
    for (const Variable::Entry& onto : variable.onto)
      A.col(onto.dof) -= onto.weight * force.col(onto.direction);
  }
  return A;
}

// Until the terms of a bound are negligible, w'' = fastest^2 w + sum_j |T_j| s^j w + ...: as many in a row as
// one depends on. y: with the size of D^T.
std::size_t Variation::terms_of(double h, double fastest, const std::vector<Variable>& variables) {
  for (auto* each : {&by_w_, &by_v_, &by_y_, &y_by_y_, &y_by_w_}) each->clear();
  const auto add = [](const Matrix& coefficients, Eigen::Index columns, double size,
                      std::vector<double>& to) {
    const auto powers = columns > 0 ? static_cast<std::size_t>(coefficients.cols() / columns) : 0;
    to.resize(std::max(to.size(), powers), 0);
    for (std::size_t j = 0; j < powers; ++j)
      to[j] +=
          size * coefficients.middleCols(static_cast<Eigen::Index>(j) * columns, columns).cwiseAbs().sum();
  };
  for (const Variable& variable : variables) {
    add(variable.T, variable.directions, variable.size, by_w_);
    add(variable.B, variable.directions, variable.size, by_v_);
    if (variable.decay.size() == 0) continue;
    add(variable.by_memory, variable.memory.cols(), variable.size, by_y_);
    add(variable.decay, variable.memory.cols(), 1, y_by_y_);
    add(variable.rate_by_q, variable.directions, 1, y_by_w_);
  }
  double square = fastest * fastest;
  for (const double each : by_w_) square += each;
  const double rate = std::sqrt(square);
  if (rate == 0) return 2;
  size_w_.assign(1, 1);  // of rate w
  size_v_.assign(1, 1);
  size_y_.assign(1, by_y_.empty() ? 0 : 1);  // of rate y
  // Of the next term.
  const auto sum = [](const std::vector<double>& by, const std::vector<double>& terms) {
    double all = 0;
    for (std::size_t j = 0; j < std::min(terms.size(), by.size()); ++j)
      all += by[j] * terms[terms.size() - 1 - j];
    return all;
  };
  std::size_t small = 0;
  for (std::size_t k = 0; small <= by_w_.size() && k + 1 < most_exponential_terms; ++k) {
    const double factor = h / static_cast<double>(k + 1);
    const double v = fastest * fastest / rate * size_w_[k] + sum(by_w_, size_w_) / rate +
                     sum(by_v_, size_v_) + sum(by_y_, size_y_) / rate;
    const double y = sum(y_by_y_, size_y_) + sum(y_by_w_, size_w_);
    size_w_.push_back(factor * rate * size_v_[k]);
    size_v_.push_back(factor * v);
    size_y_.push_back(factor * y);
    small = std::max({size_w_.back(), size_v_.back(), size_y_.back()}) > first_term_left_out ? 0 : small + 1;
  }
  return std::max<std::size_t>(size_w_.size() - small, 2);
}

namespace {

constexpr Eigen::Index lanes = 4;

struct Vectors {
  using Lanes [[gnu::vector_size(sizeof(double) * lanes), gnu::aligned(sizeof(double))]] = double;

  [[gnu::always_inline]] static Lanes& at(double* of, Eigen::Index i) {
    return *reinterpret_cast<Lanes*>(of + lanes * i);
  }

  // The rows from `start` on, 0 beyond the last one.
  static void take(const Matrix& of, Eigen::Index start, std::vector<double>& into) {
    const Eigen::Index rows = std::min(lanes, of.rows() - start);
    into.assign(static_cast<std::size_t>(lanes * of.cols()), 0);
    for (Eigen::Index i = 0; i < of.cols(); ++i)
      std::copy_n(of.data() + i * of.rows() + start, rows, into.data() + lanes * i);
  }
  static void give(const std::vector<double>& from, Eigen::Index start, Matrix& to) {
    const Eigen::Index rows = std::min(lanes, to.rows() - start);
    for (Eigen::Index i = 0; i < to.cols(); ++i)
      std::copy_n(from.data() + lanes * i, rows, to.data() + i * to.rows() + start);
  }

  // Term k of D.
  [[gnu::always_inline]] static void project(const Variable& variable, Eigen::Index k, double* of,
                                             double* terms) {
    const Variable::Entry* entry = variable.from.data();
    for (Eigen::Index b = 0; b < variable.directions; ++b) {
      const Variable::Entry* const end =
          variable.from.data() + variable.from_ends[static_cast<std::size_t>(b)];
      Lanes sum{};
      for (; entry != end; ++entry) sum += entry->weight * at(of, entry->dof);
      at(terms, k * variable.directions + b) = sum;
    }
  }

  // M^-1 D of a number for each direction.
  [[gnu::always_inline]] static void subtract(const Variable& variable, double* of, double* from) {
    for (const Variable::Entry& onto : variable.onto)
      at(from, onto.dof) -= onto.weight * at(of, onto.direction);
  }

  // sum += row a of sum_j T_j (term k - j), with so many columns in T_j.
  [[gnu::always_inline]] static void convolve(const Matrix& T, Eigen::Index columns, Eigen::Index a,
                                              Eigen::Index k, double* terms, Lanes& sum) {
    const Eigen::Index rows = T.rows(), powers = std::min(T.cols() / columns, k + 1);
    for (Eigen::Index b = 0; b < columns; ++b) {
      const double* by = T.data() + b * rows + a;
      for (Eigen::Index j = 0; j < powers; ++j, by += rows * columns)
        sum += *by * at(terms, (k - j) * columns + b);
    }
  }
};

}  // namespace

void Variation::series(double h, std::size_t terms, const Matrix& G, std::vector<Variable>& variables,
                       Matrix& W, Matrix& V) {
  for (Eigen::Index start = 0; start < W.rows(); start += lanes)
    series_from(start, h, terms, G, variables, W, V);
}

void Variation::series_from(Eigen::Index start, double h, std::size_t terms, const Matrix& G,
                            std::vector<Variable>& variables, Matrix& W, Matrix& V) {
  using Of = Vectors;
  Of::take(W, start, at_.w);
  Of::take(V, start, at_.v);
  at_.sum_w = at_.w;
  at_.sum_v = at_.v;
  at_.next_w.resize(at_.w.size());
  at_.next_v.assign(at_.v.size(), 0);
  if (G.size() > 0) Of::take(G, start, at_.next_v);
  at_.along.resize(variables.size());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const auto size = static_cast<std::size_t>(lanes * variables[i].directions);
    Buffers::Along& along = at_.along[i];
    along.w.resize(terms * size);
    if (variables[i].B.size() > 0) along.v.resize(terms * size);
    if (variables[i].E.size() > 0) along.a.resize(terms * size);
    along.sum.resize(size);
    if (variables[i].by_memory.size() == 0) continue;
    Of::take(variables[i].memory, start, along.memory);
    if (variables[i].decay.size() == 0) continue;
    along.memory_sum = along.memory;
    along.memory.resize((terms + 1) * along.memory.size());
  }
  continuation::widest([&]() __attribute__((always_inline)) { add_terms(terms, h, variables); });
  Of::give(at_.sum_w, start, W);
  Of::give(at_.sum_v, start, V);
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].decay.size() > 0) Of::give(at_.along[i].memory_sum, start, variables[i].memory);
}

// next_v: G.
[[gnu::always_inline]] inline void Variation::add_terms(std::size_t terms, double h,
                                                        const std::vector<Variable>& variables) {
  using Of = Vectors;
  using Lanes = Of::Lanes;
  const auto dofs = static_cast<Eigen::Index>(rows_.size()) - 1;
  double *w = at_.w.data(), *v = at_.v.data(), *next_w = at_.next_w.data(), *next_v = at_.next_v.data();
  for (std::size_t k = 0; k < terms; ++k) {
    const Entry* entry = entries_.data();
    for (Eigen::Index i = 0; i < dofs; ++i) {
      Lanes sum = k == 0 ? Of::at(next_v, i) : Lanes{};
      for (const Entry* const end = entries_.data() + rows_[static_cast<std::size_t>(i) + 1]; entry != end;
           ++entry)
        sum -= entry->k * Of::at(w, entry->column) + entry->c * Of::at(v, entry->column);
      Of::at(next_v, i) = sum;
    }
    const auto now = static_cast<Eigen::Index>(k);
    for (std::size_t n = 0; n < variables.size(); ++n) {
      const Variable& variable = variables[n];
      Buffers::Along& along = at_.along[n];
      Of::project(variable, now, w, along.w.data());
      const Eigen::Index directions = variable.directions, numbers = variable.memory.cols();
      const bool moving = variable.B.size() > 0, changing = variable.decay.size() > 0;
      const bool driven = !changing && now * numbers < variable.by_memory.cols();
      if (moving) Of::project(variable, now, v, along.v.data());
      for (Eigen::Index a = 0; a < directions; ++a) {
        Lanes sum{};
        Of::convolve(variable.T, directions, a, now, along.w.data(), sum);
        if (moving) Of::convolve(variable.B, directions, a, now, along.v.data(), sum);
        if (changing) Of::convolve(variable.by_memory, numbers, a, now, along.memory.data(), sum);
        for (Eigen::Index b = 0; driven && b < numbers; ++b)
          sum += variable.by_memory(a, now * numbers + b) * Of::at(along.memory.data(), b);
        Of::at(along.sum.data(), a) = sum;
      }
      for (Eigen::Index b = 0; changing && b < numbers; ++b) {
        Lanes sum{};
        Of::convolve(variable.decay, numbers, b, now, along.memory.data(), sum);
        Of::convolve(variable.rate_by_q, directions, b, now, along.w.data(), sum);
        sum *= h / static_cast<double>(k + 1);
        Of::at(along.memory.data(), (now + 1) * numbers + b) = sum;
        Of::at(along.memory_sum.data(), b) += sum;
      }
      Of::subtract(variable, along.sum.data(), next_v);
    }
    for (std::size_t n = 0; n < variables.size(); ++n) {
      const Variable& variable = variables[n];
      if (variable.E.size() == 0) continue;
      Buffers::Along& along = at_.along[n];
      Of::project(variable, now, next_v, along.a.data());
      for (Eigen::Index a = 0; a < variable.directions; ++a) {
        Lanes sum{};
        Of::convolve(variable.E, variable.directions, a, now, along.a.data(), sum);
        Of::at(along.sum.data(), a) = sum;
      }
      Of::subtract(variable, along.sum.data(), next_v);
      Of::project(variable, now, next_v, along.a.data());
    }
    const double factor = h / static_cast<double>(k + 1);
    for (Eigen::Index i = 0; i < dofs; ++i) {
      const Lanes of_w = factor * Of::at(v, i), of_v = factor * Of::at(next_v, i);
      Of::at(next_w, i) = of_w;
      Of::at(next_v, i) = of_v;
      Of::at(at_.sum_w.data(), i) += of_w;
      Of::at(at_.sum_v.data(), i) += of_v;
    }
    std::swap(w, next_w);
    std::swap(v, next_v);
  }
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
  series(std::ldexp(h, -halvings), time::terms_of(std::ldexp(h, -halvings) * fastest), input_, none_, map_w_,
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
