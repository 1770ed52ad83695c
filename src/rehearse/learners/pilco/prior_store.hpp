#pragma once

#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "rehearse/learners/learner.hpp"

namespace rehearse::learners::pilco {

/// Work on the setting's prior that was left in its store by `keep_work`. Nothing where there is no store, or no work
/// of ours in it, or where the prior has become another function since: the prior is a black box, so some of its steps
/// are made again and compared.
std::optional<nlohmann::json> kept_work(const Setting& setting);

/// Replaces the work in the setting's store, if it has one.
void keep_work(const Setting& setting, const nlohmann::json& work);

}  // namespace rehearse::learners::pilco
