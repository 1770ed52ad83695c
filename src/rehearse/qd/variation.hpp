#pragma once

#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/qd/archive.hpp"

namespace rehearse::qd {

/// The variation of elites drawn at random into a new solution.
struct Variation {
  enum class Kind {
    iso_line,  // x_i + σ_iso N(0, I) + σ_line (x_j − x_i) N(0, 1)  (Vassiliades 2018, "Discovering the elite
               // hypervolume", eq. 1)
    gaussian,  // x_i + σ_iso N(0, I)  (Mouret 2015)
    reset,     // each parameter of x_i is drawn anew with probability reset_rate, on a lattice (Cully 2015)
  };
  Kind kind = Kind::iso_line;
  double iso_sigma = 0.01;  // of the width of the box; where there is none, of 1. Vassiliades 2018
  double line_sigma = 0.2;  // Vassiliades 2018
  double reset_rate = 0.05;
  double lattice = 0.05;  // step of the lattice, of the width of the box; 0: no lattice. Cully 2015
  void fields(FieldVisitor& v);
};

/// Makes solutions, each from random numbers of its own: the same one by one, in chunks or on several threads.
class Varier {
 public:
  /// box: of each parameter, or empty: none. reset needs one.
  Varier(Variation variation, std::vector<Interval> box, Index parameters, StreamKey key);

  /// Solutions number first, first + 1, … into X (n × P): uniform in the box, or on its lattice. It needs a box.
  void draw(std::uint64_t first, MatrixView X) const;
  /// Draws solutions from N(start, σ_iso²), in the box.
  void draw_about(const Vector& start, std::uint64_t first, MatrixView X) const;
  /// The same as `draw`, but a `share` of them is N(one of the examples, (sigma · the box's width)²), in the box.
  /// examples: k × P.
  void draw_near(const Matrix& examples, double share, double sigma, std::uint64_t first, MatrixView X) const;
  /// Varies elites of the archive, of which there is at least one. No allocation after a thread's first call.
  void vary(const Archive& archive, std::uint64_t first, MatrixView X) const;

 private:
  void add_normals(const Archive& archive, std::uint64_t first, bool line, MatrixView X) const;
  void reset(const Archive& archive, std::uint64_t first, MatrixView X) const;
  double lattice_point(Index parameter, Rng& rng) const;
  void clip(MatrixView X) const;
  Rng rng(Purpose purpose, std::uint64_t solution) const;
  Matrix& normals(std::uint64_t first, Index rows, Index columns) const;

  Variation variation_;
  std::vector<Interval> box_;
  Vector iso_;  // P, σ_iso in the parameters' units
  StreamKey key_;
};

}  // namespace rehearse::qd
