#pragma once
// Description of the results of a study: their structure, and the conversion of an item to a result.

#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <functional>
#include <span>

namespace arcslip::studies {

template <class Item>
struct Described {
  results::Schema schema;
  std::function<results::Result(const Item&)> result;  // of the schema 0; refers to the scene
};

/// The results of several items.
template <class Item>
results::Results collected(const scene::Scene& scene, const Described<Item>& described,
                           std::span<const Item> items) {
  results::Results all{header(scene), {described.schema}, {}};
  for (const Item& item : items) {
    add_columns(scene, item.set, all.schemas.front().set);
    all.results.push_back(described.result(item));
  }
  return all;
}

}  // namespace arcslip::studies
