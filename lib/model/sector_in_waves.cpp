// One sector in the waves of its ring.

#include <arcslip/model/matrix_placement.hpp>

#include <algorithm>
#include <complex>

namespace arcslip::model {

using Eigen::MatrixXcd, Eigen::MatrixXd, Eigen::VectorXcd;

void SectorInWaves::make() {
  const int count = scene_.cyclic->sectors;
  waves_.resize(static_cast<std::size_t>(count) / 2 + 1);
  Index size = kept_;
  for (int n = 0; n < count; ++n) {
    const int diameter = wave_of(n).diameter;
    auto& in = waves_[static_cast<std::size_t>(diameter)];
    if (in) continue;
    in = wave({diameter, count});
    size = std::max(size, in->size());
  }
  set_copies({size});
  for (const auto& in : waves_)
    if (in) tell_error(in->size(), in->error, in->free_below);
}

SectorInWaves::Harmonic SectorInWaves::wave_of(int n) const {
  const int count = scene_.cyclic->sectors;
  const auto order = static_cast<int>(static_cast<long long>(n) * scene_.cyclic->engine_order % count);
  const int diameter = order < 0 ? order + count : order;
  return 2 * diameter > count ? Harmonic{count - diameter, true} : Harmonic{diameter, false};
}

// The loads that have the diameter of a wave.
std::vector<std::size_t> SectorInWaves::loads_in(int diameter) const {
  std::vector<std::size_t> all;
  for (std::size_t s = 0; s < placed_.shapes.size(); ++s)
    if (wave_of(scene_.excitation[placed_.shapes[s].excitation].harmonic).diameter == diameter &&
        std::find(all.begin(), all.end(), load_of_[s]) == all.end())
      all.push_back(load_of_[s]);
  return all;
}

std::shared_ptr<const WaveStructure> SectorInWaves::wave(const structure::Wave& in) const {
  const auto [purpose_of, key] = purpose(loads_in(in.diameter));
  if (!reduces_)
    return std::make_shared<const WaveStructure>(structure::whole_wave(files_, in, rows_, purpose_of.loads));
  return files_.derived->get<WaveStructure>(
      key + "in the wave " + std::to_string(in.diameter) + "/" + std::to_string(in.count),
      [&] { return structure::reduce_wave(files_, in, rows_, purpose_of, control_); });
}

// Coordinates that a wave has not are next to it, with a stiffness of their own.
bool SectorInWaves::add(LinearKind kind, const Which& which) {
  const auto dofs = static_cast<Index>(placed_.dof_names.size());
  std::vector<MatrixXcd> of_diameter(waves_.size());
  for (std::size_t d = 0; d < waves_.size(); ++d) {
    if (!waves_[d]) continue;
    const MatrixXcd& block = (*waves_[d]).*which.in_wave;
    if (block.size() == 0) return false;
    MatrixXcd& A = of_diameter[d];
    A.setZero(dofs, dofs);
    A.topLeftCorner(block.rows(), block.cols()) = block;
    if (which.in_wave == &WaveStructure::K)
      A.diagonal().segment(block.rows(), placed_.unnamed_to - block.rows()).setOnes();
  }
  placed_.parts.push_back({kind, -1, std::make_shared<const MatrixXd>(of_diameter.front().real())});
  placed_.parts.back().waves =
      std::make_shared<const WaveMatrices>(scene_.cyclic->sectors, std::move(of_diameter));
  return true;
}

// T^H f in the wave of its harmonic: complex, and of each excitation once.
void SectorInWaves::place_shapes() {
  const auto dofs = static_cast<Index>(placed_.dof_names.size());
  std::vector<PlacedShape> all;
  for (std::size_t i = 0; i < scene_.excitation.size(); ++i) {
    VectorXcd sum = VectorXcd::Zero(dofs);
    bool any = false;
    const Harmonic harmonic = wave_of(scene_.excitation[i].harmonic);
    const std::vector<std::size_t> known = loads_in(harmonic.diameter);
    for (std::size_t s = 0; s < placed_.shapes.size(); ++s) {
      if (placed_.shapes[s].excitation != i) continue;
      const auto k = std::find(known.begin(), known.end(), load_of_[s]) - known.begin();
      const MatrixXcd& loads = waves_[static_cast<std::size_t>(harmonic.diameter)]->loads;
      VectorXcd load = loads.col(k);
      if (harmonic.backwards) load = load.conjugate().eval();
      sum.head(load.size()) += (placed_.shapes[s].imaginary ? std::complex<double>(0, 1) : 1.0) * load;
      any = true;
    }
    if (!any) continue;
    all.push_back({i, false, sum.real(), {}});
    if (!sum.imag().isZero(0)) all.push_back({i, true, sum.imag(), {}});
  }
  placed_.shapes = std::move(all);
}

}  // namespace arcslip::model
