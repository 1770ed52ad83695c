// rehearse_reference FOLDER DATE: writes manual pages, completions of shells, and docs/command-line.md and
// docs/robot-file.md into a folder, from the definitions of the command line and the schema of robots' files. DATE: of
// the release.
#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "apps/catalogue.hpp"
#include "apps/reference/pages.hpp"
#include "rehearse/files/write.hpp"

namespace {

void write_all(const std::filesystem::path& folder, const std::string& date) {
  using namespace rehearse::apps;
  using rehearse::files::write_file;
  const Reference all = reference();
  const Vocabulary words = vocabulary(catalogue());
  for (const char* name : {"man", "bash", "zsh", "fish"}) std::filesystem::create_directories(folder / name);
  write_file(folder / "man/rehearse.1", man_page(all, date));
  for (const ReferenceCommand& command : all.commands)
    write_file(folder / "man" / ("rehearse-" + command.name + ".1"), man_page(all, command, date));
  write_file(folder / "command-line.md", markdown_page(all));
  write_file(folder / "robot-file.md", robot_page(robot_schema()));
  write_file(folder / "bash/rehearse", bash_completion(all, words));
  write_file(folder / "zsh/_rehearse", zsh_completion(all, words));
  write_file(folder / "fish/rehearse.fish", fish_completion(all, words));
}

}  // namespace

int main(int argc, char** argv) {
  static char name[] = "rehearse";
  ::program_invocation_short_name = name;  // examples call the program so
  if (argc != 3) return 2;
  try {
    write_all(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rehearse_reference: %s\n", error.what());
    return 1;
  }
  return 0;
}
