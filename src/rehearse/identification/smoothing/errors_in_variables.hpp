#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/identification/smoothing/measured_path.hpp"

namespace rehearse::identification {

/// The steps of a data set as errors of measurements make them (smoothing.hpp): around a path, their residuals are
///
///   r = g + w + B v,
///
/// g of the GPs' covariances, w white, v the errors, of variances R a state. Numbers that belong to steps are in a
/// vector of n · dx: block by block, in a block output by output. References must outlive this.
class ErrorsInVariables {
 public:
  ErrorsInVariables(const Dataset& measured, const Evaluator& evaluator,
                    Measurements measurements = Measurements::shared);

  const Dataset& path() const { return path_; }  // around which all is linear; the measured rows at first

  /// Takes the path that has been learned as the path.
  void move_path() {
    along_ = X_;
    path_ = path_of(along_, measured_, blocks_);
  }

  /// `before`, `after`: what an error of each state (dx) adds to the residuals (n × dx) through the measurement before
  /// and after a step; covariance(e, first, count): of output e's g among `count`
  /// rows from `first` on.
  template <class Covariance>
  void linearise(const std::vector<Matrix>& before, const std::vector<Matrix>& after, Covariance covariance) {
    for_each_block([&](std::size_t b) {
      blocks_of_r_[b].B = errors_of(blocks_[b], before, after);
      blocks_of_r_[b].K.clear();
      for (Index e = 0; e < dx_; ++e) blocks_of_r_[b].K.push_back(covariance(e, blocks_[b].first, blocks_[b].rows));
    });
  }

  const Vector& variances() const { return R_; }  // dx; empty at first
  void set_variances(Vector R) { R_ = std::move(R); }

  /// With w of variances W (dx); to be done again where a variance or the linearisation has changed. False if it is not
  /// possible.
  bool factorise(const Vector& W);

  /// Rows × dx as a vector.
  Vector stacked(const Matrix& rows) const;

  /// Residuals on the path (n × dx) as a vector, with what the errors of the path's own states add.
  Vector residuals(const Matrix& on_path) const;

  /// L⁻¹ r, with L Lᵀ the covariance of r.
  Vector whitened(Vector r) const;

  double log_evidence(const Vector& r) const;  // nats

  /// Each variance times the root of what its errors explain over what they would by chance (Zhou 2019), which makes r
  /// likelier; at least `least` (dx).
  void improve_variances(const Vector& r, const Vector& least);

  /// Subtracts the expected errors from the states, for the next path.
  void subtract_errors(const Vector& r);
  const Matrix& states() const { return X_; }

  /// Information about each output's g + w from the others: residuals and their errors' covariances.
  struct Given {
    Matrix residuals;            // n × dx
    std::vector<Matrix> errors;  // dx, n × n
  };
  Given given_others(const Vector& r, const Vector& W) const;

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  struct OfBlock {
    std::vector<Matrix> K;  // rows × rows, one an output
    Sparse B;               // dx rows × dx measurements
    Eigen::LLT<Matrix> factor;
  };

  static Sparse errors_of(const Block& block, const std::vector<Matrix>& before, const std::vector<Matrix>& after);
  Matrix covariance_of_errors(std::size_t b) const;
  Matrix covariance(std::size_t b, Matrix of_errors, const Vector& W) const;
  void give_others(std::size_t b, const Vector& r, const Vector& W, Given& given) const;

  template <class Task>
  void for_each_block(Task task) const {
    evaluator_.for_each(static_cast<Index>(blocks_.size()), [&](Index b) { task(static_cast<std::size_t>(b)); });
  }
  auto numbers(std::size_t b) const { return Eigen::seqN(dx_ * blocks_[b].first, dx_ * blocks_[b].rows); }
  auto measurements(std::size_t b) const { return Eigen::seqN(blocks_[b].first_measurement, blocks_[b].measurements); }

  const Dataset& measured_;
  const Evaluator& evaluator_;
  const Index dx_;
  const std::vector<Block> blocks_;
  const Matrix Y_;  // measurements
  Matrix X_;        // what they were of
  Matrix along_;    // the same on the path
  Dataset path_;
  Vector R_;
  std::vector<OfBlock> blocks_of_r_;
};

}  // namespace rehearse::identification
