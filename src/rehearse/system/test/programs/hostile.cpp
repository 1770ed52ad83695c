// A program that does harm, for tests: dX = X + u + φ, in the encoding that is asked for.
//
//   hostile_program ENCODING [MARK]      with a file MARK, harm is done until the file exists, which the first harm
//   makes
//
// A row's action says what it does for it (test/harm.hpp).

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

#include "rehearse/system/test/harm.hpp"

namespace {

using rehearse::system::Harm;
using Json = nlohmann::json;

bool in_json = false;
bool answered = false;  // by an error
std::string mark;

void raw(const void* data, std::size_t bytes) {
  std::cout.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes)).flush();
}
void line(const std::string& text) { std::cout << text << std::endl; }

void answer_wrongly(const std::string& json, std::int64_t number) {
  if (in_json)
    line(json);
  else
    raw(&number, sizeof number);
}

/// Does harm before an answer, or instead of it.
void harm(Harm kind) {
  if (!mark.empty()) {
    if (std::filesystem::exists(mark)) return;
    std::ofstream file(mark);
  }
  switch (kind) {
    case Harm::killed:
      std::raise(SIGKILL);
      break;
    case Harm::hung:
      pause();
      break;
    case Harm::failed:
      std::cerr << "impossible state" << std::endl;
      std::exit(1);
    case Harm::left:
      std::exit(0);
    case Harm::wrong_size:
      answer_wrongly(R"({"change":[[1.0]]})", 77);
      break;
    case Harm::no_answer:
      answer_wrongly(R"({"change":[[1.0,})", -1);
      break;
    case Harm::partial:
      std::cout << (in_json ? R"({"change":[[1.)" : std::string("\1\0\0\0", 4)) << std::flush;
      std::exit(0);
    case Harm::flood:
      for (const std::string words(10000, 'f');;) std::cout << words << std::flush;
    case Harm::crashed:
      std::raise(SIGSEGV);
      break;
    case Harm::error:
      line(R"({"error":"out of reach"})");
      answered = true;
      break;
    case Harm::noise:
      std::cerr << std::string(1 << 20, 'n') << std::endl;
      if (in_json) line("loading …\nloaded");
      break;
    case Harm::no_row:
      break;
  }
}

struct Asked {
  std::vector<std::vector<double>> states, actions;
  std::vector<double> parameters;
};

std::vector<std::vector<double>> answer_to(const Asked& asked) {
  std::vector<std::vector<double>> changes = asked.states;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const double u = asked.actions[i][0];
    if (u < 0) harm(static_cast<Harm>(static_cast<int>(u)));
    for (double& x : changes[i])
      x = u == static_cast<double>(Harm::no_row) ? std::numeric_limits<double>::quiet_NaN()
                                                 : x + u + asked.parameters[0];
  }
  return changes;
}

/// NaN is null, as JSON's writers have it.
void serve_json() {
  for (std::string text; std::getline(std::cin, text);) {
    const Json message = Json::parse(text).at("change");
    answered = false;
    const auto changes = answer_to({message.at("states"), message.at("actions"), message.at("parameters")});
    if (!answered) line(Json{{"change", changes}}.dump());
  }
}

std::vector<double> read_numbers(std::size_t count) {
  std::vector<double> numbers(count);
  std::cin.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(sizeof(double) * count));
  return numbers;
}

std::vector<std::vector<double>> read_rows(std::size_t rows, std::size_t columns) {
  std::vector<std::vector<double>> result(rows, std::vector<double>(columns));
  for (std::size_t c = 0; c < columns; ++c) {
    const std::vector<double> column = read_numbers(rows);
    for (std::size_t i = 0; i < rows; ++i) result[i][c] = column[i];
  }
  return result;
}

void serve_doubles(std::size_t dx, std::size_t du, std::size_t dphi) {
  for (std::int64_t n = 0; std::cin.read(reinterpret_cast<char*>(&n), sizeof n);) {
    Asked asked;
    asked.parameters = read_numbers(dphi);
    asked.states = read_rows(static_cast<std::size_t>(n), dx);
    asked.actions = read_rows(static_cast<std::size_t>(n), du);
    const auto changes = answer_to(asked);
    raw(&n, sizeof n);
    for (std::size_t c = 0; c < dx; ++c)
      for (const auto& row : changes) raw(&row[c], sizeof(double));
  }
}

}  // namespace

int main(int count, char** arguments) {
  constexpr rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  in_json = std::string(arguments[1]) == "json";
  if (count > 2) mark = arguments[2];
  std::ios::sync_with_stdio(false);
  line("a library says that it is loaded");
  std::string text;
  std::getline(std::cin, text);
  const Json hello = Json::parse(text);
  line(Json{{"rehearse", 1}, {"encoding", arguments[1]}}.dump());
  if (in_json)
    serve_json();
  else
    serve_doubles(hello.at("states").size(), hello.at("actions").size(), hello.at("parameters").size());
}
