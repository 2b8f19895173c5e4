#include "catch.hpp"

#include "lib/formula/random_formula.hpp"

#include <arcslip/formula/evaluator.hpp>
#include <arcslip/formula/facts.hpp>

#include <array>
#include <cmath>

using namespace arcslip::formula;

namespace {

constexpr std::array<std::string_view, 4> motion_inputs = {"q", "v", "phase", "k"};
constexpr std::array<Role, 4> roles = {Role::motion, Role::motion, Role::phase, Role::constant};

Formula formula(const std::string& text) {
  return Formula(std::vector{text}, names_of(motion_inputs));
}

// "3", "3 + 2 orders", "no polynomial"
std::string degree(const std::string& text) {
  const auto of = degree(formula(text), 0, roles);
  if (!of) return "no polynomial";
  return std::to_string(of->motion) + (of->orders > 0 ? " + " + std::to_string(of->orders) + " orders" : "");
}

Parity parity(const std::string& text) {
  return parity(formula(text), 0, roles);
}

}  // namespace

TEST_CASE("the degree of a polynomial of the motion, and its orders of the phase") {
  CHECK(degree("7*k") == "0");
  CHECK(degree("k*q^3 + q*v") == "3");
  CHECK(degree("(q^2/k - 1)*v") == "3");
  CHECK(degree("(q+v)^64") == "64");
  CHECK(degree("((q+v)^8)^9") == "72");
  CHECK(degree("exp(k)*q") == "1");
  CHECK(degree("q^-1") == "no polynomial");
  CHECK(degree("1/q") == "no polynomial");
  CHECK(degree("sqrt(q)") == "no polynomial");
  CHECK(degree("q^k") == "no polynomial");
  CHECK(degree("abs(q)") == "no polynomial");
  CHECK(degree("if(k > 1, q, v)") == "no polynomial");
  CHECK(degree("k*(1 - 0.4*cos(2*phase))*q") == "1 + 2 orders");
  CHECK(degree("sin(phase)^2*q + cos(3*phase + k)") == "1 + 3 orders");
  CHECK(degree("cos(phase/0.25 - phase)") == "0 + 3 orders");
  CHECK(degree("cos(-phase)*sin(phase*2)") == "0 + 3 orders");
  CHECK(degree("cos(phase - phase)*q") == "1");
  CHECK(degree("cos(0.5*phase)") == "no polynomial");
  CHECK(degree("cos(k*phase)") == "no polynomial");
  CHECK(degree("cos(phase + q)") == "no polynomial");
  CHECK(degree("cos(phase^2)") == "no polynomial");
  CHECK(degree("phase*q") == "no polynomial");
  CHECK(degree("phase") == "no polynomial");
  CHECK(degree("cos(2000*phase)") == "no polynomial");
  CHECK(degree("exp(cos(phase))") == "no polynomial");
}

TEST_CASE("the degree of pieces between kinks") {
  const auto of_pieces = [](const std::string& text) {
    const auto of = degree(formula(text), 0, roles, Pieces::several);
    return of ? of->motion + 100 * of->orders : -1;
  };
  CHECK(of_pieces("abs(v)*v") == 2);
  CHECK(of_pieces("max(q - k, 0)*v^3") == 4);
  CHECK(of_pieces("sign(v)*q") == 1);
  CHECK(of_pieces("if(exp(q) > 2, q^3, v)") == 3);
  CHECK(of_pieces("min(q, cos(2*phase))") == 201);
  CHECK(of_pieces("sin(sign(v))*q") == 1);  // a number on either side
  CHECK(of_pieces("abs(exp(q))") == -1);
  CHECK(of_pieces("max(phase, 0)") == -1);
  CHECK(of_pieces("exp(-abs(v))*sign(v)") == -1);
  CHECK(of_pieces("q^abs(v)") == -1);
}

TEST_CASE("odd and even formulas") {
  CHECK(parity("k*q^3 + v") == Parity::odd);
  CHECK(parity("k*q^2") == Parity::even);
  CHECK(parity("q^2 + q") == Parity::neither);
  CHECK(parity("abs(v)*v") == Parity::odd);
  CHECK(parity("sign(v)*exp(-abs(v)/k)") == Parity::odd);
  CHECK(parity("tanh(v/k)") == Parity::odd);
  CHECK(parity("cos(q)") == Parity::even);
  CHECK(parity("cos(phase)*q") == Parity::odd);
  CHECK(parity("exp(q)") == Parity::neither);
  CHECK(parity("max(q - k, 0)") == Parity::neither);
  CHECK(parity("if(abs(q) > k, q - k*sign(q), 0)") == Parity::odd);
  CHECK(parity("if(q > k, q, 0)") == Parity::neither);
  CHECK(parity("hypot(q, v)*q") == Parity::odd);
  CHECK(parity("q^-3") == Parity::odd);
  CHECK(parity("q^-2") == Parity::even);
  CHECK(parity("q^k") == Parity::neither);
  CHECK(parity("(q^2)^k*q") == Parity::odd);
  CHECK(parity("0*q") == Parity::zero);
  CHECK(parity("acos(q)") == Parity::neither);
}

