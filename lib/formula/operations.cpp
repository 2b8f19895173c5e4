#include <arcslip/formula/operations.hpp>

#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace arcslip::formula {
namespace {

constexpr int any_number = 100;

constexpr Function all_functions[] = {
    {"sqrt", Operation::sqrt, 1, 1},        {"exp", Operation::exp, 1, 1},
    {"log", Operation::log, 1, 1},          {"sin", Operation::sin, 1, 1},
    {"cos", Operation::cos, 1, 1},          {"tan", Operation::tan, 1, 1},
    {"asin", Operation::asin, 1, 1},        {"acos", Operation::acos, 1, 1},
    {"atan", Operation::atan, 1, 1},        {"sinh", Operation::sinh, 1, 1},
    {"cosh", Operation::cosh, 1, 1},        {"tanh", Operation::tanh, 1, 1},
    {"asinh", Operation::asinh, 1, 1},      {"acosh", Operation::acosh, 1, 1},
    {"atanh", Operation::atanh, 1, 1},      {"abs", Operation::abs, 1, 1},
    {"sign", Operation::sign, 1, 1},        {"min", Operation::min, 2, any_number},
    {"max", Operation::max, 2, any_number}, {"hypot", Operation::hypot, 2, 2},
    {"pow", Operation::power, 2, 2},        {"if", Operation::choose, 3, 3},
};

using X = double;

double sign_of(double a) {
  return a > 0 ? 1 : a < 0 ? -1 : a;  // of NaN: NaN
}

double power_by_exponent(double a, double b, double f) {
  return a == 0 && b > 0 ? 0 : f * std::log(a);
}

double whole_power_of(double a, double n, double) {
  return whole_power(a, static_cast<int>(n));
}

double whole_power_slope(double a, double n, double) {
  return n * whole_power(a, static_cast<int>(n) - 1);
}

double tanh_slope(double a, double, double) {
  const double cosh = std::cosh(a);  // 1 - f^2 has no digits where f is near 1
  return 1 / (cosh * cosh);
}

// In the order of the operations.
constexpr auto none = nullptr;
const Rule rules[] = {
    {Operation::constant, 0, [](X, X, X) { return 0.0; }, none, none},
    {Operation::input, 0, [](X, X, X) { return 0.0; }, none, none},
    {Operation::negate, 1, [](X a, X, X) { return -a; }, [](X, X, X) { return -1.0; }, none, Symmetry::odd},
    {Operation::add, 2, [](X a, X b, X) { return a + b; }, [](X, X, X) { return 1.0; },
     [](X, X, X) { return 1.0; }},
    {Operation::subtract, 2, [](X a, X b, X) { return a - b; }, [](X, X, X) { return 1.0; },
     [](X, X, X) { return -1.0; }},
    {Operation::multiply, 2, [](X a, X b, X) { return a * b; }, [](X, X b, X) { return b; },
     [](X a, X, X) { return a; }},
    {Operation::divide, 2, [](X a, X b, X) { return a / b; }, [](X, X b, X) { return 1 / b; },
     [](X, X b, X f) { return -f / b; }},
    {Operation::whole_power, 1, whole_power_of, whole_power_slope, none},
    {Operation::power, 2, [](X a, X b, X) { return std::pow(a, b); },
     [](X a, X b, X) { return b == 0 ? 0 : b * std::pow(a, b - 1); }, power_by_exponent},
    {Operation::sqrt, 1, [](X a, X, X) { return std::sqrt(a); }, [](X, X, X f) { return 0.5 / f; }, none},
    {Operation::exp, 1, [](X a, X, X) { return std::exp(a); }, [](X, X, X f) { return f; }, none},
    {Operation::log, 1, [](X a, X, X) { return std::log(a); }, [](X a, X, X) { return 1 / a; }, none},
    {Operation::sin, 1, [](X a, X, X) { return std::sin(a); }, [](X a, X, X) { return std::cos(a); }, none,
     Symmetry::odd},
    {Operation::cos, 1, [](X a, X, X) { return std::cos(a); }, [](X a, X, X) { return -std::sin(a); }, none,
     Symmetry::even},
    {Operation::tan, 1, [](X a, X, X) { return std::tan(a); }, [](X, X, X f) { return 1 + f * f; }, none,
     Symmetry::odd},
    {Operation::asin, 1, [](X a, X, X) { return std::asin(a); },
     [](X a, X, X) { return 1 / std::sqrt((1 - a) * (1 + a)); }, none, Symmetry::odd},
    {Operation::acos, 1, [](X a, X, X) { return std::acos(a); },
     [](X a, X, X) { return -1 / std::sqrt((1 - a) * (1 + a)); }, none},
    {Operation::atan, 1, [](X a, X, X) { return std::atan(a); }, [](X a, X, X) { return 1 / (1 + a * a); },
     none, Symmetry::odd},
    {Operation::sinh, 1, [](X a, X, X) { return std::sinh(a); }, [](X a, X, X) { return std::cosh(a); }, none,
     Symmetry::odd},
    {Operation::cosh, 1, [](X a, X, X) { return std::cosh(a); }, [](X a, X, X) { return std::sinh(a); }, none,
     Symmetry::even},
    {Operation::tanh, 1, [](X a, X, X) { return std::tanh(a); }, tanh_slope, none, Symmetry::odd},
    {Operation::asinh, 1, [](X a, X, X) { return std::asinh(a); },
     [](X a, X, X) { return 1 / std::hypot(a, 1.0); }, none, Symmetry::odd},
    {Operation::acosh, 1, [](X a, X, X) { return std::acosh(a); },
     [](X a, X, X) { return 1 / (std::sqrt(a - 1) * std::sqrt(a + 1)); }, none},
    {Operation::atanh, 1, [](X a, X, X) { return std::atanh(a); },
     [](X a, X, X) { return 1 / ((1 - a) * (1 + a)); }, none, Symmetry::odd},
    {Operation::abs, 1, [](X a, X, X) { return std::abs(a); }, [](X a, X, X) { return sign_of(a); }, none,
     Symmetry::even, Switch::kink},
    {Operation::sign, 1, [](X a, X, X) { return sign_of(a); }, none, none, Symmetry::odd, Switch::jump},
    {Operation::min, 2, [](X a, X b, X) { return b < a || std::isnan(b) ? b : a; },
     [](X a, X b, X) { return b < a ? 0.0 : 1.0; }, [](X a, X b, X) { return b < a ? 1.0 : 0.0; },
     Symmetry::none, Switch::kink},
    {Operation::max, 2, [](X a, X b, X) { return b > a || std::isnan(b) ? b : a; },
     [](X a, X b, X) { return b > a ? 0.0 : 1.0; }, [](X a, X b, X) { return b > a ? 1.0 : 0.0; },
     Symmetry::none, Switch::kink},
    {Operation::hypot, 2, [](X a, X b, X) { return std::hypot(a, b); },
     [](X a, X, X f) { return f == 0 ? 0 : a / f; }, [](X, X b, X f) { return f == 0 ? 0 : b / f; }},
    {Operation::less, 2, [](X a, X b, X) { return a < b ? 1.0 : 0.0; }, none, none, Symmetry::none,
     Switch::jump},
    {Operation::less_or_equal, 2, [](X a, X b, X) { return a <= b ? 1.0 : 0.0; }, none, none, Symmetry::none,
     Switch::jump},
    {Operation::equal, 2, [](X a, X b, X) { return a == b ? 1.0 : 0.0; }, none, none, Symmetry::none,
     Switch::jump},
    {Operation::not_equal, 2, [](X a, X b, X) { return a != b ? 1.0 : 0.0; }, none, none, Symmetry::none,
     Switch::jump},
    {Operation::choose, 3, [](X a, X b, X c) { return a != 0 ? b : c; }, none, none},
};

}  // namespace

std::span<const Function> functions() {
  return all_functions;
}

const Rule& rule(Operation operation) {
  return rules[static_cast<std::size_t>(operation)];
}

double whole_power(double x, int n) {
  double result = 1;
  for (int left = std::abs(n); left > 0; left /= 2) {
    if (left % 2 == 1) result *= x;
    x *= x;
  }
  return n < 0 ? 1 / result : result;
}

}  // namespace arcslip::formula
