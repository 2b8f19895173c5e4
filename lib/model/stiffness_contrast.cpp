#include <arcslip/model/stiffness_contrast.hpp>

#include <cmath>
#include <sstream>

namespace arcslip::model {
namespace {

constexpr double far_apart = 1e12;  // stiffnesses, one over the other

}  // namespace

std::string stiffness_apart(const Model& model, const continuation::Vector& p) {
  struct Stiffness {
    Number number{};
    double value = 0;  // N/m; in a patch, that of one element
  };
  Stiffness stiffest, softest;
  const auto look = [&](const Number& number, double value) {
    if (!(value > 0)) return;
    if (!stiffest.number.given() || value > stiffest.value) stiffest = {number, value};
    if (!softest.number.given() || value < softest.value) softest = {number, value};
  };
  for (const auto& spring : model.springs) look(spring.number, spring.number.value(p));
  for (const auto& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      const int field = element.law->traits(element.fields(p), static_cast<int>(i)).stiffness_field;
      for (const Share& share : element.shares)
        if (share.field == field) look(share.number, share.factor * share.number.value(p));
    }
  if (!stiffest.number.given() || stiffest.value < far_apart * softest.value) return {};
  std::ostringstream text;
  text.precision(4);
  const auto name = [&](const Stiffness& of) {
    return of.number.formula() != nullptr
               ? of.number.formula()->name
               : model.parameters[static_cast<std::size_t>(of.number.parameter())].name;
  };
  text << name(stiffest) << " = " << stiffest.value << " N/m is ";
  if (const double ratio = stiffest.value / softest.value; std::isfinite(ratio))
    text << ratio;
  else
    text << "more than 1e308";
  text << " times " << name(softest) << " = " << softest.value
       << " N/m, too large a ratio for double precision; make " << name(stiffest) << " smaller";
  return text.str();
}

}  // namespace arcslip::model
