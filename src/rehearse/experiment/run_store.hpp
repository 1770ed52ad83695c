#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "rehearse/experiment/spec.hpp"
#include "rehearse/learners/store.hpp"

namespace rehearse::experiment {

/// Names a folder that runs share, or none (an empty path); asked when it is first needed. Its files must come from the
/// same program on the same kind of machine: they are not checked further.
using CacheFolder = std::function<std::filesystem::path()>;

/// A learner's store: in the run's folder, `kept/NAME`, and in the cache, where runs of the same spec but for the
/// number of trials find it. A file of another spec, or a damaged one, counts as none. A cache that cannot be written
/// is left alone.
class RunStore final : public learners::Store {
 public:
  RunStore(const Spec& spec, CacheFolder cache);

  /// Sets the run folder; before that nothing is kept in one.
  void open(const std::filesystem::path& run_folder) { folder_ = run_folder; }

  std::optional<std::string> read(const std::string& name) override;
  void write(const std::string& name, const std::string& bytes) override;

 private:
  std::filesystem::path kept(const std::string& name) const;
  std::filesystem::path cached(const std::string& name);

  std::string owner_;        // the spec that it belongs to
  std::string older_owner_;  // … as older versions named it
  CacheFolder cache_;
  std::optional<std::filesystem::path> cache_folder_;
  std::filesystem::path folder_;
};

}  // namespace rehearse::experiment
