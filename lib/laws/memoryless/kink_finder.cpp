#include <arcslip/laws/memoryless/kink_finder.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::elements {
namespace {

constexpr int intervals_per_order = 16, further_intervals = 32;
constexpr int most_secants = 100;
constexpr double finest = 4 * std::numeric_limits<double>::epsilon() * whole_turn;  // rad

int grid_size(const Harmonics& h) {
  const int whole = intervals_per_order * h.order + further_intervals;
  return h.odd ? whole / 2 : whole;
}

}  // namespace

KinkFinder::KinkFinder(const FormulaLaw& law, const Harmonics& h)
    : law_(law),
      harmonics_(h),
      directions_(law.directions()),
      samples_(h, grid_size(h)),
      evaluator_(law.switches()),
      inputs_(static_cast<std::size_t>(law.inputs().count())),
      one_(inputs_.size()),
      q_(samples_.count() + 1, directions_),
      v_(q_),
      grid_(samples_.count() + 1, static_cast<Eigen::Index>(law.switches().results().size())),
      phase_(samples_.count() + 1),
      slope_(h.size()),
      phi_(h.size()),
      motion_(static_cast<std::size_t>(law.inputs().phase() + 1)),
      by_input_(inputs_.size()),
      fields_(static_cast<std::size_t>(law.inputs().fields)),
      values_(static_cast<std::size_t>(directions_)) {
  u_.resize(directions_ * h.size());
  const FormulaInputs& all = law.inputs();
  const auto set = [&](int input, const double* grid, const double* one, bool varies) {
    inputs_[static_cast<std::size_t>(input)] = {grid, varies};
    one_[static_cast<std::size_t>(input)] = {one, false};
  };
  for (int i = 0; i < directions_; ++i) {
    set(all.displacement(i), q_.col(i).data(), &motion_[static_cast<std::size_t>(all.displacement(i))], true);
    set(all.velocity(i), v_.col(i).data(), &motion_[static_cast<std::size_t>(all.velocity(i))], true);
  }
  set(all.phase(), phase_.data(), &motion_.back(), true);
  for (int k = 0; k < all.fields; ++k) {
    const double* at = &fields_[static_cast<std::size_t>(k)];
    set(all.field(k), at, at, false);
  }
  for (Eigen::Index m = 0; m < grid_.cols(); ++m) grid_to_.push_back(grid_.col(m).data());
  one_to_.resize(grid_to_.size());
  for (Eigen::Index s = 0; s < phase_.size(); ++s)
    phase_[s] = h.period * (h.span() * static_cast<double>(s) / samples_.count());
}

const std::vector<Kink>& KinkFinder::find(In u, double base_frequency, Fields fields) {
  u_ = u;
  base_frequency_ = base_frequency;
  std::copy(fields.begin(), fields.end(), fields_.begin());
  const Eigen::Index c = harmonics_.size(), last = samples_.count();
  const double sign = harmonics_.odd ? -1 : 1;  // half a period later
  for (Eigen::Index i = 0; i < directions_; ++i) {
    const auto own = u_.segment(i * c, c);
    samples_.values(own, q_.col(i).head(last));
    series_slope(harmonics_, own, slope_);
    slope_ *= base_frequency;
    samples_.values(slope_, v_.col(i).head(last));
    q_(last, i) = sign * q_(0, i);
    v_(last, i) = sign * v_(0, i);
  }
  evaluator_.compute(inputs_, static_cast<std::size_t>(last) + 1, grid_to_);
  kinks_.clear();
  for (Eigen::Index m = 0; m < grid_.cols(); ++m)
    for (Eigen::Index s = 0; s < last; ++s) {
      const double from = grid_(s, m), to = grid_(s + 1, m);
      if ((from >= 0) == (to >= 0) || !std::isfinite(from) || !std::isfinite(to)) continue;
      const auto of = static_cast<std::size_t>(m);
      const double step = harmonics_.span() / samples_.count();
      kinks_.push_back(
          {root(of, static_cast<double>(s) * step, static_cast<double>(s + 1) * step, from, to), of});
    }
  std::sort(kinks_.begin(), kinks_.end(), [](const Kink& a, const Kink& b) { return a.theta < b.theta; });
  return kinks_;
}

