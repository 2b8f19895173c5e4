#pragma once
// Calls of the functions of a monitor, with exceptions that name the monitor.

#include <arcslip/continuation/events/monitor.hpp>

#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>

namespace arcslip::continuation {

/// A function of a monitor threw.
class MonitorFailure : public std::runtime_error {
 public:
  MonitorFailure(const std::string& monitor, double parameter, const std::string& what);
  double parameter;  // where
};

template <class Function>
auto call(const Function& function, const Monitor& monitor, const Accepted& now) try {
  return function(now);
} catch (const std::exception& thrown) {
  throw MonitorFailure(monitor.name, now.parameter, thrown.what());
}

inline double value_of(const Monitor& monitor, const Accepted& now) {
  return call(monitor.value, monitor, now);
}
inline double quantity_of(const Monitor& monitor, const Accepted& now) {
  return monitor.quantity ? call(monitor.quantity, monitor, now) : 0;
}
/// Combines the part of the monitor's quantity with those of the monitors before it; unchanged if it
/// has none.
inline std::uint64_t with_part(std::uint64_t before, const Monitor& monitor, const Accepted& now) {
  return monitor.part ? (before ^ call(monitor.part, monitor, now)) * 1099511628211ull : before;
}

}  // namespace arcslip::continuation
