#include <arcslip/scene/keys/section_keys.hpp>
#include <arcslip/scene/rotation.hpp>

namespace arcslip::scene {
namespace {

constexpr Field speed{
    .name = "speed", .unit = "rad/s", .lower = 0, .upper = infinity, .help = "speed of rotation"};
constexpr Field any_speed[] = {speed};
constexpr Field highest_speed{
    .name = "highest_speed", .unit = "rad/s", .lower = 0, .upper = infinity, .lower_open = true};
constexpr Field engine_order{
    .name = "engine_order", .unit = "-", .lower = 0, .upper = infinity, .lower_open = true};

file::KeysOf<Rotation> keys() {
  file::KeysOf<Rotation> all;
  all.add(file::optional(&Rotation::highest_speed,
                         file::number(&Rotation::highest_speed, highest_speed,
                                      "up to which the structure is reduced: the upper bound of the speed")));
  all.add(
      file::optional(&Rotation::engine_order,
                     file::number(&Rotation::engine_order, engine_order,
                                  "in place of a speed: excitation frequency over the speed of rotation")));
  all.check([](const file::Reading&, Rotation& rotation) {
    if (rotation.engine_order > 0) return;
    rotation.fields = {speed};
    if (rotation.highest_speed > 0) rotation.fields.front().upper = rotation.highest_speed;
  });
  return all;
}

class RotationType final : public file::KeyedPart<Rotation, PartType> {
 public:
  RotationType() : KeyedPart(keys()) {}
  std::string_view name() const override { return "rotation"; }
  std::string_view help() const override { return "speed of C + speed G and K + speed N + speed^2 K2"; }
  bool names_directions() const override { return true; }
  std::span<const Field> fields(const Settings& options) const override {
    if (options.empty()) return any_speed;
    return options.as<Rotation>().fields;
  }
};

}  // namespace

const PartType& rotation_type() {
  static const RotationType type;
  return type;
}

}  // namespace arcslip::scene
