#include <arcslip/optimize/nlopt/minimize.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/optimize/nlopt/run.hpp>
#include <arcslip/scene/scene.hpp>

#include <nlopt.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

namespace arcslip::optimize {

using continuation::text;
namespace {

bool nlopt_takes_constraints(nlopt_algorithm code) {
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> run(nlopt_create(code, 1), &nlopt_destroy);
  const nlopt_func zero = [](unsigned, const double*, double*, void*) { return 0.0; };
  return run && nlopt_add_inequality_constraint(run.get(), zero, nullptr, 0) == NLOPT_SUCCESS;
}

Algorithm describe(nlopt_algorithm code) {
  Algorithm a;
  a.name = nlopt_algorithm_to_string(code);
  a.code = code;
  a.global = a.name.starts_with("G");
  a.needs_local = a.name.starts_with("AUGLAG") || a.name.starts_with("G_MLSL");
  a.takes_local = a.name.find("AUGLAG") != std::string::npos || a.name.find("MLSL") != std::string::npos;
  a.takes_constraints = nlopt_takes_constraints(code);
  return a;
}

std::vector<nlopt_algorithm> compiled() {
  std::vector<nlopt_algorithm> all;
  for (int i = 0; i < NLOPT_NUM_ALGORITHMS; ++i) {
    const auto code = static_cast<nlopt_algorithm>(i);
    const std::string_view title = nlopt_algorithm_name(code);
    if (title.find("NOT COMPILED") == std::string_view::npos) all.push_back(code);
  }
  return all;
}

// The most similar known name: LD_SLSQP for "slsqp" or "LD_SLSPQ". "" if none is similar.
std::string suggestion(std::string word, const std::vector<std::string>& known) {
  for (char& c : word) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const std::string& name : known)
    if (name == word || name.ends_with("_" + word)) return name;
  return scene::nearest(word, known);
}

}  // namespace

std::vector<Algorithm> algorithms() {
  std::vector<Algorithm> all;
  for (const nlopt_algorithm code : compiled()) all.push_back(describe(code));
  return all;
}

