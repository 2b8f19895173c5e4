#include <arcslip/time/equation/parameter_derivatives.hpp>

#include <arcslip/laws/automata_rates.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::time {
namespace {

constexpr double least_size = 1e-200;  // of a parameter that has one

// Along the rates of its fields.
std::optional<ElementRates> rates_of(const TimeElement& element, const std::vector<double>& rates) {
  ElementRates all;
  if (std::all_of(rates.begin(), rates.end(), [](double rate) { return rate == 0; }) ||
      !element.law->automata(element.fields))
    return all;
  auto automata = elements::automata_rates(*element.law, element.fields, rates);
  if (!automata) return {};
  all.automata = std::move(*automata);
  for (const elements::Automaton& automaton : all.automata) {
    ElementRates::Slider& bounds = all.sliders.emplace_back();
    if (automaton.memory < 0) continue;
    const elements::Slider slider = elements::slider_of(automaton);
    bounds.lower = element.directions * slider.lower.transpose();
    bounds.upper = element.directions * slider.upper.transpose();
    bounds.room = slider.room.value_or(0);
    bounds.centre = slider.centre;
  }
  return all;
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
