#pragma once
// The model of a scene: the parts and where they act, with every number replaced by its parameter, or by a
// formula of parameters. Immutable. The values are in the parameter vector p, so that a change of values
// needs no new model; the model keeps the defaults.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/laws/law.hpp>
#include <arcslip/model/number.hpp>
#include <arcslip/scene/scene.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::model {

/// d, of as many entries as there are degrees of freedom, most of them 0.
using Direction = Eigen::SparseVector<double>;

/// The model is one sector of a ring in a travelling wave: the next sector moves as this one does, but later,
///
///   x_next(theta) = x(theta - phase),   X_next,n = turn(n) X_n = exp(-i n phase) X_n
///
/// with the angle theta of the excitation and amplitudes X_n = a_n - i b_n.
struct Sector {
  int count;         // of the ring
  int engine_order;  // 0 to count - 1

  double phase() const { return 2 * std::numbers::pi * engine_order / count; }  // rad
  std::complex<double> turn(int n) const;
  /// Nodal diameters of the wave of harmonic n, 0 to count - 1.
  int diameter(int n) const { return static_cast<int>(static_cast<long long>(n) * engine_order % count); }
};

/// A mass, damper or spring: value * d d^T on the degrees of freedom. In a sector it may reach into the next
/// one: d + turn(n) next for harmonic n, and value * conj(d) d^T.
struct LinearPart {
  Number number;
  Direction direction;
  Direction next{};  // empty: within the sector
};

/// circulatory: a stiffness without a potential, to which no proportional damping belongs.
enum class LinearKind { mass, damper, spring, circulatory };

/// A matrix of a sector that reaches into the next one, in the wave of d nodal diameters: A_own + t A_next +
/// t* A_previous with t = exp(-2 pi i d/count), Hermitian where the structure is symmetric. Degrees of
/// freedom without a name stand for other motions in each wave.
class WaveMatrices {
 public:
  /// of_diameter: of each d from 0 to count/2, empty where no harmonic has it.
  WaveMatrices(int count, std::vector<Eigen::MatrixXcd> of_diameter)
      : count_(count), of_(std::move(of_diameter)) {}

  /// Of d from 0 to count - 1: the wave of count - d is that of d the other way round.
  Eigen::MatrixXcd of(int d) const {
    return 2 * d > count_ ? of_[static_cast<std::size_t>(count_ - d)].conjugate()
                          : of_[static_cast<std::size_t>(d)];
  }

 private:
  int count_;
  std::vector<Eigen::MatrixXcd> of_;
};

/// A matrix of the structure: value * A, with value = c, its number over `scale`, or c^2, or 1 where there
/// is no number. Gyroscopic matrices are dampers with a skew-symmetric A.
struct MatrixPart {
  LinearKind kind;
  Number number{};
  std::shared_ptr<const Eigen::MatrixXd> A;  // dofs x dofs; with waves, where all sectors move alike
  bool squared = false;
  double scale = 1;
  bool symmetric = true;                        // A is, or Hermitian in waves
  std::shared_ptr<const WaveMatrices> waves{};  // null: A in all of them

  double value(continuation::In p) const {
    const double c = number.given() ? number.value(p) / scale : 1;
    return squared ? c * c : c;
  }
  /// Its derivative by p_k.
  double rate(continuation::In p, int k) const {
    if (!number.depends_on(k)) return 0;
    return (squared ? 2 * number.value(p) / (scale * scale) : 1 / scale) * number.rate(p, k);
  }
};

/// Damping in proportion to the masses and the stiffnesses of the structure, but not to elements: the dynamic
/// stiffness of a motion exp(i s t) has
///
///   K (1 + i s beta + i loss_factor) + M (-s^2 + i s alpha) + i s C
///
/// and no loss at s = 0. What is not given is 0.
struct ProportionalDamping {
  Number alpha{}, beta{}, loss_factor{};

