#pragma once
// The quantities of a response, each defined once by its path, unit, meaning and getter. The keys of JSON,
// the columns of tables and figures, the limits of the optimizer and docs/results.md are derived from here.

#include <arcslip/results/response.hpp>
#include <arcslip/results/value.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace arcslip::observables {

/// The unit of a quantity in the scene's unit of frequency; its getter returns rad/s.
inline constexpr std::string_view frequency_unit = "scene";

/// The part of a scene that decides whether a quantity exists.
template <class Of>
struct OriginOf;
template <>
struct OriginOf<ResponsePoint> {
  using Type = scene::Scene;
};
template <>
struct OriginOf<Stability> {
  using Type = scene::Scene;
};
template <>
struct OriginOf<ElementResponse> {
  using Type = scene::Part;
};
template <>
struct OriginOf<NamedResponse> {
  using Type = scene::Response;
};

/// A quantity of a response (Of = ResponsePoint), of its stability (Of = Stability), of one of its elements
/// (Of = ElementResponse) or of a named response (Of = NamedResponse).
template <class Of>
struct Quantity {
  using Number = double (*)(const Of&);  // no_value if undefined
  using Flag = bool (*)(const Of&);
  using List = const std::vector<double>& (*)(const Of&);
  using Values = results::Value (*)(const Of&);
  using Origin = typename OriginOf<Of>::Type;

  std::string_view path;     // keys, joined by points: "force_per_displacement.in_phase.total"
  std::string_view unit;     // "m", "J"; "" of a flag
  std::string_view meaning;  // one line of Markdown
  std::variant<Number, Flag, List, Values> get;
  Flag has = nullptr;                   // whether the response has it; null: always
  bool (*in)(const Origin&) = nullptr;  // whether one of the scene, or element, may have it; null: always
};

using ResponseQuantity = Quantity<ResponsePoint>;
using ElementQuantity = Quantity<ElementResponse>;

/// Whether an element or a patch of a scene sticks and slips.
bool is_friction_part(const scene::Part& part);

std::span<const ResponseQuantity> response_quantities();
/// Where the stability is requested, and known.
std::span<const Quantity<Stability>> stability_quantities();
/// What modes have in addition to those of a response.
std::span<const ResponseQuantity> mode_quantities();
/// Whether modes have the quantity with this path, of a response or of a named one: not where it takes an
/// excitation.
bool is_of_modes(std::string_view path);
/// What columns of tables of points and events need to be computed, named by their path, with or without
/// "elements".
Observed needed_by(std::span<const std::string> columns);
std::span<const ElementQuantity> element_quantities();
std::span<const ElementQuantity> patch_quantities();
std::span<const Quantity<NamedResponse>> named_response_quantities();

/// The quantity with this path, which must exist.
const ResponseQuantity& response_quantity(std::string_view path);
const ElementQuantity& element_quantity(std::string_view path);

/// A number of a response; no_value if the response does not have it.
template <class Of>
double number(const Quantity<Of>& quantity, const Of& of) {
  return quantity.has && !quantity.has(of) ? no_value : std::get<0>(quantity.get)(of);
}

}  // namespace arcslip::observables
