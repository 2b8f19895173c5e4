#include <arcslip/observables/quantities.hpp>

#include <arcslip/laws/law_type.hpp>
#include <arcslip/scene/patch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace arcslip::observables {
namespace {

using Point = ResponsePoint;
using Element = ElementResponse;

template <auto member>
double value(const Point& point) {
  return point.*member;
}

// no_value where the amplitude is unbounded.
template <auto member>
double bounded(const Point& point) {
  return point.unbounded ? no_value : point.*member;
}

template <double Synthesis::* member>
double synthesis(const Point& point) {
  return point.synthesis.*member;
}

bool has_true_peak(const Point& point) {
  return !std::isnan(point.synthesis.true_omega);
}

template <double ForceComponents::* member>
double force(const Point& point) {
  return point.forces.*member;
}

template <PhaseParts ForceComponents::* member, double PhaseParts::* part>
double force(const Point& point) {
  return point.forces.*member.*part;
}

template <double PhaseParts::* part>
double total_force(const Point& point) {
  return point.forces.total().*part;
}

template <double MotionMaxima::* member>
double largest(const Point& point) {
  return point.maxima.*member;
}

template <double PhaseParts::* part>
double largest_force(const Point& point) {
  return point.maxima.force_per_displacement.*part;
}

template <double Element::* member>
double element(const Element& element) {
  return element.*member;
}

template <double ContactExtremes::* member>
double extreme(const Element& patch) {
  return patch.extremes.*member;
}

template <std::vector<double> Element::* member>
const std::vector<double>& angles(const Element& element) {
  return element.*member;
}

template <double PhaseParts::* part>
double fundamental(const Element& element) {
  return element.fundamental.*part;
}

template <double ForceMaxima::* member>
double largest_of(const Element& element) {
  return element.maxima.*member;
}

results::Value contact_states(const Element& element) {
  results::Value::List states;
  for (const auto& interval : element.contact) states.emplace_back(interval.state);
  return states;
}

results::Value contact_angles(const Element& element) {
  results::Value::Numbers angles;
  for (const auto& interval : element.contact) angles.push_back(interval.begin);
  return angles;
}

bool has_contact_states(const Element& element) {
  return !element.contact.empty();
}

bool is_unbounded(const Point& point) {
  return point.unbounded;
}

bool is_bounded(const Point& point) {
  return !point.unbounded;
}

bool has_maxima(const Point& point) {
  return !std::isnan(point.maxima.velocity);
}

bool has_named_maxima(const NamedResponse& response) {
  return !std::isnan(response.velocity);
}

bool has_force_maxima(const Point& point) {
  return has_maxima(point) && !std::isnan(point.maxima.force_per_displacement.in_phase);
}

bool is_friction(const Element& element) {
  return element.has_stick;
}

bool has_normal_load(const Element& element) {
  return element.has_normal_load;
}

bool has_wear(const Element& element) {
  return !std::isnan(element.wear_rate);
}

bool has_stick_estimate(const Element& element) {
  return !std::isnan(element.stick_estimate);
}

bool has_mean_force(const Element& element) {
  return !std::isnan(element.mean_force_min);
}

bool has_element_maxima(const Element& element) {
  return !std::isnan(element.maxima.force);
}

bool has_nonlinear_spring(const Point& point) {
  return is_bounded(point) && !std::all_of(point.elements.begin(), point.elements.end(), is_friction);
}

bool has_one_friction_element(const Point& point) {
  return std::count_if(point.elements.begin(), point.elements.end(), is_friction) == 1;
}

// Of an element, or of a patch by its law.
std::shared_ptr<const elements::Law> law_of(const scene::Part& part) {
  if (part.type != &scene::patch_type()) return elements::law_of(part);
  const auto& patch = part.options.as<scene::PatchOptions>();
  scene::Part element;
  element.type = patch.law;
  element.options = patch.law_options;
  return elements::law_of(element);
}

bool is_part_with_normal_load(const scene::Part& part) {
  return law_of(part)->has_normal_load();
}

bool is_part_that_reports_contact(const scene::Part& part) {
  return law_of(part)->reports_contact();
}

bool is_part_with_wear(const scene::Part& part) {
  return part.wear_coefficient > 0;
}

}  // namespace

