#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::prior {
namespace {

bool same_box(const Parameter& a, const Parameter& b) {
  return a.kind == b.kind && a.box.low == b.box.low && a.box.high == b.box.high && a.choices == b.choices;
}

/// True if every prior with a tunable parameter of this name has the same box for it.
bool shared(const Parameter& parameter, const std::vector<Prior>& priors) {
  return std::all_of(priors.begin(), priors.end(), [&](const Prior& prior) {
    const Index i = prior.space.find(parameter.name);
    return i < 0 || !prior.space[i].tunable() || same_box(prior.space[i], parameter);
  });
}

/// The simulators of several priors behind one more parameter.
class Choice final : public system::Simulator {
 public:
  explicit Choice(const std::vector<Prior>& priors) : priors_(priors) {
    std::vector<Parameter> parameters;
    Parameter which;
    which.name = "prior";
    which.kind = Parameter::Kind::discrete;
    for (std::size_t k = 0; k < priors.size(); ++k) which.choices.push_back(static_cast<double>(k));
    parameters.push_back(which);
    for (const Prior& prior : priors) {
      sources_.push_back(add_tunable(prior, parameters));
      values_.push_back(prior.space.values());
    }
    space_ = ParameterSpace(std::move(parameters));
  }

  const ParameterSpace& parameters() const override { return space_; }

  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    const auto k = static_cast<std::size_t>(std::lround(phi(0)));
    thread_local Vector kept;      // so that the time loop of a rollout allocates nothing
    Vector own = std::move(kept);  // not shared: one of the priors may be a choice itself
    own = values_[k];
    for (Index i = 0; i < own.size(); ++i) {
      const Index source = sources_[k][static_cast<std::size_t>(i)];
      if (source >= 0) own(i) = phi(source);
    }
    priors_[k].simulator->change(X, U, own, dX);
    kept = std::move(own);
  }

  Index rows_at_once() const override {
    Index most = 0;
    for (const Prior& prior : priors_) most = std::max(most, prior.simulator->rows_at_once());
    return most;
  }

  std::shared_ptr<const Simulator> behind_actuators() const override {
    std::vector<Prior> robots;
    for (const Prior& prior : priors_) robots.push_back(prior.behind_actuators());
    return std::make_shared<Choice>(robots);
  }

 private:
  /// The index of each parameter of a prior in the joint φ; −1: fixed by the prior.
  std::vector<Index> add_tunable(const Prior& prior, std::vector<Parameter>& joint) const {
    std::vector<Index> sources;
    for (Parameter parameter : prior.space.all()) {
      if (!parameter.tunable()) {
        sources.push_back(-1);
        continue;
      }
      const bool is_choice = parameter.name == joint.front().name;  // of which prior: a name of this choice's own
      if (is_choice || !shared(parameter, priors_)) parameter.name += "@" + prior.name;
      const auto same = [&](const Parameter& p) { return p.name == parameter.name; };
      const auto found = std::find_if(joint.begin(), joint.end(), same);
      sources.push_back(found - joint.begin());
      if (found == joint.end()) joint.push_back(parameter);
    }
    return sources;
  }

  std::vector<Prior> priors_;
  std::vector<std::vector<Index>> sources_;
  std::vector<Vector> values_;  // of each prior's own parameters
  ParameterSpace space_;
};

}  // namespace

Prior choice(const std::vector<Prior>& priors) {
  if (priors.size() < 2) throw InvalidInput(fmt::format("{} prior to choose among, must be ≥ 2", priors.size()));
  auto simulator = std::make_shared<Choice>(priors);
  std::string name;
  std::vector<Prior> behind_servos;
  for (const Prior& prior : priors) {
    name += (name.empty() ? "" : ",") + prior.name;
    behind_servos.push_back(prior.behind_servos());
  }
  const bool driven = std::ranges::any_of(priors, [](const Prior& prior) { return prior.driven != nullptr; });
  return {name, simulator, simulator->parameters(), driven ? std::make_shared<Choice>(behind_servos) : nullptr};
}

}  // namespace rehearse::prior
