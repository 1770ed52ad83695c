#include "rehearse/prior/network.hpp"

namespace rehearse::prior {

Prior network(std::string name, FeatureMap features, std::vector<gp::MomentTerm> terms) {
  auto change = [features = std::move(features), terms = std::move(terms)](
                    const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) {
    Matrix inputs(X.rows(), features.features() + U.cols());
    features.apply(X, inputs.leftCols(features.features()));
    inputs.rightCols(U.cols()) = U;
    dX = gp::evaluate_means(terms, X.cols(), inputs);
  };
  return {std::move(name), system::make_simulator({}, std::move(change)), {}};
}

}  // namespace rehearse::prior