bool is_friction_part(const scene::Part& part) {
  return law_of(part)->has_contact();
}

namespace {

bool one_friction_part(const scene::Scene& scene) {
  const auto elements = scene::all_elements(scene);
  return std::count_if(elements.begin(), elements.end(), is_friction_part) == 1;
}

bool any_nonlinear_spring(const scene::Scene& scene) {
  return !std::all_of(scene.elements.begin(), scene.elements.end(), is_friction_part) ||
         !std::all_of(scene.patches.begin(), scene.patches.end(), is_friction_part);
}

bool one_mass_and_friction_part(const scene::Scene& scene) {
  return scene.dofs.size() == 1 && scene::all_elements(scene).size() == 1 && one_friction_part(scene);
}

double stick_of_one(const Point& point) {
  return std::find_if(point.elements.begin(), point.elements.end(), is_friction)->stick_percent;
}

using F = ForceComponents;
using P = PhaseParts;

constexpr ResponseQuantity of_response[] = {
    {"omega", "rad/s", "excitation frequency", value<&Point::omega>},
    {"frequency", frequency_unit, "excitation frequency", value<&Point::omega>},
    {"amplitude", "m",
     "largest absolute displacement of the response over the period; null where unbounded, as is all that "
     "depends on it",
     bounded<&Point::amplitude>},
    {"unbounded", "", "only if true: the amplitude grows without bound", is_unbounded, is_unbounded},
    {"phase", "rad", "phase lag of the response's fundamental behind the excitation", bounded<&Point::phase>},
    {"truncation_estimate", "m",
     "estimated effect of the neglected harmonics on the amplitude at this frequency (or parameter value); "
     "at an event, on the amplitude of the event, which may move; null at a branch point of the same "
     "harmonics, where it is not known; between events of structures with more than 16 nonlinear "
     "coordinates and a fixed order, that of the line between points at which it is computed (section 7.5)",
     bounded<&Point::truncation_estimate>},
    {"truncation_flagged", "", "the estimate may be too low",
     [](const Point& point) { return point.truncation_flagged; }},
    {"energy_friction", "J", "dissipated per period by the elements", bounded<&Point::energy_friction>},
    {"energy_viscous", "J", "dissipated per period by the dampers, and taken by circulatory forces",
     bounded<&Point::energy_viscous>},
    {"energy_total", "J", "their sum",
     [](const Point& point) { return point.unbounded ? no_value : point.energy_total(); }},
    {"energy_input", "J", "work of the excitation per period; equals `energy_total`",
     bounded<&Point::energy_input>},
    {"friction_percent", "%", "share of friction in `energy_total`",
     [](const Point& point) { return point.unbounded ? no_value : point.friction_percent(); }},
    {"stick_percent", "%", "share of the period in stick, if there is exactly one friction element",
     stick_of_one, has_one_friction_element, one_friction_part},
    {"force_per_displacement.in_phase.total", "N/m",
     "F_p/x: fundamental of the forces along the motion, in phase with it, per unit displacement of the "
     "response",
     total_force<&P::in_phase>, is_bounded},
    {"force_per_displacement.in_phase.inertia", "N/m", "contribution of the inertia", force<&F::inertia>,
     is_bounded},
    {"force_per_displacement.in_phase.spring", "N/m", "contribution of the linear springs", force<&F::spring>,
     is_bounded},
    {"force_per_displacement.in_phase.contact", "N/m", "contribution of the friction elements",
     force<&F::contact, &P::in_phase>, is_bounded},
    {"force_per_displacement.in_phase.nonlinear_spring", "N/m",
     "contribution of the nonlinear springs, if any", force<&F::nonlinear_spring, &P::in_phase>,
     has_nonlinear_spring, any_nonlinear_spring},
    {"force_per_displacement.in_phase.excitation", "N/m", "in-phase part of the excitation; equals `total`",
     force<&F::excitation, &P::in_phase>, is_bounded},
    {"force_per_displacement.out_of_phase.total", "N/m",
     "F_o/x: likewise, a quarter period ahead of the motion", total_force<&P::out_of_phase>, is_bounded},
    {"force_per_displacement.out_of_phase.viscous", "N/m", "contribution of the dampers", force<&F::viscous>,
     is_bounded},
    {"force_per_displacement.out_of_phase.contact", "N/m", "contribution of the friction elements",
     force<&F::contact, &P::out_of_phase>, is_bounded},
    {"force_per_displacement.out_of_phase.nonlinear_spring", "N/m",
     "contribution of the nonlinear springs, if any", force<&F::nonlinear_spring, &P::out_of_phase>,
     has_nonlinear_spring, any_nonlinear_spring},
    {"force_per_displacement.out_of_phase.excitation", "N/m",
     "out-of-phase part of the excitation; equals `total`", force<&F::excitation, &P::out_of_phase>,
     is_bounded},
    {"rms", "m", "root mean square of the response over the period", bounded<&Point::rms>},
    {"maxima.velocity", "m/s",
     "at events, and on curves of peaks, folds and bifurcations: largest absolute velocity of the response",
     largest<&MotionMaxima::velocity>, has_maxima},
    {"maxima.acceleration", "m/s²", "likewise, acceleration", largest<&MotionMaxima::acceleration>,
     has_maxima},
    {"maxima.in_phase", "N/m",
     "likewise, only for one mass with one friction element: F_p/x of Al Sayed et al. (2011), from maxima "
     "over the period",
     largest_force<&P::in_phase>, has_force_maxima, one_mass_and_friction_part},
    {"maxima.out_of_phase", "N/m", "likewise, F_o/x", largest_force<&P::out_of_phase>, has_force_maxima,
     one_mass_and_friction_part},
};

results::Value multipliers(const Stability& stability) {
  results::Value::List all;
  for (const auto& each : stability.multipliers) {
    if (stability.kept > 0 && all.size() == static_cast<std::size_t>(stability.kept)) break;
    all.emplace_back(results::Value::Numbers{each.real(), each.imag()});
  }
  return all;
}

constexpr Quantity<Stability> of_stability[] = {
    {"stable", "", "no Floquet multiplier lies outside the unit circle",
     [](const Stability& stability) { return stability.unstable == 0; }},
    {"unstable_multipliers", "", "how many lie outside it",
     [](const Stability& stability) { return results::Value(stability.unstable); }},
    {"multipliers", "",
     "Floquet multipliers over the period of the motion, `[re, im]` of each by falling modulus; none of "
     "sliders that stick throughout",
     multipliers},
    {"multiplier_error", "",
     "estimated effect of the neglected harmonics, and of natural modes left out, on a multiplier; null "
     "where it is not known",
     [](const Stability& stability) { return stability.error; }},
    {"rotation_number", "", "at Neimark-Sacker points: argument of the multipliers on the circle over 2 pi",
     [](const Stability& stability) { return stability.rotation; },
     [](const Stability& stability) { return !std::isnan(stability.rotation); }},
};

constexpr ResponseQuantity of_mode[] = {
    {"damping_ratio", "-", "damping ratio of the mode (extended periodic motion concept)",
     value<&Point::damping_ratio>},
    {"energy", "J",
     "kinetic energy and that of springs and elements, from the static displacement, where the kinetic "
     "energy is largest",
     value<&Point::energy>},
    {"synthesis.level", "-",
     "the multiple of the excitation whose frequency response has its peak at this amplitude, by one-mode "
     "synthesis; null where the excitation does not drive the mode",
     synthesis<&Synthesis::level>},
    {"synthesis.frequency", frequency_unit, "likewise, where that peak is", synthesis<&Synthesis::omega>},
    {"synthesis.below", frequency_unit,
     "likewise, the lower frequency at which the response to the excitation of the scene has this amplitude",
     synthesis<&Synthesis::below>},
    {"synthesis.above", frequency_unit, "likewise, the higher one", synthesis<&Synthesis::above>},
    {"synthesis.true_frequency", frequency_unit,
     "at events `peak`: where the frequency response at `synthesis.level` has its peak; missing where none "
     "was "
     "found",
     synthesis<&Synthesis::true_omega>, has_true_peak},
    {"synthesis.true_amplitude", "m", "likewise, half the difference of the extremes of the response there",
     synthesis<&Synthesis::true_amplitude>, has_true_peak},
};

constexpr ElementQuantity of_element[] = {
    {"stick_percent", "%", "friction elements: share of the period in stick",
     element<&Element::stick_percent>, is_friction, is_friction_part},
    {"stick_estimate", "%",
     "friction elements, where the response has `maxima`: estimated effect of the neglected harmonics on "
     "`stick_percent`",
     element<&Element::stick_estimate>, has_stick_estimate, is_friction_part},
    {"open_percent", "%",
     "contacts with a normal direction: share of the period in separation; slip is the rest",
     element<&Element::open_percent>, has_normal_load, is_part_with_normal_load},
    {"normal_load_max", "N", "likewise, the largest normal load of the period",
     element<&Element::normal_load_max>, has_normal_load, is_part_with_normal_load},
    {"normal_load_min", "N", "likewise, the smallest normal load; 0 in separation",
     element<&Element::normal_load_min>, has_normal_load, is_part_with_normal_load},
    {"mean_force_min", "N",
     "friction elements for which it is known: smallest mean force possible with this motion; equal to the "
     "largest, unless the element sticks throughout the period",
     element<&Element::mean_force_min>, has_mean_force, is_friction_part},
    {"mean_force_max", "N", "likewise, the largest mean force", element<&Element::mean_force_max>,
     has_mean_force, is_friction_part},
    {"slip_angles", "rad", "friction elements: onset of each slip phase", angles<&Element::slip_angles>,
     is_friction, is_friction_part},
    {"reversal_angles", "rad", "friction elements: end of each slip phase", angles<&Element::reversal_angles>,
     is_friction, is_friction_part},
    {"contact_states", "",
     "contacts with exact integrals, in the order of time: `stick`, `slip+` or `slip-` by the sign of the "
     "friction force, or `slip`; `open`, `closed`, `closed+` or `closed-` by the side of a spring with two",
     contact_states, has_contact_states, is_part_that_reports_contact},
    {"contact_angles", "rad",
     "likewise, where each state begins, ascending; the last one lasts until the first", contact_angles,
     has_contact_states, is_part_that_reports_contact},
    {"energy", "J", "dissipated per period", element<&Element::energy>},
    {"wear_rate", "m³/s",
     "elements with a `wear_coefficient`: worn volume per second, the coefficient times the dissipated power",
     element<&Element::wear_rate>, has_wear, is_part_with_wear},
    {"theta_0", "rad",
     "friction elements with one stick and one slip phase in each half period: largest displacement of the "
     "element",
     element<&Element::theta_0>, is_friction, is_friction_part},
    {"theta_star", "rad", "likewise: the next slip onset", element<&Element::theta_star>, is_friction,
     is_friction_part},
    {"in_phase", "N", "fundamental of the force, in phase with the fundamental of the element's displacement",
     fundamental<&P::in_phase>},
    {"out_of_phase", "N", "likewise, a quarter period ahead", fundamental<&P::out_of_phase>},
    {"equivalent_stiffness", "N/m", "`in_phase` over the displacement",
     element<&Element::equivalent_stiffness>},
    {"equivalent_damping", "N s/m", "`out_of_phase` over the velocity",
     element<&Element::equivalent_damping>},
    {"maxima.force", "N",
     "friction elements, where the response has `maxima`: largest absolute value of the truncated "
     "Fourier series of the force",
     largest_of<&ForceMaxima::force>, has_element_maxima, is_friction_part},
    {"maxima.cosine", "N", "likewise, of the cosine terms", largest_of<&ForceMaxima::cosine>,
     has_element_maxima, is_friction_part},
    {"maxima.sine", "N", "likewise, of the sine terms", largest_of<&ForceMaxima::sine>, has_element_maxima,
     is_friction_part},
};

constexpr ElementQuantity of_patch[] = {
    {"stick_percent", "%", "share of the period in stick, the mean over the area",
     element<&Element::stick_percent>, is_friction, is_friction_part},
    {"stick_estimate", "%", "the mean of that of the contacts over the area",
     element<&Element::stick_estimate>, has_stick_estimate, is_friction_part},
    {"open_percent", "%", "laws with a normal direction: likewise in separation; slip is the rest",
     element<&Element::open_percent>, has_normal_load, is_part_with_normal_load},
    {"normal_load_max", "N", "likewise, the largest total normal load of the period",
     element<&Element::normal_load_max>, has_normal_load, is_part_with_normal_load},
    {"normal_load_min", "N", "likewise, the smallest", element<&Element::normal_load_min>, has_normal_load,
     is_part_with_normal_load},
    {"energy", "J", "dissipated per period", element<&Element::energy>},
    {"wear_rate", "m³/s", "with a `wear_coefficient`: worn volume per second", element<&Element::wear_rate>,
     has_wear, is_part_with_wear},
    {"stick_percent_min", "%", "the smallest share of the period in stick of a contact",
     extreme<&ContactExtremes::stick_percent_min>},
    {"pressure_max", "Pa",
     "laws with a normal direction: the largest normal load of a contact over its area, in the period",
     extreme<&ContactExtremes::pressure_max>, has_normal_load, is_part_with_normal_load},
    {"energy_per_area_max", "J/m²", "the largest energy that a contact dissipates per period, over its area",
     extreme<&ContactExtremes::energy_per_area_max>},
    {"wear_depth_rate_max", "m/s",
     "with a `wear_coefficient`: the largest worn volume of a contact per second, over its area",
     extreme<&ContactExtremes::wear_depth_rate_max>, has_wear, is_part_with_wear},
};

constexpr Quantity<NamedResponse> of_named_response[] = {
    {"amplitude", "m", "largest absolute displacement over the period",
     [](const NamedResponse& response) { return response.amplitude; }},
    {"phase", "rad", "phase lag of the fundamental behind the excitation",
     [](const NamedResponse& response) { return response.phase; }},
    {"rms", "m", "root mean square over the period",
     [](const NamedResponse& response) { return response.rms; }},
    {"maxima.velocity", "m/s", "where the response has `maxima`: largest absolute velocity",
     [](const NamedResponse& response) { return response.velocity; }, has_named_maxima},
    {"maxima.acceleration", "m/s²", "likewise, acceleration",
     [](const NamedResponse& response) { return response.acceleration; }, has_named_maxima},
};

template <class List>
const auto& at(const List& list, std::string_view path) {
  const auto found =
      std::find_if(std::begin(list), std::end(list), [&](const auto& each) { return each.path == path; });
  if (found == std::end(list)) throw std::invalid_argument("no quantity \"" + std::string(path) + "\"");
  return *found;
}

}  // namespace

