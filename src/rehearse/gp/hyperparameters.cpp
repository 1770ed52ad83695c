#include "rehearse/gp/hyperparameters.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::gp {

double Hyperparameters::signal_variance() const { return std::exp(2 * log_signal); }
double Hyperparameters::noise_variance() const { return std::exp(2 * log_noise); }

Vector Hyperparameters::flat() const {
  Vector flat(inputs() + 2 + log_trend.size());
  flat << log_lengths, log_signal, log_noise, log_trend;
  return flat;
}

Hyperparameters Hyperparameters::from_flat(const ConstVectorView& flat, Index inputs) {
  if (flat.size() != inputs + 2 && flat.size() != 2 * inputs + 3)
    throw InvalidInput(fmt::format("{} log hyperparameters, must be {}, or {} with a trend, for {} inputs", flat.size(),
                                   inputs + 2, 2 * inputs + 3, inputs));
  return {.log_lengths = flat.head(inputs),
          .log_signal = flat(inputs),
          .log_noise = flat(inputs + 1),
          .log_trend = flat.tail(flat.size() - inputs - 2)};
}

std::vector<std::string> violations(const Hyperparameters& hyperparameters, Index inputs, const std::string& name) {
  std::vector<std::string> list;
  if (hyperparameters.inputs() != inputs)
    list.push_back(fmt::format("{}.log_lengths has {} values, must be {}", name, hyperparameters.inputs(), inputs));
  const auto require_finite = [&](const std::string& field, double value) {
    if (!std::isfinite(value)) list.push_back(fmt::format("{}.{} = {}, must be finite", name, field, value));
  };
  for (Index d = 0; d < hyperparameters.inputs(); ++d)
    require_finite(fmt::format("log_lengths[{}]", d), hyperparameters.log_lengths(d));
  require_finite("log_signal", hyperparameters.log_signal);
  require_finite("log_noise", hyperparameters.log_noise);
  if (hyperparameters.has_trend() && hyperparameters.log_trend.size() != inputs + 1)
    list.push_back(
        fmt::format("{}.log_trend has {} values, must be {}", name, hyperparameters.log_trend.size(), inputs + 1));
  for (Index d = 0; d < hyperparameters.log_trend.size(); ++d)
    require_finite(fmt::format("log_trend[{}]", d), hyperparameters.log_trend(d));
  return list;
}

}  // namespace rehearse::gp