void KinkFinder::set_motion(double theta) {
  const Eigen::Index c = harmonics_.size();
  for (int i = 0; i < directions_; ++i) {
    auto& at = values_[static_cast<std::size_t>(i)];
    at = series_values(harmonics_, u_.segment(i * c, c), theta);
    motion_[static_cast<std::size_t>(law_.inputs().displacement(i))] = at.x;
    motion_[static_cast<std::size_t>(law_.inputs().velocity(i))] = base_frequency_ * at.d1;
  }
  motion_.back() = harmonics_.period * theta;
}

double KinkFinder::value(std::size_t of, double theta) {
  set_motion(theta);
  std::fill(one_to_.begin(), one_to_.end(), nullptr);
  one_to_[of] = &one_value_;
  evaluator_.compute(one_, 1, one_to_);
  return one_value_;
}

// The secant method that halves the value of the end that stays (Illinois), in a bracket.
double KinkFinder::root(std::size_t of, double from, double to, double f_from, double f_to) {
  const bool above = f_from >= 0;
  if (f_from == 0) return from;
  for (int k = 0; k < most_secants && to - from > finest; ++k) {
    double next = from - f_from * (to - from) / (f_to - f_from);
    if (!(next > from && next < to)) next = 0.5 * (from + to);
    const double f = value(of, next);
    if (f == 0) return next;
    if ((f >= 0) == above) {
      from = next;
      f_from = f;
      f_to *= 0.5;
    } else {
      to = next;
      f_to = f;
      f_from *= 0.5;
    }
  }
  return 0.5 * (from + to);
}

double KinkFinder::differentiate(const Kink& kink) {
  set_motion(kink.theta);
  derivatives_.clear();
  for (std::size_t k = 0; k < by_input_.size(); ++k)
    derivatives_.push_back({kink.of, static_cast<int>(k), &by_input_[k]});
  std::fill(one_to_.begin(), one_to_.end(), nullptr);
  evaluator_.compute(one_, 1, one_to_, derivatives_);
  const FormulaInputs& all = law_.inputs();
  double by_theta = harmonics_.period * by_input_[static_cast<std::size_t>(all.phase())];
  for (int i = 0; i < directions_; ++i) {
    const Values& at = values_[static_cast<std::size_t>(i)];
    by_theta += by_input_[static_cast<std::size_t>(all.displacement(i))] * at.d1 +
                by_input_[static_cast<std::size_t>(all.velocity(i))] * base_frequency_ * at.d2;
  }
  return by_theta;
}

void KinkFinder::rate(const Kink& kink, Out by_u) {
  const double by_theta = differentiate(kink);
  series_basis(harmonics_, kink.theta, phi_);
  const FormulaInputs& all = law_.inputs();
  const Eigen::Index c = harmonics_.size();
  for (int i = 0; i < directions_; ++i) {
    const double by_q = by_input_[static_cast<std::size_t>(all.displacement(i))];
    const double by_v = base_frequency_ * by_input_[static_cast<std::size_t>(all.velocity(i))];
    auto own = by_u.segment(i * c, c);
    own = by_q * phi_;
    for (int j = 0; j < harmonics_.sines(); ++j) {
      const int n = harmonics_.sine_order(j), a = harmonics_.cosine_index(n), b = harmonics_.sine_index(n);
      own[a] -= by_v * n * phi_[b];
      own[b] += by_v * n * phi_[a];
    }
  }
  by_u /= -by_theta;
}

double KinkFinder::rate_by_frequency(const Kink& kink) {
  const double by_theta = differentiate(kink);
  double by_frequency = 0;
  for (int i = 0; i < directions_; ++i)
    by_frequency += by_input_[static_cast<std::size_t>(law_.inputs().velocity(i))] *
                    values_[static_cast<std::size_t>(i)].d1;
  return -by_frequency / by_theta;
}

double KinkFinder::rate_by_field(const Kink& kink, int field) {
  const double by_theta = differentiate(kink);
  return -by_input_[static_cast<std::size_t>(law_.inputs().field(field))] / by_theta;
}

}  // namespace arcslip::elements
