#include <arcslip/optimize/evaluation/design_space.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/observables/quantities.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr std::array<double, 7> diagonal = {0.5, 0.25, 0.75, 0.125, 0.875, 0, 1};  // shares of the bounds
constexpr int samples_of_all = 8, samples_of_each = 8;                             // parameter
constexpr const char* linear_name = "a linear limit";

// Whether the responses tell the mean force that a contact may hold.
bool reports_mean_force(const model::Model& model, const model::NonlinearPart& part) {
  const auto element = part.law->element(
      model.harmonics, {model.settings.friction == scene::Friction::exact, model.settings.samples});
  const Eigen::Index size = model.harmonics.size() * (part.law->directions() + part.law->auxiliary());
  element->move_to(Vector::Zero(size), part.fields(model::defaults(model)), false);
  elements::FrictionState state;
  return element->friction(state) && std::isfinite(state.mean_max);
}

// Of what the responses of a model have, the quantity of a name.
class ObservableSearch {
 public:
  ObservableSearch(const model::Model& model, double to_unit, const std::string& name)
      : model_(model), to_unit_(to_unit), name_(name) {}

  // Throws OptionsError with what there is.
  PeakAmplitude::Observable run() {
    if (auto found = of_response()) return found;
    for (std::size_t e = 0; e < model_.elements.size(); ++e)
      if (auto found = of_element(e)) return found;
    for (std::size_t k = 0; k < model_.patches.size(); ++k)
      if (auto found = of_patch(k)) return found;
    std::string list;
    for (const std::string& each : known_) list += (list.empty() ? "" : ", ") + each;
    const std::string likely = scene::nearest(name_, known_);
    throw OptionsError("no observable \"" + name_ + "\" to limit" +
                       (likely.empty() ? "." : "; did you mean \"" + likely + "\"?") + " Known: " + list);
  }

 private:
  using Number = observables::ElementQuantity::Number;

  PeakAmplitude::Observable of_response() {
    using observables::ResponseQuantity;
    for (const ResponseQuantity& each : observables::response_quantities()) {
      const auto* get = std::get_if<ResponseQuantity::Number>(&each.get);
      if (!get || each.has || !is_wanted(std::string(each.path))) continue;
      return [get = *get, unit = each.unit == observables::frequency_unit ? to_unit_ : 1](
                 const observables::ResponsePoint& point) { return unit * get(point); };
    }
    return {};
  }

  PeakAmplitude::Observable of_element(std::size_t e) {
    const model::NonlinearPart& element = model_.elements[e];
    for (const std::string_view path :
         {"stick_percent", "energy", "equivalent_stiffness", "equivalent_damping", "open_percent",
          "normal_load_max", "normal_load_min", "mean_force_min", "mean_force_max", "wear_rate"})
      if (has(element, path) && is_wanted(element.name + "." + std::string(path)))
        return [e, get = std::get<Number>(observables::element_quantity(path).get)](
                   const observables::ResponsePoint& point) { return get(point.elements[e]); };
    return {};
  }

  PeakAmplitude::Observable of_patch(std::size_t k) {
    const model::NonlinearPart& first = model_.elements[model_.patches[k].first];
    for (const observables::ElementQuantity& each : observables::patch_quantities()) {
      const bool always = each.path.starts_with("energy") || each.path.starts_with("stick_percent");
      const bool some =
          always || (each.path.starts_with("wear") ? has(first, "wear_rate") : has_normal_load(first));
      if (some && is_wanted(model_.patches[k].name + "." + std::string(each.path)))
        return [k, get = std::get<Number>(each.get)](const observables::ResponsePoint& point) {
          return get(point.patches[k]);
        };
    }
    return {};
  }

  static bool has_normal_load(const model::NonlinearPart& element) { return element.law->has_normal_load(); }
  bool has(const model::NonlinearPart& element, std::string_view path) const {
    if (path == "stick_percent" || path == "energy") return element.law->has_contact();
    if (path == "open_percent" || path.starts_with("normal_load")) return has_normal_load(element);
    if (path.starts_with("mean_force")) return reports_mean_force(model_, element);
    return path != "wear_rate" || element.wear_coefficient != 0;
  }

