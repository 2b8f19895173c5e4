#include <arcslip/model/placed_matrices.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/model/matrix_placement.hpp>

namespace arcslip::model {

PlacedMatrices place_matrices(const scene::Scene& scene, const control::Control& control) {
  const scene::Matrices& sector = *scene.matrices;
  if (sector.faces.empty()) return CopiesOfStructure(scene, sector, control).place();
  if (sector.copies == 1) return SectorInWaves(scene, sector, control).place();
  const auto ring =
      sector.derived->get<scene::Matrices>(ring_key(sector), [&] { return structure::closed_ring(sector); });
  return CopiesOfStructure(scene, *ring, control).place();
}

}  // namespace arcslip::model
