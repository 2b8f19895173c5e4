#include <arcslip/hbm/linear/fixed_interface.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/hbm/linear/sparsity_pattern.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace arcslip::hbm {
namespace {

constexpr Eigen::Index too_few = 1;     // linear coordinates
constexpr Eigen::Index too_many = 500;  // of them: sparse factors cost less than modes, where there are any
constexpr double proportional = 1e-12;  // entries of C next to its diagonal
constexpr double indefinite = 1e-9;     // a negative eigenvalue of M or K, relative to the largest

// In (q, l).
struct Blocks {
  Eigen::MatrixXd qq, lq, ll;
};
Blocks blocks(const Eigen::MatrixXd& A, const Eigen::MatrixXd& P, Eigen::Index r) {
  const Eigen::SparseMatrix<double> sparse = A.sparseView();
  const Eigen::MatrixXd AP = sparse * P;
  const auto Pq = P.leftCols(r), Pl = P.rightCols(P.cols() - r);
  Blocks in_y{Pq.transpose() * AP.leftCols(r), Pl.transpose() * AP.leftCols(r),
              Pl.transpose() * AP.rightCols(P.cols() - r)};
  in_y.ll = 0.5 * (in_y.ll + in_y.ll.transpose()).eval();
  return in_y;
}

// Not above x > 0: in units of it, modes have the same digits in all units of a scene that are powers of two.
double power_of_two(double x) {
  return x > 0 && std::isfinite(x) ? std::ldexp(1.0, std::ilogb(x)) : 1.0;
}

// Whether the dynamic stiffness has factors that cost far less than those of a dense matrix.
bool is_sparse(const model::Model& model) {
  if (!model.matrices.empty()) return false;
  SparsityPattern links(model.dofs);
  links.link_diagonal();
  for (const auto* parts : {&model.masses, &model.dampers, &model.springs})
    for (const model::LinearPart& part : *parts) {
      std::vector<Eigen::Index> linked;
      for (model::Direction::InnerIterator x(part.direction); x; ++x) linked.push_back(x.index());
      links.link_all(linked);
    }
  return sparse_is_cheaper(links.matrix());
}

}  // namespace

double ModalMatrix::form(const Eigen::VectorXcd& y) const {
  const Eigen::Index r = qq.rows(), l = ll.size();
  double sum = 0;
  for (Eigen::Index j = 0; j < l; ++j) {
    sum += ll[j] * std::norm(y[r + j]);
    for (Eigen::Index k = 0; k < r; ++k) sum += 2 * lq(j, k) * std::real(std::conj(y[r + j]) * y[k]);
  }
  for (Eigen::Index k = 0; k < r; ++k)
    for (Eigen::Index i = 0; i < r; ++i) sum += qq(i, k) * std::real(std::conj(y[i]) * y[k]);
  return sum;
}

// With B = K + s^2 M definite, which it is for floating and for massless coordinates as well: M v = mu B v,
// and in its modes, times the unit of B, M is mu and K is 1 - s^2 mu.
std::shared_ptr<const FixedInterfaceModes> fixed_interface_modes(const model::Model& model,
                                                                 const Eigen::MatrixXd& P, int unknowns,
                                                                 double frequency) {
  const Eigen::Index r = unknowns, l = P.cols() - r;
  if (l <= too_few || (l > too_many && is_sparse(model))) return {};
  auto modes = std::make_shared<FixedInterfaceModes>();
  modes->p = model::defaults(model);
  const auto& p = modes->p;
  const auto negative = [&](const model::LinearPart& part) { return !(part.number.value(p) >= 0); };
  for (const auto* parts : {&model.masses, &model.dampers, &model.springs})
    if (std::any_of(parts->begin(), parts->end(), negative)) return {};
  const auto in_y = [&](model::LinearKind kind) { return blocks(model::sum_of(model, kind, p), P, r); };
  const Blocks M = in_y(model::LinearKind::mass), C = in_y(model::LinearKind::damper),
               K = in_y(model::LinearKind::spring);
  const double shift = frequency * frequency;
  const Eigen::MatrixXd B = K.ll + shift * M.ll;
  const double unit = power_of_two(B.cwiseAbs().maxCoeff());
  const auto [mu, V] = continuation::symmetric_modes(M.ll / unit, B / unit);
  if (mu.size() == 0 || !mu.allFinite() || !V.allFinite()) return {};
  if (mu.minCoeff() < -indefinite * mu.maxCoeff() || shift * mu.maxCoeff() > 1 + indefinite) return {};
  modes->M = {M.qq, V.transpose() * M.lq, unit * mu.cwiseMax(0.0)};
  modes->K = {K.qq, V.transpose() * K.lq, unit * (1 - shift * mu.array().max(0.0)).max(0.0).matrix()};
  modes->C = {C.qq, V.transpose() * C.lq, {}};
  Eigen::MatrixXd damping = V.transpose() * C.ll * V;
  modes->C.ll = damping.diagonal();
  damping.diagonal().setZero();
  modes->damped = damping.cwiseAbs().maxCoeff() <= proportional * modes->C.ll.cwiseAbs().maxCoeff();
  if (!modes->damped) {
    const auto dampers = std::count_if(model.dampers.begin(), model.dampers.end(),
                                       [&](const auto& part) { return part.number.value(p) > 0; });
    const bool matrices = std::any_of(model.matrices.begin(), model.matrices.end(), [](const auto& part) {
      return part.kind == model::LinearKind::damper;
    });
    if (matrices || dampers > std::min<Eigen::Index>(most_changes, l / 2)) return {};
    modes->C.qq.setZero();
    modes->C.lq.setZero();
    modes->C.ll.setZero();
  }
  modes->of_linear = V;
  return modes;
}

}  // namespace arcslip::hbm
