#include "rehearse/identification/smoothing/errors_in_variables.hpp"

#include <algorithm>
#include <utility>

#include "rehearse/gp/evidence.hpp"

namespace rehearse::identification {
namespace {

constexpr Index kMostNumbers = 800;  // of a block

/// Each number of `values` n times.
Vector each(const Vector& values, Index n) { return values.transpose().replicate(n, 1).reshaped(); }

}  // namespace

ErrorsInVariables::ErrorsInVariables(const Dataset& measured, const Evaluator& evaluator, Measurements measurements)
    : measured_(measured),
      evaluator_(evaluator),
      dx_(measured.states.cols()),
      blocks_(blocks_of(measured, std::max<Index>(1, kMostNumbers / dx_), measurements)),
      Y_(measurements_of(measured, blocks_)),
      X_(Y_),
      along_(Y_),
      path_(measured),
      blocks_of_r_(blocks_.size()) {}

ErrorsInVariables::Sparse ErrorsInVariables::errors_of(const Block& block, const std::vector<Matrix>& before,
                                                       const std::vector<Matrix>& after) {
  const auto dx = static_cast<Index>(before.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (Index d = 0; d < dx; ++d)
    for (Index e = 0; e < dx; ++e)
      for (Index i = 0; i < block.rows; ++i) {
        const auto of = static_cast<std::size_t>(d);
        const Index row = e * block.rows + i;
        const Index column = d * block.measurements + block.before[static_cast<std::size_t>(i)];
        entries.emplace_back(row, column, before[of](block.first + i, e));
        entries.emplace_back(row, column + 1, after[of](block.first + i, e));
      }
  Sparse B(dx * block.rows, dx * block.measurements);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

Matrix ErrorsInVariables::covariance_of_errors(std::size_t b) const {
  const Sparse& B = blocks_of_r_[b].B;
  return Matrix(B * each(R_, blocks_[b].measurements).asDiagonal() * B.transpose());
}

/// `of_errors`: covariance_of_errors(b).
Matrix ErrorsInVariables::covariance(std::size_t b, Matrix of_errors, const Vector& W) const {
  const Index rows = blocks_[b].rows;
  Matrix C = std::move(of_errors);
  C.diagonal() += each(W, rows);
  for (Index e = 0; e < dx_; ++e)
    C.block(e * rows, e * rows, rows, rows) += blocks_of_r_[b].K[static_cast<std::size_t>(e)];
  return C;
}

bool ErrorsInVariables::factorise(const Vector& W) {
  for_each_block([&](std::size_t b) { blocks_of_r_[b].factor = covariance(b, covariance_of_errors(b), W).llt(); });
  return std::ranges::all_of(blocks_of_r_, [](const auto& of) { return of.factor.info() == Eigen::Success; });
}

Vector ErrorsInVariables::stacked(const Matrix& rows) const {
  Vector r(rows.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    r(numbers(b)) = rows.middleRows(blocks_[b].first, blocks_[b].rows).reshaped();
  return r;
}

Vector ErrorsInVariables::residuals(const Matrix& on_path) const {
  Vector r = stacked(on_path);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Matrix off = Y_(measurements(b), Eigen::all) - along_(measurements(b), Eigen::all);
    r(numbers(b)) += blocks_of_r_[b].B * off.reshaped();
  }
  return r;
}

Vector ErrorsInVariables::whitened(Vector r) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Vector of_block = r(numbers(b));
    r(numbers(b)) = blocks_of_r_[b].factor.matrixL().solve(of_block);
  }
  return r;
}

double ErrorsInVariables::log_evidence(const Vector& r) const {
  double log_determinant = 0;
  for (const OfBlock& block : blocks_of_r_)
    log_determinant += 2 * block.factor.matrixLLT().diagonal().array().log().sum();
  return -(whitened(r).squaredNorm() + log_determinant + static_cast<double>(r.size()) * gp::kLogTwoPi) / 2;
}

void ErrorsInVariables::improve_variances(const Vector& r, const Vector& least) {
  std::vector<Matrix> sums(blocks_.size());
  for_each_block([&](std::size_t b) {
    const auto& [K, B, factor] = blocks_of_r_[b];
    const Vector weights = factor.solve(Vector(r(numbers(b))));
    const Vector explained = (B.transpose() * weights).cwiseAbs2();
    const Matrix inverse = factor.solve(Matrix::Identity(B.rows(), B.rows()));
    const Vector chance = B.cwiseProduct(inverse * B).transpose() * Vector::Ones(B.rows());
    sums[b].resize(dx_, 2);
    sums[b] << explained.reshaped(blocks_[b].measurements, dx_).colwise().sum().transpose(),
        chance.reshaped(blocks_[b].measurements, dx_).colwise().sum().transpose();
  });
  Matrix total = Matrix::Zero(dx_, 2);
  for (const Matrix& sum : sums) total += sum;
  R_.array() *= total.col(0).cwiseQuotient(total.col(1)).array().sqrt();
  R_ = R_.cwiseMax(least);
}

void ErrorsInVariables::subtract_errors(const Vector& r) {
  for_each_block([&](std::size_t b) {
    const auto& [K, B, factor] = blocks_of_r_[b];
    const Index n = blocks_[b].measurements;
    const Vector v = each(R_, n).cwiseProduct(B.transpose() * factor.solve(Vector(r(numbers(b)))));
    X_(measurements(b), Eigen::all) = Y_(measurements(b), Eigen::all) - v.reshaped(n, dx_);
  });
}

ErrorsInVariables::Given ErrorsInVariables::given_others(const Vector& r, const Vector& W) const {
  const Index n = measured_.size();
  Given given{Matrix(n, dx_), std::vector<Matrix>(static_cast<std::size_t>(dx_), Matrix::Zero(n, n))};
  for_each_block([&](std::size_t b) { give_others(b, r(numbers(b)), W, given); });
  return given;
}

void ErrorsInVariables::give_others(std::size_t b, const Vector& r, const Vector& W, Given& given) const {
  const Index rows = blocks_[b].rows, first = blocks_[b].first;
  const Matrix S = covariance_of_errors(b), C = covariance(b, S, W);
  for (Index e = 0; e < dx_; ++e) {
    std::vector<Index> others;
    for (Index i = 0; i < r.size(); ++i)
      if (i / rows != e) others.push_back(i);
    const auto own = Eigen::seqN(e * rows, rows);
    const Eigen::LLT<Matrix> factor = Matrix(C(others, others)).llt();
    if (factor.info() != Eigen::Success) {
      given.residuals.middleRows(first, rows).setConstant(kNaN);
      return;
    }
    const Matrix across = factor.matrixL().solve(Matrix(S(others, own)));
    given.residuals.col(e).segment(first, rows) =
        r(own) - across.transpose() * factor.matrixL().solve(Vector(r(others)));
    given.errors[static_cast<std::size_t>(e)].block(first, first, rows, rows) =
        S(own, own) - across.transpose() * across;
  }
}

}  // namespace rehearse::identification
