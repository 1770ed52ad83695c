#pragma once
// MuJoCo's own objects, and protection against its errors. For the files of this room, and for
// robots whose model is their own.

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <mujoco/mujoco.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::mujoco {

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPointer = std::unique_ptr<mjModel, ModelDeleter>;
using DataPointer = std::unique_ptr<mjData, DataDeleter>;

/// The model of an MJCF or URDF file. Throws InvalidInput with MuJoCo's own words. Any thread.
ModelPointer load(const std::string& path);

/// Both throw std::runtime_error where MuJoCo has an error. Any thread.
ModelPointer copy(const mjModel& model);
DataPointer make_data(const mjModel& model);

/// Calls work(data). Null, or MuJoCo's error, which the thread's next call overwrites. After an error MuJoCo goes no
/// further: work is left by longjmp. So it may call MuJoCo's C functions, and holds nothing that has a destructor.
const char* guarded(void (*work)(void*), void* data);

template <class Work>
const char* guarded(Work work) {
  static_assert(std::is_trivially_destructible_v<Work>, "work is left by longjmp");
  return guarded([](void* data) { (*static_cast<Work*>(data))(); }, &work);
}

/// The numbers of one object in an array of MuJoCo's that has `Size` numbers of each.
template <int Size, class Number>
Number* numbers_of(Number* array, int id) {
  return array + std::ptrdiff_t{Size} * id;
}

/// Names of all objects of a type (mjOBJ_BODY, …) that have one.
std::vector<std::string> names_of(const mjModel& model, mjtObj type);

/// The number of an object, −1 and a violation if there is none of that name. `where` begins the message.
int find(const mjModel& model, mjtObj type, const std::string& name, const std::string& where, Violations& violations);

/// The number of a hinge or slide. −1 and a violation if there is none of that name, or it is another kind of joint.
int find_scalar_joint(const mjModel& model, const std::string& name, const std::string& where, Violations& violations);

}  // namespace rehearse::mujoco
