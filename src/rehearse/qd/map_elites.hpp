#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/qd/archive.hpp"
#include "rehearse/qd/variation.hpp"

namespace rehearse::qd {

struct MapElitesOptions {
  Index batch = 512;            // solutions of a generation, made from the same archive
  Index initial = 1024;         // solutions drawn at random first
  double examples = 0.5;        // share of these that are near an example, where there is one
  double example_sigma = 0.15;  // and how near, in widths of the box
  Variation variation;
  void fields(FieldVisitor& v);
};

/// The space of solutions: a box, in which the first are uniform unless there is a start or there are examples; or
/// unbounded about a start.
struct SearchSpace {
  std::vector<Interval> box;    // P, or empty
  std::optional<Vector> start;  // P: the first solutions are N(start, σ_iso²)
  Matrix examples;              // k × P, or empty: solutions known to do something sensible
};

/// Performances (n, higher is better) and descriptors (n × D) of solutions X (n × P), the first of which has number
/// `first` among all that were ever made. Results that are not finite count as failed and are never kept. Called from
/// several threads at once; a row must depend on itself and its number alone. Views are written.
using Evaluate =
    std::function<void(const ConstMatrixView& X, std::uint64_t first, VectorView performances, MatrixView descriptors)>;

/// MAP-Elites (Mouret 2015): elites drawn uniformly, varied, evaluated, kept where they are the best of their niche.
///
/// All random numbers are keyed by the number of the solution that they make: the archive and two counts are the
/// whole state of a search, and results are the same for any number of threads and whether `step` or `ask` and `tell`
/// are used. A generation that is interrupted leaves no trace.
class MapElites {
 public:
  /// Throws InvalidInput with every violation. key: names the stream, its purpose is ignored.
  MapElites(Archive archive, SearchSpace space, MapElitesOptions options, StreamKey key);

  /// Goes on from a state that was kept: an archive after so many evaluations.
  void resume(Archive archive, std::uint64_t evaluations, std::uint64_t failed);

  /// One generation, spread over the evaluator in chunks of a fixed size.
  void step(const Evaluate& evaluate, const Evaluator& evaluator);

  /// One generation by hand: `ask` gives solutions (batch × P), `tell` takes their results. `ask` is idempotent.
  const Matrix& ask();
  void tell(const ConstVectorView& performances, const ConstMatrixView& descriptors);  // batch; batch × D

  const Archive& archive() const { return archive_; }
  std::uint64_t evaluations() const { return evaluations_; }
  std::uint64_t failed() const { return failed_; }

 private:
  void make(std::uint64_t first, MatrixView X) const;
  void keep(double performance, const double* descriptor, Index niche, const double* solution, Index stride);

  Archive archive_;
  SearchSpace space_;
  MapElitesOptions options_;
  Varier varier_;
  std::uint64_t evaluations_ = 0, failed_ = 0;
  Matrix chunks_;  // of `step`: a column is a chunk's solutions, descriptors, performances and niches
  Matrix asked_;   // of `ask`
};

}  // namespace rehearse::qd
