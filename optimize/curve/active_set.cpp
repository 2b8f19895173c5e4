#include <arcslip/optimize/curve/active_set.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::optimize {
namespace {

using continuation::Matrix;
using Kind = Inequality::Kind;

constexpr double violated = 1e-7;  // of multipliers and of y

struct Multiplier {
  Inequality of;
  double value;
};

std::vector<Multiplier> multipliers(const ActiveSet& active, const OptimalityEvaluator& at) {
  std::vector<Multiplier> all;
  const auto add = [&](const Inequality& of) { all.push_back({of, at.slack(of)}); };
  for (const std::size_t i : active.peaks) add({Kind::peak, i});
  for (std::size_t k = 0; k < active.held.size(); ++k)
    if (active.held[k] != 0) add({Kind::bound, k, active.held[k]});
  return all;
}

// In the balance of gradients, and of the weights.
Vector column(const Inequality& of, const OptimalityEvaluator& at, Eigen::Index parameters) {
  Vector c = Vector::Zero(parameters + 1);
  if (of.kind == Kind::peak)
    c << at.gradient(of.index), 1;
  else
    c[static_cast<Eigen::Index>(of.index)] = of.side;
  return c;
}

// The multiplier that vanishes first as that of `what` increases: its index, with the values of the others
// and of `what` then.
std::optional<std::size_t> leaves(const Inequality& what, const OptimalityEvaluator& at,
                                  std::vector<Multiplier>& all, double& entering) {
  const auto count = static_cast<Eigen::Index>(all.size());
  Matrix B(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    B.col(i) = column(all[static_cast<std::size_t>(i)].of, at, count - 1);
  const Vector change = -continuation::solve_any(B, column(what, at, count - 1));
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double rate = change[static_cast<Eigen::Index>(i)];
    if (!(rate < 0) || (first && all[i].value / -rate >= entering)) continue;
    entering = all[i].value / -rate;
    first = i;
  }
  if (first)
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i].value += entering * change[static_cast<Eigen::Index>(i)];
  return first;
}

}  // namespace

std::vector<Inequality> inequalities(const ActiveSet& active) {
  std::vector<Inequality> all;
  for (std::size_t k = 0; k < active.held.size(); ++k)
    for (const int side : {-1, 1})
      if (active.held[k] == 0 || active.held[k] == side) all.push_back({Kind::bound, k, side});
  if (active.peaks.size() > 1)
    for (const std::size_t i : active.peaks) all.push_back({Kind::peak, i});
  return all;
}

bool exchange(ActiveSet& active, const OptimalityEvaluator& at) {
  if (at.highest_other() && at.distance_of_others() < -higher_peak) {
    active.peaks.push_back(*at.highest_other());
    return true;
  }
  for (const Inequality& each : inequalities(active)) {
    if (!(at.slack(each) < -violated)) continue;
    if (each.kind == Kind::peak)
      std::erase(active.peaks, each.index);
    else
      active.held[each.index] = active.held[each.index] == 0 ? each.side : 0;
    return true;
  }
  return false;
}

std::optional<Exchanged> exchanged(const ActiveSet& active, const Inequality& what,
                                   const OptimalityEvaluator& at) {
  std::vector<Multiplier> all = multipliers(active, at);
  Exchanged result{{{}, std::vector<int>(active.held.size(), 0)}, {}, what};
  const auto known = std::find_if(all.begin(), all.end(), [&](const Multiplier& m) { return m.of == what; });
  if (known != all.end()) {
    all.erase(known);
  } else {
    double entering = 0;
    if (all.size() == active.held.size() + 1) {
      const auto out = leaves(what, at, all, entering);
      if (!out) return {};
      result.watched = all[*out].of;
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(*out));
    }
    all.push_back({what, entering});
  }
  for (const auto& [of, value] : all) {
    if (of.kind == Kind::bound) {
      result.active.held[of.index] = of.side;
    } else {
      result.active.peaks.push_back(of.index);
      result.weights.push_back(value);
    }
  }
  return result;
}

}  // namespace arcslip::optimize