  double alpha_at(continuation::In p) const { return alpha.value_or(p, 0); }
  double beta_at(continuation::In p) const { return beta.value_or(p, 0); }
  double loss_factor_at(continuation::In p) const { return loss_factor.value_or(p, 0); }
};

/// What a number adds to a field of an element: factor * number.
struct Share {
  int field;
  Number number;
  double factor = 1;
};

/// A nonlinear element: its law acts on q_i = d_i . x, along d_i, and with a sector q_i = d_i . x + next_i .
/// x_next.
struct NonlinearPart {
  std::string name;
  std::shared_ptr<const elements::Law> law;
  std::vector<Share> shares;  // of its fields: one each, or more in a patch
  std::vector<Direction> directions;
  std::size_t field_count = 0;
  double wear_coefficient = 0;    // m^3/J
  std::vector<Direction> next{};  // empty: within the sector; else one for each direction

  std::vector<double> fields(const continuation::Vector& p) const;
  void set_fields(continuation::In p, std::span<double> fields) const;
};

/// A patch of contacts.
struct Patch {
  std::string name;
  std::size_t first;          // of its elements
  std::vector<double> areas;  // of each, m^2
};

/// An excitation, g (cosine cos n theta + sine sin n theta) with theta = w t, w the excitation frequency:
///
///   g = d                  a force along d
///   g = (n w)^2 M r        a displacement of the ground along r
///   g = -M r               an acceleration of the ground along r
///
/// in coordinates relative to the ground, which moves with all that is fixed to it. M r = sum_k m_k (d_k . r)
/// d_k over the masses, and M of the matrices times their r. The imaginary part of a shape is an excitation
/// of its own, i times the complex amplitude cosine - i sine.
struct Excitation {
  enum class Kind { force, base_displacement, base_acceleration };
  Kind kind;
  int harmonic;  // n
  Number cosine, sine;
  Direction direction;     // d or r; of r what the degrees of freedom of the model see
  Eigen::VectorXd load{};  // on all rows: what is added to d, or M r of the matrices; empty: none
  bool imaginary = false;

  bool moves_base() const { return kind != Kind::force; }
  /// The complex amplitude, a - i b of a cos n theta + b sin n theta, and its derivative by parameter k.
  std::complex<double> amplitude(continuation::In p) const;
  std::complex<double> amplitude_rate(continuation::In p, int k) const;
  /// The factor of d or M r, and its derivative by the excitation frequency w.
  double factor(double w) const;
  double factor_rate(double w) const;
  /// The displacement of the ground over the given amplitude, and its derivative by w; of a force 0.
  double displacement(double w) const;
  double displacement_rate(double w) const;
};

/// A response next to that of the amplitude. Its amplitude, too, is the largest over its places.
struct NamedResponse {
  std::vector<Direction> places;
  bool absolute = false;
};

/// How the matrices of the scene were reduced.
struct Reduction {
  int rows = 0;                  // of the matrices, in each copy
  int kept = 0;                  // of them
  int coordinates = 0;           // next to the degrees of freedom with names, in the copy with most
  double highest_frequency = 0;  // rad/s
  double error = 0;              // structure::Reduced::error
  double free_below = 0;         // rad/s: natural frequencies below are not distinguished from 0
  double highest_speed = 0;      // rad/s, of the rotation
};

/// Index of the excitation frequency in the parameters.
inline constexpr int frequency = 0;

