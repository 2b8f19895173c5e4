#include <arcslip/results/figure.hpp>

#include <cmath>

namespace arcslip::results {

bool FigureAxis::shows(double value) const {
  return std::isfinite(value) && !(logarithmic && value <= 0);
}

double FigureAxis::place(double value) const {
  const auto [lower, upper] = range;
  const double shown = value * factor;
  return logarithmic ? std::log(shown / lower) / std::log(upper / lower) : (shown - lower) / (upper - lower);
}

}  // namespace arcslip::results
