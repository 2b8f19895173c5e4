#pragma once
// Where a problem widens: the branches that leave those of a problem F(u, p) = 0 in more unknowns than it
// has.
//
// G(u, v, p) = 0 has the solutions of F with v = 0, and a symmetry keeps them apart: G_v(u, 0, p) = F(u, p)
// and the residual of v is zero there, so that
//
//   J_G = [ J_F  0 ]
//         [ 0    D ]
//
// along a branch of F. F may be a motion that repeats after a period, in its harmonics, and v the harmonics
// between them: the period doubles where a branch of G leaves. F may be symmetric solutions, and v what they
// lack. The branches cross where det D = 0, at a simple zero over the arclength where J_F is regular, and
// phi, D phi = 0, is the tangent of the branch that leaves. Its two halves are images of each other by the
// symmetry: Junction::images.

#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace arcslip::continuation {

struct Widening {
  std::shared_ptr<const Problem> narrow;          // F, n unknowns
  std::shared_ptr<const Problem> wide;            // G, with the same parameters. Its Jacobian is a matrix
  std::function<void(In u, Vector& wide)> embed;  // of n: sets all unknowns of G, with v = 0
  std::vector<int> added;                         // the unknowns v of G
  int free = 0;  // index of the free parameter; others have the problem's values
};

struct WideningOptions {
  int points_around = 12;    // of the branch, to both sides of an event: where its branch point is sought.
                             // The event may be located by other means, whose errors move it by steps
  double same_place = 1e-7;  // branch points that are closer are one, relative to |(u, p)|
  double resolved_step = 1e-13;  // of a step between points of the branch, to which the zero is located
  double continuous = 1e-5;  // of the change of the smallest singular value over the step: a larger rest at
                             // the zero is a jump across it. Between rounding and any jump of interest
  double singular = 1e-13;   // reciprocal condition of D without its null vector: below, D loses two ranks
  int bisections = 12;       // of the step, until the null vectors of its middle serve at both ends
  int sweeps = 4;            // of inverse iteration, which converges like the ratio of two singular values
};

/// Why no branch point was found.
enum class NotWidened {
  no_crossing,    // det D keeps its sign around the event
  several_cross,  // D loses two ranks or more at once, as in symmetric structures
  jumps,         // D jumps there, between two smooth pieces: the branch that leaves has no tangent of its own
  not_evaluated  // where it crosses, no solution of F was found, or G could not be evaluated
};

/// The branch points at which a branch of F meets those of G.
class WiderBranchPoints {
 public:
  explicit WiderBranchPoints(Widening problems, const WideningOptions& options = {});

  const std::shared_ptr<const Problem>& wide() const { return of_.wide; }

  /// The zero of det D nearest to the step that follows point `after` of the branch, whose points (u, p)
  /// these are; not one of those found before. Its half-branch has length 1 in the scales of G.
  std::variant<Junction, NotWidened> locate(const std::vector<Vector>& branch, std::size_t after);

 private:
  bool move_to(const Vector& v);
  int sign_at(const Vector& v);
  Junction junction_along(const Vector& added) const;
  std::variant<Junction, NotWidened> refine(const Vector& from, const Vector& to);

  Widening of_;
  WideningOptions options_;
  std::unique_ptr<Evaluator> at_;
  Matrix D_;
  LU<double> lu_;  // of it
  Vector p_, u_;
  std::vector<Vector> found_;
};

}  // namespace arcslip::continuation
