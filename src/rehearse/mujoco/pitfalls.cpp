#include "rehearse/mujoco/pitfalls.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/files/regular_file.hpp"

namespace rehearse::mujoco {
namespace {

constexpr double kMostPoints = 4096. * 4096.;
constexpr std::string_view kSpace = " \t\r\n";

struct Tag {
  std::string_view name;
  std::map<std::string_view, std::string_view> attributes;

  std::string_view operator[](std::string_view attribute) const {
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? std::string_view() : found->second;
  }
};

/// The tags that begin elements.
class Tags {
 public:
  explicit Tags(std::string_view text) : left_(text) {}

  bool next(Tag& tag) {
    while (to('<')) {
      if (skip("!--", "-->") || skip("![CDATA[", "]]>") || skip("?", "?>") || skip("!", ">") || skip("/", ">"))
        continue;
      tag = {.name = word(" \t\r\n/><"), .attributes = {}};
      while (take_attribute(tag)) {
      }
      return true;
    }
    return false;
  }

 private:
  void drop(std::size_t size) { left_.remove_prefix(std::min(size, left_.size())); }
  void drop_space() { drop(left_.find_first_not_of(kSpace)); }

  bool to(char c) {
    const std::size_t at = left_.find(c);
    drop(at == std::string_view::npos ? at : at + 1);
    return at != std::string_view::npos;
  }

  bool skip(std::string_view begin, std::string_view end) {
    if (!left_.starts_with(begin)) return false;
    const std::size_t at = left_.find(end, begin.size());
    drop(at == std::string_view::npos ? at : at + end.size());
    return true;
  }

  std::string_view word(std::string_view ends) {
    const std::string_view word = left_.substr(0, left_.find_first_of(ends));
    drop(word.size());
    return word;
  }

  bool take_attribute(Tag& tag) {
    drop_space();
    const std::string_view name = word(" \t\r\n=/><");
    drop_space();
    if (name.empty() || !left_.starts_with('=')) return false;
    drop(1);
    drop_space();
    if (!left_.starts_with('"') && !left_.starts_with('\'')) return false;
    const std::string_view quote = left_.substr(0, 1);
    drop(1);
    tag.attributes.emplace(name, word(quote));
    drop(1);
    return true;
  }

  std::string_view left_;
};

/// A number of points along a side. References to characters could be any number.
double side(std::string_view text) {
  if (text.find('&') != std::string_view::npos) return kInf;
  return std::max(std::strtod(std::string(text).c_str(), nullptr), 0.);
}

const std::vector<std::string> kJointTypes = {"revolute", "continuous", "prismatic", "fixed", "floating", "planar"};

struct Sides {
  std::string_view element, first, second;
};
constexpr std::array<Sides, 2> kSides = {{{"texture", "width", "height"}, {"hfield", "nrow", "ncol"}}};

class Inspector {
 public:
  explicit Inspector(const std::string& path) : path_(path), files_{path} {}

  void inspect() {
    for (std::size_t i = 0; i < files_.size(); ++i) read(std::string(files_[i]));
    violations_.throw_if_any();
  }

 private:
  void read(const std::string& file) try {
    const std::string text = files::read_file(file, files::Links::follow);
    Tags tags(text);
    for (Tag tag; tags.next(tag);) take(file, tag);
  } catch (const InvalidInput&) {
    // MuJoCo says so.
  }

  void take(const std::string& file, const Tag& tag) {
    if (tag.name == "include") include(std::string(tag["file"]));
    is_urdf_ = is_urdf_ || tag.name == "robot";
    // Those of transmissions have none.
    if (is_urdf_ && tag.name == "joint" && tag.attributes.contains("type")) check_type(file, tag);
    for (const Sides& sides : kSides)
      if (tag.name == sides.element) add(file, tag, sides);
  }

  /// Included files are looked for beside the model, wherever the file that includes them is.
  void include(const std::string& name) {
    const std::string file = (std::filesystem::path(path_).parent_path() / name).string();
    if (std::find(files_.begin(), files_.end(), file) == files_.end()) files_.push_back(file);
  }

  void check_type(const std::string& file, const Tag& tag) {
    const std::string type(tag["type"]);
    if (!is_among(type, kJointTypes))
      violations_.add(
          fmt::format("{}: joint '{}': unknown type '{}'{}", file, tag["name"], type, suggestions(type, kJointTypes)));
  }

  void add(const std::string& file, const Tag& tag, const Sides& sides) {
    const double first = side(tag[sides.first]), second = side(tag[sides.second]);
    const bool cube = tag.name == "texture" && tag["type"] != "2d";  // of six squares, whatever its height
    const double points = first * (cube ? std::max(second, 6 * first) : second);
    if (points_ + points <= kMostPoints) {
      points_ += points;
      return;
    }
    violations_.add(
        fmt::format("{}: {} '{}': {} × {} = {} × {}{}, all textures and height fields of a model must have "
                    "≤ {} points together",
                    file, tag.name, tag["name"], sides.first, sides.second, tag[sides.first], tag[sides.second],
                    cube ? ", of a cube of six squares" : "", kMostPoints));
  }

  std::string path_;
  std::vector<std::string> files_;
  bool is_urdf_ = false;
  double points_ = 0;
  Violations violations_;
};

}  // namespace

void refuse_pitfalls(const std::string& path) { Inspector(path).inspect(); }

}  // namespace rehearse::mujoco
