#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/moments/moment_kernel.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/gp/correlation-inl.hpp"
#include "rehearse/moments/moment_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::moments {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace rehearse::gp::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): the vectors of its kernels

constexpr int kWidest = 8;  // partial sums of what is summed over points

/// Only the sums over rows, as a network with itself; those over columns too; or half of a symmetric matrix.
enum class PairKind { rows, columns, triangle };

HWY_INLINE V load(const double* p) { return hn::LoadU(kTag, p); }
HWY_INLINE void add_to(double* p, V value) { hn::StoreU(hn::Add(load(p), value), kTag, p); }

constexpr int kGroup = 4;  // points of b taken together: their long chains of dependent operations overlap

/// The exponentials of kGroup vectors at once, with short_exp's polynomial as even and odd powers, two chains half as
/// long.
HWY_INLINE void exponentials(V* x) {
  const V cut = constant(-80);
  V r[kGroup], square[kGroup], even[kGroup], odd[kGroup], shifted[kGroup];
  for (int g = 0; g < kGroup; ++g) {
    r[g] = reduce(hn::Max(x[g], cut), shifted[g]);
    square[g] = hn::Mul(r[g], r[g]);
    odd[g] = constant(kExpCoefficients[0]);
    even[g] = constant(kExpCoefficients[1]);
  }
  for (int i = 2; i < kExpDegree; i += 2)
    for (int g = 0; g < kGroup; ++g) {
      odd[g] = hn::MulAdd(odd[g], square[g], constant(kExpCoefficients[i]));
      even[g] = hn::MulAdd(even[g], square[g], constant(kExpCoefficients[i + 1]));
    }
  for (int g = 0; g < kGroup; ++g) {
    const V value = scale_by_power(hn::MulAdd(odd[g], r[g], even[g]), shifted[g]);
    x[g] = hn::IfThenElseZero(hn::Gt(x[g], cut), value);
  }
}

/// The loops for kD dimensions, or for any number where kD is 0.
template <int kD>
struct Loops {
  static constexpr int kSize = kD ? kD : static_cast<int>(kMostMomentInputs);
  static HWY_INLINE int dimensions(Index D) { return kD ? kD : static_cast<int>(D); }

  static HWY_INLINE void load_point(const WeightedPoints& a, int D, Index i, V* z) {
    for (int d = 0; d < D; ++d) z[d] = load(a.points + d * a.stride + i);
  }

  /// zᵀ P z
  static HWY_INLINE V quadratic(const V* z, int D, const double* P) {
    V total = hn::Zero(kTag);
    for (int d = 0; d < D; ++d) {
      V row = hn::Zero(kTag);
      for (int k = 0; k < D; ++k) row = hn::MulAdd(constant(P[d * D + k]), z[k], row);
      total = hn::MulAdd(row, z[d], total);
    }
    return total;
  }

  static HWY_INLINE void mean_correlations(const WeightedPoints& a, int D, const double* P, double factor, double* q) {
    V z[kSize];
    for (Index i = 0; i < a.stride; i += lanes()) {
      load_point(a, D, i, z);
      const V exponent = hn::Mul(quadratic(z, D, P), constant(-0.5));
      hn::StoreU(hn::Mul(small_exp(exponent), constant(factor)), kTag, q + i);
    }
  }

  /// Sums over points, eight partial ones each until the end.
  class Sums {
   public:
    HWY_INLINE explicit Sums(int D) : D_(D) { std::fill(memory_, memory_ + kWidest * (1 + D + D * D), 0.0); }

    /// Adds the points from i on, one a lane.
    HWY_INLINE void add(Index i, const V* z, V g, bool second) {
      const Index place = place_in_eight(i);
      add_to(memory_ + place, g);
      for (int d = 0; d < D_; ++d) {
        const V gz = hn::Mul(g, z[d]);
        add_to(first(d) + place, gz);
        if (!second) continue;
        for (int k = 0; k <= d; ++k) {
          double* entry = matrix(d, k) + place;
          hn::StoreU(hn::MulAdd(gz, z[k], load(entry)), kTag, entry);
        }
      }
    }
    HWY_INLINE void add_product(Index i, const V* z, const V* h) {  // of z hᵀ
      for (int d = 0; d < D_; ++d)
        for (int k = 0; k < D_; ++k) {
          double* entry = matrix(d, k) + place_in_eight(i);
          hn::StoreU(hn::MulAdd(z[d], h[k], load(entry)), kTag, entry);
        }
    }
    HWY_INLINE void give(PointSums& sums) const {
      sums.total = sum_of_eight(memory_);
      for (int d = 0; d < D_; ++d) sums.first[d] = sum_of_eight(first(d));
      if (!sums.second) return;
      for (int d = 0; d < D_; ++d)
        for (int k = 0; k <= d; ++k) sums.second[d * D_ + k] = sums.second[k * D_ + d] = sum_of_eight(matrix(d, k));
    }
    HWY_INLINE void give_product(double* cross) const {
      for (int d = 0; d < D_; ++d)
        for (int k = 0; k < D_; ++k) cross[k * D_ + d] = sum_of_eight(matrix(d, k));
    }

