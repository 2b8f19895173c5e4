#include <arcslip/stability/piecewise_linear_monodromy.hpp>

#include <arcslip/time/event_driven/event_driven.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace arcslip::time {
namespace {

constexpr double negligible_skew = 1e-14;      // skew part of a stiffness, relative
constexpr double negligible_coupling = 1e-14;  // couplings of modes by damping, relative
constexpr double most_parallel = 1e5;          // condition of the planes' basis
constexpr double small_turn = 0.1;             // rad^2: below, by series
constexpr double slow = 1e-3;                  // of the fastest: a motion without a frequency of its own
constexpr Eigen::Index least_modes = 10;       // with inertia
constexpr std::size_t most_numbers = std::size_t{1} << 23;  // in phases kept

}  // namespace

LinearPhases::LinearPhases(const EquationOfMotion& equation, std::vector<PhasePart> parts,
                           const ModesKept& kept, std::shared_ptr<const NaturalModes> modes)
    : parts_(std::move(parts)), memories_(equation.memory), free_(std::move(modes)) {
  for (const PhasePart& part : parts_) {
    first_row_.push_back(static_cast<int>(rows_));
    rows_ += part.directions.cols();
    auto& kinds = kind_.emplace_back();
    for (std::size_t j = 0; j < part.stiffness.size(); ++j) {
      std::size_t i = 0;
      while (part.stiffness[i] != part.stiffness[j] || part.by_memory[i] != part.by_memory[j]) ++i;
      kinds.push_back(static_cast<int>(i));
    }
  }
  Matrix D(equation.dofs(), rows_);
  for (std::size_t i = 0; i < parts_.size(); ++i)
    D.middleCols(first_row_[i], parts_[i].directions.cols()) = parts_[i].directions;

  if (!free_) free_ = time::natural_modes(equation);
  const NaturalModes& free = *free_;
  natural_ = free.squares.cwiseMax(0).cwiseSqrt();
  Eigen::Index n = 0;
  const Matrix circulatory = equation.circulatory();
  const bool symmetric_parts = circulatory.size() == 0 && equation.C == equation.C.transpose();
  const auto keeps = [&](Eigen::Index k) {
    return !symmetric_parts || k < least_modes || (natural_[k] <= kept.highest && k < kept.most);
  };
  while (n < natural_.size() && keeps(n)) ++n;
  if (n == 0) throw SingularMass("no degree of freedom has a mass");
  const Matrix V = free.V.leftCols(n);
  squares_ = free.squares.head(n);
  damping_ = V.transpose() * equation.C * V;
  if (circulatory.size() > 0) circulatory_ = V.transpose() * circulatory * V;
  contact_ = D.transpose() * V;
  const Eigen::Index cut = natural_.size() - n, none = free.without_mass.cols();
  if (cut + none == 0) return;
  Matrix following(rows_, cut + none);
  following.leftCols(cut) =
      D.transpose() * free.V.rightCols(cut) * natural_.tail(cut).cwiseInverse().asDiagonal();
  if (none > 0) following.rightCols(none) = D.transpose() * free.without_mass;
  residual_ = following * following.transpose();
}

void LinearPhases::begin(const std::vector<int>& of, const std::vector<int>& kept) {
  if (numbers_ > most_numbers) {
    phases_.clear();
    numbers_ = 0;
  }
  kinds_.resize(of.size());
  for (std::size_t i = 0; i < of.size(); ++i) kinds_[i] = kind_[i][static_cast<std::size_t>(of[i])];
  kept_ = kept;
  pending_.clear();
  first_ = now_ = &phase_of(kinds_);
  const Eigen::Index n = modes(), starts = 2 * n + static_cast<Eigen::Index>(kept.size());
  X_.setIdentity(starts, 2 * n);
  Z_.setZero(starts, memories_);
  for (std::size_t k = 0; k < kept.size(); ++k) Z_(2 * n + static_cast<Eigen::Index>(k), kept[k]) = 1;
}

void LinearPhases::change(std::size_t part, int mode) {
  const int kind = kind_[part][static_cast<std::size_t>(mode)];
  if (kinds_[part] == kind) return;
  kinds_[part] = kind;
  pending_.emplace_back(static_cast<int>(part), kind);
}

const LinearPhases::Phase& LinearPhases::phase_of(const std::vector<int>& kinds) {
  const auto [at, is_new] = phases_.try_emplace(kinds);
  if (is_new) {
    at->second.kinds = kinds;
    decompose(at->second);
    numbers_ += static_cast<std::size_t>(at->second.to_modes.size() + at->second.from_modes.size() +
                                         at->second.along.size() + at->second.inputs.size());
  }
  return at->second;
}

