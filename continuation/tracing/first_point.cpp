#include <arcslip/continuation/tracing/first_point.hpp>

#include <arcslip/continuation/tracing/pseudo_transient.hpp>

namespace arcslip::continuation {
namespace {

constexpr double local = 1e-2;    // corrections below: a solution is near, and no other start helps
constexpr double decrease = 0.1;  // of |F|, until Newton's method is tried again

// The double root at a fold or a branch point is approached linearly.
bool is_regular(const Correction& found) {
  return found.converged && !found.linear;
}

class FirstPoint {
 public:
  FirstPoint(const Problem& problem, Corrector& with, const Options& options, const Vector& row,
             const Vector& guess)
      : problem_(problem), with_(with), options_(options), row_(row), guess_(guess) {}

  Correction newton(Vector& v, Damping damping) {
    v = guess_;
    return with_.newton(v, row_, options_.newton.start_iterations, damping);
  }

  // Newton's method from the points of a transient.
  Correction transient(Vector& v, int direction) {
    PseudoTransient motion(problem_, with_, guess_, direction);
    Correction last;
    double tried = decrease * motion.residual();
    for (int k = 0; k < options_.newton.transient_steps && goes_on() && motion.step(); ++k) {
      if (motion.residual() > tried) continue;
      tried = decrease * motion.residual();
      v = motion.point();
      last = with_.newton(v, row_, options_.newton.iterations, Damping::natural);
      if (is_regular(last)) break;
    }
    return last;
  }

  bool goes_on() const { return !options_.go_on || options_.go_on(); }

 private:
  const Problem& problem_;
  Corrector& with_;
  const Options& options_;
  const Vector& row_;
  Vector guess_;
};

}  // namespace

Correction first_point(const Problem& problem, Corrector& with, const Options& options, const Vector& row,
                       Vector& v) {
  FirstPoint search(problem, with, options, row, v);
  const Vector guess = v;
  const Correction first = search.newton(v, Damping::natural);
  if (first.converged) return first;
  const bool can_begin = first.iterations > 0 || first.evaluated;
  if (can_begin && search.goes_on()) {
    if (const Correction found = search.newton(v, Damping::none); is_regular(found)) return found;
    const bool is_near_singular_solution = first.linear && first.last < local;
    for (const int direction : {1, -1})
      if (!is_near_singular_solution)
        if (const Correction found = search.transient(v, direction); is_regular(found)) return found;
    search.newton(v, Damping::natural);  // for what it says of its failure
  }
  v = guess;
  return first;
}

}  // namespace arcslip::continuation
