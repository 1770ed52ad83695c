# Sourced: what the program says of itself by --help and `list`, from which nothing of apps/reference is made.

# Its commands.
commands_said() { "$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z]*\) .*/\1/p'; }

# flags_said COMMAND
flags_said() { "$program" "$1" --help | grep -oE '^  (-h,)?--[a-z-]+' | sed 's/.*--/--/'; }

# names_said Scenarios|Learners|Presets
names_said() { "$program" list | sed -n "/^$1/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p"; }