void LinearPhases::enter() {
  if (pending_.empty()) return;
  const auto known = std::find_if(now_->ways.begin(), now_->ways.end(),
                                  [&](const Way& way) { return way.changes == pending_; });
  const Way* way = nullptr;
  if (known != now_->ways.end()) {
    way = &*known;
  } else {
    const Phase& to = phase_of(kinds_);
    Way& added = now_->ways.emplace_back();
    added.changes = pending_;
    added.to = &to;
    if (&to != now_) added.turn = turn(*now_, to);
    numbers_ += static_cast<std::size_t>(added.turn.size());
    way = &added;
  }
  turn_by(way->turn);
  now_ = way->to;
  pending_.clear();
}

// From the right: a' = to_modes from_modes a, whose a are rows.
Matrix LinearPhases::turn(const Phase& from, const Phase& to) const {
  if (!from.planes && !to.planes) return (to.to_modes * from.from_modes).transpose();
  const Eigen::Index n = modes();
  const auto twice = [&](const Phase& phase, const Matrix& map) -> Matrix {
    if (phase.planes) return map;
    Matrix both = Matrix::Zero(2 * n, 2 * n);
    both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = map;
    return both;
  };
  return (twice(to, to.to_modes) * twice(from, from.from_modes)).transpose();
}

void LinearPhases::turn_by(const Matrix& turn) {
  const Eigen::Index n = modes();
  if (turn.size() == 0) return;
  next_.resize(X_.rows(), 2 * n);
  if (turn.rows() == 2 * n) {
    next_.noalias() = X_ * turn;
  } else {
    next_.leftCols(n).noalias() = X_.leftCols(n) * turn;
    next_.rightCols(n).noalias() = X_.rightCols(n) * turn;
  }
  X_.swap(next_);
}

void LinearPhases::decompose(Phase& phase) const {
  const Eigen::Index n = modes();
  Matrix by_memory = Matrix::Zero(rows_, memories_);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const PhasePart& part = parts_[i];
    const auto mode = static_cast<std::size_t>(phase.kinds[i]);
    if (part.memory >= 0)
      by_memory.block(first_row_[i], part.memory, part.directions.cols(), 1) = part.by_memory[mode];
  }
  const auto times_T = [&](const Matrix& q) {
    Matrix f(rows_, q.cols());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const auto count = parts_[i].directions.cols();
      f.middleRows(first_row_[i], count) =
          parts_[i].stiffness[static_cast<std::size_t>(phase.kinds[i])] * q.middleRows(first_row_[i], count);
    }
    return f;
  };
  phase.along = contact_;
  if (residual_.size() > 0) {
    const Matrix follow =
        Matrix::Identity(rows_, rows_) + residual_ * times_T(Matrix::Identity(rows_, rows_));
    phase.along = continuation::solve(follow, contact_);
    phase.behind = -continuation::solve(follow, residual_ * by_memory);
    by_memory += times_T(phase.behind);
  }
  phase.K = contact_.transpose() * times_T(phase.along);
  phase.K.diagonal() += squares_;
  if (circulatory_.size() > 0) phase.K += circulatory_;
  phase.inputs = -contact_.transpose() * by_memory;

  const double size = phase.K.cwiseAbs().maxCoeff();
  const Matrix even = 0.5 * (phase.K + phase.K.transpose());
  auto [squares, U] = continuation::symmetric_modes(even);
  const bool found = squares.size() == n;
  const Matrix damping = found ? Matrix(U.transpose() * damping_ * U) : Matrix();
  Matrix coupling = damping;
  if (found) coupling.diagonal().setZero();
  if (found && (phase.K - even).cwiseAbs().maxCoeff() <= negligible_skew * size &&
      coupling.cwiseAbs().maxCoeff() <= negligible_coupling * damping.cwiseAbs().maxCoeff()) {
    for (Eigen::Index j = 0; j < n; ++j) phase.oscillators.push_back({0.5 * damping(j, j), squares[j]});
    phase.to_modes = U.transpose();
    phase.from_modes = U;
    phase.along *= U;
    phase.inputs = U.transpose() * phase.inputs;
  } else if (phase.planes = true; !(found && find_planes(phase, U, squares, damping))) {
    phase.series = true;
    phase.to_modes = phase.from_modes = Matrix::Identity(2 * n, 2 * n);
  }
  phase.fastest = std::sqrt(phase.K.norm()) + damping_.norm();
}

