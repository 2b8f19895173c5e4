#include <arcslip/model/stiffness_apart.hpp>

#include <cmath>
#include <sstream>

namespace arcslip::model {
namespace {

constexpr double far_apart = 1e12;  // stiffnesses, one over the other

}  // namespace

std::string stiffness_apart(const Model& model, const continuation::Vector& p) {
  int stiffest = -1, softest = -1;
  const auto look = [&](int k) {
    if (!(p[k] > 0)) return;
    if (stiffest < 0 || p[k] > p[stiffest]) stiffest = k;
    if (softest < 0 || p[k] < p[softest]) softest = k;
  };
  for (const auto& spring : model.springs) look(spring.parameter);
  for (const auto& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      const int field = element.law->traits(element.fields(p), static_cast<int>(i)).stiffness_field;
      if (field >= 0) look(element.parameters[static_cast<std::size_t>(field)]);
    }
  if (stiffest < 0 || p[stiffest] < far_apart * p[softest]) return {};
  std::ostringstream text;
  text.precision(4);
  const auto name = [&](int k) { return model.parameters[static_cast<std::size_t>(k)].name; };
  text << name(stiffest) << " = " << p[stiffest] << " N/m is ";
  if (const double ratio = p[stiffest] / p[softest]; std::isfinite(ratio))
    text << ratio;
  else
    text << "more than 1e308";
  text << " times " << name(softest) << " = " << p[softest]
       << " N/m, too large a ratio for double precision; make " << name(stiffest) << " smaller";
  return text.str();
}

}  // namespace arcslip::model
