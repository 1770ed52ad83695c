#include <cmath>

#include <nlohmann/json.hpp>

#include "rehearse/policy/exported_text.hpp"

namespace rehearse::policy {
namespace {

using Json = nlohmann::ordered_json;

Json list(const Vector& values) { return std::vector<double>(values.begin(), values.end()); }

Json lists(const Matrix& values) {
  Json all = Json::array();
  for (Index i = 0; i < values.rows(); ++i) all.push_back(list(values.row(i)));
  return all;
}

Json inputs(const std::vector<Input>& inputs) {
  constexpr const char* kNames[] = {"identity", "cos", "sin"};
  Json all = Json::array();
  for (const Input& input : inputs)
    all.push_back({{"state", input.state},
                   {"function", kNames[static_cast<std::size_t>(input.function)]},
                   {"scale", input.scale}});
  return all;
}

void add_squash(Json& form, const Squash& squash) {
  form["gain"] = squash.gain;
  form["squash"] = squash.shape == Squash::Shape::tanh ? "tanh" : "sine";
}

Json to_form(const Layers& layers) {
  Json form = {{"form", "layers"}, {"inputs", inputs(layers.inputs)}};
  form["hidden"] = lists(layers.hidden);
  form["output"] = lists(layers.output);
  add_squash(form, layers.squash);
  return form;
}

Json to_form(const Radial& radial) {
  Json form = {{"form", "radial"}, {"inputs", inputs(radial.inputs)}};
  form["centres"] = lists(radial.centres);
  form["lengths"] = lists(radial.lengths);
  form["weights"] = lists(radial.weights);
  add_squash(form, radial.squash);
  return form;
}

Json to_form(const Table& table) {
  return {{"form", "table"}, {"actions", lists(table.actions)}, {"per_s", table.per_s}, {"periodic", table.periodic}};
}

Json to_form(const Feedback& feedback) {
  return {{"form", "feedback"},
          {"actions", lists(feedback.actions)},
          {"states", lists(feedback.states)},
          {"gains", lists(feedback.gains)},
          {"per_s", feedback.per_s},
          {"angles", feedback.angles}};
}

Json computes(const Description& description) {
  Json all = std::visit([](const auto& form) { return to_form(form); }, description.form);
  if (const auto& near = description.near)
    all["near"] = {{"action", list(near->action)},
                   {"state", list(near->state)},
                   {"gain", lists(near->gain)},
                   {"shape", lists(near->shape)},
                   {"angles", near->angles}};
  return all;
}

/// The conversion of each action to a command, and its memory: docs/export.md.
Json commands(const Actuators& actuators) {
  Json all = Json::array();
  const auto known = [](bool is, auto value) { return is ? Json(value) : Json(); };
  for (const Actuators::Channel& channel : actuators.channels())
    all.push_back({{"last", known(channel.kept > 0, channel.last_command)},
                   {"remembers", channel.kept},
                   {"start", channel.start_command},
                   {"passes", channel.filter_gain},
                   {"max_step", known(std::isfinite(channel.max_change), channel.max_change)},
                   {"reached", known(channel.reached_state >= 0, channel.reached_state)},
                   {"delay", static_cast<double>(channel.delay_steps) + channel.delay_fraction},
                   {"stays", channel.lag_decay}});
  return all;
}

}  // namespace

std::string to_json(const Exported& exported) {
  const Origin& from = exported.origin;
  Json states = Json::array(), actions = Json::array();
  for (const StateVariable& state : exported.states) states.push_back({{"name", state.name}, {"unit", state.unit}});
  for (const ActionVariable& action : exported.actions)
    actions.push_back(
        {{"name", action.name}, {"unit", action.unit}, {"low", action.bounds.low}, {"high", action.bounds.high}});
  Json all = {{"about", std::string("a ") + kExportedMark},
              {"format", 1},
              {"robot", from.robot},
              {"learner", from.learner},
              {"prior", from.prior},
              {"seed", from.seed},
              {"trial", from.trial},
              {"return", from.total_reward ? Json(*from.total_reward) : Json()},
              {"dt_s", exported.dt_s},
              {"steps", exported.horizon},
              {"states", states},
              {"actions", actions},
              {"policy", exported.kind},
              {"theta", list(exported.theta)},
              {"computes", computes(exported.description)},
              {"test",
               {{"states", lists(exported.answers.states)},
                {"times_s", list(exported.answers.times_s)},
                {"actions", lists(exported.answers.actions)}}}};
  if (memory(exported) > 0) all["commands"] = commands(exported.actuators);
  return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rehearse::policy