  bool is_wanted(const std::string& path) { return known_.emplace_back(path) == name_; }

  const model::Model& model_;
  double to_unit_;
  const std::string& name_;
  std::vector<std::string> known_;
};

}  // namespace

DesignSpace::DesignSpace(const scene::Scene& scene, const OptimumProblem& problem)
    : to_unit_(1 / scene::to_rad_per_s(scene.frequency_unit)) {
  if (problem.over.empty()) throw OptionsError("there is nothing to vary: no parameter is named");
  if (!(problem.frequency_from > 0 && problem.frequency_from < problem.frequency_to))
    throw OptionsError(continuation::text("the frequency window is [", problem.frequency_from, ", ",
                                          problem.frequency_to, "]: 0 < lower < upper"));
  model_ = std::make_shared<model::Model>(model::build(scene));
  for (const DesignVariable& v : problem.over) add(v, scene);
  for (const LinearLimit& limit : problem.linear_limits) add(limit);
  for (const ObservableLimit& limit : problem.limits) {
    static_cast<void>(observable(limit.observable));
    if (std::isnan(limit.at_least) || std::isnan(limit.at_most) || !(limit.at_least < limit.at_most))
      throw OptionsError(continuation::text("limit on \"", limit.observable, "\" is [", limit.at_least, ", ",
                                            limit.at_most, "]: the lower must be below the upper"));
  }
}

void DesignSpace::add(const DesignVariable& v, const scene::Scene& scene) {
  const std::string bounds =
      continuation::text("bounds of \"", v.name, "\" are [", v.lower, ", ", v.upper, "]");
  if (std::find(names_.begin(), names_.end(), v.name) != names_.end())
    throw OptionsError("parameter \"" + v.name + "\" is named twice");
  if (v.name == "frequency") throw OptionsError("the frequency cannot be a design parameter");
  scene::Scene with = scene;
  scene::set(with, v.name, scene::value(scene, v.name));  // unknown, or tied
  if (!(std::isfinite(v.lower) && std::isfinite(v.upper))) throw OptionsError(bounds + ": must be finite");
  if (v.lower == v.upper)
    throw OptionsError(bounds + ": equal bounds leave nothing to vary; leave the parameter out");
  if (!(v.lower < v.upper)) throw OptionsError(bounds + ": the lower must be below the upper");
  for (const double bound : {v.lower, v.upper}) scene::set(with, v.name, bound);  // may it take them?
  names_.push_back(v.name);
  parameters_.push_back(model::parameter_index(*model_, v.name));
  lower_.push_back(v.lower);
  upper_.push_back(v.upper);
  scales_.emplace_back(v.lower, v.upper);
}

void DesignSpace::add(const LinearLimit& limit) {
  std::vector<double> weights(names_.size(), 0.0);
  for (const auto& [name, weight] : limit.weights) {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at == names_.end())
      throw OptionsError("a linear limit names \"" + name +
                         "\", which is not one of the design parameters: " + names());
    weights[static_cast<std::size_t>(at - names_.begin())] += weight;
  }
  for (const auto& [sign, bound] : {std::pair(1, limit.at_most), std::pair(-1, limit.at_least)}) {
    if (!std::isfinite(bound)) continue;
    Linear& each = linear_.emplace_back(Linear{weights, sign * bound, bound != 0 ? std::abs(bound) : 1});
    for (double& w : each.weights) w *= sign;
  }
}

std::vector<double> DesignSpace::start(std::vector<std::string>& notes) const {
  std::vector<double> start;
  for (std::size_t k = 0; k < names_.size(); ++k) {
    const double own = model_->parameters[static_cast<std::size_t>(parameters_[k])].value;
    start.push_back(std::clamp(own, lower_[k], upper_[k]));
    if (start.back() != own)
      notes.push_back(continuation::text("the start ", names_[k], " = ", own, " is outside [", lower_[k],
                                         ", ", upper_[k], "], and was moved to ", start.back()));
  }
  return start;
}

int DesignSpace::attempts() const {
  return static_cast<int>(diagonal.size());
}