   private:
    HWY_INLINE double* first(int d) { return memory_ + kWidest * (1 + d); }
    HWY_INLINE const double* first(int d) const { return memory_ + kWidest * (1 + d); }
    HWY_INLINE double* matrix(int d, int k) { return memory_ + kWidest * (1 + D_ + d * D_ + k); }
    HWY_INLINE const double* matrix(int d, int k) const { return memory_ + kWidest * (1 + D_ + d * D_ + k); }

    double memory_[kWidest * (1 + kSize + kSize * kSize)];
    int D_;
  };

  static HWY_INLINE void point_sums(const WeightedPoints& a, int D, PointSums& out) {
    Sums sums(D);
    V z[kSize];
    for (Index i = 0; i < a.stride; i += lanes()) {
      load_point(a, D, i, z);
      sums.add(i, z, load(a.weights + i), out.second != nullptr);
    }
    sums.give(out);
  }

  /// z_jᵀ B z_j for all j.
  static HWY_INLINE void own_terms(const WeightedPoints& b, int D, const double* B, double* out) {
    V z[kSize];
    for (Index j = 0; j < b.stride; j += lanes()) {
      load_point(b, D, j, z);
      hn::StoreU(quadratic(z, D, B), kTag, out + j);
    }
  }

  /// The lanes are points of `a`; the points of `b` come one after the other.
  template <PairKind kKind>
  static HWY_INLINE void pair_sums(const WeightedPoints& a, const WeightedPoints& b, int D, const PairForm& form,
                                   const double* weights, PairSums& out, double* scratch) {
    // Copies, which no store through a pointer can change.
    const double *points = b.points, *weights_b = b.weights;
    const Index stride = b.stride, size = (b.size + kGroup - 1) / kGroup * kGroup;  // of the padding, weights are 0
    double* own = scratch;
    double* columns = scratch + stride;  // Σ_i of b's points, eight partial ones each
    own_terms(b, D, form.B, own);
    if (kKind != PairKind::rows) std::fill(columns, columns + kWidest * stride, 0.0);
    Sums sums(D), products(D);
    for (Index i = 0; i < a.stride; i += lanes()) {
      V z[kSize], slope[kSize], h[kSize + 1];
      load_point(a, D, i, z);
      const V start = quadratic(z, D, form.A), w = load(a.weights + i);
      for (int d = 0; d < D; ++d) {
        slope[d] = hn::Zero(kTag);
        for (int k = 0; k < D; ++k) slope[d] = hn::MulAdd(constant(form.C[d * D + k]), z[k], slope[d]);
      }
      for (int d = 0; d <= D; ++d) h[d] = hn::Zero(kTag);
      const Index end = kKind == PairKind::triangle ? std::min(size, i / kWidest * kWidest + kWidest) : size;
      for (Index j = 0; j < end; j += kGroup) {
        V G[kGroup];
        for (int g = 0; g < kGroup; ++g) G[g] = hn::Add(start, constant(own[j + g]));
        for (int d = 0; d < D; ++d)
          for (int g = 0; g < kGroup; ++g) G[g] = hn::MulAdd(slope[d], constant(points[d * stride + j + g]), G[g]);
        exponentials(G);
        for (int g = 0; g < kGroup; ++g) {
          double* column = columns + kWidest * (j + g) + place_in_eight(i);
          if (kKind == PairKind::columns) hn::StoreU(hn::MulAdd(G[g], w, load(column)), kTag, column);
          G[g] = hn::Mul(
              G[g], kKind == PairKind::triangle ? load(weights + (j + g) * a.stride + i) : constant(weights_b[j + g]));
          if (kKind == PairKind::triangle) add_to(column, G[g]);
          h[0] = hn::Add(h[0], G[g]);
          for (int d = 0; d < D; ++d) h[d + 1] = hn::MulAdd(G[g], constant(points[d * stride + j + g]), h[d + 1]);
        }
      }
      if (out.rows)
        for (int d = 0; d <= D; ++d) hn::StoreU(h[d], kTag, out.rows + d * a.stride + i);
      if (kKind != PairKind::triangle)
        for (int d = 0; d <= D; ++d) h[d] = hn::Mul(h[d], w);
      sums.add(i, z, h[0], true);
      products.add_product(i, z, h + 1);
    }
    sums.give(out.a);
    products.give_product(out.cross);
    if (kKind == PairKind::columns) give_columns(b, D, columns, own, out.b);
    if (kKind == PairKind::triangle) add_mirror(b, D, columns, own, out);
  }

