#pragma once
// The option "offset" of elements with sliders (slider_offset.hpp).

#include <arcslip/laws/slider_offset.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <array>
#include <string>
#include <utility>

namespace arcslip::elements {

struct OffsetOption {
  Offset offset = Offset::centred;
  friend bool operator==(const OffsetOption&, const OffsetOption&) = default;
};

inline scene::file::KeysOf<OffsetOption> offset_option() {
  static constexpr std::array<scene::file::Word<Offset>, 2> words = {
      {{"centred", Offset::centred}, {"static", Offset::static_loads}}};
  scene::file::KeysOf<OffsetOption> keys;
  keys.add(scene::file::word("offset", &OffsetOption::offset, words,
                             "where a slider that never slips rests: midway between its limits, without a "
                             "mean force, or as close as possible to its force-free position, with one"));
  return keys;
}

/// The same key of a law that has the centred offset alone. without: why there is no other, and what to do
/// instead.
template <class Options>
scene::file::KeyGroup<Options> centred_offset(std::string help, std::string without) {
  scene::Key key{"offset", scene::KeyType::word, "", "\"centred\"", "\"centred\"", false, std::move(help)};
  key.words = {"centred"};
  const auto read = [without = std::move(without)](const scene::file::Reading& reading, Options&) {
    const scene::file::Location place = reading.keys.find("offset");
    const auto* word = place.node != nullptr ? place.node->template get<std::string>() : nullptr;
    if (place.node != nullptr && (word == nullptr || *word != "centred"))
      reading.faults.add(place.pointer, "found another offset than \"centred\", " + without);
  };
  const auto write = [](const Options&, const scene::Scene&, scene::file::Node::Object&) {};
  return {{key}, read, write};
}

inline Offset offset_of(const scene::Settings& options) {
  return options.empty() ? Offset::centred : options.as<OffsetOption>().offset;
}

}  // namespace arcslip::elements