// In the balanced coordinates (rho y, y'), with y in the modes U of the even part of K.
bool LinearPhases::find_planes(Phase& phase, const Matrix& U, const Vector& squares,
                               const Matrix& damping) const {
  const Eigen::Index n = modes();
  Vector rho = squares.cwiseAbs().cwiseSqrt();
  rho = rho.cwiseMax(slow * std::max(rho.maxCoeff(), damping.cwiseAbs().maxCoeff()));
  if (!(rho.minCoeff() > 0)) return false;
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n) = rho.asDiagonal();
  A.bottomLeftCorner(n, n) = -(U.transpose() * phase.K * U) * rho.cwiseInverse().asDiagonal();
  A.bottomRightCorner(n, n) = -damping;
  const auto [values, vectors] = continuation::modes(A);
  if (values.size() != 2 * n) return false;

  Matrix P(2 * n, 2 * n);
  Eigen::Index planes = 0;
  const auto add = [&](const Vector& second, double gamma, double square) {
    P.col(n + planes) = second;
    P.col(planes++) = A * second + 2 * gamma * second;
    phase.oscillators.push_back({gamma, square});
  };
  phase.oscillators.clear();
  std::vector<Eigen::Index> real;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const std::complex<double> value = values[i];
    if (value.imag() == 0) real.push_back(i);
    if (!(value.imag() > 0)) continue;
    if (planes == n) return false;
    // Its parts at right angles.
    const Eigen::VectorXcd v = vectors.col(i);
    const std::complex<double> square = v.transpose() * v;
    add((v * std::polar(1.0, -0.5 * std::arg(square))).real(), -value.real(), std::norm(value));
  }
  std::sort(real.begin(), real.end(), [&values = values](Eigen::Index a, Eigen::Index b) {
    return values[a].real() < values[b].real();
  });
  if (2 * planes + static_cast<Eigen::Index>(real.size()) != 2 * n) return false;
  for (std::size_t i = 0; i < real.size() / 2; ++i) {
    const Eigen::Index a = real[i], b = real[i + real.size() / 2];
    const double first = values[a].real(), second = values[b].real();
    add(vectors.col(a).real() + vectors.col(b).real(), -0.5 * (first + second), first * second);
  }
  const Vector lengths = P.colwise().norm();
  if (!(lengths.minCoeff() > 0)) return false;
  const Matrix unit = P * lengths.cwiseInverse().asDiagonal();
  const Matrix inverse = continuation::solve(unit, Matrix::Identity(2 * n, 2 * n));
  if (!(unit.norm() * inverse.norm() < most_parallel * static_cast<double>(2 * n))) return false;

  // (eta, eta') = from a.
  Matrix from(2 * n, 2 * n), to(2 * n, 2 * n);
  from.topRows(n) = U * rho.cwiseInverse().asDiagonal() * P.topRows(n);
  from.bottomRows(n) = U * P.bottomRows(n);
  to.leftCols(n) = inverse.leftCols(n) * rho.asDiagonal() * U.transpose();
  to.rightCols(n) = inverse.rightCols(n) * U.transpose();
  phase.to_modes = lengths.cwiseInverse().asDiagonal() * to;
  phase.from_modes = std::move(from);
  phase.along = Matrix(phase.along * phase.from_modes.topRows(n));
  phase.inputs = Matrix(phase.to_modes.rightCols(n) * phase.inputs);
  return true;
}

