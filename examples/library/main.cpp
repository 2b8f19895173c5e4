// The folds of mu + x - x^3 = 0 in mu; then what a scene file asks for.
#include <arcslip/continuation.hpp>
#include <arcslip/optimize.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>

int main(int argc, char** argv) {
  using namespace arcslip::continuation;
  const auto cusp = from_functions(1, {{"mu", "", -1}, {"lambda", "", 1}},
                                   [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); });
  const Start start{.u = Vector::Constant(1, -1.3), .p = parameter_values(*cusp), .free = 0};
  const Branch branch = trace(cusp, start, {.lower = -1, .upper = 1}, {fold_monitor()});
  for (const Event& fold : branch.events)
    std::printf("%s at mu = %.12f, x = %.9f\n", fold.monitor.c_str(), fold.point.parameter, fold.point.u[0]);
  std::printf("%zu points; %s\n", branch.points.size(), branch.stop.message.c_str());

  if (argc < 2) return 0;
  auto catalogue = arcslip::studies::catalogue();
  arcslip::optimize::add_studies(catalogue);
  const auto scene = arcslip::scene::read_file(argv[1], catalogue);
  arcslip::results::write_table(std::cout, arcslip::studies::run(scene));
}
