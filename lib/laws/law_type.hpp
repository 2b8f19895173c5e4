#pragma once
// Laws of force as types of a scene's elements. A law of one's own is one class in one pair of files:
//
//   class Hardening final : public elements::PlainLaw { ... };
//   scene::Catalogue catalogue = studies::catalogue();
//   catalogue.elements.push_back(std::make_shared<Hardening>());
//   const auto scene = scene::read_file("scene.json", catalogue);

#include <arcslip/laws/law.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>

#include <memory>

namespace arcslip::elements {

/// The type of a law in a scene file.
class LawType : public scene::PartType {
 public:
  /// The law with these options.
  virtual std::shared_ptr<const Law> law(const scene::Settings& options) const = 0;
  bool has_wear(const scene::Settings& options) const override;
};

/// A law without options is its own type, and so is one whose options have their defaults. It must outlive
/// all scenes and models that use it.
class PlainLaw : public LawType, public Law {
 public:
  int directions() const final { return static_cast<int>(direction_count()); }
  std::shared_ptr<const Law> law(const scene::Settings&) const override {
    return {std::shared_ptr<const void>(), this};
  }
};

/// The law of an element of a scene. Throws std::invalid_argument if its type is not a law.
std::shared_ptr<const Law> law_of(const scene::Part& part);

}  // namespace arcslip::elements
