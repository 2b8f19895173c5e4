#include "lib/analyses/branches/extended_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace extended {
namespace {

// Nodes and weights of Gauss and Legendre on [-1, 1].
constexpr int nodes = 16;
const std::array<std::pair<Real, Real>, nodes>& gauss() {
  static const auto rule = [] {
    std::array<std::pair<Real, Real>, nodes> all;
    for (int i = 0; i < nodes; ++i) {
      Real x = std::cos(pi * (static_cast<Real>(i) + 0.75L) / (nodes + 0.5L)), slope = 0;
      for (int newton = 0; newton < 10; ++newton) {
        Real before = 1, value = x;
        for (int k = 2; k <= nodes; ++k)
          before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
        slope = nodes * (x * value - before) / (x * x - 1);
        x -= value / slope;
      }
      all[static_cast<std::size_t>(i)] = {x, 2 / ((1 - x * x) * slope * slope)};
    }
    return all;
  }();
  return rule;
}

class March {
 public:
  March(const Law& law, const Series& x_t, const Series& x_n) : law_(law), x_t_(x_t), x_n_(x_n) {
    const Series& any = x_t.empty() ? x_n : x_t;
    order_ = any.order();
    const Series none(std::vector<Complex>(static_cast<std::size_t>(order_ + 1)));
    N_ = (x_n.empty() ? none : x_n.times(law.k_n)).plus(law.N_0);
    forces_.tangential.resize(static_cast<std::size_t>(order_ + 1));
    forces_.normal.resize(static_cast<std::size_t>(order_ + 1));
  }

  Forces run() {
    const Real at_rest = std::max(law_.N_0, Real(0));
    const auto [highest, lowest] = N_.range();
    const bool closed = lowest > 0, open = highest <= 0;
    if (!x_n_.empty()) normal(closed, open, at_rest);
    if (x_t_.empty()) {
      forces_.state = closed ? State::closed : open ? State::open : State::several;
      return forces_;
    }
    forces_.state = open ? State::open : State::several;
    if (open) return forces_;
    if (law_.mu == 0) {
      if (closed) forces_.state = State::slip;
      return forces_;
    }
    tangential(closed);
    return forces_;
  }

 private:
  void normal(bool closed, bool open, Real at_rest) {
    if (open) {
      forces_.normal[0] = -at_rest;
      forces_.normal_rounding = at_rest;
      return;
    }
    if (closed && at_rest > 0) {
      for (int n = 0; n <= order_; ++n) forces_.normal[static_cast<std::size_t>(n)] = law_.k_n * x_n_[n];
      forces_.normal_rounding = law_.k_n * x_n_.bound();
      forces_.normal_preload = at_rest;
      return;
    }
    const auto ends = period(N_.roots(0.1L));
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      if (N_.value((ends[i] + ends[i + 1]) / 2) > 0)
        add(
            ends[i], ends[i + 1], [&](Real theta) { return N_.value(theta); }, forces_.normal);
    forces_.normal[0] -= at_rest;
    forces_.normal_rounding = std::abs(law_.N_0) + law_.k_n * x_n_.bound();
  }

