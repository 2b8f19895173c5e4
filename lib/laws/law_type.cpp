#include <arcslip/laws/law_type.hpp>

#include <stdexcept>
#include <string>

namespace arcslip::elements {

bool LawType::has_wear(const scene::Settings& options) const {
  return law(options)->dissipative();
}

std::shared_ptr<const Law> law_of(const scene::Part& part) {
  const auto* type = dynamic_cast<const LawType*>(part.type);
  if (type == nullptr) throw std::invalid_argument("the element \"" + part.name + "\" has no law of force");
  return type->law(part.options);
}

}  // namespace arcslip::elements
