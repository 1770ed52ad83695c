#include "rehearse/learners/json.hpp"

#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"

namespace rehearse::learners {

using nlohmann::json;

json to_json(const Vector& v) { return std::vector<double>(v.begin(), v.end()); }

json to_json(const Matrix& m) {
  return {{"rows", m.rows()}, {"values", std::vector<double>(m.data(), m.data() + m.size())}};
}

json to_json(const Episode& e) {
  json j = {{"states", to_json(e.states)},   {"true_states", to_json(e.true_states)},
            {"actions", to_json(e.actions)}, {"rewards", to_json(e.rewards)},
            {"charged", e.charged},          {"ended", e.ended}};
  if (e.episode_reward != 0) j["episode_reward"] = e.episode_reward;
  if (!e.failure.empty()) j["failure"] = e.failure;
  if (!e.broken_limits.empty()) j["broken_limits"] = e.broken_limits;
  return j;
}

Vector to_vector(const json& j) {
  const auto values = j.get<std::vector<double>>();
  return Vector::Map(values.data(), static_cast<Index>(values.size()));
}

std::vector<Vector> to_vectors(const json& j) {
  std::vector<Vector> vectors;
  for (const json& element : j) vectors.push_back(to_vector(element));
  return vectors;
}

Matrix to_matrix(const json& j) {
  const auto values = j.at("values").get<std::vector<double>>();
  const Index rows = j.at("rows").get<Index>(), size = static_cast<Index>(values.size());
  if (rows < 0 || (rows == 0 ? size != 0 : size % rows != 0)) throw InvalidInput("a matrix has a wrong size");
  return Matrix::Map(values.data(), rows, rows == 0 ? 0 : size / rows);
}

Episode to_episode(const json& j) {
  Episode e;
  e.states = to_matrix(j.at("states"));
  e.true_states = to_matrix(j.at("true_states"));
  e.actions = to_matrix(j.at("actions"));
  e.rewards = to_vector(j.at("rewards"));
  e.charged = j.at("charged").get<double>();
  e.episode_reward = j.value("episode_reward", 0.0);
  e.ended = j.at("ended").get<bool>();
  e.failure = j.value("failure", "");
  e.broken_limits = j.value("broken_limits", std::vector<std::string>());
  return e;
}

json to_json(const identification::WarmStart& start) {
  json kernels = json::array();
  for (const auto& kernel : start.kernels) kernels.push_back(to_json(kernel.flat()));
  return {{"kernels", kernels},
          {"kernel_inputs", start.kernels.empty() ? 0 : start.kernels.front().inputs()},
          {"phi", start.phi ? to_json(*start.phi) : json()},
          {"odd", start.odd}};
}

identification::WarmStart to_warm_start(const json& j) {
  identification::WarmStart start;
  for (const Vector& flat : to_vectors(j.at("kernels"))) {
    const Index inputs = j.value("kernel_inputs", flat.size() - 2);  // PILCO's older states lack it, and have no trend
    start.kernels.push_back(gp::Hyperparameters::from_flat(flat, inputs));
  }
  if (const auto phi = j.find("phi"); phi != j.end() && !phi->is_null()) start.phi = to_vector(*phi);
  start.odd = j.value("odd", false);  // states of before it was asked lack it
  return start;
}

}  // namespace rehearse::learners
