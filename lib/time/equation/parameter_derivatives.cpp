#include <arcslip/time/equation/parameter_derivatives.hpp>

#include <arcslip/continuation/problem/difference.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

namespace arcslip::time {
namespace {

constexpr double least_size = 1e-200;  // of a parameter that has one

using elements::Automaton;
using elements::Guard;
using elements::Law;
using elements::Mode;

// A law's automata, and its sliders' bounds, which are functions of its fields.
struct Numbers {
  std::vector<Automaton> automata;
  std::vector<ElementRates::Slider> sliders;
};

Numbers numbers_of(const TimeElement& element, const std::vector<double>& fields) {
  Numbers numbers;
  auto automata = element.law->automata(fields);
  if (!automata) return numbers;
  numbers.automata = std::move(*automata);
  for (const Automaton& automaton : numbers.automata) {
    ElementRates::Slider& slider = numbers.sliders.emplace_back();
    const int k = automaton.memory;
    if (k < 0 || element.law->slider_direction(k) < 0) continue;
    slider.lower = element.directions * element.law->slider_bound(fields, k, -1).transpose();
    slider.upper = element.directions * element.law->slider_bound(fields, k, 1).transpose();
    slider.room = element.law->slider_room(fields, k).value_or(0);
  }
  return numbers;
}

bool same_modes(const Numbers& a, const Numbers& b) {
  return std::equal(a.automata.begin(), a.automata.end(), b.automata.begin(), b.automata.end(),
                    [](const Automaton& one, const Automaton& other) {
                      return std::equal(one.modes.begin(), one.modes.end(), other.modes.begin(),
                                        other.modes.end(), [](const Mode& m, const Mode& n) {
                                          return m.name == n.name && m.rests == n.rests &&
                                                 std::equal(
                                                     m.leaves.begin(), m.leaves.end(), n.leaves.begin(),
                                                     n.leaves.end(), [](const Guard& g, const Guard& h) {
                                                       return g.to == h.to && g.q.size() == h.q.size() &&
                                                              g.v.size() == h.v.size();
                                                     });
                                        });
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

void add(double weight, const Numbers& from, Numbers& to) {
  for (std::size_t i = 0; i < to.automata.size(); ++i) {
    for (std::size_t j = 0; j < to.automata[i].modes.size(); ++j)
      add(weight, from.automata[i].modes[j], to.automata[i].modes[j]);
    to.sliders[i].lower += weight * from.sliders[i].lower;
    to.sliders[i].upper += weight * from.sliders[i].upper;
    to.sliders[i].room += weight * from.sliders[i].room;
  }
}

// The sum of weight * (numbers - here): exactly 0 where a number does not change.
ElementRates sum(const Numbers& here, std::initializer_list<std::pair<double, const Numbers*>> terms) {
  Numbers all = here;
  add(-1, here, all);
  for (const auto& [weight, numbers] : terms) {
    Numbers change = *numbers;
    add(-1, here, change);
    add(weight, change, all);
  }
  return {std::move(all.automata), std::move(all.sliders)};
}

// Along the rates of its fields. A field of 0 is a limit of most laws, below which they have other numbers:
// then from the side on which it is positive.
std::optional<ElementRates> rates_of(const TimeElement& element, const std::vector<double>& rates) {
  if (std::all_of(rates.begin(), rates.end(), [](double rate) { return rate == 0; })) return ElementRates{};
  double h = std::numeric_limits<double>::infinity(), limit = 0;  // 1, -1: the side of a limit
  for (std::size_t k = 0; k < rates.size(); ++k) {
    if (rates[k] == 0) continue;
    const double field = std::abs(element.fields[k]);
    if (field == 0 && limit == 0) limit = rates[k] > 0 ? 1 : -1;
    h = std::min(h, continuation::difference_step * (field == 0 ? 1 : field) / std::abs(rates[k]));
  }
  const Numbers here = numbers_of(element, element.fields);
  const auto at = [&](double distance) -> std::optional<Numbers> {
    std::vector<double> fields = element.fields;
    for (std::size_t k = 0; k < rates.size(); ++k) fields[k] += distance * rates[k];
    Numbers numbers = numbers_of(element, fields);
    if (!same_modes(here, numbers)) return {};
    return numbers;
  };
  const auto one_sided = [&](double side) -> std::optional<ElementRates> {
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

Matrix rate_of(const Matrix& above, const Matrix& below, double distance) {
  if (above == below) return {};
  return (above - below) / distance;
}

// The parts of both that differ, over the distance.
template <class Part, class Same>
std::vector<Part> difference(const std::vector<Part>& above, const std::vector<Part>& below, double distance,
                             Same&& same) {
  std::vector<Part> parts;
  const auto add = [&](const Part& part, double weight) {
    parts.push_back(part);
    parts.back().cosine *= weight;
    parts.back().sine *= weight;
  };
  const bool in_pairs = above.size() == below.size();
  for (std::size_t i = 0; i < above.size(); ++i)
    if (!in_pairs || !same(above[i], below[i])) add(above[i], 1 / distance);
  for (std::size_t i = 0; i < below.size(); ++i)
    if (!in_pairs || !same(above[i], below[i])) add(below[i], -1 / distance);
  return parts;
}

void add_by_frequency(const model::Model& model, const continuation::Vector& p, EquationRates& rates) {
  rates.omega = model.harmonics.base_frequency(1);
  const double w = p[model::frequency];
  for (const model::Excitation& part : model.excitation) {
    const int n = model.harmonics.excited(part.harmonic);
    const std::complex<double> given = part.amplitude(p);
    if (const double rate = part.factor_rate(w); rate != 0)
      rates.forces.push_back(
          {rate / part.factor(w) * model::shape(model, part, p), n, given.real(), -given.imag()});
    const double moved =
        (model.absolute ? part.direction.dot(model.response) : 0) * part.displacement_rate(w);
    if (moved != 0) rates.base.push_back({n, moved * given.real(), -moved * given.imag()});
  }
}

}  // namespace

double EquationRates::base_at(const EquationOfMotion& equation, double t) const {
  double sum = 0;
  const auto angle = [&](const BaseMotion& part) { return part.harmonic * equation.omega * t; };
  for (const BaseMotion& part : base)
    sum += part.cosine * std::cos(angle(part)) + part.sine * std::sin(angle(part));
  for (const BaseMotion& part : equation.base)
    sum +=
        omega * part.harmonic * t * (part.sine * std::cos(angle(part)) - part.cosine * std::sin(angle(part)));
  return sum;
}

double size_of_parameter(const model::Model& model, const continuation::Vector& p, int k) {
  const double size = std::max(std::abs(p[k]), model.parameters[static_cast<std::size_t>(k)].scale);
  return size > least_size ? size : 1;
}

namespace {

// The model with a parameter of its own for each number that is a formula, and the derivatives of all by one.
struct WithoutFormulas {
  model::Model model;
  continuation::Vector p, by;
};

WithoutFormulas without_formulas(const model::Model& model, const continuation::Vector& p, int k) {
  WithoutFormulas all{model, p, {}};
  const Eigen::Index own = p.size(), more = static_cast<Eigen::Index>(model.formulas.size());
  all.p.conservativeResize(own + more);
  all.by.setZero(own + more);
  all.by[k] = 1;
  all.model.formulas.clear();
  for (Eigen::Index i = 0; i < more; ++i) {
    const auto& formula = model.formulas[static_cast<std::size_t>(i)];
    all.p[own + i] = formula->value(p);
    all.by[own + i] = formula->rate(p, k);
    all.model.parameters.push_back({formula->name, {}, all.p[own + i], std::abs(all.p[own + i])});
    for (model::Number* number : model::numbers(all.model))
      if (number->formula() == formula) *number = static_cast<int>(own + i);
  }
  return all;
}

// By parameter k, and by all others along with it.
std::optional<EquationRates> rates_along(const model::Model& model, const continuation::Vector& p, int k,
                                         const continuation::Vector& by) {
  EquationRates rates;
  const double h = size_of_parameter(model, p, k);
  const continuation::Vector above_p = p + h * by, below_p = p - h * by;
  const double distance = above_p[k] - below_p[k];
  rates.M = rate_of(model::mass_matrix(model, above_p), model::mass_matrix(model, below_p), distance);
  rates.C = rate_of(model::damping_matrix(model, above_p), model::damping_matrix(model, below_p), distance);
  rates.K =
      rate_of(model::stiffness_matrix(model, above_p), model::stiffness_matrix(model, below_p), distance);
  const EquationOfMotion here = equation_of_motion(model, p);
  for (std::size_t e = 0; e < here.elements.size(); ++e) {
    const std::vector<double> above = model.elements[e].fields(above_p),
                              below = model.elements[e].fields(below_p);
    std::vector<double> of_fields(above.size());
    for (std::size_t i = 0; i < above.size(); ++i) of_fields[i] = (above[i] - below[i]) / distance;
    auto of = rates_of(here.elements[e], of_fields);
    if (!of) return {};
    rates.elements.push_back(std::move(*of));
  }
  if (k == model::frequency) {
    add_by_frequency(model, p, rates);
    return rates;
  }
  const EquationOfMotion above = equation_of_motion(model, above_p),
                         below = equation_of_motion(model, below_p);
  rates.forces =
      difference(above.forces, below.forces, distance, [](const HarmonicForce& a, const HarmonicForce& b) {
        return a.direction == b.direction && a.cosine == b.cosine && a.sine == b.sine;
      });
  rates.base = difference(above.base, below.base, distance, [](const BaseMotion& a, const BaseMotion& b) {
    return a.cosine == b.cosine && a.sine == b.sine;
  });
  return rates;
}

}  // namespace

std::optional<EquationRates> equation_rates(const model::Model& model, const continuation::Vector& p, int k) {
  // The differences are exact where the equation is at most quadratic in what changes, as it is in its own
  // numbers, but in no formula.
  const bool follow = std::any_of(model.formulas.begin(), model.formulas.end(),
                                  [k](const auto& number) { return number->formula.uses(k); });
  if (!follow) return rates_along(model, p, k, continuation::Vector::Unit(p.size(), k));
  const WithoutFormulas all = without_formulas(model, p, k);
  return rates_along(all.model, all.p, k, all.by);
}

}  // namespace arcslip::time