TEST_CASE("whatever is called odd or even is so, in random formulas") {
  constexpr std::array<Role, 3> all = {Role::motion, Role::motion, Role::constant};
  long seen = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    std::mt19937_64 bits(seed);
    const auto tree = random_formula::grown(bits, 1 + static_cast<int>(bits() % 4));
    const std::string text = random_formula::text(*tree, bits);
    std::optional<Formula> of;
    try {
      of.emplace(std::vector{text}, names_of(std::array<std::string_view, 3>{"q", "v2", "damper.k_1"}));
    } catch (const FormulaError&) {
      continue;
    }
    const Parity sign = parity(*of, 0, all);
    const auto growth = degree(*of, 0, all);
    for (int trial = 0; trial < 4; ++trial) {
      std::array<double, 3> x{}, mirrored{}, grown{};
      for (std::size_t i = 0; i < 3; ++i)
        x[i] = 4 * static_cast<double>(bits() >> 11) / 9007199254740992.0 - 2;
      mirrored = {-x[0], -x[1], x[2]};
      const double size = random_formula::largest_part(*tree, x.data());
      const double there_size = random_formula::largest_part(*tree, mirrored.data());
      if (!(size < 1e6) || !(there_size < 1e6)) continue;
      const double here = random_formula::value(*tree, x.data());
      const double there = random_formula::value(*tree, mirrored.data());
      CAPTURE(seed, text, x);
      if (sign == Parity::odd && std::abs(here + there) > 1e-9 * std::max(size, 1.0)) CHECK(here == -there);
      if (sign == Parity::even && std::abs(here - there) > 1e-9 * std::max(size, 1.0)) CHECK(here == there);
      if (sign == Parity::zero && std::abs(here) > 1e-9 * std::max(size, 1.0)) CHECK(here == 0);
      seen += sign == Parity::odd || sign == Parity::even;
      // A polynomial's differences of an order above its degree are 0.
      if (growth && growth->motion <= 6) {
        double difference = 0, binomial = 1, most = 0;
        const int order = growth->motion + 1;
        for (int j = 0; j <= order; ++j) {
          grown = {x[0] * (j + 1), x[1] * (j + 1), x[2]};
          const double f = random_formula::value(*tree, grown.data());
          difference += (j % 2 == 0 ? 1 : -1) * binomial * f;
          most = std::max(most, std::abs(binomial * f));
          binomial = binomial * (order - j) / (j + 1);
        }
        if (std::isfinite(most) && std::abs(difference) > 1e-9 * std::max(most, 1.0)) CHECK(difference == 0);
      }
    }
  }
  CHECK(seen > 5000);
}

TEST_CASE("kinks are where what varies changes its sign") {
  const auto kinks = [](const std::string& text) { return switches(formula(text), roles).results().size(); };
  CHECK(kinks("abs(v)*v") == 1);
  CHECK(kinks("abs(v)*v + sign(v)*q") == 1);  // the same
  CHECK(kinks("max(q, 0) + min(q, 0)") == 1);
  CHECK(kinks("max(q, 0, v)") == 2);
  CHECK(kinks("if(cos(phase) > 0, q, v)") == 1);
  CHECK(kinks("if(abs(q) > k, q, v)") == 2);
  CHECK(kinks("abs(k)*q") == 0);
  CHECK(kinks("if(k > 1, q, v)") == 0);
  CHECK(kinks("tanh(q)") == 0);
  const auto jumps = [](const std::string& text) { return may_jump(formula(text), roles); };
  CHECK(jumps("sign(v)"));
  CHECK(jumps("if(q > 0, 1, 2)"));
  CHECK(jumps("q*(q > 0)"));
  CHECK_FALSE(jumps("abs(v)"));
  CHECK_FALSE(jumps("max(q, 0)"));
  CHECK_FALSE(jumps("sign(k)*q"));
  const double q = 0.7, v = -0.2, phase = 0, k = 2;
  double f = 0;
  Evaluator(switches(formula("max(k, q - v)"), roles))
      .compute(std::array<InputValues, 4>{{{&q, true}, {&v, true}, {&phase, true}, {&k, false}}}, 1,
               std::array{&f});
  CHECK(f == Approx(k - (q - v)));
}

TEST_CASE("the coefficients of a polynomial of one input") {
  const std::array<double, 4> values = {0, 2, 0, 3};
  CHECK(polynomial(formula("k*(q - 1)^2*q + v"), 0, 0, values) == std::vector<double>{2, 3, -6, 3});
  CHECK(polynomial(formula("-(q/2 - sqrt(k*12))"), 0, 0, values) == std::vector<double>{6, -0.5});
  CHECK(polynomial(formula("exp(0*v)"), 0, 0, values) == std::vector<double>{1});
  CHECK_FALSE(polynomial(formula("exp(q)"), 0, 0, values));
  CHECK_FALSE(polynomial(formula("1/q"), 0, 0, values));
  CHECK_FALSE(polynomial(formula("(q^32)^3"), 0, 0, values));
  CHECK(polynomial(formula("q^64"), 0, 0, values)->size() == 65);
}
