#pragma once
// Harmonic balance as a continuation problem:
//
//   R(u, p) = Z(omega) u + sum_e E_e^T F_e(E_e u) - factor f = 0
//
// u: the coefficients of the nonlinear coordinates (hbm/linear/coordinates.hpp), each in the layout of
// fourier/harmonics.hpp, followed by the auxiliary unknowns of laws, whose equations are rows of F_e. p: the
// model's parameters ("frequency" first, rad/s), and last "excitation_factor", which scales all forces, from
// rest (u = 0 at 0) to the scene (1).

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/control/workers.hpp>
#include <arcslip/hbm/element_gather.hpp>
#include <arcslip/hbm/linear/dynamic_stiffness.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::hbm {

class HbmEvaluator final : public continuation::Evaluator {
 public:
  explicit HbmEvaluator(const class HbmProblem& problem);
  ~HbmEvaluator() override;

  continuation::Evaluated move_to(continuation::In u, continuation::In p, continuation::Needs needs) override;
  /// The same with the linear part of another evaluator of these equations that is at these parameters, if it
  /// is; it stays there until the next move.
  continuation::Evaluated move_next_to(const HbmEvaluator& other, continuation::In u, continuation::In p,
                                       continuation::Needs needs);
  const Vector& residual() const override { return R_; }
  const continuation::Jacobian& jacobian() const override;  // put together on the first call
  void parameter_derivative(int k, continuation::Out dR) const override;
  std::uint64_t piece() const override;
  /// Moves only elements, and the one that left a piece last before the others.
  continuation::Evaluated test_piece(continuation::In u, continuation::In p, std::uint64_t piece,
                                     continuation::PieceTest test, bool& inside) override;

  /// The rows and columns of J of the cosine and sine of order n > 0, those of block i at 2 i and 2 i + 1,
  /// from the parts of J. J_n: 2 blocks() x 2 blocks().
  void jacobian_of_order(int n, Eigen::MatrixXd& J_n) const;

  /// y = J x from the parts of J, without putting it together.
  void apply_jacobian(In x, continuation::Out y) const;

  // Data for observables, at the last point.
  const DynamicStiffness& stiffness() const { return lent_ ? *lent_ : stiffness_; }
  double force_factor() const { return force_factor_; }
  std::size_t element_count() const { return parts_.size(); }
  const elements::Element& element(std::size_t e) const { return *parts_[e].element; }
  /// From now on: Element::place_slider().
  bool place_slider(std::size_t e, double share) { return parts_[e].element->place_slider(share); }
  const Vector& element_motion(std::size_t e) const { return parts_[e].motion; }
  In unknowns() const { return u_; }

 private:
  struct Part {
    std::unique_ptr<elements::Element> element;
    ElementMap map;
    bool rate_dependent;
    const model::NonlinearPart* of;
    std::vector<double> fields;
    Vector motion;
    std::uint64_t tested = 0;  // its piece in tested_piece_
  };

  continuation::Evaluated move(continuation::In u, continuation::In p, continuation::Needs needs,
                               const DynamicStiffness* lent);
  void move(Part& part, const continuation::In& u, const continuation::In& p, bool jacobian);
  void move_all(const continuation::In& u, const continuation::In& p, bool jacobian);
  void assemble() const;

  std::shared_ptr<const model::Model> model_;
  Eigen::Index displacements_;  // before the auxiliary unknowns
  DynamicStiffness stiffness_;
  const DynamicStiffness* lent_ = nullptr;  // in place of it, by move_next_to()
  std::vector<Part> parts_;
  std::shared_ptr<control::Workers> workers_;  // null: one thread
  double seconds_[2] = {0, 0};  // of all elements in one thread: without and with their Jacobians
  std::vector<std::size_t> latest_to_leave_;   // a piece, of parts_
  std::optional<std::uint64_t> tested_piece_;  // the last one in which a point was found
  Vector u_, p_, R_;
  mutable Vector derivative_, product_;
  mutable continuation::Jacobian jacobian_;
  mutable bool assembled_ = true;  // jacobian_ is that of the last place with one
  double force_factor_ = 1;
};

