#pragma once
// A kind of study: its keys in a scene file and its computation. Kinds and laws of force are listed in a
// Catalogue, which is passed to the reader of a scene; reader, writer and command depend on no specific kind.

#include <arcslip/control/progress.hpp>
#include <arcslip/results/figure.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace arcslip::scene {

/// A parameter that a study itself sets, and how: `which the study is "over"`.
struct ParameterUse {
  std::string parameter, how;
};

/// Options for the extent of the results.
struct RunOptions {
  bool points = true;         // false: only events and facts, no rows of points and histories
  bool coefficients = false;  // points and events with the Fourier coefficients a_n, b_n of the response
  bool figures = false;
  results::ProgressCallback progress{};  // false stops; the results so far are kept
  // For combinations of for_each, or load cases of one optimum, that are computed at the same time; where
  // there are fewer of these, for the elements of each response. Results are those of one thread. progress is
  // then called by several threads, one at a time.
  int threads = 1;
};

class StudyType {
 public:
  virtual ~StudyType() = default;

  virtual std::string_view name() const = 0;  // "frf", as a scene file writes it
  virtual std::string_view verb() const { return name(); }
  virtual std::string_view help() const = 0;  // one line

  /// The keys between "kind" and "for_each", in the order of a file.
  virtual std::vector<Key> keys() const = 0;
  virtual Settings defaults() const = 0;
  virtual Settings read(const file::Reading& from) const = 0;
  /// Files named by the settings.
  virtual std::vector<NamedFile*> files(Settings&) const { return {}; }
  virtual void write(const Settings& settings, const Scene& scene, std::vector<file::Member>& to) const = 0;

  virtual std::vector<ParameterUse> taken(const Settings& settings) const = 0;
  /// Removes a parameter from lists of values; the continuation parameter cannot be removed.
  virtual void drop(std::string_view parameter, Settings& settings) const = 0;

  /// The structure of all results of the study.
  virtual results::Schema schema(const Scene& scene, const Study& study, const RunOptions& options) const = 0;
  /// Whether RunOptions::coefficients changes the results.
  virtual bool takes_coefficients() const = 0;
  /// Passes the results to the sink as they are computed, with the index of their schema in the sink: one
  /// after the other for each combination of the study's for_each lists, each independent of the others.
  /// Returns the requested figures, each with a unique name; a figure may be empty.
  virtual std::vector<results::FigureData> run(const Scene& scene, const Study& study,
                                               const RunOptions& options, std::size_t schema,
                                               results::Sink& sink) const = 0;
};

/// The laws of force of the section "elements" and the kinds of studies known to a reader. They must outlive
/// every scene.
struct Catalogue {
  std::vector<const PartType*> elements;
  std::vector<const StudyType*> studies;

  /// The law or the kind with that name, or null.
  const PartType* element(std::string_view name) const;
  const StudyType* study(std::string_view name) const;
};

}  // namespace arcslip::scene
