#include <arcslip/continuation/correction/first_point.hpp>

#include <arcslip/continuation/correction/pseudo_transient.hpp>

namespace arcslip::continuation {
namespace {

constexpr double local = 1e-2;    // corrections below: a solution is near, and no other start helps
constexpr double decrease = 0.1;  // of |F|, until Newton's method is tried again

// The double root at a fold or a branch point is approached linearly.
bool is_regular(const Correction& found) {
  return found.converged && !found.linear;
}

class Search {
 public:
  Search(const Problem& problem, Corrector& with, const Options& options, const control::Control& control,
         const Vector& row, const Vector& guess)
      : problem_(problem), with_(with), options_(options), control_(control), row_(row), guess_(guess) {}

  Correction newton(Vector& v, Damping damping) {
    v = guess_;
    return with_.newton(v, row_, options_.newton.start_iterations, damping);
  }

  // Newton's method from the points of a transient.
  Correction transient(Vector& v, int direction) {
    PseudoTransient motion(problem_, with_,
                           options_.linear_solver ? options_.linear_solver() : problem_.linear_solver(),
                           guess_, direction);
    Correction last;
    double tried = decrease * motion.residual();
    for (int k = 0; k < options_.newton.transient_steps && keep_going() && motion.step(); ++k) {
      if (motion.residual() > tried) continue;
      tried = decrease * motion.residual();
      v = motion.point();
      last = with_.newton(v, row_, options_.newton.iterations, Damping::natural);
      if (is_regular(last)) break;
    }
    return last;
  }

  bool keep_going() { return !is_stopped && !(is_stopped = !control_.keep_going()); }

  bool is_stopped = false;

 private:
  const Problem& problem_;
  Corrector& with_;
  const Options& options_;
  const control::Control& control_;
  const Vector& row_;
  Vector guess_;
};

}  // namespace

FirstPoint first_point(const Problem& problem, Corrector& with, const Options& options,
                       const control::Control& control, const Vector& row, Vector& v) {
  Search search(problem, with, options, control, row, v);
  FirstPoint first{search.newton(v, Damping::natural), with.failure()};
  const Correction& by_newton = first.correction;
  if (by_newton.converged || (by_newton.iterations == 0 && !by_newton.evaluated)) return first;
  const Vector ended = v;
  if (search.keep_going())
    if (const Correction found = search.newton(v, Damping::none); is_regular(found)) return {found, {}};
  const bool is_near_singular_solution = by_newton.linear && by_newton.last < local;
  for (const int direction : {1, -1})
    if (!is_near_singular_solution && search.keep_going())
      if (const Correction found = search.transient(v, direction); is_regular(found)) return {found, {}};
  v = ended;
  first.is_stopped = search.is_stopped;
  return first;
}

}  // namespace arcslip::continuation
