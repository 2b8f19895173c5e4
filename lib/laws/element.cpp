#include <arcslip/laws/element.hpp>

namespace arcslip::elements {

void Element::frequency_derivative(Out dF) const {
  dF.setZero();
}

}  // namespace arcslip::elements
