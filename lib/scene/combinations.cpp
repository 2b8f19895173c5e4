#include <arcslip/scene/combinations.hpp>

#include <algorithm>
#include <limits>

namespace arcslip::scene {

double Combinations::count() const {
  if (in_rows_ && !lists_.empty()) return static_cast<double>(lists_.front().second.size());
  double product = 1;
  for (const auto& [parameter, values] : lists_) product *= static_cast<double>(values.size());
  return product;
}

std::size_t Combinations::size() const {
  return static_cast<std::size_t>(std::min<double>(count(), std::numeric_limits<int>::max()));
}

Setting Combinations::operator[](std::size_t index) const {
  Setting setting;
  for (auto list = lists_.rbegin(); list != lists_.rend(); ++list) {
    const auto& [parameter, values] = *list;
    setting.emplace_back(parameter, values[index % values.size()]);
    if (!in_rows_) index /= values.size();
  }
  std::reverse(setting.begin(), setting.end());
  return setting;
}

}  // namespace arcslip::scene
