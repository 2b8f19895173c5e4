#include <arcslip/continuation/problem/choices.hpp>

#include <algorithm>

namespace arcslip::continuation {

void Choices::anew() {
  made_.clear();
  calls_ = 0;
  kept_ = false;
}

void Choices::keep() {
  calls_ = 0;
  kept_ = true;
}

// A call that was not made before, or that was another one, goes by the numbers.
std::size_t Choices::choose(std::size_t by_numbers, std::size_t options) {
  const std::size_t call = calls_++;
  if (!kept_) made_.push_back(by_numbers);
  return kept_ && call < made_.size() && made_[call] < options ? made_[call] : by_numbers;
}

double Choices::max(double a, double b) {
  return choose(b > a, 2) ? b : a;
}

double Choices::min(double a, double b) {
  return choose(b < a, 2) ? b : a;
}

double Choices::abs(double x) {
  return choose(x < 0, 2) ? -x : x;
}

double Choices::positive(double x) {
  return choose(x < 0, 2) ? 0 : x;
}

double Choices::clamp(double x, double lower, double upper) {
  const std::size_t at = choose(x < lower ? 1 : x > upper ? 2 : 0, 3);
  return at == 1 ? lower : at == 2 ? upper : x;
}

bool Choices::above(double x, double corner) {
  return choose(x >= corner, 2) != 0;
}

std::size_t Choices::part(double x, std::span<const double> corners) {
  const auto end = std::find_if(corners.begin(), corners.end(), [=](double at) { return !(x >= at); });
  return choose(static_cast<std::size_t>(end - corners.begin()), corners.size() + 1);
}

std::size_t Choices::part(double x, std::initializer_list<double> corners) {
  return part(x, std::span<const double>(corners.begin(), corners.size()));
}

// Each choice is mixed in by the finalizer of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t Choices::piece() const {
  std::uint64_t mixed = made_.size();
  for (const std::size_t choice : made_) {
    mixed += 0x9e3779b97f4a7c15u + choice;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
    mixed ^= mixed >> 31;
  }
  return mixed;
}

}  // namespace arcslip::continuation
