#include <arcslip/laws/automata_rates.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

namespace arcslip::elements {
namespace {

constexpr double difference_step = 6e-6;  // relative: the cube root of the rounding error

using Automata = std::vector<Automaton>;

bool same(const Mode& m, const Mode& n) {
  return m.name == n.name && m.rests == n.rests &&
         std::equal(m.leaves.begin(), m.leaves.end(), n.leaves.begin(), n.leaves.end(),
                    [](const Guard& g, const Guard& h) {
                      return g.to == h.to && g.q.size() == h.q.size() && g.v.size() == h.v.size();
                    });
}

bool same_modes(const Automata& a, const Automata& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Automaton& one, const Automaton& other) {
    return std::equal(one.modes.begin(), one.modes.end(), other.modes.begin(), other.modes.end(), same);
  });
}

// to += weight * from, in all their numbers.
void add(double weight, const Guard& from, Guard& to) {
  to.q += weight * from.q;
  to.v += weight * from.v;
  to.z += weight * from.z;
  to.c += weight * from.c;
}

void add(double weight, const Mode& from, Mode& to) {
  to.f_q += weight * from.f_q;
  to.f_z += weight * from.f_z;
  to.f_0 += weight * from.f_0;
  to.z_q += weight * from.z_q;
  to.z_0 += weight * from.z_0;
  for (std::size_t i = 0; i < to.leaves.size(); ++i) add(weight, from.leaves[i], to.leaves[i]);
}

void add(double weight, const Automata& from, Automata& to) {
  for (std::size_t i = 0; i < to.size(); ++i)
    for (std::size_t j = 0; j < to[i].modes.size(); ++j) add(weight, from[i].modes[j], to[i].modes[j]);
}

// The sum of weight * (automata - here): exactly 0 where a number does not change.
Automata sum(const Automata& here, std::initializer_list<std::pair<double, const Automata*>> terms) {
  Automata all = here;
  add(-1, here, all);
  for (const auto& [weight, automata] : terms) {
    Automata change = *automata;
    add(-1, here, change);
    add(weight, change, all);
  }
  return all;
}

}  // namespace

std::optional<Automata> automata_rates(const Law& law, Fields fields, std::span<const double> rates) {
  double h = std::numeric_limits<double>::infinity(), limit = 0;  // 1, -1: the side of a limit
  for (std::size_t k = 0; k < rates.size(); ++k) {
    if (rates[k] == 0) continue;
    const double field = std::abs(fields[k]);
    if (field == 0 && limit == 0) limit = rates[k] > 0 ? 1 : -1;
    h = std::min(h, difference_step * (field == 0 ? 1 : field) / std::abs(rates[k]));
  }
  const Automata here = automata_of(law, fields);
  if (std::isinf(h)) return sum(here, {});
  std::vector<double> moved(fields.begin(), fields.end());
  const auto at = [&](double distance) -> std::optional<Automata> {
    for (std::size_t k = 0; k < rates.size(); ++k) moved[k] = fields[k] + distance * rates[k];
    auto automata = law.automata(moved);
    if (!automata || !same_modes(here, *automata)) return {};
    return automata;
  };
  const auto one_sided = [&](double side) -> std::optional<Automata> {
    const auto once = at(side * h), twice = at(2 * side * h);
    if (!once || !twice) return {};
    return sum(here, {{2 / (side * h), &*once}, {-0.5 / (side * h), &*twice}});
  };
  if (limit != 0) return one_sided(limit);
  const auto above = at(h), below = at(-h);
  if (above && below) return sum(here, {{0.5 / h, &*above}, {-0.5 / h, &*below}});
  auto rate = one_sided(1);
  return rate ? rate : one_sided(-1);
}

}  // namespace arcslip::elements
