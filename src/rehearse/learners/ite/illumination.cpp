#include "rehearse/learners/ite/illumination.hpp"

#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::learners::ite {
namespace {

constexpr const char* kKept = "archive";
constexpr std::string_view kSeed = "{seed}";  // in the name of a file
constexpr int kRevision = 1;                  // of the code that makes archives; a new one makes kept archives stale
constexpr Index kCheckpointRows = 16384;      // evaluations between two states that are kept
constexpr Index kTriedAgain = 16;             // elites of an archive that was kept

/// Rollouts in the prior.
class Rollouts {
 public:
  explicit Rollouts(const Setting& setting)
      : model_(*setting.prior, setting.prior->space.values()),
        policy_(*setting.policy),
        evaluator_(*setting.evaluator),
        task_(setting.task) {
    task_.start_std.setZero();
  }

  void operator()(const ConstMatrixView& X, VectorView performances, MatrixView descriptors) const {
    thread_local rollout::Episodes episodes;
    thread_local Episode episode;
    rollout::simulate_episodes({model_, policy_, task_, {}, {.sample = false}}, X, {}, episodes, evaluator_);
    for (Index i = 0; i < X.rows(); ++i) {
      performances(i) = kNaN;
      if (episodes.failed[static_cast<std::size_t>(i)]) continue;
      episodes.copy(i, episode);
      const Vector descriptor = task_.descriptor(episode);
      if (descriptor.size() != descriptors.cols())
        throw InvalidInput(fmt::format("the task's descriptor has {} numbers, its descriptor_bounds {}",
                                       descriptor.size(), descriptors.cols()));
      performances(i) = episodes.returns(i);
      descriptors.row(i) = descriptor.transpose();
    }
  }

 private:
  dynamics::SimulatorModel model_;
  const policy::Policy& policy_;
  const Evaluator& evaluator_;
  Task task_;
};

/// The description of an archive in its file.
std::string about(const Setting& setting, IlluminationOptions options) {
  std::string text = fmt::format("ite archive {}\nseed = {}\n", kRevision, setting.seed);
  for (const auto& [name, value] : list_fields([&](FieldVisitor& v) { options.fields(v); }))
    text += fmt::format("{} = {}\n", name, value);
  if (setting.start)
    for (const double number : *setting.start) text += to_text(number) + "\n";
  return text;
}

class Illumination {
 public:
  Illumination(const Setting& setting, const IlluminationOptions& options)
      : setting_(setting), options_(options), rollouts_(setting), about_(about(setting, options)) {}

  qd::Search run() {
    auto kept = read();
    if (kept && !holds(*kept)) kept.reset();
    if (kept && kept->evaluations >= wanted()) return std::move(*kept);
    qd::MapElites search(empty_archive(), {.box = box(), .examples = examples()}, options_.search,
                         {.seed = setting_.seed});
    if (kept && kept->archive.niches() == search.archive().niches())
      search.resume(std::move(kept->archive), kept->evaluations, kept->failed);
    finish(search);
    keep(search);
    return state(search);
  }

 private:
  /// The policy's examples, and the policy that the run begins with.
  Matrix examples() const {
    Matrix all = setting_.policy->examples();
    if (!setting_.start) return all;
    all.conservativeResize(all.rows() + 1, setting_.start->size());
    all.bottomRows(1) = setting_.start->transpose();
    return all;
  }

  std::vector<Interval> box() const {
    return std::vector<Interval>(static_cast<std::size_t>(setting_.policy->parameters()),
                                 setting_.policy->box().value_or(Interval{-options_.box, options_.box}));
  }

  qd::Archive empty_archive() const {
    const auto& bounds = setting_.task.descriptor_bounds;
    const bool grid = options_.kind == IlluminationOptions::Kind::grid;
    const qd::Cvt cvt{.bounds = bounds,
                      .niches = options_.niches,
                      .samples = std::max<Index>(100000, 10 * options_.niches),
                      .seed = setting_.seed};
    return {grid ? qd::Niches(qd::Grid{bounds, std::vector<Index>(bounds.size(), options_.bins)})
                 : qd::Niches(cvt, *setting_.evaluator),
            setting_.policy->parameters()};
  }

