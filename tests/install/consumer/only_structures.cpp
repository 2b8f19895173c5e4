#include <arcslip/scene/scene.hpp>

int main() {
  return arcslip::scene::unit_name(arcslip::scene::FrequencyUnit::hertz) == "Hz" ? 0 : 1;
}
