#pragma once
// Rings of equal sectors, "structure": {"cyclic": {"sectors": 24, "engine_order": 3}, ...}: one sector in the
// wave of its engine order, or all of them with "full": true.

#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/keys/read_values.hpp>
#include <arcslip/scene/named_file.hpp>

#include <optional>

namespace arcslip::scene::file {

inline constexpr int least_sectors = 2, largest_sectors = 10'000;

/// "cyclic" of one sector.
std::optional<Cyclic> read_cyclic(const Location& place, Faults& faults);

/// A full ring; 0 sectors: none.
struct Ring {
  int sectors = 0;
};

/// Of a scene with "full": true, writes out all sectors, as entries with "repeat" (repeat.hpp) over an index
/// "sector" would be: the names of degrees of freedom, parts and named responses get the number of their
/// sector, {"next": name} is the name in the sector after it, and excitation is delayed by the engine order
/// times its harmonic. Matrices from files get as many "copies", and shapes one of them. A single response is
/// that of sector 1. "mistuning": {"part.field": [one factor for each sector]} multiplies the values
/// (mistuning.hpp). Origins are those of repeated entries, before and afterwards. Adds
/// faults, after which the tree is not complete.
Ring write_out_ring(Node& scene, const FileSource& source, Origins& origins, Faults& faults);

/// Each field "part.field" of a sector is one parameter for all sectors: a tie of this name, unless another
/// tie has it or values differ.
void tie_sectors(const Ring& ring, Scene& scene);

}  // namespace arcslip::scene::file
