#include <arcslip/observables/unresolved_resonances.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/model/cyclic_waves.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace arcslip::observables {
namespace {

using continuation::Vector;
using model::LinearKind;

constexpr int most_dofs_for_modes = 200;    // of which all modes are computed
constexpr double rigid_body = 1e-10;        // v^T K v over the terms that it is made of
constexpr double equal_frequencies = 1e-6;  // relative: any combination of such modes is taken as one
constexpr double at_node = 1e-9;            // r . v or f . v over the largest that it might be
constexpr double rigid_link = 1e6;          // of the largest stiffness: a contact that gives no way at all
constexpr double with_mass = 1e-12;         // of the largest 1/(omega^2 + shift): others are massless

// The stiffness that an element has as a spring along its direction i, N/m.
using Spring = std::function<double(std::size_t element, std::size_t i)>;

Spring springs_within(const model::Model& model, const Vector& p, std::vector<double> motions) {
  return [&model, &p, motions = std::move(motions)](std::size_t e, std::size_t i) {
    const auto& element = model.elements[e];
    const double reach = e < motions.size() ? motions[e] : 0;
    return element.law->stiffness(element.fields(p), static_cast<int>(i), reach);
  };
}

// Symmetric, with the stiffnesses of the elements.
Eigen::MatrixXd whole_stiffness(const model::Model& model, const Vector& p, const Spring& spring) {
  Eigen::MatrixXd K = model::sum_of(model, model::LinearKind::spring, p);
  if (!model::is_symmetric(model)) K = 0.5 * (K + K.transpose()).eval();
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    for (std::size_t i = 0; i < model.elements[e].directions.size(); ++i)
      model::add_outer(spring(e, i), model.elements[e].directions[i], K);
  return K;
}

// M v = mu (K + shift M) v: mu = 1/(omega^2 + shift), zero for massless motions; definite with any shift > 0.
double shift_of(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K) {
  return std::max(K.cwiseAbs().maxCoeff() / std::max(M.cwiseAbs().maxCoeff(), 1e-300), 1e-300);
}

// The modes with mass, V^T M V = the largest |M_ij|, and omega^2: the same digits in all units.
struct ModesWithMass {
  Vector squares;
  Eigen::MatrixXd V;
};
ModesWithMass modes_with_mass(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K) {
  const double mass = std::max(M.cwiseAbs().maxCoeff(), 1e-300);
  const double stiffness = std::max(K.cwiseAbs().maxCoeff(), 1e-300);
  const auto modes = continuation::symmetric_modes(M / mass, K / stiffness + M / mass);
  Eigen::Index massless = 0;
  const Eigen::Index all = modes.values.size();
  while (massless < all && !(modes.values[massless] > with_mass * modes.values[all - 1])) ++massless;
  const Eigen::Index n = all - massless;
  const Vector mu = modes.values.tail(n);
  return {(mu.cwiseInverse().array() - 1) * (stiffness / mass),
          modes.V.rightCols(n) * mu.cwiseSqrt().cwiseInverse().asDiagonal()};
}

// The largest eigenvalue of K v = omega^2 M v; massless motions have none. 0 where there is none at all.
double highest_square(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K) {
  const double shift = shift_of(M, K);
  const Vector all = continuation::symmetric_eigenvalues(M, K + shift * M);
  if (all.size() == 0) return 0;
  const double largest = all.maxCoeff();
  double highest = 0;
  for (double mu : all)
    if (mu > with_mass * largest) highest = std::max(highest, 1 / mu - shift);
  return highest;
}

// The gyroscopic matrix.
Eigen::MatrixXd skew_damping(const model::Model& model, const Vector& p) {
  if (model::is_symmetric(model)) return {};
  const Eigen::MatrixXd C = model::sum_of(model, model::LinearKind::damper, p);
  return 0.5 * (C - C.transpose());
}

// The largest |lambda|^2 of lambda^2 M v + lambda G v + K v = 0, G skew-symmetric, in the modes of M and K
// with mass: those without have no gyroscopic forces.
double highest_square(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K, const Eigen::MatrixXd& G) {
  if (G.size() == 0 || G.isZero(0)) return highest_square(M, K);
  const ModesWithMass modes = modes_with_mass(M, K);
  const Eigen::Index n = modes.squares.size();
  if (n == 0) return 0;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  const double scale = std::sqrt(shift_of(M, K));
  A.topRightCorner(n, n).diagonal().setConstant(scale);
  A.bottomLeftCorner(n, n).diagonal() = -modes.squares / scale;
  A.bottomRightCorner(n, n) = -modes.V.transpose() * (G / M.cwiseAbs().maxCoeff()) * modes.V;
  const Eigen::VectorXcd all = continuation::eigenvalues(A);
  return all.size() > 0 ? all.cwiseAbs2().maxCoeff() : 0;
}

// Stiffnesses of the elements, in the wave of a diameter.
void add_elements(const model::Model& model, const Spring& spring, int diameter, Eigen::MatrixXd& K) {
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const auto& element = model.elements[e];
    for (std::size_t i = 0; i < element.directions.size(); ++i)
      model::add_outer(spring(e, i), element.directions[i],
                       element.next.empty() ? model::Direction() : element.next[i],
                       turn(*model.sector, diameter), K);
  }
}

