#include <arcslip/continuation/problem/problem_from_functions.hpp>

using namespace arcslip::continuation;

int main() {
  const auto line = from_functions(1, {{"p", "", 2}}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  return parameter_index(*line, "p");
}
