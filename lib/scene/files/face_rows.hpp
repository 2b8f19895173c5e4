#pragma once
// The CSV file with the rows of a sector on its two faces: the header "own,next", then on each line a row of
// the one face and the row of the other face that is this row of the next sector, from 1 on. Empty lines and
// those that begin with # are left out.

#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/keys/read_values.hpp>
#include <arcslip/scene/matrices.hpp>

namespace arcslip::scene::file {

/// Adds the pairs to matrices, whose size is known. Faults stand at the key that names the file.
void read_face_rows(const Location& at, const NamedFile& file, Matrices& matrices, Faults& faults);

}  // namespace arcslip::scene::file
