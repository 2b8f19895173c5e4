// Belongs to arcslip::structures; arcslip::continuation knows nothing of it.
#include <arcslip/scene/scene.hpp>

int main() {
  return static_cast<int>(arcslip::scene::FrequencyUnit::hertz);
}
