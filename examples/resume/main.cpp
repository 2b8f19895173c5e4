// A trace that is stopped, saved to a file and resumed by another program goes on as if nothing had happened:
// Semenov's thermal explosion u = lambda e^u, whose ignition is the fold at lambda = 1/e, u = 1.
//
//   resume [file = trace.json]

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

using namespace arcslip::continuation;

int main(int argc, char** argv) {
  const std::string file = argc > 1 ? argv[1] : "trace.json";
  const auto problem = from_functions(1, {{"lambda", "", 0.02}},
                                      [](In u, In p, Out F) { F[0] = u[0] - p[0] * std::exp(u[0]); });
  const Start start{.u = Vector::Zero(1), .p = parameter_values(*problem)};
  const Options options{.lower = 0.01, .upper = 1};

  Tracer tracer(problem, start, options, {fold_monitor()});
  for (int points = 0; points < 50 && tracer.step(); ++points) {
  }
  std::ofstream(file) << to_json(tracer.save());

  std::ifstream saved(file);
  const std::string text{std::istreambuf_iterator<char>(saved), {}};
  Tracer resumed(problem, state_from_json(text), options, {fold_monitor()});
  while (resumed.step()) {
  }

  while (tracer.step()) {
  }
  const Branch &branch = resumed.branch(), &unbroken = tracer.branch();
  double difference = 0;
  for (std::size_t k = 0; k < unbroken.points.size(); ++k)
    difference = std::fmax(difference, std::abs(branch.points.at(k).u[0] - unbroken.points[k].u[0]));
  for (const Event& fold : branch.events)
    std::printf("fold at lambda = %.12f, u = %.9f\n", fold.point.parameter, fold.point.u[0]);
  std::printf("trace of %zu points, the unbroken one of %zu, difference = %g; %s\n", branch.points.size(),
              unbroken.points.size(), difference, branch.stop.message.c_str());
}
