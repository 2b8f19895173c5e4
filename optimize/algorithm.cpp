#include <arcslip/optimize/algorithm.hpp>
#include <arcslip/scene/scene.hpp>

#include <nlopt.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>

namespace arcslip::optimize {
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

// The known name that was meant: "slsqp" is LD_SLSQP, "LD_SLSPQ" too. "" where nothing is near.
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

}  // namespace arcslip::optimize
