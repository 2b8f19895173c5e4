#pragma once
// Entries that stand for several over an index: {"repeat": 12, "name": "m{i}", "at": "blade{i}",
// "value": 1.24}.

#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/keys/json_tree.hpp>

namespace arcslip::scene::file {

inline constexpr int largest_repeat = 10'000;  // copies of one entry
inline constexpr int largest_engine_order = 1'000'000;

/// Puts in place of each entry of a scene with the key "repeat" its copies for i = 1 to count, in which
///   {i}, {i+k}, {i-k} in texts and names of keys  are these numbers; of a cyclic index modulo count, from 1;
///   {"each": [v1, v2, ...]}                       is the value of i in a list of count values;
///   "engine_order": m of an excitation            delays copy i by the phase 2 pi m (i - 1)/count: an
///   amplitude
///                                                 cosine + i sine of the first turns by it.
/// Entries are those of the lists of structure, elements, patches, excitation and response, and of each tie;
/// of degrees of freedom and ties, which are texts, the copy is its "name". The copies of all entries
/// together have at most largest_count values and largest_size bytes of text. Returns where the items of the
/// new lists stand in the file; adds faults, after which the tree is not complete.
Origins repeat(Node& scene, Faults& faults);

}  // namespace arcslip::scene::file