  void finish(qd::MapElites& search) const {
    const auto evaluate = [this](const ConstMatrixView& X, std::uint64_t, VectorView performances,
                                 MatrixView descriptors) { rollouts_(X, performances, descriptors); };
    const Stopwatch watch;
    const std::uint64_t before = search.evaluations();
    std::uint64_t kept = before;
    while (search.evaluations() < wanted()) {
      search.step(evaluate, *setting_.evaluator);
      if (search.evaluations() - kept >= kCheckpointRows && search.evaluations() < wanted()) {
        kept = search.evaluations();
        keep(search);
      }
      report(search, watch.per_s(static_cast<Index>(search.evaluations() - before)));
    }
    if (search.archive().size() == 0)
      throw InvalidInput(fmt::format("no archive: all {} rollouts in the prior failed", search.evaluations()));
  }

  void report(const qd::MapElites& search, double per_s) const {
    if (!setting_.progress) return;
    const auto done = static_cast<double>(search.evaluations()) / static_cast<double>(options_.evaluations);
    setting_.progress({.phase = "archive",
                       .done = std::min(1.0, done),
                       .best = search.archive().statistics().best,
                       .rollouts = static_cast<Index>(search.evaluations()),
                       .rollouts_per_s = per_s});
  }

  std::uint64_t wanted() const { return static_cast<std::uint64_t>(options_.evaluations); }

  qd::Search state(const qd::MapElites& search) const {
    return {search.archive(), search.evaluations(), search.failed(), about_};
  }

  std::optional<qd::Search> read() const {
    const auto bytes = setting_.store ? setting_.store->read(kKept) : std::nullopt;
    if (!bytes) return {};
    try {
      qd::Search kept = qd::from_bytes(*bytes, kKept);
      if (kept.about == about_) return kept;
    } catch (const InvalidInput&) {  // of another version: it is made again
    }
    return {};
  }

  void keep(const qd::MapElites& search) const {
    if (setting_.store) setting_.store->write(kKept, to_bytes(state(search)));
  }

  /// True if some elites, spread evenly, perform as when they were kept; false after the simulator changed.
  bool holds(const qd::Search& kept) const {
    const qd::Archive& archive = kept.archive;
    if (archive.parameters() != setting_.policy->parameters() || archive.size() == 0) return false;
    return try_again(archive);
  }

  bool try_again(const qd::Archive& archive) const {
    const Index n = std::min(kTriedAgain, archive.size());
    Matrix X(n, archive.parameters()), descriptors(n, archive.niches().dimensions());
    Vector performances(n);
    const auto elite = [&](Index i) { return i * archive.size() / n; };
    for (Index i = 0; i < n; ++i) X.row(i) = archive.solution(elite(i)).transpose();
    rollouts_(X, performances, descriptors);
    for (Index i = 0; i < n; ++i)
      if (performances(i) != archive.performance(elite(i)) ||
          descriptors.row(i).transpose() != archive.descriptor(elite(i)))
        return false;
    return true;
  }

