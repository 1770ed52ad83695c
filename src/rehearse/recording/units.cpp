#include "rehearse/recording/units.hpp"

#include <algorithm>
#include <numbers>
#include <string_view>

namespace rehearse::recording {
namespace {

enum class Quantity { time, angle, angular_speed, length, speed, force, torque };

struct Unit {
  std::string_view name;
  Quantity quantity;
  double in_si;
};

constexpr double kDegree = std::numbers::pi / 180;
constexpr Unit kUnits[] = {
    {"s", Quantity::time, 1},
    {"ms", Quantity::time, 1e-3},
    {"us", Quantity::time, 1e-6},
    {"µs", Quantity::time, 1e-6},
    {"ns", Quantity::time, 1e-9},
    {"rad", Quantity::angle, 1},
    {"deg", Quantity::angle, kDegree},
    {"°", Quantity::angle, kDegree},
    {"rad/s", Quantity::angular_speed, 1},
    {"deg/s", Quantity::angular_speed, kDegree},
    {"°/s", Quantity::angular_speed, kDegree},
    {"rpm", Quantity::angular_speed, 2 * std::numbers::pi / 60},
    {"m", Quantity::length, 1},
    {"cm", Quantity::length, 1e-2},
    {"mm", Quantity::length, 1e-3},
    {"m/s", Quantity::speed, 1},
    {"cm/s", Quantity::speed, 1e-2},
    {"mm/s", Quantity::speed, 1e-3},
    {"N", Quantity::force, 1},
    {"mN", Quantity::force, 1e-3},
    {"Nm", Quantity::torque, 1},
    {"mNm", Quantity::torque, 1e-3},
};

void erase(std::string& text, std::string_view part) {
  for (std::size_t at = 0; (at = text.find(part)) != std::string::npos;) text.erase(at, part.size());
}

/// "N·m" and "N m" as "Nm".
std::string spelled(std::string unit) {
  for (const std::string_view part : {" ", "*", "·", "⋅"}) erase(unit, part);
  return unit;
}

const Unit* find(const std::string& name) {
  const auto* const found = std::ranges::find(kUnits, std::string_view(name), &Unit::name);
  return found == std::end(kUnits) ? nullptr : found;
}

}  // namespace

std::optional<double> conversion(const std::string& from, const std::string& to) {
  const std::string a = spelled(from), b = spelled(to);
  if (a == b) return 1;
  const Unit *known_a = find(a), *known_b = find(b);
  if (!known_a || !known_b || known_a->quantity != known_b->quantity) return std::nullopt;
  return known_a->in_si / known_b->in_si;
}

std::vector<std::string> units_like(const std::string& unit) {
  std::vector<std::string> names = {unit};
  if (const Unit* known = find(spelled(unit)))
    for (const Unit& other : kUnits)
      if (other.quantity == known->quantity && &other != known) names.emplace_back(other.name);
  return names;
}

}  // namespace rehearse::recording
