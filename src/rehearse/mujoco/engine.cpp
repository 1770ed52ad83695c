#include "rehearse/mujoco/engine.hpp"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <mutex>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/options.hpp"
#include "rehearse/mujoco/pitfalls.hpp"

namespace rehearse::mujoco {
namespace {

// MuJoCo's handlers are functions without an argument of ours, one of each for the whole program. The variables of a
// guarded call are therefore here, once a thread.
thread_local std::jmp_buf* innermost = nullptr;
thread_local std::array<char, 300> last_error{};

void remember(const char* message) {
  const std::size_t size = std::min(std::char_traits<char>::length(message), last_error.size() - 1);
  std::copy_n(message, size, last_error.begin());
  last_error[size] = '\0';
}

/// MuJoCo ends the program if this returns. Where nobody guards a call, an exception is the best that is left: the
/// library is compiled with tables to unwind, as all is on this platform.
void leave(const char* message) {
  remember(message);
  if (innermost) std::longjmp(*innermost, 1);
  throw std::runtime_error(message);
}

/// Sets handlers of errors and warnings. Without them MuJoCo prints, writes MUJOCO_LOG.TXT and ends the program. Its
/// warnings are counted in mjData, too.
void take_over_errors() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_warning = [](const char*) {};
    mju_user_error = leave;
  });
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto end = text.find_last_not_of(' ');
  return end == std::string::npos ? "" : text.substr(0, end + 1);
}

const char* word_for(mjtObj type) { return mju_type2Str(type); }

int count(const mjModel& model, mjtObj type) {
  switch (type) {
    case mjOBJ_BODY:
      return model.nbody;
    case mjOBJ_JOINT:
      return model.njnt;
    case mjOBJ_GEOM:
      return model.ngeom;
    case mjOBJ_SITE:
      return model.nsite;
    case mjOBJ_SENSOR:
      return model.nsensor;
    case mjOBJ_ACTUATOR:
      return model.nu;
    case mjOBJ_TENDON:
      return model.ntendon;
    case mjOBJ_KEY:
      return model.nkey;
    default:
      return 0;
  }
}

template <class Pointer, class Make>
Pointer made(const char* what, Make make) {
  take_over_errors();
  decltype(make()) result = nullptr;
  const auto work = [&result, &make] { result = make(); };
  if (const char* error = guarded(work)) throw std::runtime_error(fmt::format("MuJoCo has no {}: {}", what, error));
  if (!result) throw std::runtime_error(fmt::format("MuJoCo has no {}", what));
  return Pointer(result);
}

}  // namespace

const char* guarded(void (*work)(void*), void* data) {
  std::jmp_buf here;
  std::jmp_buf* const outer = innermost;
  innermost = &here;
  if (setjmp(here) != 0) {
    innermost = outer;
    return last_error.data();
  }
  work(data);
  innermost = outer;
  return nullptr;
}

ModelPointer load(const std::string& path) {
  refuse_pitfalls(path);
  take_over_errors();
  std::array<char, 1000> error{};
  try {  // no guard: MuJoCo's reader is C++, which longjmp must not leave
    ModelPointer model(mj_loadXML(path.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
    if (model) return model;
  } catch (const std::exception& failure) {
    throw InvalidInput(fmt::format("{}: {}", path, one_line(failure.what())));
  }
  throw InvalidInput(fmt::format("{}: {}", path, one_line(error.data())));
}

ModelPointer copy(const mjModel& model) {
  return made<ModelPointer>("copy of the model", [&model] { return mj_copyModel(nullptr, &model); });
}

DataPointer make_data(const mjModel& model) {
  return made<DataPointer>("data of the model", [&model] { return mj_makeData(&model); });
}

std::vector<std::string> names_of(const mjModel& model, mjtObj type) {
  std::vector<std::string> names;
  for (int i = 0; i < count(model, type); ++i)
    if (const char* name = mj_id2name(&model, type, i)) names.emplace_back(name);
  return names;
}

int find(const mjModel& model, mjtObj type, const std::string& name, const std::string& where, Violations& violations) {
  const int id = name.empty() ? -1 : mj_name2id(&model, type, name.c_str());
  if (id >= 0) return id;
  const std::vector<std::string> names = names_of(model, type);
  violations.add(
      names.empty()
          ? fmt::format("{}: there is no {} '{}': the model has none with a name", where, word_for(type), name)
          : fmt::format("{}: there is no {} '{}'{}", where, word_for(type), name, suggestions(name, names)));
  return -1;
}

int find_scalar_joint(const mjModel& model, const std::string& name, const std::string& where, Violations& violations) {
  const int id = find(model, mjOBJ_JOINT, name, where, violations);
  if (id < 0) return -1;
  const int type = model.jnt_type[id];
  if (type == mjJNT_HINGE || type == mjJNT_SLIDE) return id;
  const bool is_free = type == mjJNT_FREE;
  violations.add(
      fmt::format("{}: '{}' is a {} joint, must be a hinge or a slide: put {} in its place in the model, or "
                  "read the body by {{ sensor = … }} or {{ body = … }}",
                  where, name, is_free ? "free" : "ball",
                  is_free ? "three slides and three hinges (in a plane two and one)" : "three hinges"));
  return -1;
}

}  // namespace rehearse::mujoco
