#include "apps/cli/signals.hpp"

#include <csignal>

namespace rehearse::apps {
namespace {

volatile std::sig_atomic_t remembered = 0;

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { remembered = signal; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

int caught_signal() { return remembered; }

int exit_code_of_signal() { return 128 + (remembered != 0 ? remembered : SIGTERM); }

}  // namespace rehearse::apps