  void tangential(bool closed) {
    const Series h = N_.times(law_.mu / law_.k_t);
    const Series lower = x_t_.plus(h.times(-1)), upper = x_t_.plus(h);
    if (closed) {
      const Real a = lower.range().first, b = upper.range().second;
      if (a <= b) {
        for (int n = 0; n <= order_; ++n)
          forces_.tangential[static_cast<std::size_t>(n)] = law_.k_t * x_t_[n];
        forces_.tangential[0] -= law_.k_t * (a + b) / 2;
        forces_.tangential_rounding = law_.k_t * x_t_.moving() + law_.mu * N_.moving();
        forces_.tangential_preload =
            law_.k_t * std::abs(x_t_[0]) + law_.mu * (std::abs(law_.N_0) + std::abs(N_[0] - law_.N_0));
        forces_.state = State::stick;
        return;
      }
    }
    forces_.tangential_rounding =
        law_.k_t * x_t_.bound() +
        law_.mu * (std::abs(law_.N_0) + (law_.k_n > 0 ? law_.k_n * x_n_.bound() : 0));
    std::vector<Real> all = N_.roots(0.1L);
    for (const Series* bound : {&lower, &upper})
      for (const Real theta : bound->rate().roots(0.1L)) all.push_back(theta);
    std::sort(all.begin(), all.end());
    const auto ends = period(all);
    const Series lower_rate = lower.rate(), upper_rate = upper.rate(), rate = x_t_.rate();
    Real w = x_t_.value(ends.front());
    for (const bool counts : {false, true}) {
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const Real a = ends[i], b = ends[i + 1];
        if (!(b > a)) continue;
        if (N_.value((a + b) / 2) <= 0) {
          w = x_t_.value(b);
          continue;
        }
        const Real low = lower.value(b), high = upper.value(b);
        // The bound that carries the slider first.
        const Real from_below = low > w ? onset(lower, lower_rate, w, a, b) : b;
        const Real from_above = high < w ? onset(upper, upper_rate, w, a, b) : b;
        const Real begin = std::min(from_below, from_above);
        const Real sign = low > w && from_below <= from_above ? 1 : -1;
        if (counts) {
          add_tangential(a, begin, rate, [&](Real theta) { return law_.k_t * (x_t_.value(theta) - w); });
          add_tangential(begin, b, rate, [&](Real theta) { return sign * law_.mu * N_.value(theta); });
        }
        if (low > w || high < w) w = sign > 0 ? low : high;
      }
    }
  }

  // Where a monotonic bound reaches w in [a, b].
  static Real onset(const Series& bound, const Series& rate, Real w, Real a, Real b) {
    const bool reached = (bound.value(a) - w) * (bound.value(b) - w) >= 0;
    return reached ? a : bisected(bound, rate, w, a, b);
  }

  // The period from the first of these angles on, with the last one a turn later.
  static std::vector<Real> period(std::vector<Real> angles) {
    if (angles.empty()) angles.push_back(0);
    angles.push_back(angles.front() + turn);
    return angles;
  }

  template <class Force>
  void add_tangential(Real a, Real b, const Series& rate, const Force& force) {
    std::vector<Complex> by_rate(1);
    add(a, b, force, forces_.tangential);
    add(
        a, b, [&](Real theta) { return force(theta) * rate.value(theta); }, by_rate);
    forces_.work += turn * by_rate[0].real();
  }

  // F_n += integral of f exp(-i n theta) over pi, of the mean over 2 pi.
  template <class Function>
  void add(Real a, Real b, const Function& f, std::vector<Complex>& F) const {
    if (!(b > a)) return;
    const int panels = 1 + static_cast<int>((b - a) * static_cast<Real>(std::max(order_, 1)) / pi);
    const Real half = (b - a) / static_cast<Real>(2 * panels);
    for (int panel = 0; panel < panels; ++panel)
      for (const auto& [x, weight] : gauss()) {
        const Real theta = a + half * (static_cast<Real>(2 * panel + 1) + x);
        const Complex step = unit(-theta);
        Complex power = weight * half * f(theta) / pi;
        F[0] += power / Real(2);
        for (std::size_t n = 1; n < F.size(); ++n) F[n] += (power *= step);
      }
  }

  Law law_;
  const Series &x_t_, &x_n_;
  Series N_;
  int order_ = 0;
  Forces forces_;
};

}  // namespace

const char* name(State state) {
  constexpr const char* names[] = {"slip", "stick", "open", "closed", "several"};
  return names[static_cast<int>(state)];
}

Forces forces(const Law& law, const Series& x_t, const Series& x_n) {
  return March(law, x_t, x_n).run();
}

}  // namespace extended
