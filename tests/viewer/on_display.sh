#!/usr/bin/env bash
# on_display.sh SCRIPT COMMAND...: runs COMMAND on a display of its own, and SCRIPT beside it once its window
# is there. SCRIPT is bash that sends keys and mouse motion with xdotool. Exits like COMMAND.
set -euo pipefail
script="$1"
shift

number="$(mktemp)"
Xvfb -displayfd 3 -screen 0 1280x720x24 3>"$number" 2>/dev/null &
server=$!
trap 'kill "$server" 2>/dev/null; rm -f "$number"' EXIT
for ((i = 0; i < 100; ++i)); do
  [[ -s "$number" ]] && break
  sleep 0.1
done
DISPLAY=":$(cat "$number")"
export DISPLAY

# In a sanitizer's build: the display's driver, unloaded when a window closes, keeps 240 bytes.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
"$@" &
program=$!
# Without a window manager, keys go to the window under the mouse.
timeout 60 xdotool search --sync --onlyvisible --name '^touchdown: ' >/dev/null
xdotool mousemove 300 400
eval "$script"
wait "$program"
