#include "rehearse/learners/pilco/prior_knowledge.hpp"

#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/json.hpp"

namespace rehearse::learners::pilco {

using nlohmann::json;

/// The terms of a model have the same centres, so they are written once.
json to_json(const PriorKnowledge& knowledge) {
  json terms = json::array();
  for (const moments::MomentTerm& term : knowledge.network)
    terms.push_back({{"output", term.output},
                     {"log_lengths", learners::to_json(term.log_lengths)},
                     {"weights", learners::to_json(term.weights)}});
  const Matrix centres = knowledge.network.empty() ? Matrix() : knowledge.network.front().centres;
  json j = {{"centres", learners::to_json(centres)},
            {"terms", terms},
            {"theta", learners::to_json(knowledge.theta)},
            {"predicted_return", knowledge.predicted_return ? json(*knowledge.predicted_return) : json()},
            {"evaluations", knowledge.evaluations},
            {"failed", knowledge.failed},
            {"notes", knowledge.notes}};
  for (const Vector& policy : knowledge.policies) j["policies"].push_back(learners::to_json(policy));
  return j;
}

PriorKnowledge to_knowledge(const json& j) {
  PriorKnowledge knowledge{.theta = to_vector(j.at("theta")),
                           .evaluations = j.at("evaluations").get<Index>(),
                           .failed = j.at("failed").get<Index>()};
  j.at("notes").get_to(knowledge.notes);
  if (!j.at("predicted_return").is_null()) knowledge.predicted_return = j.at("predicted_return").get<double>();
  if (j.contains("policies")) knowledge.policies = to_vectors(j.at("policies"));
  const Matrix centres = to_matrix(j.at("centres"));
  for (const json& term : j.at("terms"))
    knowledge.network.push_back({.output = term.at("output").get<Index>(),
                                 .centres = centres,
                                 .log_lengths = to_vector(term.at("log_lengths")),
                                 .weights = to_vector(term.at("weights"))});
  return knowledge;
}

}  // namespace rehearse::learners::pilco
