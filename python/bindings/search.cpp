#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings/calls.hpp"
#include "python/bindings/interruption.hpp"
#include "python/bindings/options.hpp"
#include "python/bindings/pieces.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/optim/cmaes.hpp"
#include "rehearse/qd/map_elites.hpp"

namespace rehearse::python {
namespace {

std::vector<Interval> intervals(const std::vector<std::pair<double, double>>& pairs) {
  std::vector<Interval> result;
  for (const auto& [low, high] : pairs) result.push_back({low, high});
  return result;
}

using Pairs = std::vector<std::pair<double, double>>;

optim::Cmaes make_cmaes(const Vector& mean, double sigma, const Pairs& bounds, std::uint64_t seed,
                        const OptionTexts& texts) {
  require_processor();
  optim::CmaesOptions options;
  set_options([&](FieldVisitor& v) { options.fields(v); }, texts, {"bounds", "seed", "max_evaluations"});
  return {mean, sigma, intervals(bounds), options, StreamKey{.seed = seed, .purpose = Purpose::search}};
}

/// With the interpreter's lock, as all methods of a search: other threads may have the same one.
void tell_cmaes(optim::Cmaes& search, const Vector& values) {
  if (values.size() != search.population())
    throw InvalidInput(
        fmt::format("values has {} entries, must have {}, one a candidate", values.size(), search.population()));
  search.tell(values);
}

/// A space of descriptors: bins of a grid, or so many niches of a tessellation.
struct Space {
  Pairs bounds;
  std::vector<Index> bins;  // empty: a tessellation
  Index niches = 1000;
};

qd::Niches niches_of(const Space& space, std::uint64_t seed, const Evaluator& evaluator) {
  if (!space.bins.empty()) return qd::Niches(qd::Grid{intervals(space.bounds), space.bins});
  qd::Cvt cvt{.bounds = intervals(space.bounds), .niches = space.niches, .seed = seed};
  cvt.samples = std::max(cvt.samples, 10 * cvt.niches);
  return qd::Niches(cvt, evaluator);
}

qd::MapElites make_map_elites(const Pairs& bounds, const Space& space, std::uint64_t seed, const OptionTexts& texts) {
  require_processor();
  qd::MapElitesOptions options;
  set_options([&](FieldVisitor& v) { options.fields(v); }, texts, {"bins", "niches", "seed"});
  const auto parameters = static_cast<Index>(bounds.size());
  std::optional<qd::MapElites> search;
  do_unlocked(std::make_shared<Failure>(), [&](const std::function<bool()>& stop) {
    qd::Archive archive(niches_of(space, seed, *make_stoppable(make_thread_evaluator(1), stop)), parameters);
    search.emplace(std::move(archive), qd::SearchSpace{.box = intervals(bounds)}, options, StreamKey{.seed = seed});
  });
  return std::move(*search);
}

void tell_map_elites(qd::MapElites& search, const Vector& performances, const Matrix& descriptors) {
  const Index rows = search.ask().rows(), dimensions = search.archive().niches().dimensions();
  if (performances.size() != rows || descriptors.rows() != rows || descriptors.cols() != dimensions)
    throw InvalidInput(fmt::format("performances has {} entries and descriptors is {} × {}, must be {} and {} × {}",
                                   performances.size(), descriptors.rows(), descriptors.cols(), rows, rows,
                                   dimensions));
  search.tell(performances, descriptors);
}

py::dict elites_of(const qd::MapElites& search) {
  const qd::Archive& archive = search.archive();
  Matrix solutions(archive.size(), archive.parameters()), descriptors(archive.size(), archive.niches().dimensions());
  Vector performances(archive.size());
  std::vector<Index> niches;
  for (Index i = 0; i < archive.size(); ++i) {
    solutions.row(i) = archive.solution(i).transpose();
    descriptors.row(i) = archive.descriptor(i).transpose();
    performances(i) = archive.performance(i);
    niches.push_back(archive.niche(i));
  }
  return py::dict(py::arg("solutions") = solutions, py::arg("descriptors") = descriptors,
                  py::arg("performances") = performances, py::arg("niches") = niches);
}

py::dict statistics_of(const qd::MapElites& search, double floor) {
  const qd::Statistics s = search.archive().statistics(floor);
  return py::dict(py::arg("filled") = s.filled, py::arg("coverage") = s.coverage, py::arg("qd_score") = s.qd_score,
                  py::arg("best") = s.best, py::arg("mean") = s.mean);
}

}  // namespace

void add_search(py::module_& module) {
  using namespace py::literals;
  py::class_<optim::Cmaes>(module, "Cmaes")
      .def(py::init(&make_cmaes), "mean"_a, "sigma"_a, "bounds"_a, "seed"_a, "options"_a)
      .def("ask", [](optim::Cmaes& search) { return Matrix(search.ask().transpose()); })
      .def("tell", &tell_cmaes, "values"_a)
      .def_property_readonly("stop",
                             [](const optim::Cmaes& search) -> std::optional<std::string> {
                               if (search.stop() == optim::Stop::none) return {};
                               return to_string(search.stop());
                             })
      .def_property_readonly("best_x", [](const optim::Cmaes& search) { return search.best_x(); })
      .def_property_readonly("best_value", &optim::Cmaes::best_value)
      .def_property_readonly("mean", &optim::Cmaes::mean)
      .def_property_readonly("sigma", &optim::Cmaes::sigma)
      .def_property_readonly("evaluations", &optim::Cmaes::evaluations)
      .def_property_readonly("population", &optim::Cmaes::population);
  py::class_<qd::MapElites>(module, "MapElites")
      .def(py::init([](const Pairs& bounds, const Pairs& descriptor_bounds, const std::vector<Index>& bins,
                       Index niches, std::uint64_t seed, const OptionTexts& options) {
             return make_map_elites(bounds, {descriptor_bounds, bins, niches}, seed, options);
           }),
           "bounds"_a, "descriptor_bounds"_a, "bins"_a, "niches"_a, "seed"_a, "options"_a)
      .def("ask", [](qd::MapElites& search) { return search.ask(); })
      .def("tell", &tell_map_elites, "performances"_a, "descriptors"_a)
      .def("elites", &elites_of)
      .def("statistics", &statistics_of, "floor"_a)
      .def_property_readonly("evaluations", &qd::MapElites::evaluations);
}

}  // namespace rehearse::python