std::span<const ResponseQuantity> response_quantities() {
  return of_response;
}

std::span<const Quantity<Stability>> stability_quantities() {
  return of_stability;
}

std::span<const ResponseQuantity> mode_quantities() {
  return of_mode;
}

Observed needed_by(std::span<const std::string> columns) {
  constexpr std::string_view of_solution[] = {"omega",        "frequency", "amplitude", "unbounded", "order",
                                              "coefficients", "kind",      "nonsmooth", "located",   "after"};
  Observed all = solution_alone;
  for (const std::string_view column : columns) {
    const bool is_estimate = column.ends_with("_estimate") || column == "truncation_flagged";
    const bool is_of_stick = column.ends_with(".stick_estimate");
    const bool is_maximum = is_of_stick || column.find("maxima.") != std::string_view::npos;
    all.estimates = all.estimates || is_estimate;
    all.maxima = all.maxima || is_maximum;
    all.motion = all.motion || is_maximum ||
                 (!is_estimate && std::ranges::find(of_solution, column) == std::end(of_solution));
  }
  return all;
}

bool is_of_modes(std::string_view path) {
  for (const std::string_view without :
       {"unbounded", "phase", "truncation", "force_per_displacement", "maxima"})
    if (path.starts_with(without)) return false;
  return true;
}

std::span<const ElementQuantity> element_quantities() {
  return of_element;
}

std::span<const ElementQuantity> patch_quantities() {
  return of_patch;
}

std::span<const Quantity<NamedResponse>> named_response_quantities() {
  return of_named_response;
}

const ResponseQuantity& response_quantity(std::string_view path) {
  return at(of_response, path);
}

const ElementQuantity& element_quantity(std::string_view path) {
  return at(of_element, path);
}

}  // namespace arcslip::observables