  static HWY_INLINE void give_columns(const WeightedPoints& b, int D, const double* columns, double* total,
                                      PointSums& out) {
    std::fill(total, total + b.stride, 0.0);
    for (Index j = 0; j < b.size; ++j) total[j] = b.weights[j] * sum_of_eight(columns + kWidest * j);
    point_sums({b.points, total, b.size, b.stride}, D, out);
  }

  /// Adds the sums of the other triangle.
  static HWY_INLINE void add_mirror(const WeightedPoints& b, int D, const double* columns, double* total,
                                    PairSums& out) {
    double first[kSize], second[kSize * kSize];
    PointSums mirror{0, first, second};
    std::fill(total, total + b.stride, 0.0);
    for (Index j = 0; j < b.size; ++j) total[j] = sum_of_eight(columns + kWidest * j);
    point_sums({b.points, total, b.size, b.stride}, D, mirror);
    out.a.total += mirror.total;
    for (int d = 0; d < D; ++d) {
      out.a.first[d] += first[d];
      for (int k = 0; k < D; ++k) out.a.second[d * D + k] += second[d * D + k];
      for (int k = 0; k <= d; ++k)
        out.cross[d * D + k] = out.cross[k * D + d] = out.cross[d * D + k] + out.cross[k * D + d];
    }
  }
};

template <template <int> class Call, class... Arguments>
HWY_INLINE void dispatch(Index D, Arguments&&... arguments) {
  switch (D) {
    case 3:
      return Call<3>::run(arguments...);
    case 4:
      return Call<4>::run(arguments...);
    case 5:
      return Call<5>::run(arguments...);
    case 6:
      return Call<6>::run(arguments...);
    case 7:
      return Call<7>::run(arguments...);
    case 9:  // the pendubot with joint angles
      return Call<9>::run(arguments...);
    default:
      return Call<0>::run(arguments...);
  }
}

template <int kD>
struct MeanCall {
  static HWY_NOINLINE void run(const WeightedPoints& a, Index D, const double* P, double factor, double* q) {
    Loops<kD>::mean_correlations(a, Loops<kD>::dimensions(D), P, factor, q);
  }
};
template <int kD>
struct PointCall {
  static HWY_NOINLINE void run(const WeightedPoints& a, Index D, PointSums& sums) {
    Loops<kD>::point_sums(a, Loops<kD>::dimensions(D), sums);
  }
};
template <int kD>
struct PairCall {
  static HWY_NOINLINE void run(const WeightedPoints& a, const WeightedPoints& b, Index D, const PairForm& form,
                               const double* weights, PairSums& sums, double* scratch) {
    const int dimensions = Loops<kD>::dimensions(D);
    if (weights) {
      Loops<kD>::template pair_sums<PairKind::triangle>(a, b, dimensions, form, weights, sums, scratch);
    } else if (sums.b.first) {
      Loops<kD>::template pair_sums<PairKind::columns>(a, b, dimensions, form, weights, sums, scratch);
    } else {
      Loops<kD>::template pair_sums<PairKind::rows>(a, b, dimensions, form, weights, sums, scratch);
    }
  }
};

void MeanKernel(const WeightedPoints& a, Index D, const double* P, double factor, double* q) {
  dispatch<MeanCall>(D, a, D, P, factor, q);
}
void PointKernel(const WeightedPoints& a, Index D, PointSums& sums) { dispatch<PointCall>(D, a, D, sums); }
void PairKernel(const WeightedPoints& a, const WeightedPoints& b, Index D, const PairForm& form, const double* weights,
                PairSums& sums, double* scratch) {
  dispatch<PairCall>(D, a, b, D, form, weights, sums, scratch);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::moments
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::moments {

Matrix pair_weights(const Matrix& W) {
  constexpr Index kBlock = 8;
  const Index n = W.rows(), stride = moment_stride(n);
  Matrix weights = Matrix::Zero(stride, stride);
  for (Index j = 0; j < n; ++j)
    for (Index i = j / kBlock * kBlock; i < n; ++i) weights(i, j) = W(i, j) * (i / kBlock == j / kBlock ? 0.5 : 1);
  return weights;
}

HWY_EXPORT(MeanKernel);
HWY_EXPORT(PointKernel);
HWY_EXPORT(PairKernel);

void mean_correlations(const WeightedPoints& a, Index D, const double* P, double factor, double* q) {
  HWY_DYNAMIC_DISPATCH(MeanKernel)(a, D, P, factor, q);
}
void point_sums(const WeightedPoints& a, Index D, PointSums& sums) { HWY_DYNAMIC_DISPATCH(PointKernel)(a, D, sums); }
void pair_sums(const WeightedPoints& a, const WeightedPoints& b, Index D, const PairForm& form, const double* weights,
               PairSums& sums, double* scratch) {
  HWY_DYNAMIC_DISPATCH(PairKernel)(a, b, D, form, weights, sums, scratch);
}

}  // namespace rehearse::moments
#endif
