#pragma once
// The option "offset" of elements with sliders (slider_offset.hpp).

#include <arcslip/elements/slider_offset.hpp>
#include <arcslip/scene/study_keys.hpp>

#include <array>

namespace arcslip::elements {

struct OffsetOption {
  Offset offset = Offset::centred;
  friend bool operator==(const OffsetOption&, const OffsetOption&) = default;
};

inline scene::file::KeysOf<OffsetOption> offset_option() {
  static constexpr std::array<scene::file::Word<Offset>, 2> words = {
      {{"centred", Offset::centred}, {"static", Offset::static_loads}}};
  scene::file::KeysOf<OffsetOption> keys;
  keys.add(
      scene::file::word("offset", &OffsetOption::offset, words,
                        "of a slider that sticks throughout the period: between its bounds, without a mean "
                        "force, or as near to its place without force as they allow, so that it holds one"));
  return keys;
}

inline Offset offset_of(const scene::Settings& options) {
  return options.empty() ? Offset::centred : options.as<OffsetOption>().offset;
}

}  // namespace arcslip::elements
