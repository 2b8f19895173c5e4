#pragma once
// A kind of study: what its settings are called in a scene file, and what it computes. Kinds stand in a
// Catalogue, as laws of force do, which whoever reads a scene passes; the reader, the writer and the command
// know none by name.

#include <arcslip/results/figure.hpp>
#include <arcslip/results/progress.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace arcslip::scene {

/// A parameter to which a study itself gives values, and how: `which the study is "over"`.
struct Taken {
  std::string parameter, how;
};

/// How much of its results a study is to give.
struct RunOptions {
  bool points = true;         // false: for who sees only events and facts, no rows of points and of histories
  bool coefficients = false;  // points and events with the harmonics of the response: a_n, b_n
  bool figures = false;
  results::ProgressCallback progress{};  // false stops: what is computed so far is kept
};

class StudyType {
 public:
  virtual ~StudyType() = default;

  virtual std::string_view name() const = 0;  // "frf", as a scene file writes it
  virtual std::string_view verb() const { return name(); }
  virtual std::string_view help() const = 0;  // one line

  /// Those between "kind" and "for_each", in the order of a file.
  virtual std::vector<Key> keys() const = 0;
  virtual Settings defaults() const = 0;
  virtual Settings read(const file::Reading& from) const = 0;
  /// Files that the settings name.
  virtual std::vector<NamedFile*> files(Settings&) const { return {}; }
  virtual void write(const Settings& settings, const Scene& scene, file::Node::Object& to) const = 0;

  virtual std::vector<Taken> taken(const Settings& settings) const = 0;
  /// Takes a parameter from lists of values; from what the study is over it cannot be taken.
  virtual void drop(std::string_view parameter, Settings& settings) const = 0;

  /// What all results of the study look like.
  virtual results::Schema schema(const Scene& scene, const Study& study, const RunOptions& options) const = 0;
  /// Whether RunOptions::coefficients changes the results.
  virtual bool takes_coefficients() const = 0;
  /// Hands the results to the sink as they are there, as of the schema with this index, which the sink knows:
  /// one after the other for each combination of the study's for_each lists, each as if it stood alone.
  /// Returns the figures that were asked for, each with a name of its own; with one there may be nothing on
  /// it.
  virtual std::vector<results::FigureData> run(const Scene& scene, const Study& study,
                                               const RunOptions& options, std::size_t schema,
                                               results::Sink& sink) const = 0;
};

/// What a reader knows: the laws of force of the section "elements", and the kinds of studies. They outlive
/// every scene.
struct Catalogue {
  std::vector<const PartType*> elements;
  std::vector<const StudyType*> studies;

  /// The law or the kind of that name, or null.
  const PartType* element(std::string_view name) const;
  const StudyType* study(std::string_view name) const;
};

}  // namespace arcslip::scene
