#include <arcslip/model/placed_matrices.hpp>

#include <arcslip/model/matrix_placement.hpp>

namespace arcslip::model {

PlacedMatrices place_matrices(const scene::Scene& scene, const scene::StopRequest& stop) {
  const scene::Matrices& sector = *scene.matrices;
  if (sector.faces.empty()) return CopiesOfStructure(scene, sector, stop).place();
  if (sector.copies == 1) return SectorInWaves(scene, sector, stop).place();
  const auto ring =
      sector.derived->get<scene::Matrices>(ring_key(sector), [&] { return structure::closed_ring(sector); });
  return CopiesOfStructure(scene, *ring, stop).place();
}

}  // namespace arcslip::model
