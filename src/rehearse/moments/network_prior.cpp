#include "rehearse/moments/network_prior.hpp"

namespace rehearse::moments {

prior::Prior network_prior(std::string name, FeatureMap features, std::vector<MomentTerm> terms) {
  auto change = [features = std::move(features), terms = std::move(terms)](
                    const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) {
    Matrix inputs(X.rows(), features.features() + U.cols());
    features.apply(X, inputs.leftCols(features.features()));
    inputs.rightCols(U.cols()) = U;
    dX = evaluate_means(terms, X.cols(), inputs);
  };
  return {std::move(name), system::make_simulator({}, std::move(change)), {}};
}

}  // namespace rehearse::moments
