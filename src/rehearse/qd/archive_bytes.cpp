#include "rehearse/qd/archive_bytes.hpp"

#include <array>
#include <cstring>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/checksum.hpp"

namespace rehearse::qd {
namespace {

constexpr std::uint64_t kMostParameters = 10'000'000;  // of a policy
constexpr std::array<char, 8> kMagic{'R', 'H', 'S', 'A', 'R', 'C', 'H', '\n'};
constexpr std::uint32_t kVersion = 1, kByteOrder = 0x01020304, kOtherByteOrder = 0x04030201;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t byte_order = kByteOrder;
  std::uint64_t checksum = 0;  // of all that follows
  std::uint64_t about = 0;     // bytes
  std::uint64_t descriptors = 0, parameters = 0, niches = 0, elites = 0;
  std::uint64_t grid = 0;  // 1: a grid, 0: a tessellation
  std::uint64_t evaluations = 0, failed = 0;
};
static_assert(sizeof(Header) == 88);
constexpr std::size_t kUnchecked = offsetof(Header, about);  // bytes

/// Bytes after the header, as far as the sizes are sensible; of others more than any file has.
double body_size(const Header& h) {
  const auto D = static_cast<double>(h.descriptors), niches = static_cast<double>(h.niches);
  const auto elites = static_cast<double>(h.elites), P = static_cast<double>(h.parameters);
  return static_cast<double>(h.about) + 8 * (2 * D + (h.grid ? D : D * niches)) + elites * (4 + 8 * (1 + D + P));
}

class Writer {
 public:
  template <class T>
  void put(const T* values, Index n) {
    bytes_.append(reinterpret_cast<const char*>(values), static_cast<std::size_t>(n) * sizeof(T));
  }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

/// A reader of bytes. The caller ensures that there are enough.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void take(T* values, Index n) {
    const std::size_t size = static_cast<std::size_t>(n) * sizeof(T);
    std::memcpy(values, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

 private:
  std::string_view bytes_;
};

void put_niches(const Niches& niches, Writer& out) {
  for (const Interval& bound : niches.bounds()) out.put(&bound.low, 1), out.put(&bound.high, 1);
  for (const Index bins : niches.bins()) {
    const auto count = static_cast<std::uint64_t>(bins);
    out.put(&count, 1);
  }
  out.put(niches.centroids().data(), niches.centroids().size());
}

Niches take_niches(const Header& h, Reader& in) {
  const auto D = static_cast<Index>(h.descriptors);
  std::vector<Interval> bounds(h.descriptors);
  for (Interval& bound : bounds) in.take(&bound.low, 1), in.take(&bound.high, 1);
  if (h.grid) {
    std::vector<std::uint64_t> bins(h.descriptors);
    in.take(bins.data(), D);
    return Niches(Grid{bounds, {bins.begin(), bins.end()}});
  }
  Matrix centroids(D, static_cast<Index>(h.niches));
  in.take(centroids.data(), centroids.size());
  return Niches(std::move(bounds), std::move(centroids));
}

void put_elites(const Archive& archive, Writer& out) {
  for (Index e = 0; e < archive.size(); ++e) {
    const auto niche = static_cast<std::uint32_t>(archive.niche(e));
    const double performance = archive.performance(e);
    out.put(&niche, 1);
    out.put(&performance, 1);
    out.put(archive.descriptor(e).data(), archive.descriptor(e).size());
    out.put(archive.solution(e).data(), archive.parameters());
  }
}

void take_elites(const Header& h, Reader& in, Archive& archive) {
  Vector descriptor(archive.niches().dimensions()), solution(archive.parameters());
  for (std::uint64_t e = 0; e < h.elites; ++e) {
    std::uint32_t niche = 0;
    double performance = 0;
    in.take(&niche, 1);
    in.take(&performance, 1);
    in.take(descriptor.data(), descriptor.size());
    in.take(solution.data(), solution.size());
    const bool fits = niche < h.niches && archive.elite_of(niche) < 0 && descriptor.allFinite() && solution.allFinite();
    if (!fits || !archive.add(niche, performance, descriptor.data(), solution.data()))
      throw InvalidInput(fmt::format("elite {} contradicts the rest", e + 1));
  }
}

Header checked_header(std::string_view bytes) {
  Header h;
  if (bytes.size() < kMagic.size() || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    throw InvalidInput("not an archive of Rehearse");
  if (bytes.size() < sizeof(Header)) throw InvalidInput("truncated within the header");
  std::memcpy(&h, bytes.data(), sizeof(Header));
  if (h.byte_order == kOtherByteOrder) throw InvalidInput("written on a machine of the other byte order");
  if (h.version != kVersion)
    throw InvalidInput(
        fmt::format("format {}, of another version of Rehearse (this one reads {})", h.version, kVersion));
  const double expected = body_size(h) + sizeof(Header);
  if (static_cast<double>(bytes.size()) < expected)
    throw InvalidInput(fmt::format("truncated or damaged: {} bytes, should be {:.0f}", bytes.size(), expected));
  if (static_cast<double>(bytes.size()) > expected || h.byte_order != kByteOrder || h.grid > 1 ||
      h.checksum != files::checksum(bytes.substr(kUnchecked)))
    throw InvalidInput("damaged: the checksum does not fit");
  if (h.parameters > kMostParameters)  // that no elite has to vouch for
    throw InvalidInput(fmt::format("policies of {} numbers, must have at most {}", h.parameters, kMostParameters));
  return h;
}

Search read(std::string_view bytes) {
  const Header h = checked_header(bytes);
  Reader in(bytes.substr(sizeof(Header)));
  std::string about(h.about, '\0');
  in.take(about.data(), static_cast<Index>(h.about));
  Niches niches = take_niches(h, in);
  if (static_cast<std::uint64_t>(niches.size()) != h.niches)
    throw InvalidInput("its grid has another number of niches");
  Search search{Archive(std::move(niches), static_cast<Index>(h.parameters)), h.evaluations, h.failed, about};
  take_elites(h, in, search.archive);
  return search;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::string to_bytes(const Search& search) {
  const Archive& archive = search.archive;
  const Niches& niches = archive.niches();
  const Header h{.about = search.about.size(),
                 .descriptors = static_cast<std::uint64_t>(niches.dimensions()),
                 .parameters = static_cast<std::uint64_t>(archive.parameters()),
                 .niches = static_cast<std::uint64_t>(niches.size()),
                 .elites = static_cast<std::uint64_t>(archive.size()),
                 .grid = niches.is_grid(),
                 .evaluations = search.evaluations,
                 .failed = search.failed};
  Writer out;
  out.bytes().reserve(sizeof(Header) + static_cast<std::size_t>(body_size(h)));
  out.put(&h, 1);
  out.put(search.about.data(), static_cast<Index>(search.about.size()));
  put_niches(niches, out);
  put_elites(archive, out);
  fit_checksum(out.bytes());
  return std::move(out.bytes());
}

void fit_checksum(std::string& bytes) {
  if (bytes.size() <= kUnchecked) return;
  const std::uint64_t sum = files::checksum(std::string_view(bytes).substr(kUnchecked));
  std::memcpy(bytes.data() + offsetof(Header, checksum), &sum, sizeof sum);
}

Search from_bytes(std::string_view bytes, const std::string& name) {
  try {
    return read(bytes);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", name, first_line(error.what())));
  }
}

}  // namespace rehearse::qd