// Of a sector of a ring in the waves of all its harmonics, in real and imaginary parts.
double highest_square_of_waves(const model::Model& model, const Vector& p, const Spring& spring) {
  double highest = 0;
  const bool symmetric = model::is_symmetric(model);
  for (const int diameter : diameters(*model.sector)) {
    const auto sum = [&](LinearKind kind) { return sum_in_wave(model, kind, p, diameter); };
    Eigen::MatrixXd K = sum(LinearKind::spring), G;
    if (!symmetric) {
      K = 0.5 * (K + K.transpose()).eval();
      const Eigen::MatrixXd C = sum(LinearKind::damper);
      G = 0.5 * (C - C.transpose());
    }
    add_elements(model, spring, diameter, K);
    highest = std::max(highest, highest_square(sum(LinearKind::mass), K, G));
  }
  return highest;
}

// d . phi, of a motion of n degrees of freedom or of its real and imaginary parts.
std::complex<double> along(const model::Direction& d, const Vector& phi) {
  const bool wave = phi.size() > d.size();
  std::complex<double> sum = 0;
  for (model::Direction::InnerIterator i(d); i; ++i)
    sum += i.value() * std::complex(phi[i.index()], wave ? phi[d.size() + i.index()] : 0.0);
  return sum;
}

double largest_response(const model::Model& model, const Vector& phi) {
  double largest = std::abs(along(model.response.sparseView(), phi));
  for (const model::Direction& d : model.others) largest = std::max(largest, std::abs(along(d, phi)));
  return largest;
}

// turn: to the next sector.
double largest_at_elements(const model::Model& model, std::complex<double> turn, const Vector& phi) {
  double largest = 0;
  for (const auto& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      std::complex<double> q = along(element.directions[i], phi);
      if (!element.next.empty()) q += turn * along(element.next[i], phi);
      largest = std::max(largest, std::abs(q));
    }
  return largest;
}

// stiffness: of the structure alone; K: with the elements.
void add_modes(const model::Model& model, const Vector& p, const Eigen::MatrixXd& M,
               const Eigen::MatrixXd& dampers, const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& K,
               std::complex<double> turn, std::vector<ResonantMode>& to) {
  const model::ProportionalDamping none, &damping = model.damping ? *model.damping : none;
  const ModesWithMass modes = modes_with_mass(M, K);
  for (Eigen::Index k = 0; k < modes.squares.size(); ++k) {
    const double omega = std::sqrt(std::max(modes.squares[k], 0.0));
    const Vector phi = modes.V.col(k);
    const double stiff = phi.dot(stiffness * phi);
    const double loss = omega * (phi.dot(dampers * phi) + damping.alpha_at(p) * phi.dot(M * phi) +
                                 damping.beta_at(p) * stiff) +
                        damping.loss_factor_at(p) * stiff;
    const double force = largest_response(model, phi) * largest_at_elements(model, turn, phi);
    to.push_back({omega, force == 0 ? 0 : loss > 0 ? force / loss : std::numeric_limits<double>::infinity()});
  }
}

}  // namespace

double bound_of_highest_natural_frequency(const model::Model& model, const Vector& p) {
  if (model.sector) return 0;
  const Eigen::MatrixXd M = model::mass_matrix(model, p);
  const Vector masses = M.diagonal();
  if (!(masses.minCoeff() > 0) || !M.isDiagonal(0)) return 0;
  const Eigen::MatrixXd K = whole_stiffness(model, p, springs_within(model, p, {}));
  const double square = (K.diagonal().array() / masses.array()).maxCoeff();
  return square > 0 ? std::sqrt(square) : 0;
}

