#include <arcslip/stability/multipliers.hpp>

#include <arcslip/results/response.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::observables {
namespace {

using Complex = std::complex<double>;

constexpr double neutral = 1e-10;  // |mu| above 1 by less is rounding
constexpr double real = 1e-9;      // |imaginary part| of a real multiplier, relative

bool is_complex(const Complex& multiplier) {
  return std::abs(multiplier.imag()) > real * std::abs(multiplier);
}

}  // namespace

int count_unstable(const Multipliers& multipliers) {
  return static_cast<int>(std::count_if(multipliers.begin(), multipliers.end(),
                                        [](const Complex& each) { return std::abs(each) > 1 + neutral; }));
}

double distance(const Multipliers& multipliers, const Multipliers& others) {
  double largest = 0;
  for (const Complex& each : multipliers) {
    double nearest = std::abs(each);  // of those that the others lack, 0
    for (const Complex& other : others) nearest = std::min(nearest, std::abs(each - other));
    largest = std::max(largest, nearest);
  }
  return largest;
}

std::array<Complex, 2> nearest_two(const Multipliers& multipliers, Complex value) {
  std::array<Complex, 2> nearest{value + 1.0, value + 1.0};
  std::array<double, 2> distances{HUGE_VAL, HUGE_VAL};
  for (const Complex& each : multipliers) {
    const double distance = std::abs(each - value);
    if (!(distance < distances[1])) continue;
    const std::size_t i = distance < distances[0] ? 0 : 1;
    if (i == 0) {
      nearest[1] = nearest[0];
      distances[1] = distances[0];
    }
    nearest[i] = each;
    distances[i] = distance;
  }
  return nearest;
}

double at_minus_one(const Multipliers& multipliers) {
  const auto nearest = nearest_two(multipliers, -1);
  const auto beyond = std::count_if(multipliers.begin(), multipliers.end(),
                                    [](const Complex& each) { return each.imag() == 0 && each.real() < -1; });
  const double size = std::abs(1.0 + nearest[0]) * std::abs(1.0 + nearest[1]);
  return beyond % 2 == 0 ? size : -size;
}

double at_unit_modulus(const Multipliers& multipliers) {
  double size = 1;
  bool negative = false;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Complex &a = multipliers[i], &b = multipliers[j];
      const Complex factor = 1.0 - a * b;
      const bool conjugates = a.imag() != 0 && a == std::conj(b), both_real = a.imag() == 0 && b.imag() == 0;
      const bool on_circle = (conjugates || both_real) && std::abs(factor) < multiplier_rounding;
      size = std::min(size, on_circle ? multiplier_rounding : std::abs(factor));
      if ((conjugates || both_real) && !on_circle && factor.real() < 0) negative = !negative;
    }
  return negative ? -size : size;
}

Complex pair_nearest_circle(const Multipliers& multipliers) {
  Complex nearest = 0;
  for (const Complex& each : multipliers)
    if (each.imag() > 0 && is_complex(each) && std::abs(1 - std::abs(each)) < std::abs(1 - std::abs(nearest)))
      nearest = each;
  return nearest;
}

double rotation_number(const Multipliers& multipliers) {
  const Complex nearest = pair_nearest_circle(multipliers);
  return nearest == 0.0 ? no_value : std::arg(nearest) / (2 * std::numbers::pi);
}

Multipliers without(Multipliers multipliers, const Multipliers& values) {
  for (const Complex& value : values) {
    if (multipliers.empty()) break;
    multipliers.erase(std::min_element(
        multipliers.begin(), multipliers.end(),
        [&](const Complex& a, const Complex& b) { return std::abs(a - value) < std::abs(b - value); }));
  }
  return multipliers;
}

}  // namespace arcslip::observables
