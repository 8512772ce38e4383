#!/usr/bin/env bash
# on_display.sh SCRIPT COMMAND...: runs COMMAND on a display of its own, and SCRIPT beside it once its window
# is drawn. SCRIPT is bash that sends keys and mouse motion with xdotool. Exits like COMMAND.
set -euo pipefail
script="$1"
shift

number="$(mktemp)"
Xvfb -displayfd 3 -screen 0 1280x720x24 3>"$number" 2>/dev/null &
server=$!
program=
trap 'kill $program "$server" 2>/dev/null; rm -f "$number"' EXIT
for ((i = 0; i < 100; ++i)); do
  [[ -s "$number" ]] && break
  sleep 0.1
done
DISPLAY=":$(cat "$number")"
export DISPLAY

# picture SIZE X Y: this part of the display, as bytes of red, green and blue.
picture() {
  ffmpeg -loglevel error -f x11grab -draw_mouse 0 -video_size "$1" -i "$DISPLAY+$2,$3" -frames:v 1 -f rawvideo -pix_fmt rgb24 -
}
has_colour() { [[ "$(picture 2x2 "$1" "$2" | od -An -tx1 -N3 | tr -d ' ')" == "$3" ]]; }
has_window() { xdotool search --onlyvisible --name '^touchdown: ' >/dev/null 2>&1; }
is_drawn() { (($(picture 600x400 0 0 | tr -d '\0' | wc -c) > 0)); } # an empty display is black

# expect WHAT COMMAND...: repeats a command until it succeeds. A busy machine may need seconds for a picture.
expect() {
  local -r last=$((SECONDS + 60))
  while ((SECONDS < last)) && kill -0 "$program" 2>/dev/null; do
    "${@:2}" && return
    sleep 0.1
  done
  echo "on_display.sh: expected $1" >&2
  return 1
}
until_shown() { expect "the colour $3 at $1, $2" has_colour "$@"; }
until_written() { expect "the text '$2' in $1" grep -qsF "$2" "$1"; }

# In a sanitizer's build: the display's driver, unloaded when a window closes, keeps 240 bytes.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
"$@" &
program=$!
expect "a window" has_window || wait "$program"
expect "a picture in the window" is_drawn
# Without a window manager, keys go to the window under the mouse.
xdotool mousemove 300 400
eval "$script"
wait "$program"