double highest_natural_frequency(const model::Model& model, const Vector& p,
                                 const std::vector<double>& motions) {
  const Spring spring = springs_within(model, p, motions);
  if (model.sector) return std::sqrt(highest_square_of_waves(model, p, spring));
  return std::sqrt(highest_square(model::mass_matrix(model, p), whole_stiffness(model, p, spring),
                                  skew_damping(model, p)));
}

std::optional<std::vector<ResonantMode>> resonant_modes(const model::Model& model, const Vector& p) {
  if (model.dofs > most_dofs_for_modes || !model::is_symmetric(model)) return {};
  std::vector<ResonantMode> all;
  const Spring at_rest = springs_within(model, p, {});
  if (model.sector) {
    for (const int diameter : diameters(*model.sector)) {
      const auto sum = [&](LinearKind kind) { return sum_in_wave(model, kind, p, diameter); };
      const Eigen::MatrixXd stiffness = sum(LinearKind::spring);
      Eigen::MatrixXd K = stiffness;
      add_elements(model, at_rest, diameter, K);
      add_modes(model, p, sum(LinearKind::mass), sum(LinearKind::damper), stiffness, K,
                turn(*model.sector, diameter), all);
    }
  } else {
    add_modes(model, p, model::mass_matrix(model, p), model::sum_of(model, LinearKind::damper, p),
              model::sum_of(model, LinearKind::spring, p), whole_stiffness(model, p, at_rest), 0, all);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.omega < b.omega; });
  return all;
}

namespace {

// Of an element in its directions. rigid: of friction without a stiffness that sticks.
Eigen::MatrixXd tangent(const elements::Law& law, const std::vector<double>& fields, Contacts contacts,
                        double rigid) {
  if (!is_contact(law)) return elements::tangent_at_rest(law, fields);
  Eigen::VectorXd k = Eigen::VectorXd::Zero(law.directions());
  for (int i = 0; contacts == Contacts::stuck && i < law.directions(); ++i) {
    const double stiffness = law.traits(fields, i).stiffness;
    k[i] = !law.set_valued() && std::isfinite(stiffness) ? stiffness : rigid;
  }
  return k.asDiagonal();
}

// Adds the tangents of all elements, in the wave of a diameter for a sector. False: directions of one element
// are coupled in a sector, for which there is no sum.
bool add_tangents(const model::Model& model, const Vector& p, Contacts contacts, double rigid, int diameter,
                  Eigen::MatrixXd& K) {
  for (const auto& element : model.elements) {
    const Eigen::MatrixXd k = tangent(*element.law, element.fields(p), contacts, rigid);
    const auto direction = [&](Eigen::Index i) { return element.directions[static_cast<std::size_t>(i)]; };
    for (Eigen::Index i = 0; i < k.rows(); ++i) {
      if (model.sector) {
        model::add_outer(
            k(i, i), direction(i),
            element.next.empty() ? model::Direction() : element.next[static_cast<std::size_t>(i)],
            turn(*model.sector, diameter), K);
      } else {
        model::add_outer(k(i, i), direction(i), K);
      }
      for (Eigen::Index j = 0; j < i; ++j) {
        if (k(i, j) == 0) continue;
        if (model.sector) return false;
        const Eigen::MatrixXd both = k(i, j) * Vector(direction(i)) * Vector(direction(j)).transpose();
        K += both + both.transpose();
      }
    }
  }
  return true;
}

bool moves(const Vector& direction, const Vector& v) {
  return std::abs(direction.dot(v)) > at_node * direction.lpNorm<1>() * v.lpNorm<Eigen::Infinity>();
}

bool moves_any(const std::vector<Vector>& directions, const Vector& v) {
  return std::any_of(directions.begin(), directions.end(),
                     [&](const Vector& direction) { return moves(direction, v); });
}

// The forces of the lowest harmonic of the excitation, without their size.
std::vector<Vector> lowest_forces(const model::Model& model, const Vector& p) {
  std::vector<Vector> all;
  for (const model::Excitation& each : model.excitation)
    if (each.harmonic == model.force_harmonic && std::abs(each.amplitude(p)) > 0)
      all.push_back(model::shape(model, each, p));
  return all;
}

std::vector<Vector> places_of_response(const model::Model& model) {
  std::vector<Vector> all{Vector(model.response)};
  for (const model::Direction& other : model.others) all.emplace_back(other);
  return all;
}

// v^T C v / (2 omega), and the loss factor over 2, of a mode with v^T M v = 1. K: of the structure alone.
double damping_ratio(const model::Model& model, const Vector& p, const Eigen::MatrixXd& C,
                     const Eigen::MatrixXd& K, double omega, const Vector& v) {
  const model::ProportionalDamping none, &damping = model.damping ? *model.damping : none;
  const double stiff = v.dot(K * v);
  return (v.dot(C * v) + damping.alpha_at(p) + damping.beta_at(p) * stiff) / (2 * omega) +
         damping.loss_factor_at(p) * stiff / (2 * omega * omega);
}

struct ShapeAtRest {
  ModeAtRest mode;
  Vector v;  // v^T M v = 1
};

// Modes of one frequency, of which any combination is a mode: a force drives the one sum (v_k . f) v_k, which
// says whether the response is at a node.
void tell_driven(std::span<ShapeAtRest> equal, const std::vector<Vector>& forces,
                 const std::vector<Vector>& places) {
  bool driven = false, driven_responds = false, any_responds = false;
  for (const Vector& force : forces) {
    Vector motion = Vector::Zero(force.size());
    for (const ShapeAtRest& each : equal)
      if (moves(force, each.v)) motion += force.dot(each.v) * each.v;
    if (motion.isZero(0)) continue;
    driven = true;
    driven_responds = driven_responds || moves_any(places, motion);
  }
  for (const ShapeAtRest& each : equal) any_responds = any_responds || moves_any(places, each.v);
  for (ShapeAtRest& each : equal) {
    each.mode.driven = driven;
    each.mode.responds = driven ? driven_responds : any_responds;
  }
}

// Of shapes in increasing order of their frequencies.
void tell_driven_by_frequency(std::vector<ShapeAtRest>& all, const std::vector<Vector>& forces,
                              const std::vector<Vector>& places) {
  for (auto first = all.begin(); first != all.end();) {
    const auto next = std::find_if(first, all.end(), [&](const ShapeAtRest& each) {
      return each.mode.omega > (1 + equal_frequencies) * first->mode.omega;
    });
    tell_driven({first, next}, forces, places);
    first = next;
  }
}

}  // namespace

