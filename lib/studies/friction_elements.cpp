#include <arcslip/studies/friction_elements.hpp>

#include <limits>

namespace arcslip::studies {

std::vector<std::string> friction_elements(std::span<const observables::ResponseBranch* const> branches) {
  std::vector<std::string> names;
  for (const observables::ResponseBranch* branch : branches) {
    for (const observables::ResponsePoint& point : branch->points) {
      for (const observables::ElementResponse& element : point.elements) {
        if (element.has_stick) {
          names.push_back(element.name);
        }
      }
      if (!point.elements.empty()) {
        return names;  // every point of a scene has the same elements
      }
    }
  }
  return names;
}

double stick_percent(const observables::ResponsePoint& point, std::string_view element) {
  for (const observables::ElementResponse& candidate : point.elements) {
    if (candidate.has_stick && candidate.name == element) {
      return candidate.stick_percent;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace arcslip::studies