Algorithm algorithm(const std::string& name) {
  std::vector<std::string> names;
  std::string list;
  for (const nlopt_algorithm code : compiled()) {
    names.emplace_back(nlopt_algorithm_to_string(code));
    if (names.back() == name) return describe(code);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  const std::string meant = suggestion(name, names);
  throw OptionsError("no algorithm \"" + name + "\" in this NLopt" +
                     (meant.empty() ? "." : "; did you mean \"" + meant + "\"?") + " Known: " + list);
}

namespace {

using Handle = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;

void require(bool holds, const char* what, double value, const char* allowed) {
  if (!holds) throw OptionsError(text(what, " is ", value, ", must be ", allowed));
}

void check(const std::string& where, const Tolerances& t) {
  const std::pair<const char*, double> all[] = {{"x_relative", t.x_relative},
                                                {"x_absolute", t.x_absolute},
                                                {"f_relative", t.f_relative},
                                                {"f_absolute", t.f_absolute}};
  for (const auto& [field, value] : all)
    require(value >= 0 && std::isfinite(value), (where + "." + field).c_str(), value, "finite and >= 0");
}

void check(const NonlinearProgram& problem, const std::vector<double>& start, const Algorithm& chosen) {
  const std::size_t n = start.size();
  if (n == 0) throw OptionsError("there is nothing to vary: the start has 0 variables");
  if (problem.lower.size() != n || problem.upper.size() != n)
    throw OptionsError(text("the start has ", n, " variables, but there are ", problem.lower.size(),
                            " lower and ", problem.upper.size(), " upper bounds"));
  if (!problem.objective) throw OptionsError("the problem has no objective");
  for (std::size_t i = 0; i < n; ++i) {
    const double lower = problem.lower[i], upper = problem.upper[i];
    const std::string bounds = text("bounds of variable ", i, " are [", lower, ", ", upper, "]");
    if (lower == upper)
      throw OptionsError(bounds + ": equal bounds leave nothing to vary; leave the variable out");
    if (!(lower < upper)) throw OptionsError(bounds + ": the lower must be below the upper");
    if (chosen.global && !(std::isfinite(lower) && std::isfinite(upper)))
      throw OptionsError(bounds + ": " + chosen.name + " is a global algorithm and needs finite bounds");
    if (!std::isfinite(start[i])) throw OptionsError(text("the start has variable ", i, " = ", start[i]));
  }
  if (!problem.constraints.empty() && !chosen.takes_constraints) {
    std::string able;
    for (const Algorithm& a : algorithms())
      if (a.takes_constraints) able += (able.empty() ? "" : ", ") + a.name;
    throw OptionsError(text(chosen.name, " does not support constraints, but there are ",
                            problem.constraints.size(), "; algorithms that do: ", able));
  }
  for (const Constraint& c : problem.constraints) {
    if (!c.function) throw OptionsError("constraint \"" + c.name + "\" has no function");
    require(c.tolerance >= 0 && std::isfinite(c.tolerance),
            ("tolerance of constraint \"" + c.name + "\"").c_str(), c.tolerance, "finite and >= 0");
  }
}

void check(const MinimizeOptions& o, const Algorithm& chosen) {
  check("tolerances", o.tolerances);
  require(o.evaluations >= 1, "evaluations", o.evaluations, ">= 1");
  require(o.seconds >= 0 && std::isfinite(o.seconds), "seconds", o.seconds, "finite and >= 0 (0: no limit)");
  require(!std::isnan(o.target), "target", o.target, "a number");
  require(o.population >= 0, "population", o.population, ">= 0 (0: the algorithm's own)");
  if (o.local && !chosen.takes_local)
    throw OptionsError("a local algorithm is only for AUGLAG and MLSL, not for " + chosen.name);
  if (!o.local && chosen.needs_local)
    throw OptionsError(chosen.name + " needs a local algorithm, such as LD_SLSQP or LN_BOBYQA");
  if (o.local) {
    check("local.tolerances", o.local->tolerances);
    require(o.local->evaluations >= 0, "local.evaluations", o.local->evaluations, ">= 0 (0: no limit)");
  }
}

struct Callback {
  Run* run;
  std::size_t constraint;
};

double call_objective(unsigned n, const double* x, double* gradient, void* data) {
  return static_cast<Callback*>(data)->run->objective({x, n}, {gradient, gradient ? n : 0u});
}

double call_constraint(unsigned n, const double* x, double* gradient, void* data) {
  const auto& callback = *static_cast<Callback*>(data);
  return callback.run->constraint(callback.constraint, {x, n}, {gradient, gradient ? n : 0u});
}

Handle create(const Algorithm& chosen, std::size_t n) {
  Handle handle(nlopt_create(static_cast<nlopt_algorithm>(chosen.code), static_cast<unsigned>(n)),
                &nlopt_destroy);
  if (!handle) throw std::bad_alloc();
  return handle;
}

void set(nlopt_opt handle, const Tolerances& t) {
  nlopt_set_xtol_rel(handle, t.x_relative);
  nlopt_set_xtol_abs1(handle, t.x_absolute);
  nlopt_set_ftol_rel(handle, t.f_relative);
  nlopt_set_ftol_abs(handle, t.f_absolute);
}

void set(nlopt_opt handle, const NonlinearProgram& problem, const MinimizeOptions& options) {
  nlopt_set_lower_bounds(handle, problem.lower.data());
  nlopt_set_upper_bounds(handle, problem.upper.data());
  set(handle, options.tolerances);
  nlopt_set_stopval(handle, options.target);
  nlopt_set_maxeval(handle, options.evaluations);  // the time limit is enforced by Run, which sees every call
  nlopt_set_population(handle, static_cast<unsigned>(options.population));
  if (options.local) {
    const Handle local = create(algorithm(options.local->algorithm), problem.lower.size());
    set(local.get(), options.local->tolerances);
    nlopt_set_maxeval(local.get(), options.local->evaluations);
    nlopt_set_local_optimizer(handle, local.get());
  }
}

// Projects x onto the bounds, with notes.
std::vector<std::string> move_inside(std::vector<double>& x, const NonlinearProgram& problem) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double inside = std::clamp(x[i], problem.lower[i], problem.upper[i]);
    if (inside == x[i]) continue;
    notes.push_back(text("the start of variable ", i, " was ", x[i], ", outside [", problem.lower[i], ", ",
                         problem.upper[i], "], and was moved to ", inside));
    x[i] = inside;
  }
  return notes;
}

}  // namespace

MinimizeResult minimize(const NonlinearProgram& problem, std::vector<double> start,
                        const MinimizeOptions& options) {
  const Algorithm chosen = algorithm(options.algorithm);
  check(options, chosen);
  check(problem, start, chosen);
  std::vector<std::string> notes = move_inside(start, problem);

  const Handle handle = create(chosen, start.size());
  set(handle.get(), problem, options);
  Run run(problem, options, handle.get());
  std::vector<Callback> callbacks;
  callbacks.reserve(problem.constraints.size() + 1);
  callbacks.push_back({&run, 0});
  nlopt_set_min_objective(handle.get(), call_objective, &callbacks.back());
  for (std::size_t k = 0; k < problem.constraints.size(); ++k) {
    callbacks.push_back({&run, k});
    nlopt_add_inequality_constraint(handle.get(), call_constraint, &callbacks.back(),
                                    problem.constraints[k].tolerance);
  }

  nlopt_srand(options.seed);  // of this thread
  double value = 0;
  const int code = nlopt_optimize(handle.get(), start.data(), &value);
  MinimizeResult result = run.result(code, nlopt_get_errmsg(handle.get()));
  result.notes = std::move(notes);
  return result;
}

}  // namespace arcslip::optimize