bool is_contact(const elements::Law& law) {
  return law.has_contact() || law.reports_contact() || law.set_valued();
}

std::optional<std::vector<ModeAtRest>> modes_at_rest(const model::Model& model, const Vector& p,
                                                     Contacts contacts, int most_dofs) {
  const bool in_waves = model.sector.has_value();
  if (model.dofs * (in_waves ? 2 : 1) > most_dofs || !model::is_symmetric(model)) return {};
  const int diameter = in_waves ? model.sector->diameter(model.force_harmonic) : 0;
  const auto sum = [&](LinearKind kind) {
    return in_waves ? sum_in_wave(model, kind, p, diameter) : model::sum_of(model, kind, p);
  };
  const Eigen::MatrixXd M = sum(LinearKind::mass), C = sum(LinearKind::damper);
  const Eigen::MatrixXd own = sum(LinearKind::spring);
  Eigen::MatrixXd K = own;
  if (!add_tangents(model, p, contacts, rigid_link * K.cwiseAbs().maxCoeff(), diameter, K)) return {};
  const ModesWithMass modes = modes_with_mass(M, K);
  std::vector<ShapeAtRest> all;
  for (Eigen::Index k = 0; k < modes.squares.size(); k += in_waves ? 2 : 1) {  // in waves all are double
    const Vector v = modes.V.col(k);
    const double stiffness = v.dot(K * v);
    if (!(stiffness > rigid_body * v.cwiseAbs().dot(K.cwiseAbs() * v.cwiseAbs()))) continue;
    const double mass = v.dot(M * v), omega = std::sqrt(stiffness / mass);
    ShapeAtRest& shape = all.emplace_back(ShapeAtRest{{omega}, v / std::sqrt(mass)});
    shape.mode.damping_ratio = damping_ratio(model, p, C, own, omega, shape.v);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.mode.omega < b.mode.omega; });
  if (!in_waves) tell_driven_by_frequency(all, lowest_forces(model, p), places_of_response(model));
  std::vector<ModeAtRest> reported;
  for (const ShapeAtRest& each : all) reported.push_back(each.mode);
  return reported;
}

std::optional<Eigen::MatrixXd> stiffness_at_rest(const model::Model& model, const Vector& p,
                                                 Contacts contacts) {
  if (model.sector) return {};
  Eigen::MatrixXd K = model::sum_of(model, LinearKind::spring, p);
  K = 0.5 * (K + K.transpose()).eval();
  if (!add_tangents(model, p, contacts, rigid_link * K.cwiseAbs().maxCoeff(), 0, K)) return {};
  return K;
}

}  // namespace arcslip::observables
