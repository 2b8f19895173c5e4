#include <arcslip/scene/combinations.hpp>

#include <algorithm>
#include <limits>

namespace arcslip::scene {

Combinations::Combinations(const Study& study) : Combinations(study.for_each, study.in_rows) {
  if (study.samples.count == 0) return;
  plan_ = &study.samples;
  sampler_.emplace(study.samples);
}

double Combinations::count() const {
  if (plan_ != nullptr) return static_cast<double>(plan_->count);
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
  if (plan_ != nullptr) {
    const std::vector<double> values = (*sampler_)(index);
    for (std::size_t k = 0; k < values.size(); ++k)
      setting.emplace_back(plan_->parameters[k].first, values[k]);
    return setting;
  }
  for (auto list = lists_.rbegin(); list != lists_.rend(); ++list) {
    const auto& [parameter, values] = *list;
    setting.emplace_back(parameter, values[index % values.size()]);
    if (!in_rows_) index /= values.size();
  }
  std::reverse(setting.begin(), setting.end());
  return setting;
}

std::vector<std::string> varied_parameters(const Study& study) {
  std::vector<std::string> names;
  for (const auto& [parameter, values] : study.for_each) names.push_back(parameter);
  for (const auto& [parameter, distribution] : study.samples.parameters) names.push_back(parameter);
  return names;
}

}  // namespace arcslip::scene