class HbmProblem final : public continuation::Problem {
 public:
  /// displacement: typical amplitude (m), the scale of the unknowns; frequency: the scale of the excitation
  /// frequency (rad/s); about: a frequency of the study (rad/s), about which modes of the structure are most
  /// accurate, where it is not that scale.
  HbmProblem(std::shared_ptr<const model::Model> model, const Harmonics& harmonics, double displacement,
             double frequency, std::optional<double> about = {});
  /// The same with another typical amplitude.
  HbmProblem(const HbmProblem& other, double displacement);
  /// The same with other harmonics and another sampling than in the model's settings.
  HbmProblem(const HbmProblem& other, const Harmonics& harmonics, const elements::Sampling& sampling);

  int size() const override { return blocks() * harmonics_.size(); }
  std::span<const continuation::Parameter> parameters() const override { return parameters_; }
  Vector scales() const override;
  std::unique_ptr<continuation::Evaluator> evaluator() const override;
  std::unique_ptr<HbmEvaluator> hbm_evaluator() const;
  /// A dense LU that knows the harmonic of each unknown.
  std::unique_ptr<continuation::LinearSolver> linear_solver() const override;
  /// Not where condensing the linear coordinates costs more than the Jacobian of the others.
  bool chord_pays() const override;

  const model::Model& model() const { return *model_; }
  std::shared_ptr<const model::Model> shared_model() const { return model_; }
  const Harmonics& harmonics() const { return harmonics_; }
  const elements::Sampling& sampling() const { return sampling_; }
  const Coordinates& coordinates() const { return coordinates_; }
  /// Coordinates and auxiliary unknowns, harmonics().size() coefficients each.
  int blocks() const { return blocks_; }
  /// The position of the unknowns of an element.
  ElementMap map_of(std::size_t element) const;
  double displacement() const { return displacement_; }
  int excitation_factor() const { return static_cast<int>(parameters_.size()) - 1; }
  /// Of Model::threads, which evaluators share; null: one.
  const std::shared_ptr<control::Workers>& workers() const { return workers_; }

 private:
  std::shared_ptr<const model::Model> model_;
  Harmonics harmonics_;
  elements::Sampling sampling_;
  Coordinates coordinates_;
  int blocks_;
  std::vector<continuation::Parameter> parameters_;
  double displacement_;
  std::shared_ptr<control::Workers> workers_;
};

/// Default values of the parameters, at one excitation frequency (rad/s).
Vector parameters_at(const HbmProblem& problem, double omega);

// A periodic response at given parameters, without an initial guess.

/// The response of the structure without its elements, Z^-1 f, at the parameters p (with force_factor 1). Not
/// finite at an undamped resonance.
Vector linear_response(const HbmProblem& problem, const Vector& p);

/// Newton's method from a guess. Empty if it fails. Its work is added to `work`.
std::optional<Vector> response_near(const HbmProblem& problem, const Vector& p, const Vector& guess,
                                    continuation::Counts& work);
std::optional<Vector> response_near(const HbmProblem& problem, const Vector& p, const Vector& guess);

/// u: empty if none was found. work: of the search, without points and rejected steps on its ways.
struct SteadyState {
  std::optional<Vector> u;
  continuation::Counts work;
};

/// Newton's method from rest, from the linear response and from those with all sliders stuck and with springs
/// in place of the elements; if none converges, continuation in the excitation factor from rest at 0 to 1 or
/// -1, where the response is that at 1 reversed, or from a part of the excitation; and at last continuation
/// in a factor of the element forces, as for a stop without a gap, which has a kink at rest: from the
/// structure without elements or, where that has no response, with springs in place of them, as for a mass
/// between two stops; and Newton's method from motions at random, the same in each run. Empty if that fails,
/// too, or if `control` ends meanwhile.
SteadyState steady_state(const std::shared_ptr<const HbmProblem>& problem, const Vector& p,
                         const control::Control& control = {});

}  // namespace arcslip::hbm
