#include <arcslip/model/cyclic_waves.hpp>

#include <set>

namespace arcslip::observables {

std::vector<int> diameters(const model::Sector& sector) {
  std::set<int> all;
  for (int order = 0; order < sector.count; ++order)
    if (const int diameter = sector.diameter(order); 2 * diameter <= sector.count) all.insert(diameter);
  return {all.begin(), all.end()};
}

std::complex<double> turn(const model::Sector& sector, int diameter) {
  return model::Sector{sector.count, diameter}.turn(1);
}

void add_complex(double factor, const Eigen::MatrixXcd& A, Eigen::MatrixXd& sum) {
  const Eigen::Index n = A.rows();
  sum.topLeftCorner(n, n) += factor * A.real();
  sum.bottomRightCorner(n, n) += factor * A.real();
  sum.topRightCorner(n, n) -= factor * A.imag();
  sum.bottomLeftCorner(n, n) += factor * A.imag();
}

Eigen::MatrixXd sum_in_wave(const model::Model& model, model::LinearKind kind, const continuation::Vector& p,
                            int diameter) {
  const Eigen::Index n = model.dofs;
  const std::complex<double> t = turn(*model.sector, diameter);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  const auto& parts = kind == model::LinearKind::mass     ? model.masses
                      : kind == model::LinearKind::damper ? model.dampers
                                                          : model.springs;
  if (kind != model::LinearKind::circulatory)
    for (const model::LinearPart& part : parts)
      model::add_outer(part.number.value(p), part.direction, part.next, t, sum);
  for (const model::MatrixPart& part : model.matrices) {
    if (part.kind != kind) continue;
    if (part.waves)
      add_complex(part.value(p), part.waves->of(diameter), sum);
    else
      add_complex(part.value(p), part.A->cast<std::complex<double>>(), sum);
  }
  return sum;
}

}  // namespace arcslip::observables
