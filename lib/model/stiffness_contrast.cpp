#include <arcslip/model/stiffness_contrast.hpp>

#include <cmath>
#include <sstream>

namespace arcslip::model {
namespace {

constexpr double far_apart = 1e12;  // stiffnesses, one over the other

}  // namespace

std::string stiffness_apart(const Model& model, const continuation::Vector& p) {
  struct Stiffness {
    int parameter = -1;
    double value = 0;  // N/m; in a patch, that of one element
  };
  Stiffness stiffest, softest;
  const auto look = [&](int k, double value) {
    if (!(value > 0)) return;
    if (stiffest.parameter < 0 || value > stiffest.value) stiffest = {k, value};
    if (softest.parameter < 0 || value < softest.value) softest = {k, value};
  };
  for (const auto& spring : model.springs) look(spring.parameter, p[spring.parameter]);
  for (const auto& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      const int field = element.law->traits(element.fields(p), static_cast<int>(i)).stiffness_field;
      for (const Share& share : element.shares)
        if (share.field == field) look(share.parameter, share.factor * p[share.parameter]);
    }
  if (stiffest.parameter < 0 || stiffest.value < far_apart * softest.value) return {};
  std::ostringstream text;
  text.precision(4);
  const auto name = [&](const Stiffness& of) {
    return model.parameters[static_cast<std::size_t>(of.parameter)].name;
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
