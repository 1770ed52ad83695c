#pragma once
// The saved state of learners and runs, as JSON values. As CBOR they keep every double; as text NaN and infinities are
// lost.

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/identification/fit_problem.hpp"

namespace rehearse::learners {

nlohmann::json to_json(const Vector& v);
nlohmann::json to_json(const Matrix& m);
nlohmann::json to_json(const Episode& e);
nlohmann::json to_json(const identification::WarmStart& start);

/// These throw nlohmann::json::exception, or InvalidInput, where something else was saved.
Vector to_vector(const nlohmann::json& j);
std::vector<Vector> to_vectors(const nlohmann::json& j);
Matrix to_matrix(const nlohmann::json& j);
Episode to_episode(const nlohmann::json& j);
identification::WarmStart to_warm_start(const nlohmann::json& j);

}  // namespace rehearse::learners
