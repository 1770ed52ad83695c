#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/gp/moment_kernel.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/gp/correlation-inl.hpp"
#include "rehearse/gp/moment_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::gp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kWidest = 8;  // lanes of the widest vector

HWY_INLINE Index lanes() { return static_cast<Index>(hn::Lanes(kTag)); }
HWY_INLINE V load(const double* p) { return hn::LoadU(kTag, p); }
HWY_INLINE void add_to(double* p, V value) { hn::StoreU(hn::Add(load(p), value), kTag, p); }
HWY_INLINE double sum(V v) { return hn::GetLane(hn::SumOfLanes(kTag, v)); }

/// exp(x), 0 below e^−80. x ≤ 0 but for rounding.
HWY_INLINE V exponential(V x) {
  const V cut = constant(-80);
  return hn::IfThenElseZero(hn::Gt(x, cut), short_exp(hn::Max(x, cut)));
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
      hn::StoreU(hn::Mul(exponential(exponent), constant(factor)), kTag, q + i);
    }
  }

  /// Sums kept lane by lane until the end, in kWidest doubles each.
  class Sums {
   public:
    HWY_INLINE explicit Sums(int D) : D_(D) { std::fill(memory_, memory_ + kWidest * (1 + D + D * D), 0.0); }

    HWY_INLINE void add(const V* z, V g, bool second) {
      add_to(memory_, g);
      for (int d = 0; d < D_; ++d) {
        const V gz = hn::Mul(g, z[d]);
        add_to(first(d), gz);
        if (!second) continue;
        for (int k = 0; k <= d; ++k) {
          double* entry = matrix(d, k);
          hn::StoreU(hn::MulAdd(gz, z[k], load(entry)), kTag, entry);
        }
      }
    }
    HWY_INLINE void add_product(const V* z, const V* h) {  // of z hᵀ
      for (int d = 0; d < D_; ++d)
        for (int k = 0; k < D_; ++k) {
          double* entry = matrix(d, k);
          hn::StoreU(hn::MulAdd(z[d], h[k], load(entry)), kTag, entry);
        }
    }
    HWY_INLINE void give(PointSums& sums) const {
      sums.total = sum(load(memory_));
      for (int d = 0; d < D_; ++d) sums.first[d] = sum(load(first(d)));
      if (!sums.second) return;
      for (int d = 0; d < D_; ++d)
        for (int k = 0; k <= d; ++k) sums.second[d * D_ + k] = sums.second[k * D_ + d] = sum(load(matrix(d, k)));
    }
    HWY_INLINE void give_product(double* cross) const {
      for (int d = 0; d < D_; ++d)
        for (int k = 0; k < D_; ++k) cross[k * D_ + d] = sum(load(matrix(d, k)));
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
      sums.add(z, load(a.weights + i), out.second != nullptr);
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
  template <bool kWeights, bool kColumns>
  static HWY_INLINE void pair_sums(const WeightedPoints& a, const WeightedPoints& b, int D, const PairForm& form,
                                   const double* weights, PairSums& out, double* scratch) {
    double* own = scratch;
    double* columns = scratch + b.stride;  // Σ_i w_i L_ij, lane by lane
    own_terms(b, D, form.B, own);
    if (kColumns) std::fill(columns, columns + kWidest * b.stride, 0.0);
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
      for (Index j = 0; j < b.size; ++j) {
        V exponent = hn::Add(start, constant(own[j]));
        for (int d = 0; d < D; ++d) exponent = hn::MulAdd(slope[d], constant(b.points[d * b.stride + j]), exponent);
        const V L = exponential(exponent);
        if (kColumns) {
          double* column = columns + kWidest * j;
          hn::StoreU(hn::MulAdd(L, w, load(column)), kTag, column);
        }
        const V g = hn::Mul(L, kWeights ? load(weights + j * a.stride + i) : constant(b.weights[j]));
        h[0] = hn::Add(h[0], g);
        for (int d = 0; d < D; ++d) h[d + 1] = hn::MulAdd(g, constant(b.points[d * b.stride + j]), h[d + 1]);
      }
      if (out.rows)
        for (int d = 0; d <= D; ++d) hn::StoreU(h[d], kTag, out.rows + d * a.stride + i);
      if (!kWeights)
        for (int d = 0; d <= D; ++d) h[d] = hn::Mul(h[d], w);
      sums.add(z, h[0], true);
      products.add_product(z, h + 1);
    }
    sums.give(out.a);
    products.give_product(out.cross);
    if (kColumns) give_columns(b, D, columns, own, out.b);
  }

  static HWY_INLINE void give_columns(const WeightedPoints& b, int D, const double* columns, double* total,
                                      PointSums& out) {
    std::fill(total, total + b.stride, 0.0);
    for (Index j = 0; j < b.size; ++j) total[j] = b.weights[j] * sum(load(columns + kWidest * j));
    point_sums({b.points, total, b.size, b.stride}, D, out);
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
    if (weights) return Loops<kD>::template pair_sums<true, false>(a, b, dimensions, form, weights, sums, scratch);
    if (sums.b.first) return Loops<kD>::template pair_sums<false, true>(a, b, dimensions, form, weights, sums, scratch);
    Loops<kD>::template pair_sums<false, false>(a, b, dimensions, form, weights, sums, scratch);
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
}  // namespace rehearse::gp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::gp {

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

}  // namespace rehearse::gp
#endif