std::vector<double> DesignSpace::attempt(int k) const {
  const double share = diagonal[static_cast<std::size_t>(k)];
  std::vector<double> y = scaled(lower_);
  const std::vector<double> upper = scaled(upper_);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += share * (upper[i] - y[i]);
  return design(y);
}

int DesignSpace::samples() const {
  return samples_of_all + samples_of_each * static_cast<int>(names_.size());
}

// A lattice by the powers of the root g of g^(n+1) = g + 1 (for n = 1 the golden ratio), from the centre.
std::vector<double> DesignSpace::sample(int k) const {
  const auto n = static_cast<double>(names_.size());
  double g = 2;
  for (int i = 0; i < 60; ++i) g = std::pow(1 + g, 1 / (n + 1));
  std::vector<double> y = scaled(lower_);
  const std::vector<double> upper = scaled(upper_);
  double rate = 1, whole = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    rate /= g;
    y[i] += std::modf(0.5 + rate * (k + 1), &whole) * (upper[i] - y[i]);
  }
  return design(y);
}

double DesignSpace::distance(std::span<const double> a, std::span<const double> b) const {
  double most = 0;
  for (std::size_t k = 0; k < names_.size(); ++k)
    most = std::max(most, std::abs(scales_[k].scaled(a[k]) - scales_[k].scaled(b[k])) /
                              (scales_[k].scaled(upper_[k]) - scales_[k].scaled(lower_[k])));
  return most;
}

std::vector<double> DesignSpace::scaled(std::span<const double> design) const {
  std::vector<double> y;
  for (std::size_t k = 0; k < design.size(); ++k) y.push_back(scales_[k].scaled(design[k]));
  return y;
}

std::vector<double> DesignSpace::design(std::span<const double> y) const {
  std::vector<double> design;
  for (std::size_t k = 0; k < names_.size(); ++k)
    design.push_back(std::clamp(scales_[k].value(y[k]), lower_[k], upper_[k]));
  return design;
}

double DesignSpace::slope(std::size_t k, double value) const {
  return scales_[k].slope(value);
}

PeakAmplitude::Observable DesignSpace::observable(const std::string& name) const {
  return ObservableSearch(*model_, to_unit_, name).run();
}

double DesignSpace::value(const Linear& limit, std::span<const double> design) const {
  double sum = 0;
  for (std::size_t k = 0; k < names_.size(); ++k) sum += limit.weights[k] * design[k];
  return (sum - limit.bound) / limit.scale;
}

void DesignSpace::add_linear(NonlinearProgram& problem) const {
  const std::size_t n = names_.size();
  for (const Linear& limit : linear_)
    problem.constraints.push_back({linear_name,
                                   [this, n, limit](auto y, auto g) {
                                     const std::vector<double> p = design(y.first(n));
                                     std::fill(g.begin(), g.end(), 0.0);
                                     for (std::size_t k = 0; k < std::min(n, g.size()); ++k)
                                       g[k] = limit.weights[k] * slope(k, p[k]) / limit.scale;
                                     return value(limit, p);
                                   },
                                   limit_tolerance});
}

double DesignSpace::margin(std::span<const double> design) const {
  double margin = -std::numeric_limits<double>::infinity();
  for (const Linear& limit : linear_) margin = std::max(margin, value(limit, design));
  return margin;
}

std::vector<ActiveLimit> DesignSpace::active(std::span<const double> design) const {
  std::vector<ActiveLimit> active;
  for (const Linear& limit : linear_) {
    const double at = value(limit, design);
    if (at < -as_active) continue;
    Vector gradient(static_cast<Eigen::Index>(design.size()));
    for (std::size_t k = 0; k < design.size(); ++k)
      gradient[static_cast<Eigen::Index>(k)] = limit.weights[k] * slope(k, design[k]) / limit.scale;
    active.push_back({linear_name, 0, gradient, -at});
  }
  return active;
}

std::string DesignSpace::text(std::span<const double> design) const {
  std::string list;
  for (std::size_t k = 0; k < names_.size(); ++k)
    list += (k == 0 ? "" : ", ") + names_[k] + " = " + continuation::text(design[k]);
  return list;
}

std::string DesignSpace::names() const {
  std::string list;
  for (const std::string& name : names_) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace arcslip::optimize