  const Setting& setting_;
  const IlluminationOptions& options_;
  Rollouts rollouts_;
  std::string about_;
};

/// An archive that somebody made. It is taken at its word: another version of the simulator may have made it. Throws
/// InvalidInput.
qd::Search read_archive(const std::string& file, const Task& task, const policy::Policy& policy) {
  const files::RegularFile bytes(file, O_RDONLY, files::Links::follow);
  if (!bytes.open()) throw InvalidInput(fmt::format("archive.file = {}: {}", file, bytes.problem()));
  qd::Search search = qd::from_bytes(bytes.read(), "archive.file = " + file);
  const Index parameters = search.archive.parameters(), dimensions = search.archive.niches().dimensions();
  const auto descriptors = static_cast<Index>(task.descriptor_bounds.size());
  Violations violations;
  violations.require(parameters == policy.parameters(),
                     fmt::format("archive.file = {}: its policies have {} parameters, must have {} as policy {} has",
                                 file, parameters, policy.parameters(), policy.name()));
  violations.require(dimensions == descriptors,
                     fmt::format("archive.file = {}: its descriptors have {} numbers, must have {} as the task's have",
                                 file, dimensions, descriptors));
  violations.require(search.archive.size() > 0, fmt::format("archive.file = {}: it is empty", file));
  violations.throw_if_any();
  return search;
}

std::optional<std::string> violation_of_file(const std::string& file, const Task& task, const policy::Policy& policy) {
  try {
    if (!file.empty() && file.find(kSeed) == std::string::npos) read_archive(file, task, policy);
    return {};
  } catch (const InvalidInput& wrong) {
    return wrong.what();
  }
}

}  // namespace

void IlluminationOptions::fields(FieldVisitor& v) {
  v.text("file", file, "file of an existing archive ({seed} stands for the run's seed); empty: one is made");
  v.choice("kind", kind, "niches: centroidal Voronoi tessellation (cvt) or regular grid", {"cvt", "grid"},
           published("grid", "Cully 2015"));
  v.integer("niches", niches, "niches of the tessellation", between(1, 1e7));
  v.integer("bins", bins, "bins of the grid, for each descriptor", between(1, 1e6));
  v.integer("evaluations", evaluations, "rollouts in the prior that make the archive", at_least(1),
            published(40000000, "Cully 2015"));
  v.number("box", box, "policy parameters are searched in [−box, box], unless the policy has bounds of its own",
           between(1e-6, 1e6));
  v.publish("search.examples", published(0, "Cully 2015"));
  v.publish("search.variation.kind", published("reset", "Cully 2015"));
  v.group("search", search, kExpert);
}

std::vector<std::string> violations(const IlluminationOptions& options, const Task& task,
                                    const policy::Policy& policy) {
  Violations violations;
  violations.require(static_cast<bool>(task.descriptor),
                     "learner ite needs a descriptor, numbers that say how an episode went, which the task does not "
                     "have: only a robot in C++ can give one, not a robot's file or one in Python (docs/ite.md); "
                     "choose the learner gp-mi or black-drops-prior");
  violations.require(task.limits.empty(),
                     "the task has limits, which ite does not keep: choose the learner gp-mi or black-drops-prior");
  if (task.descriptor)
    for (const std::string& line : qd::bounds_violations(task.descriptor_bounds))
      violations.add("descriptor_bounds of the task, which ite needs: " + line);
  const double niches = std::pow(options.bins, task.descriptor_bounds.size());
  violations.require(options.kind != IlluminationOptions::Kind::grid || niches <= qd::kMostNiches,
                     fmt::format("archive.bins = {} of {} descriptors are {:g} niches, must be ≤ {:g}", options.bins,
                                 task.descriptor_bounds.size(), niches, qd::kMostNiches));
  if (auto violation = violation_of_file(options.file, task, policy)) violations.add(*std::move(violation));
  return violations.list();
}

IlluminationOptions for_seed(IlluminationOptions options, std::uint64_t seed) {
  const std::size_t at = options.file.find(kSeed);
  if (at != std::string::npos) options.file.replace(at, kSeed.size(), std::to_string(seed));
  return options;
}

std::shared_ptr<const qd::Search> illuminate(const Setting& setting, const IlluminationOptions& options) {
  if (!options.file.empty())
    return std::make_shared<qd::Search>(read_archive(options.file, setting.task, *setting.policy));
  return std::make_shared<qd::Search>(Illumination(setting, options).run());
}

}  // namespace rehearse::learners::ite