namespace {

// a and a' after a time, from a, a' and constant rates of change y_1 of a and y_2 of a'.
struct Step {
  double a_a, a_v, v_a, v_v, a_1, a_2, v_1, v_2;
};

// The integral of the response to a unit velocity, a solution of q'' + 2 gamma q' + square q = 1 from rest.
double from_rest(double gamma, double square, double h, double free, double velocity) {
  const double turn = square * h * h, decay = 2 * gamma * h;
  if (std::abs(turn) < small_turn && std::abs(decay) < 1) {
    double before = 0, term = 0.5, sum = 0.5;  // over h^2
    for (int k = 1; k < 24; ++k) {
      const double next = -(decay * (k + 1) * term + turn * before) / ((k + 1) * (k + 2));
      before = term;
      term = next;
      sum += next;
    }
    return sum * h * h;
  }
  return square != 0 ? (1 - free) / square : (h - velocity) / (2 * gamma);
}

Step step_of(double gamma, double square, double h, bool driven) {
  const double below = square - gamma * gamma;
  double cosine, sine;  // exp(-gamma h) cos(nu h), exp(-gamma h) sin(nu h)/nu
  if (below >= 0) {
    const double nu = std::sqrt(below), decay = gamma == 0 ? 1 : std::exp(-gamma * h);
    cosine = decay * std::cos(nu * h);
    sine = nu * h < 1e-8 ? decay * h : decay * std::sin(nu * h) / nu;
  } else {
    const double kappa = std::sqrt(-below), slower = std::exp((kappa - gamma) * h);
    const double apart = -std::expm1(-2 * kappa * h);
    cosine = slower * (1 - 0.5 * apart);
    sine = kappa * h < 1e-8 ? slower * h : slower * apart / (2 * kappa);
  }
  Step step{cosine + gamma * sine, sine, -square * sine, cosine - gamma * sine, 0, 0, 0, 0};
  if (!driven) return step;
  step.a_2 = from_rest(gamma, square, h, step.a_a, sine);
  step.v_2 = sine;
  step.a_1 = sine + 2 * gamma * step.a_2;
  step.v_1 = -square * step.a_2;
  return step;
}

}  // namespace

bool LinearPhases::move(double time) {
  enter();
  if (!(time > 0)) return true;
  if (!(now_->fastest * time < fastest_turns)) return false;
  const Eigen::Index n = modes();
  const bool driven = memories_ > 0 && !Z_.isZero(0);
  if (driven) driven_.noalias() = Z_ * now_->inputs.transpose();
  if (now_->series) {
    position_ = X_.leftCols(n);
    velocity_ = X_.rightCols(n);
    if (!driven) driven_.resize(0, 0);
    variation_.set(now_->K, damping_, driven_);
    variation_.move(time, now_->fastest, position_, velocity_);
    X_.leftCols(n) = position_;
    X_.rightCols(n) = velocity_;
    return true;
  }
  const Eigen::Index starts = X_.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    const Oscillator& of = now_->oscillators[static_cast<std::size_t>(j)];
    const Step step = step_of(of.gamma, of.square, time, driven);
    double* const a = X_.col(j).data();
    double* const v = X_.col(n + j).data();
    for (Eigen::Index i = 0; i < starts; ++i) {
      const double before = a[i];
      a[i] = step.a_a * before + step.a_v * v[i];
      v[i] = step.v_a * before + step.v_v * v[i];
    }
    if (!driven) continue;
    const auto second = driven_.col(now_->planes ? n + j : j);
    X_.col(j) += step.a_2 * second;
    X_.col(n + j) += step.v_2 * second;
    if (!now_->planes) continue;
    X_.col(j) += step.a_1 * driven_.col(j);
    X_.col(n + j) += step.v_1 * driven_.col(j);
  }
  return true;
}

Matrix LinearPhases::along(std::size_t part) const {
  const auto rows = now_->along.middleRows(first_row_[part], parts_[part].directions.cols());
  Matrix q = X_.leftCols(rows.cols()) * rows.transpose();
  if (now_->behind.size() > 0)
    q += Z_ * now_->behind.middleRows(first_row_[part], parts_[part].directions.cols()).transpose();
  return q;
}

const Matrix& LinearPhases::map() {
  enter();
  if (now_ != first_) turn_by(turn(*now_, *first_));
  now_ = first_;
  const Eigen::Index n = modes(), size = X_.rows();
  Vector scale = Vector::Ones(size);
  double fastest = 0;
  for (const Oscillator& of : first_->oscillators)
    fastest = std::max(fastest, std::sqrt(std::abs(of.square)));
  if (fastest == 0) fastest = first_->fastest > 0 ? first_->fastest : 1;
  for (Eigen::Index j = 0; j < n; ++j)
    scale[j] = first_->series
                   ? fastest
                   : std::max(std::sqrt(std::abs(first_->oscillators[static_cast<std::size_t>(j)].square)),
                              slow * fastest);
  map_.resize(size, size);
  map_.topRows(2 * n) = X_.transpose();
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const Eigen::Index at = 2 * n + static_cast<Eigen::Index>(k);
    map_.row(at) = Z_.col(kept_[k]).transpose();
    const double by = first_->inputs.col(kept_[k]).cwiseAbs().maxCoeff() / fastest;
    if (by > 0) scale[at] = by;
  }
  for (Eigen::Index j = 0; j < size; ++j)
    for (Eigen::Index i = 0; i < size; ++i) map_(i, j) *= scale[i] / scale[j];
  return map_;
}

}  // namespace arcslip::time
