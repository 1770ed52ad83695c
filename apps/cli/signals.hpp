#pragma once

namespace rehearse::apps {

/// From here on the first SIGINT or SIGTERM is only remembered, so that work stops where it can be continued; a second
/// one ends the process as usual.
void catch_signals();

/// 0 if there was none.
int caught_signal();

/// Of a process that stopped because of it, or because another rank was told to.
int exit_code_of_signal();

}  // namespace rehearse::apps
