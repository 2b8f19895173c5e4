// Values and derivatives of random formulas: 20 000 of them, 1 000 000 with ARCSLIP_FULL=1.

#include "catch.hpp"

#include "lib/formula/random_formula.hpp"
#include "volume.hpp"

#include <arcslip/formula/evaluator.hpp>

#include <algorithm>
#include <array>

using namespace arcslip::formula;
using random_formula::inputs;

namespace {

using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;

InputOf input_names() {
  std::array<std::string_view, inputs> all;
  std::copy(std::begin(random_formula::names), std::end(random_formula::names), all.begin());
  return names_of(all);
}

// df/dx_k by a complex step.
template <class T>
double complex_step(const random_formula::Tree& tree, const double* at, int k) {
  using Real = typename T::value_type;
  const Real h = Real(1e-30);
  std::array<T, inputs> x;
  for (int i = 0; i < inputs; ++i) x[static_cast<std::size_t>(i)] = T(Real(at[i]), i == k ? h : Real(0));
  return static_cast<double>(std::imag(random_formula::value(tree, x.data())) / h);
}

}  // namespace

TEST_CASE("values and derivatives of random formulas are those of complex steps") {
  const long count = static_cast<long>(Volume{"ARCSLIP_FORMULAS", 20000, 1000000}.count());
  long compared = 0, with_derivatives = 0, undefined = 0;
  double worst = 0;
  const InputOf input_of = input_names();
  for (long seed = 1; seed <= count; ++seed) {
    std::mt19937_64 bits(static_cast<std::uint64_t>(seed));
    const auto tree = random_formula::grown(bits, 1 + static_cast<int>(bits() % 5));
    const std::string text = random_formula::text(*tree, bits);
    std::optional<Formula> formula;
    try {
      formula.emplace(std::vector{text}, input_of);
    } catch (const FormulaError& error) {  // a constant part of it has no value, as 1/0
      if (std::string(error.what()).find("not a finite number") == std::string::npos) {
        CAPTURE(seed, text, error.what());
        CHECK(false);
      }
      continue;
    }
    constexpr std::size_t samples = 3;
    std::array<std::array<double, samples>, inputs> x;
    for (auto& column : x)
      for (double& each : column) each = 4 * static_cast<double>(bits() >> 11) / 9007199254740992.0 - 2;
    std::array<double, samples> f{};
    std::array<std::array<double, samples>, inputs> slope{};
    std::array<InputValues, inputs> values{};
    std::vector<Derivative> derivatives;
    for (std::size_t i = 0; i < inputs; ++i) {
      values[i] = {x[i].data(), i != 2};  // the last one is the same at all samples
      derivatives.push_back({0, static_cast<int>(i), slope[i].data()});
    }
    Evaluator evaluator(*formula);
    evaluator.compute(values, samples, std::array{f.data()}, derivatives);
    for (std::size_t s = 0; s < samples; ++s) {
      const std::array<double, inputs> at = {x[0][s], x[1][s], x[2][0]};
      const double size = random_formula::largest_part(*tree, at.data());
      if (!(size < 1e6)) continue;
      const std::array<long double, inputs> precise = {at[0], at[1], at[2]};
      const auto expected = static_cast<double>(random_formula::value(*tree, precise.data()));
      CAPTURE(seed, text, at, s);
      if (!(std::abs(random_formula::value(*tree, at.data()) - expected) <= 1e-13 * size))
        continue;  // few digits
      ++compared;
      if (!(std::abs(f[s] - expected) <= 1e-12 * std::max(size, 1.0))) CHECK(f[s] == expected);
      for (int k = 0; k < inputs; ++k) {
        const double exact = complex_step<LongComplex>(*tree, at.data(), k);
        const double rounded = complex_step<Complex>(*tree, at.data(), k);
        const double found = slope[static_cast<std::size_t>(k)][s];
        // How far the rounding of another method reaches says how many digits there are.
        const double digits = std::abs(exact - rounded);
        if (!std::isfinite(exact) || !(digits < 1e-9 * std::max(1.0, std::abs(exact))) ||
            std::abs(exact) > 1e8)
          continue;
        if (!std::isfinite(found)) {  // at the end of a domain, as acosh(1^q)
          ++undefined;
          continue;
        }
        ++with_derivatives;
        const double error = std::abs(found - exact) / std::max(1.0, std::abs(exact));
        if (!(error < 1e-9)) {
          CAPTURE(k, exact, rounded);
          CHECK(found == exact);
        }
        worst = std::max(worst, error);
      }
    }
  }
  CAPTURE(compared, with_derivatives, worst);
  CHECK(compared > count);
  CHECK(with_derivatives > 2 * count);
  CHECK(undefined < count / 200);
}