struct Model {
  int dofs = 0;
  std::vector<std::string> dof_names;
  int unnamed_from = 0, unnamed_to = 0;  // rows and coordinates of matrices, without a name in the scene
  std::vector<continuation::Parameter> parameters;             // [0] is "frequency", rad/s
  std::vector<std::shared_ptr<const NumberFormula>> formulas;  // all numbers that follow parameters
  std::vector<LinearPart> masses, dampers, springs;
  std::vector<MatrixPart> matrices;
  std::optional<ProportionalDamping> damping;
  std::optional<Sector> sector;
  bool linked = false;  // masses, dampers, springs or matrices reach into the next sector
  std::vector<NonlinearPart> elements;
  std::vector<Patch> patches;
  std::vector<Excitation> excitation;
  Eigen::VectorXd response;       // the direction of the amplitude
  std::vector<Direction> others;  // further ones: then the amplitude is the largest along all of them
  bool absolute = false;          // these are displacements with that of the ground, not relative to it
  std::vector<NamedResponse> named_responses;         // of the scene
  std::shared_ptr<const scene::Catalogue> catalogue;  // of the scene: it owns the laws of the elements
  elements::Harmonics harmonics;  // odd only, where no even one is excited and all laws are antisymmetric
  bool antisymmetric = true;      // all laws are
  scene::Harmonics settings;
  std::optional<Reduction> reduction;  // of its matrices
  int force_harmonic = 1;              // lowest of the excitation: the fundamental
  int threads = 1;                     // of the scene
  /// Asked within evaluations that take long, those with factors of large matrices: an evaluation that is
  /// stopped fails.
  control::Control control{};
};

/// From a validated scene. The matrices of a large structure are reduced to the rows that the scene uses
/// (structure/reduction.hpp), once for all copies of the scene. Throws structure::ReductionError and
/// control::Interrupted.
Model build(const scene::Scene& scene, const control::Control& control = {});

/// The model in other harmonics of the same excitation; friction has as many samples in a period of it.
Model in_harmonics(Model model, const elements::Harmonics& harmonics);

/// Index of a parameter. Throws scene::ParameterError; also for a number that follows others.
int parameter_index(const Model& model, const std::string& name);

/// All numbers of a model.
std::vector<Number*> numbers(Model& model);
/// Whether all numbers given by formulas are within their bounds.
bool within_bounds(const Model& model, continuation::In p);

/// Default values of the parameters.
continuation::Vector defaults(const Model& model);

/// d + next: where all sectors move alike.
Direction in_phase(const Direction& d, const Direction& next);

/// g of an excitation.
Eigen::VectorXd shape(const Model& model, const Excitation& excitation, const continuation::Vector& p);

/// sum += factor d d^T.
void add_outer(double factor, const Direction& d, Eigen::MatrixXd& sum);
/// The same with conj(d + turn next) (d + turn next)^T, on real and imaginary parts of the degrees of
/// freedom, one after the other: sum is 2 dofs x 2 dofs.
void add_outer(double factor, const Direction& d, const Direction& next, std::complex<double> turn,
               Eigen::MatrixXd& sum);

/// Whether all matrices of the structure are symmetric.
bool is_symmetric(const Model& model);

/// The sum of p d d^T and of the matrices of one kind. Of a sector: what does not reach into the next one.
Eigen::MatrixXd sum_of(const Model& model, LinearKind kind, const continuation::Vector& p);
/// M, C and K of M x'' + C x' + K x, gyroscopic and circulatory matrices included, without a loss factor,
/// which has no equation in time.
Eigen::MatrixXd mass_matrix(const Model& model, const continuation::Vector& p);
Eigen::MatrixXd damping_matrix(const Model& model, const continuation::Vector& p);
Eigen::MatrixXd stiffness_matrix(const Model& model, const continuation::Vector& p);

/// Of a contact or stop: whether it is open at rest, or just touches, so that it holds a mean position only
/// where a constant force closes it.
bool is_open_at_rest(const NonlinearPart& element, const continuation::Vector& p);

/// With a mean among the unknowns: a degree of freedom whose mean position is supported by no spring or law,
/// directly or through others, nor by a contact or stop that the constant forces close. Friction forces do
/// not depend on it, so that it would be arbitrary or drift. Empty if there is none. in_stick: contacts that
/// hold a mean force while they stick count as supports.
std::optional<int> drifting_dof(const Model& model, const continuation::Vector& p, bool in_stick = true);

/// For messages: a degree of freedom by its name, in quotes; "the structure" where the scene has none for it.
std::string coordinate_name(const Model& model, int dof);

}  // namespace arcslip::model
